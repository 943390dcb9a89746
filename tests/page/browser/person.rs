//! A person at the page: deeds, and the sights that follow.

use super::chromium::{Chromium, installed};
use super::downloads::{recording, save};
use super::explorer::{Explorer, opened, rested};
use super::page::{Page, difference};
use asperity::setup::{Setup, command};
use resvg::{tiny_skia::Pixmap, usvg};
use serde_json::{Value, json};
use std::collections::HashSet;
use std::fs::File;
use std::time::Instant;

/// The latest run as the server tells it.
fn run(explorer: &Explorer) -> Value {
    explorer.state()["run"].clone()
}

/// The number in the first column of the table, in the row of an observable, without the error that may stand beside it.
fn number(page: &mut Page, name: &str) -> f64 {
    let shown = page.text(&format!("document.querySelector('#numbers td[data-number=\"{name}\"]').innerText"));
    shown.split(" ±").next().unwrap().parse().unwrap()
}

/// Table and controls hold what the server tells of the latest run.
fn agrees(explorer: &Explorer, page: &mut Page) -> Value {
    rested(page);
    let run = run(explorer);
    assert_eq!(page.text("document.body.dataset.status"), run["numbers"]["status"].as_str().unwrap());
    for name in ["kappa", "kappa_r", "relative_area", "certificate"] {
        let (shown, told) = (number(page, name), run["numbers"][name].as_f64().unwrap());
        assert!((shown / told - 1.0).abs() < 6e-3, "{name} is shown as {shown} and is {told}");
    }
    run
}

fn the_viewer_draws(page: &mut Page) {
    let picture = page.settled();
    let background = picture[0];
    let (drawn, colours) =
        (difference(&picture, &vec![background; picture.len()]), HashSet::<_>::from_iter(&picture).len());
    assert!(drawn > 0.02 && colours > 30, "{drawn} of the viewer is not background, in {colours} colours");
    assert_eq!(page.value("document.getElementById('viewer-note').hidden"), true);
}

fn the_load_moves_the_contact(explorer: &Explorer, page: &mut Page) {
    let (before, picture) = (agrees(explorer, page), page.settled());
    for _ in 0..25 {
        page.press_at("control-load", "ArrowRight");
    }
    let after = agrees(explorer, page);
    let load = |run: &Value| run["knobs"]["load"].as_f64().unwrap();
    assert!((load(&after) / load(&before) / 10f64.sqrt() - 1.0).abs() < 1e-2, "{} to {}", load(&before), load(&after));
    let kappa = |run: &Value| run["numbers"]["kappa"].as_f64().unwrap();
    assert!(kappa(&after) < 0.9 * kappa(&before), "{} to {}", kappa(&before), kappa(&after));
    page.until_redrawn(&picture, 0.01);
}

fn solvers_and_geometries_switch(explorer: &Explorer, page: &mut Page) {
    let line = agrees(explorer, page)["numbers"].clone();
    page.press_at("control-solver", "ArrowDown");
    let gradients = agrees(explorer, page);
    assert_eq!(gradients["knobs"]["solver"]["method"], "polonsky-keer");
    assert_eq!(gradients["numbers"]["relative_area_counted"], line["relative_area_counted"]);
    assert_ne!(gradients["numbers"]["transforms"], line["transforms"]);
    assert_eq!(page.value("document.getElementById('row-masses').hidden"), true);
    page.press_at("control-solver", "ArrowDown");
    assert_eq!(page.value("document.getElementById('row-masses').hidden"), false);
    assert_eq!(agrees(explorer, page)["knobs"]["solver"]["method"], "gfmd");
    page.press_at("control-solver", "Home");
    agrees(explorer, page);
    page.press_at("control-domain", "ArrowDown");
    let surface = agrees(explorer, page);
    assert_eq!((&surface["knobs"]["domain"], &surface["knobs"]["points"]), (&json!("surface"), &json!(256)));
    page.press_at("control-domain", "ArrowUp");
    assert_eq!(agrees(explorer, page)["knobs"]["domain"], "line");
}

