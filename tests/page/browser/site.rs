//! The page as a folder of files, behind a server that knows nothing but files, and straight from disk: the browser solves.

use super::appearance::{SERIOUS, load_axe};
use super::chromium::{Chromium, installed};
use super::explorer::rested;
use super::lessons::{Means, all_are_played, play};
use super::page::Page;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A telephone and a screen.
const SIZES: [[u32; 2]; 2] = [[390, 844], [1440, 900]];

/// A lesson whose load can be turned.
const LESSON: &str = r#"
    title = "Two loads"
    knobs = { points = 512, cutoff = 64 }
    turn = { load = [0.2] }
    [[step]]
    text = "First."
    [[step]]
    text = "At last."
    knobs.body = "sine"
    knobs.roughness = 0
    turn = {}
    sweep = true
"#;

/// Writes a site into a folder.
fn export(folder: &Path, arguments: &[&str]) -> PathBuf {
    let site = folder.join("site");
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    let status = command.arg("explore").args(arguments).arg("--export").arg(&site).current_dir(folder).status();
    assert!(status.unwrap().success());
    site
}

/// A server of the files of a folder, below `/courses/contact/`.
struct Files {
    origin: String,
    is_down: Arc<AtomicBool>,
}

impl Files {
    fn serve(site: PathBuf) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let origin = format!("http://{}", listener.local_addr().unwrap());
        let is_down = Arc::new(AtomicBool::new(false));
        let is_gone = Arc::clone(&is_down);
        std::thread::spawn(move || {
            for mut stream in listener.incoming().flatten() {
                let (site, is_gone) = (site.clone(), Arc::clone(&is_gone));
                std::thread::spawn(move || {
                    let mut head = BufReader::new(stream.try_clone().unwrap()).lines();
                    let first = head.next().and_then(Result::ok).unwrap_or_default();
                    while head.next().is_some_and(|line| line.is_ok_and(|line| !line.is_empty())) {}
                    if is_gone.load(Ordering::Relaxed) {
                        return; // which closes the connection, also one that was opened before
                    }
                    let path = first.split([' ', '?']).nth(1).unwrap_or_default();
                    let (head, body) = answer(&site, path);
                    stream.write_all(head.as_bytes()).and_then(|()| stream.write_all(&body)).ok(); // a browser that has gone needs nothing
                });
            }
        });
        Self { origin, is_down }
    }

    fn address(&self) -> String {
        format!("{}/courses/contact/?theme=dark&language=en", self.origin)
    }
}

/// Head and body of the answer at a path.
fn answer(site: &Path, path: &str) -> (String, Vec<u8>) {
    let name = path.strip_prefix("/courses/contact/").map(|it| if it.is_empty() { "index.html" } else { it });
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
    let length = body.len();
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n"
    );
    (head, body)
}

/// The address of a site as a double click opens it.
fn on_disk(site: &Path) -> String {
    format!("file://{}?theme=dark", site.join("index.html").display())
}

/// Opens a page, in a browser without graphics, and waits for its solver.
fn open(page: &mut Page, address: &str) {
    page.open(address);
    page.until("document.body.dataset.section !== undefined && document.body.dataset.solver === 'ready'");
    assert_eq!(page.text("byId('solver').innerText"), "solved in this browser");
}

/// Nothing was asked of another host. What the Rerun viewer asks of one, the policy of the page blocks; without the viewer it blocks nothing.
fn stays_at_home(page: &Page, own: &str, has_viewer: bool) {
    let is_own = |url: &str| ["data:", "blob:", "about:", own].iter().any(|start| url.starts_with(start));
    let failed = page.chromium.events("Network.loadingFailed");
    let blocked: Vec<_> = failed.filter(|it| it["blockedReason"] == "csp").map(|it| &it["requestId"]).collect();
    let sent = page.chromium.events("Network.requestWillBeSent").filter(|it| !blocked.contains(&&it["requestId"]));
    let outward: Vec<&str> = sent.map(|it| it["request"]["url"].as_str().unwrap()).filter(|url| !is_own(url)).collect();
    assert_eq!(outward, [""; 0]);
    let told = page.chromium.events("Log.entryAdded").map(|it| it["entry"]["text"].as_str().unwrap());
    let told = told.filter(|text| text.contains("Content Security Policy")).count();
    assert!(has_viewer || (told == 0 && blocked.is_empty()), "the policy blocked something");
}

