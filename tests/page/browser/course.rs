//! The lessons as a folder of files, behind a server that knows nothing but files, and straight from disk.

use super::chromium::{Chromium, installed};
use super::explorer::ROOMY;
use super::page::Page;
use serde_json::json;
use std::io::{BufRead, BufReader, Write};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A lesson whose load can be turned.
const LESSON: &str = r#"
    title = "Two loads"
    knobs = { points = 512, cutoff = 64 }
    turn = { load = [0.02, 0.2], solver = [{ method = "polonsky-keer" }] }
    [[step]]
    text = "First."
    [[step]]
    text = "Then."
    knobs.load = 0.02
    [[step]]
    text = "At last."
    knobs.body = "sine"
    knobs.roughness = 0
    turn = {}
    sweep = true
    [[step]]
    text = "It is there."
    turn = {}
    ask = { kind = "choose", question = "Is it there?", choices = ["Yes", "No"], right = 1 }
"#;

/// Exports the lesson into a folder.
fn course(folder: &Path) -> PathBuf {
    let (lessons, site) = (folder.join("lessons"), folder.join("site"));
    std::fs::create_dir(&lessons).unwrap();
    std::fs::write(lessons.join("two.toml"), LESSON).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    let status = command.args(["explore", "--lessons"]).arg(lessons).arg("--export").arg(&site).status();
    assert!(status.unwrap().success());
    site
}

/// Serves a folder below `/courses/contact/`, and returns its origin.
fn serve(site: PathBuf) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let origin = format!("http://{}", listener.local_addr().unwrap());
    std::thread::spawn(move || {
        for mut stream in listener.incoming().flatten() {
            let site = site.clone();
            std::thread::spawn(move || {
                let mut head = BufReader::new(stream.try_clone().unwrap()).lines();
                let first = head.next().and_then(Result::ok).unwrap_or_default();
                while head.next().is_some_and(|line| line.is_ok_and(|line| !line.is_empty())) {}
                let path = first.split([' ', '?']).nth(1).unwrap_or_default();
                let name =
                    path.strip_prefix("/courses/contact/").map(|it| if it.is_empty() { "index.html" } else { it });
                let kind = match name.and_then(|name| name.rsplit('.').next()) {
                    Some("html") => "text/html",
                    Some("js") => "text/javascript",
                    Some("css") => "text/css",
                    Some("svg") => "image/svg+xml",
                    Some("wasm") => "application/wasm",
                    _ => "application/octet-stream",
                };
                let (status, body) = match name.map(|name| std::fs::read(site.join(name))) {
                    Some(Ok(body)) => ("200 OK", body),
                    _ => ("404 Not Found", Vec::new()),
                };
                let head = format!(
                    "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
                    body.len()
                );
                stream.write_all(head.as_bytes()).and_then(|()| stream.write_all(&body)).ok(); // a browser that has gone needs nothing
            });
        }
    });
    origin
}

const FAULT: &str = "document.getElementById('fault').innerText";
const LOAD: &str = "document.getElementById('control-load')";

/// Waits until the run of a load is shown in the table.
fn shows(page: &mut Page, load: f64) {
    page.until(&format!("shownOrLatest()?.knobs.load === {load} && document.body.dataset.run === shownRun"));
    let shown = page.text("document.querySelector('#numbers td[data-number=kappa]').innerText");
    let solved = page.text("figure(solvedRun(knobs).numbers.kappa)");
    assert_eq!(shown, solved);
}