fn runs_are_compared(explorer: &Explorer, page: &mut Page) {
    let first = agrees(explorer, page);
    page.click("pin");
    page.click("dice");
    let second = agrees(explorer, page);
    assert_ne!(first["knobs"]["seed"], second["knobs"]["seed"]);
    let shown = |run: &Value| format!("document.body.dataset.run === {}", run["id"]);
    page.click("swap");
    page.until(&shown(&first));
    page.click("swap");
    page.until(&shown(&second));
    page.click("pin");
    assert_eq!(page.value("document.getElementById('runs').options.length"), 6);
}

/// The step that the viewer shows, and the last that it has.
const STEP: &str = "viewer.get_time_for_timeline(shownRun, 'step')";
const LAST: &str = "viewer.get_timeline_time_range(shownRun, 'step').max";

fn a_run_plays(page: &mut Page) {
    page.settled();
    page.value("seek(1)");
    page.until(&format!("{STEP} === {LAST}"));
    let picture = page.settled();
    page.press_at("scrub", "Home");
    assert_eq!(page.text("document.getElementById('scrub-step').value"), "step 0");
    page.until(&format!("{STEP} === 0"));
    page.until_redrawn(&picture, 0.001);
    page.value("document.getElementById('duration').value = 0.9");
    page.click("play");
    page.until(
        "document.getElementById('play').textContent === 'Play' && document.getElementById('scrub').value === '1000'",
    );
}

/// What the viewer tells of a click into an image over steps takes it to the step at that place; clicks elsewhere do not.
fn a_picked_step_is_shown(page: &mut Page) {
    let pick = |entity: &str| {
        let item = format!("{{ type: 'entity', entity_path: '/rough_line/{entity}', position: [250, 9, 0] }}");
        format!("heardViewer(JSON.stringify({{ type: 'selection_change', recording_id: shownRun, items: [{item}] }}))")
    };
    page.value("seek(1)");
    page.until(&format!("{STEP} === {LAST}"));
    page.value(&pick("pressure/image"));
    page.settled();
    assert_eq!(page.value(&format!("{STEP} === {LAST}")), true, "a click into a field went to a step");
    page.value(&pick("raster/image"));
    page.until(&format!("{STEP} === Math.floor(({LAST} + 1) / 4)"));
}

fn a_sweep_draws_its_curves(explorer: &Explorer, page: &mut Page) {
    page.click("sweep");
    page.until("document.body.dataset.sweep === 'ended' && document.body.dataset.busy === 'false'");
    let points = explorer.state()["sweep"]["points"].as_array().unwrap().clone();
    assert!(points.last().unwrap()["relative_area"].as_f64().unwrap() > 0.9999);
    for curve in ["chart-area polyline.computed", "chart-kappa polyline.second"] {
        let drawn = page.value(&format!("document.querySelector('#{curve}').points.numberOfItems"));
        assert_eq!(drawn, points.len(), "{curve}");
    }
    tables_and_charts_are_saved(&points, page);
    let id = explorer.state()["sweep"]["id"].as_str().unwrap().to_owned();
    page.until(&format!("(document.body.dataset.shown || '').startsWith('{id} ')"));
    let (name, store) = recording(&save(page, "save-rrd", "rough-line_sweep_multilevel.rrd"));
    let mut curves =
        store.iter_physical_chunks().filter(|chunk| chunk.entity_path().to_string().starts_with("/curve/"));
    assert!(name == id && curves.any(|chunk| chunk.timelines().contains_key(&"load".into())));
}