/// Plays lessons to their ends on a slow machine.
fn are_played(page: &mut Page, size: [u32; 2], lessons: &[Value]) {
    page.resize(size);
    page.chromium.page("Emulation.setCPUThrottlingRate", json!({"rate": 4}));
    for lesson in lessons {
        play(None, page, lesson, Means::Mouse);
    }
    page.chromium.page("Emulation.setCPUThrottlingRate", json!({"rate": 1}));
}

/// All lessons are played by finger on a German telephone, and then the network goes.
#[test]
fn a_site_is_played_without_a_server_and_without_a_network() {
    let Some(program) = installed() else { return };
    let folder = tempfile::tempdir().unwrap();
    let files = Files::serve(export(folder.path(), &["--no-recordings"]));
    let mut page = Page { chromium: Chromium::without_graphics(&program) };
    page.resize(SIZES[0]);
    page.chromium.page("Emulation.setTouchEmulationEnabled", json!({"enabled": true, "maxTouchPoints": 1}));
    page.follow(&files.address().replace("language=en", "language=de"));
    page.until("document.body.dataset.solver === 'ready'");
    all_are_played(&mut page, Means::Finger);
    open(&mut page, &files.address());
    if load_axe(&mut page) {
        assert_eq!(page.value(SERIOUS), json!([]));
    }
    assert_eq!(page.value("['view-viewer', 'view-both', 'save-rrd'].every((id) => byId(id).disabled)"), true);
    stays_at_home(&page, &format!("{}/courses/contact/", files.origin), false);
    page.until("navigator.serviceWorker.ready.then(({ active }) => active.state === 'activated')");
    files.is_down.store(true, Ordering::Relaxed);
    open(&mut page, &files.address());
    turn_the_load(&mut page);
    assert_eq!(page.value("fetch('nothing.js').then(() => 'there', () => 'gone')"), "gone", "the server is down");
}

/// All lessons to their ends on a telephone and a screen, from a server of files and from disk.
#[test]
#[ignore = "takes minutes"]
fn all_lessons_are_played_without_a_server() {
    let Some(program) = installed() else { return };
    let folder = tempfile::tempdir().unwrap();
    let site = export(folder.path(), &["--no-recordings"]);
    let files = Files::serve(site.clone());
    for address in [files.address(), on_disk(&site)] {
        for size in SIZES {
            let mut page = Page { chromium: Chromium::without_graphics(&program) };
            page.resize(size);
            open(&mut page, &address);
            let lessons = page.value("lessons");
            are_played(&mut page, size, lessons.as_array().unwrap());
        }
    }
}

/// Another load is solved in the browser, and its numbers are shown.
fn turn_the_load(page: &mut Page) {
    page.type_into("control-load-value", "0.123");
    rested(page);
    assert_eq!(page.value("latest().knobs.load"), 0.123);
    let shown = page.text("document.querySelector('#numbers td[data-number=relative_area]').innerText");
    assert_eq!(shown, page.text("figure(latest().numbers.relative_area)"));
    assert!(page.value("document.getElementById('fault').hidden") == true);
}

/// What a person does with a page from disk: turn, stop, press, open a file, ask why, and save.
#[test]
fn a_page_from_disk_solves() {
    let Some(program) = installed() else { return };
    let folder = tempfile::tempdir().unwrap();
    let site = export(folder.path(), &["--no-recordings"]);
    let mut page = Page { chromium: Chromium::without_graphics(&program) };
    page.resize(SIZES[1]);
    open(&mut page, &on_disk(&site));
    turn_the_load(&mut page);
    page.click("sweep");
    page.until("report.sweep?.ended && !report.busy");
    assert_eq!(page.value("document.querySelectorAll('#chart-area polyline.computed').length"), 1);
    a_relaxation_is_watched_and_stopped(&mut page);
    the_newest_order_wins(&mut page);
    page.value("(takeGrip('press'), press(0.5 * section.highest), true)");
    page.until("document.body.dataset.held !== undefined && !holding");
    page.value("(letGo(), true)");
    rested(&mut page);
    page.click("why");
    page.until("document.body.dataset.why === latest().id");
    assert_eq!(page.value("document.querySelectorAll('#why-causes li').length > 0"), true);
    page.press("Escape");
    a_file_stays_in_the_browser(&mut page);
    page.click("save-npz");
    page.chromium.told("Browser.downloadProgress", |event| event["state"] == "completed");
    let saved = std::fs::read_dir(page.chromium.downloads()).unwrap().next().unwrap().unwrap().path();
    assert!(std::fs::read(saved).unwrap().starts_with(b"PK"));
    a_solver_that_breaks_begins_again(&mut page);
}

