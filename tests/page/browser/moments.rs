//! Moments: what the page says of a step, of a state in time, and of a state that a link asks for.

use super::chromium::{Chromium, installed};
use super::explorer::{Explorer, rested, sketched};
use super::page::Page;
use serde_json::json;

const TITLE: &str = "byId('title').innerText";

/// Solves other knobs, and goes to the first moment of the run.
fn first_moment(page: &mut Page, knobs: &str) -> String {
    page.value(&format!("Object.assign(knobs, {knobs}), show(), changed()"));
    rested(page);
    page.press_at("scrub", "Home");
    page.until("moment !== null && isWhole");
    page.text(TITLE)
}

/// A step is not the end of its run, and a state in time is at its own time.
#[test]
fn moments_have_their_own_titles() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "&view=picture&language=en");
    let gfmd = "{ points: 256, cutoff: 32, solver: { method: 'gfmd', masses: 'stiffness', dynamics: 'damped', 'time-step': 0.5, damping: 1 } }";
    assert_eq!(first_moment(&mut page, gfmd), "Rough line, p* = 0.05: step 0");
    let creep = "{ solver: { method: 'multilevel' }, creep: 9, time: 3 }";
    assert_eq!(first_moment(&mut page, creep), "Rough line, p* = 0.05, f = 9, t = 0 τ");
    assert_eq!(page.text("document.getElementById('this').innerText"), "t = 0 τ");
    page.value("seek(0.7)");
    page.until("moment.numbers.time > 0 && isWhole");
    let (time, title) = (page.value("moment.numbers.time").as_f64().unwrap(), page.text(TITLE));
    let told: f64 = title.split("t = ").nth(1).unwrap().strip_suffix(" τ").unwrap().parse().unwrap();
    assert!((told / time - 1.0).abs() < 0.01, "{title} at {time}");
    page.press_at("scrub", "End");
    page.until("moment === null && isWhole");
    assert_eq!(page.text(TITLE), "Rough line, p* = 0.05, f = 9, T/τ = 3: converged");
}

/// A refused value leaves what is being solved as it is, and the knobs go back to that.
#[test]
fn a_refused_value_stops_nothing() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "&view=picture&language=en");
    page.value(
        "Object.assign(knobs, { points: 32768, cutoff: 128, stop: { tolerance: 1e-13, 'max-iterations': 100000 }, \
         solver: { method: 'gfmd', masses: 'uniform', dynamics: 'damped', 'time-step': 0.5, damping: 1 } }), show(), changed()",
    );
    page.until("report.busy && latest().knobs.solver.method === 'gfmd' && latest().numbers");
    let run = page.text("latest().id");
    page.value("knobs.load = -1, changed()");
    page.until("!byId('fault').hidden && knobs.load === 0.05");
    assert_eq!(page.value("[report.busy, shownOrLatest().id]"), json!([true, run]));
    let steps = page.value("latest().numbers.iterations").as_u64().unwrap();
    page.until(&format!("latest().id === '{run}' && latest().numbers.iterations > {steps}"));
    page.click("cancel");
    page.until("!report.busy && isWhole");
    assert!(page.text(TITLE).ends_with(": stopped"), "{}", page.text(TITLE));
}

/// A link to the state with which the page begins anyway shows it.
#[test]
fn a_link_to_the_start_has_a_picture() {
    let Some(program) = installed() else { return };
    let explorer = Explorer::start();
    let mut page = Page { chromium: Chromium::without_graphics(&program) };
    page.resize([1440, 900]);
    page.follow(&explorer.address("&theme=dark&view=picture"));
    rested(&mut page);
    let state = page.text("encodeURIComponent(JSON.stringify({ knobs }))");
    page.chromium.open_tab();
    page.follow(&explorer.address(&format!("&theme=dark&view=picture#{state}")));
    rested(&mut page);
    assert_eq!(page.value("isWhole"), true);
}

/// A viewer that is not shown has no size for which recordings would be drawn; one that is shown has.
#[test]
fn a_hidden_viewer_has_no_size() {
    let Some(program) = installed() else { return };
    for (view, told) in [("picture", false), ("both", true)] {
        let (_explorer, page) = sketched(&program, &format!("&view={view}"));
        let sent = page.chromium.events("Network.requestWillBeSent");
        let sizes = sent.filter(|it| it["request"]["url"].as_str().unwrap().ends_with("api/window"));
        assert_eq!(sizes.count() > 0, told, "{view}");
    }
}