fn what_is_saved_opens(explorer: &Explorer, page: &mut Page) {
    let run = run(explorer);
    let stem = run["file_stem"].as_str().unwrap();
    assert_eq!(stem, format!("rough-line_p{}_multilevel", run["knobs"]["load"]));
    let (name, store) = recording(&save(page, "save-rrd", &format!("{stem}.rrd")));
    assert_eq!(run["id"], name);
    assert!(
        store.iter_physical_chunks().any(|chunk| chunk.entity_path().to_string() == "/contact/trace/kappa_r_counted")
    );
    let saved = save(page, "save-npz", &format!("{stem}.npz"));
    let mut arrays = ndarray_npy::NpzReader::new(File::open(saved).unwrap()).unwrap();
    let pressure: ndarray::Array1<f64> = arrays.by_name("pressure").unwrap();
    assert_eq!(run["knobs"]["points"], pressure.len());
    let scene = std::fs::read_to_string(save(page, "save-setup", &format!("{stem}.toml"))).unwrap();
    assert_eq!(run["setup"], scene);
    assert_eq!(command(&Setup::from_toml(&scene).unwrap()), run["command"].as_str().unwrap());
    let picture = Pixmap::load_png(save(page, "save-picture", &format!("{stem}.png"))).unwrap();
    let [.., width, height] = page.place("canvas");
    let off = [f64::from(picture.width()) - width, f64::from(picture.height()) - height];
    assert!(off.iter().all(|by| by.abs() < 1.0), "the picture is {off:?} larger than the viewer");
    let colours: HashSet<_> = picture.pixels().iter().map(|pixel| (pixel.red(), pixel.green(), pixel.blue())).collect();
    assert!(colours.len() > 30, "the picture has {} colours", colours.len());
}

/// The earlier run that is shown is the one that is saved, by every button.
fn all_buttons_save_the_run_that_is_shown(explorer: &Explorer, page: &mut Page) {
    let latest = run(explorer);
    page.click("swap");
    page.until(&format!("document.body.dataset.run !== {}", latest["id"]));
    let (id, stem) = (page.text("current().id"), page.text("current().file_stem"));
    let (name, _) = recording(&save(page, "save-rrd", &format!("{stem}.rrd")));
    assert_eq!(name, id);
    let mut arrays =
        ndarray_npy::NpzReader::new(File::open(save(page, "save-npz", &format!("{stem}.npz"))).unwrap()).unwrap();
    let setup: ndarray::Array1<u8> = arrays.by_name("setup").unwrap();
    let scene = std::fs::read(save(page, "save-setup", &format!("{stem}.toml"))).unwrap();
    assert_eq!(setup.to_vec(), scene);
    assert_ne!(latest["setup"], String::from_utf8(scene).unwrap());
    page.click("swap");
}

fn tables_and_charts_are_saved(points: &[Value], page: &mut Page) {
    let mut table = csv::Reader::from_path(save(page, "save-curve", "rough-line_sweep_multilevel.csv")).unwrap();
    let place = table.headers().unwrap().iter().position(|name| name == "kappa_r").unwrap();
    let rows: Vec<f64> = table.records().map(|row| row.unwrap()[place].parse().unwrap()).collect();
    let told: Vec<f64> = points.iter().map(|point| point["kappa_r"].as_f64().unwrap()).collect();
    assert_eq!(rows, told);
    let charts = std::fs::read_to_string(save(page, "save-charts", "rough-line_sweep_multilevel.svg")).unwrap();
    let tree = usvg::Tree::from_str(&charts, &usvg::Options::default()).unwrap();
    let mut picture = Pixmap::new(tree.size().width() as u32, tree.size().height() as u32).unwrap();
    resvg::render(&tree, resvg::tiny_skia::Transform::default(), &mut picture.as_mut());
    let blue = picture.pixels().iter().filter(|p| [p.red(), p.green(), p.blue()] == [0x56, 0xb4, 0xe9]).count();
    assert!(blue > 100, "{blue} pixels have the colour of the computed curve");
}

/// Requests to elsewhere that the policy of the page did not block.
fn outward(chromium: &Chromium, origin: &str) -> Vec<String> {
    let own = format!("{origin}/");
    let is_own = |url: &str| ["data:", "blob:", "about:", &own].iter().any(|start| url.starts_with(start));
    let blocked: HashSet<&Value> = chromium
        .events("Network.loadingFailed")
        .filter(|event| event["blockedReason"] == "csp")
        .map(|event| &event["requestId"])
        .collect();
    let requests = chromium.events("Network.requestWillBeSent").filter(|event| !blocked.contains(&event["requestId"]));
    let sockets = chromium.events("Network.webSocketCreated").chain(chromium.events("Network.webTransportCreated"));
    let addresses = requests.map(|event| &event["request"]["url"]).chain(sockets.map(|event| &event["url"]));
    addresses.map(|url| url.as_str().unwrap().to_owned()).filter(|url| !is_own(url)).collect()
}

