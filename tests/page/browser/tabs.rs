//! Several tabs on one server, and a server that goes and comes back.

use super::chromium::installed;
use super::explorer::{Explorer, opened, rested, sketched};
use super::page::Page;
use serde_json::json;

const OPTIONS: &str = "/?renderer=webgl&theme=dark";
const FAULT: &str = "document.getElementById('fault').innerText";

/// Opens another tab on the explorer, and returns the one before.
fn open_tab(explorer: &Explorer, page: &mut Page) -> String {
    let before = page.chromium.open_tab();
    page.open(&format!("{}{OPTIONS}", explorer.origin()));
    page.until("['there', 'full'].includes(document.body.dataset.server)");
    before
}

fn loads(page: &mut Page) -> String {
    page.value("runs.map((run) => run.knobs.load)").to_string()
}

/// Two tabs turn their knobs, and each sees its own runs.
fn tabs_do_not_mix(explorer: &Explorer, page: &mut Page) -> String {
    let first = open_tab(explorer, page);
    rested(page);
    page.type_into("control-load-value", "0.02");
    rested(page);
    assert_eq!(loads(page), "[0.05,0.02]");
    let second = page.chromium.switch_to(first);
    page.type_into("control-load-value", "0.3");
    rested(page);
    assert_eq!(loads(page), "[0.05,0.3]");
    assert_eq!(page.value("latest().id"), "run-2");
    page.chromium.switch_to(second)
}

/// A tab that is opened anew has its runs, and a tab that is a copy of it does not.
fn a_tab_finds_its_runs_again(explorer: &Explorer, page: &mut Page) {
    let (session, before) = (page.text("session"), loads(page));
    page.value("window.isOld = true");
    page.chromium.page("Page.reload", json!({}));
    page.until("!window.isOld && document.readyState === 'complete' && document.body.dataset.server === 'there'");
    assert_eq!((page.text("session"), loads(page)), (session.clone(), before));
    let address = format!("{}{OPTIONS}&copy", explorer.origin());
    let original = page.chromium.open_copy(&address);
    page.until("document.readyState === 'complete' && document.body.dataset.server === 'there'");
    assert_ne!(page.text("session"), session, "the copy of a tab has its session");
    rested(page);
    page.chromium.page("Page.close", json!({}));
    page.chromium.switch_to(original);
}

/// With all sessions taken the next tab says so, and begins as soon as another one is closed.
fn a_tab_too_many_waits(explorer: &Explorer, page: &mut Page) {
    let take = "(async () => { for (;;) { \
          const { session: its } = await answered(fetch('api/session', sent('0'))); \
          setInterval(() => fetch(`session/${its}/api/state`), 500); } })().catch((error) => error.status)";
    assert_eq!(page.value(take), 503);
    let before = open_tab(explorer, page);
    page.until("document.body.dataset.server === 'full'");
    assert!(page.text(FAULT).starts_with("4 tabs are open, which"), "{}", page.text(FAULT));
    let waiting = page.chromium.switch_to(before);
    page.value("location.href = 'about:blank'; true");
    page.until("location.href === 'about:blank'");
    page.chromium.switch_to(waiting);
    page.until("document.body.dataset.server === 'there'");
    rested(page);
    assert_eq!(page.value("document.getElementById('fault').hidden"), true);
}

#[test]
fn every_tab_has_a_session_of_its_own() {
    let Some(program) = installed() else { return };
    let (explorer, mut page) = sketched(&program, "");
    tabs_do_not_mix(&explorer, &mut page);
    a_tab_finds_its_runs_again(&explorer, &mut page);
    a_tab_too_many_waits(&explorer, &mut page);
}

/// The server is killed: the page says so and keeps what it has. It comes back on the same port: the page goes on by itself.
#[test]
fn a_server_that_comes_back_is_found() {
    let Some(program) = installed() else { return };
    let (explorer, mut page) = opened(&program);
    page.type_into("control-load-value", "0.02");
    rested(&mut page);
    page.click("pin");
    page.until("pinned === 'run-2'");
    page.type_into("control-load-value", "0.1");
    rested(&mut page);
    page.click("sweep");
    page.until("document.body.dataset.sweep === 'ended' && document.body.dataset.busy === 'false'");
    let shown = "[document.getElementById('numbers').innerText, document.querySelectorAll('#results polyline').length]";
    let before = page.value(shown);
    let read = "['run-1', 'run-2', 'run-3'].every((id) => viewer.get_timeline_time_range(id, 'step')) && viewer.get_timeline_time_range('sweep-4', 'load') !== null";
    page.until(read);
    page.until("runs.length === 4 && runs.every((run) => run.ended && run.followed)");
    let port = explorer.kill();
    page.until("document.body.dataset.server === 'gone'");
    assert!(
        page.text(FAULT).starts_with("The server has stopped: start asperity explore again"),
        "{}",
        page.text(FAULT)
    );
    assert_eq!(page.value(shown), before);
    assert_eq!(page.value(read), true);
    page.type_into("control-load-value", "0.2");
    page.until("document.body.dataset.server === 'gone' && !document.getElementById('fault').hidden");
    let _explorer = Explorer::start_at(port);
    page.until("document.body.dataset.server === 'there' && document.getElementById('fault').hidden");
    rested(&mut page);
    assert_eq!(page.value("[latest().knobs.load, latest().id]"), json!([0.2, "run-6"]));
    assert_eq!(page.value("[pinned, runOf(pinned).knobs.load]"), json!(["run-5", 0.02]));
    assert_eq!(
        page.value("runs.map((run) => run.id)"),
        json!(["run-1", "run-2", "run-3", "sweep-4", "run-5", "run-6"])
    );
    page.value("showRun('run-3'), true");
    assert_eq!(
        page.value("document.getElementById('save-rrd').disabled"),
        true,
        "what the server lost cannot be saved"
    );
    assert_eq!(page.value(shown).as_array().unwrap()[1], before.as_array().unwrap()[1]);
}