/// The lesson is walked through, its load turned; `draws` says whether the viewer follows.
fn a_lesson_is_taken(page: &mut Page, draws: bool) {
    page.until("document.body.dataset.run !== undefined");
    page.press_at("lesson", "t");
    page.until("document.body.dataset.lesson === '0'");
    shows(page, 0.05);
    assert_eq!(
        page.value(&format!("[{LOAD}.min, {LOAD}.max, {LOAD}.value, {LOAD}.disabled]")),
        json!(["0", "2", "1", false])
    );
    let said = page.text("document.getElementById('solved').innerText");
    assert!(said.contains("p* 0.02, 0.05, 0.2") && said.contains("Conjugate gradients"), "{said}");
    page.press_at("control-load", "ArrowRight");
    shows(page, 0.2);
    page.press_at("control-load", "ArrowLeft");
    page.press_at("control-load", "ArrowLeft");
    shows(page, 0.02);
    page.press_at("control-solver", "ArrowDown");
    page.until("latest().knobs.solver.method === 'polonsky-keer'");
    page.press_at("control-solver", "Home");
    page.until("latest().knobs.solver.method === 'multilevel'");
    let idle = "['hurst', 'seed', 'points', 'domain', 'body', 'tolerance'].filter((id) => !document.getElementById(`control-${id}`).disabled)";
    assert_eq!(page.value(idle), json!([]));
    assert_eq!(
        page.value("['sweep', 'dice', 'open-file', 'save-npz'].filter((id) => !document.getElementById(id).disabled)"),
        json!([])
    );
    page.press_at("play", "d");
    page.until(&format!("{FAULT}.startsWith('This course page cannot show that. It can show: p* 0.02')"));
    if draws {
        page.until("document.body.dataset.shown !== undefined && !isReading()");
        page.settled();
    }
    page.click("lesson-next");
    shows(page, 0.02);
    page.click("lesson-next");
    page.until("document.body.dataset.sweep === 'ended'");
    assert_eq!(page.value("document.querySelectorAll('#chart-area polyline.computed').length"), 1);
    page.click("lesson-back");
    shows(page, 0.02);
    assert_eq!(page.value("document.getElementById('fault').hidden"), true);
    a_question_is_answered(page);
}

/// The step that asks shows its surface before it is pressed, and its contact after the answer.
fn a_question_is_answered(page: &mut Page) {
    page.click("lesson-next");
    page.until("document.body.dataset.lesson === '2' && !byId('lesson-next').disabled");
    page.click("lesson-next");
    page.until("document.body.dataset.unpressed === '3'");
    assert_eq!(page.value("section.pressure.some((pressure) => pressure > 0)"), false);
    page.click("answer-1");
    shows(page, 0.05);
    page.until("section.pressure.some((pressure) => pressure > 0)");
}

#[test]
fn a_course_needs_no_server_of_its_own() {
    let Some(program) = installed() else { return };
    let folder = tempfile::tempdir().unwrap();
    let site = course(folder.path());
    let origin = serve(site.clone());
    let mut page = Page { chromium: Chromium::start(&program) };
    page.resize(ROOMY);
    page.open(&format!("{origin}/courses/contact/?renderer=webgl&theme=dark"));
    page.until("document.body.dataset.viewer === 'started'");
    a_lesson_is_taken(&mut page, true);
    let own = format!("{origin}/courses/contact/");
    let is_own = |url: &str| ["data:", "blob:", "about:", &own].iter().any(|start| url.starts_with(start));
    let blocked: Vec<_> = page
        .chromium
        .events("Network.loadingFailed")
        .filter(|it| it["blockedReason"] == "csp")
        .map(|it| &it["requestId"])
        .collect();
    let sent = page.chromium.events("Network.requestWillBeSent").filter(|it| !blocked.contains(&&it["requestId"]));
    let outward: Vec<&str> = sent.map(|it| it["request"]["url"].as_str().unwrap()).filter(|url| !is_own(url)).collect();
    assert_eq!(outward, [""; 0]);
    page.open(&format!("file://{}?theme=dark", site.join("index.html").display()));
    page.until("document.body.dataset.viewer === 'failed'");
    let note = page.text("document.getElementById('viewer-note').innerText");
    assert!(note.starts_with("Browsers do not let a page that is opened from a folder read files"), "{note}");
    a_lesson_is_taken(&mut page, false);
}