/// Where the module cannot begin, the page says so and keeps its first picture.
#[test]
fn a_browser_that_cannot_run_the_module_is_told() {
    let Some(program) = installed() else { return };
    let folder = tempfile::tempdir().unwrap();
    let site = export(folder.path(), &["--no-recordings"]);
    std::fs::write(site.join("module.js"), "const MODULE = \"AAAA\";").unwrap();
    let mut page = Page { chromium: Chromium::without_graphics(&program) };
    page.open(&on_disk(&site));
    page.until("byId('fault').innerText.startsWith('This browser cannot run the solver (')");
    assert_eq!(page.value("section.pressure.some((p) => p > 0)"), true);
}

/// Where the module cannot be had from the server, it is the network that is named, and not the browser.
#[test]
fn a_module_that_cannot_be_loaded_is_told() {
    let Some(program) = installed() else { return };
    let folder = tempfile::tempdir().unwrap();
    let site = export(folder.path(), &["--no-recordings"]);
    std::fs::remove_file(site.join("module.packed")).unwrap();
    let files = Files::serve(site);
    let mut page = Page { chromium: Chromium::without_graphics(&program) };
    page.open(&format!("{}&language=en", files.address()));
    page.until("byId('fault').innerText.startsWith('The file module.packed could not be loaded')");
    assert_eq!(page.value("section.pressure.some((p) => p > 0)"), true);
}

/// GFMD shows its steps while it runs, and ends when it is told to.
fn a_relaxation_is_watched_and_stopped(page: &mut Page) {
    let long = "{ solver: { method: 'gfmd', ...{ masses: 'uniform', dynamics: 'damped', damping: 1, 'time-step': 0.5 } }, points: 65536, stop: { tolerance: 1e-12, 'max-iterations': 20000 } }";
    page.value(&format!("(knobs = {{ ...knobs, ...{long} }}, show(), changed(), true)"));
    page.until("document.body.dataset.running === latest().id && latest().numbers.iterations > 20");
    assert_eq!(page.value("section.pressure.some((p) => p > 0)"), true);
    page.click("cancel");
    page.until("!report.busy && latest().ended && latest().numbers.status === 'stopped by the observer'");
}

/// A running solve ends for the next order, which is the one that is shown.
fn the_newest_order_wins(page: &mut Page) {
    page.value("(knobs = { ...knobs, load: 0.3 }, show(), changed(), true)");
    page.until("report.busy && latest().knobs.load === 0.3");
    let next = "{ solver: { method: 'multilevel' }, points: 4096, load: 0.07, stop: { tolerance: 1e-8, 'max-iterations': 20000 } }";
    page.value(&format!("(knobs = {{ ...knobs, ...{next} }}, show(), changed(), true)"));
    rested(page);
    assert_eq!(page.value("[latest().knobs.load, latest().numbers.status]"), json!([0.07, "converged"]));
}