/// Page and workers talk to their own server only, and could not do otherwise.
fn the_policy_blocks(explorer: &Explorer, page: &mut Page) {
    let own = format!("{}/session/{}/run/", explorer.origin(), explorer.session);
    let urls = page.chromium.events("Network.requestWillBeSent").map(|event| event["request"]["url"].as_str().unwrap());
    let read: HashSet<&str> = urls.filter_map(|url| url.strip_prefix(&own)?.split(".rrd").next()).collect();
    for run in [&run(explorer), &explorer.state()["sweep"]].map(|it| it["id"].as_str().unwrap()) {
        assert!(read.contains(run), "the log of requests lacks those of the viewer for {run}: {read:?}");
    }
    println!("The policy blocked {} requests of the viewer.", blocked(&page.chromium));
    let fetch = "fetch('http://elsewhere.test/').then(() => 'sent', () => 'refused')";
    assert_eq!(page.text(fetch), "refused");
    let worker = format!(
        "new Promise((told) => {{ const code = new Blob([`{}.then(postMessage)`]); \
         new Worker(URL.createObjectURL(code)).onmessage = (event) => told(event.data); }})",
        fetch.replace("elsewhere", "worker.elsewhere")
    );
    assert_eq!(page.text(&worker), "refused");
    assert_eq!(outward(&page.chromium, &explorer.origin()), [""; 0], "requests that were not blocked");
}

/// Number of requests that the policy of the page blocked.
fn blocked(chromium: &Chromium) -> usize {
    let entries = chromium.events("Log.entryAdded").map(|event| &event["entry"]);
    entries.filter(|entry| entry["source"] == "security" && is_of_the_policy(entry)).count()
}

fn is_of_the_policy(entry: &Value) -> bool {
    entry["text"].as_str().is_some_and(|text| text.contains("Content Security Policy"))
}

/// Errors in the console, but for those about what the policy blocked.
fn errors(chromium: &Chromium) -> Vec<String> {
    let entries = chromium.events("Log.entryAdded").map(|event| &event["entry"]);
    let logged = entries.filter(|entry| entry["level"] == "error" && !is_of_the_policy(entry));
    let is_error = |call: &&Value| call["type"] == "error" || call["type"] == "assert";
    let told = |call: &Value| call["args"].to_string();
    let (refused, called): (Vec<_>, Vec<_>) = chromium
        .events("Runtime.consoleAPICalled")
        .filter(is_error)
        .map(told)
        .partition(|text| text.contains("Failed to fetch"));
    let unexplained = refused.into_iter().skip(blocked(chromium)); // the viewer complains of each
    let thrown = chromium.events("Runtime.exceptionThrown").map(|event| event["exceptionDetails"].to_string());
    logged.map(Value::to_string).chain(called).chain(unexplained).chain(thrown).collect()
}

#[test]
fn a_person_at_the_page() {
    let Some(program) = installed() else { return };
    let begun = Instant::now();
    let done = |what: &str| println!("{:6.1} s  {what}", begun.elapsed().as_secs_f64());
    let (explorer, mut page) = opened(&program);
    done("the page is open");
    the_viewer_draws(&mut page);
    done("the viewer draws");
    the_load_moves_the_contact(&explorer, &mut page);
    done("the load moves the contact");
    solvers_and_geometries_switch(&explorer, &mut page);
    done("solvers and geometries switch");
    runs_are_compared(&explorer, &mut page);
    a_run_plays(&mut page);
    done("a run plays");
    a_picked_step_is_shown(&mut page);
    done("a picked step is shown");
    what_is_saved_opens(&explorer, &mut page);
    all_buttons_save_the_run_that_is_shown(&explorer, &mut page);
    done("what is saved opens");
    a_sweep_draws_its_curves(&explorer, &mut page);
    done("a sweep draws its curves, and its recording opens");
    assert_eq!(page.value("document.getElementById('fault').hidden"), true);
    let errors = errors(&page.chromium);
    the_policy_blocks(&explorer, &mut page);
    assert_eq!(errors, [""; 0]);
}