/// A map of heights is read, described and solved, and sent nowhere.
fn a_file_stays_in_the_browser(page: &mut Page) {
    let row = |y: usize| (0..16).map(|x| format!("{:.3}", ((x * y) as f64 * 0.3).sin())).collect::<Vec<_>>().join("\t");
    let text = (0..16).map(row).collect::<Vec<_>>().join("\n");
    let sent = |page: &Page| {
        let urls = page.chromium.events("Network.requestWillBeSent").map(|it| it["request"]["url"].as_str().unwrap());
        urls.filter(|url| !url.starts_with("blob:")).count()
    };
    let before = sent(page);
    page.value(&format!("takeFile(new File([{}], 'map.txt')).then(() => true)", json!(text)));
    page.until("byId('fault').innerText.startsWith('The file states no size. Type its Width')");
    page.type_into("heights-width", "10 um");
    rested(page);
    assert_eq!(page.value("[knobs.body, section.y === null]"), json!(["file", false]));
    let told = page.text("byId('group-file').innerText");
    assert!(told.contains("This page reads it, and sends it nowhere.") && told.contains("16 x 16"), "{told}");
    page.value("takeFile(new File(['no numbers'], 'prose.txt')).then(() => true)");
    page.until("byId('fault').innerText.startsWith('prose.txt ')");
    assert_eq!(sent(page), before, "the file went somewhere");
}

/// A module that fails is replaced, and the page says so and works on.
fn a_solver_that_breaks_begins_again(page: &mut Page) {
    page.value(
        "(knobs = { ...knobs, body: 'flat', domain: 'line', points: 512, cutoff: 64 }, show(), changed(), true)",
    );
    rested(page);
    page.value("solver.then((engine) => (replace(engine, 'unreachable'), true))");
    page.until(
        "byId('fault').innerText.startsWith('The solver in the browser failed on these settings (unreachable)')",
    );
    turn_the_load(page);
}

/// The viewer is loaded when it is asked for, and shows the states of the lesson that are recorded.
#[test]
fn a_site_shows_recordings_on_demand() {
    let Some(program) = installed() else { return };
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("lessons")).unwrap();
    std::fs::write(folder.path().join("lessons/two.toml"), LESSON).unwrap();
    let site = export(folder.path(), &["--lessons", "lessons"]);
    let files = Files::serve(site.clone());
    let mut page = Page { chromium: Chromium::start(&program) };
    page.resize(SIZES[1]);
    open(&mut page, &format!("{}&renderer=webgl", files.address()));
    page.press_at("lesson", "t");
    page.until("document.body.dataset.lesson === '0'");
    rested(&mut page);
    let is_viewer = |it: &Value| it["request"]["url"].as_str().unwrap().contains("re_viewer");
    assert_eq!(page.chromium.events("Network.requestWillBeSent").filter(|it| is_viewer(it)).count(), 0);
    page.click("view-both");
    page.until(
        "document.body.dataset.viewer === 'started' && (document.body.dataset.shown || '').startsWith(latest().id)",
    );
    page.until("!isReading() && !isAwake()");
    page.type_into("control-load-value", "0.07");
    rested_in_picture(&mut page);
    assert!(page.text("byId('viewer-note').innerText").starts_with("There is no recording of this state."));
    assert_eq!(page.value("byId('save-rrd').disabled"), true);
    page.type_into("control-load-value", "0.2");
    page.until(
        "latest().knobs.load === 0.2 && latest().ended && (document.body.dataset.shown || '').startsWith(latest().id)",
    );
    assert_eq!(page.value("byId('viewer-note').hidden && !byId('save-rrd').disabled"), true);
    page.click("lesson-next");
    page.until("document.body.dataset.sweep === 'ended' && (document.body.dataset.shown || '').startsWith('sweep-')");
    stays_at_home(&page, &format!("{}/courses/contact/", files.origin), true);
    open(&mut page, &on_disk(&site));
    let why = page.text("byId('view-viewer').disabled ? byId('view-viewer').title : 'it can be pressed'");
    assert!(why.starts_with("A browser does not let a page that is opened from a folder start the viewer."), "{why}");
}

/// Waits until the page's own picture shows the run of the knobs.
fn rested_in_picture(page: &mut Page) {
    page.until("!report.busy && latest().ended && words(latest().knobs) === words(knobs) && document.body.dataset.section === latest().id");
}

/// Opens a site without recordings behind a server of files, which goes on as long as what is returned.
pub fn served(page: &mut Page, folder: &Path) -> impl Sized + use<> {
    let files = Files::serve(export(folder, &["--no-recordings"]));
    open(page, &format!("{}&language=en", files.address()));
    files
}
