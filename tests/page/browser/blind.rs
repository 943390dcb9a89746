//! A browser that cannot draw the viewer: the page goes on without it.

use super::chromium::installed;
use super::explorer::{rested, sketched};
use super::page::Page;
use serde_json::Value;

fn the_picture_takes_the_place_of_the_viewer(page: &mut Page) {
    let note = page.text("document.getElementById('viewer-note').innerText");
    assert!(note.contains("works without it"), "{note}");
    let [.., viewer] = page.place("viewer");
    let [.., own] = page.place("own");
    assert!(own > 3.0 * viewer, "the picture is {own} high, what is left of the viewer {viewer}");
    let picture = page.picture("section");
    let drawn = picture.iter().filter(|&&pixel| pixel != picture[0]).count();
    assert!(drawn > picture.len() / 4, "{drawn} of {} pixels are drawn", picture.len());
}

fn controls_and_hand_work(page: &mut Page) {
    let area = "latest().numbers.relative_area";
    let before = page.value(area).as_f64().unwrap();
    page.press_at("control-load", "ArrowRight");
    rested(page);
    let after = page.value(area).as_f64().unwrap();
    assert!(after > before, "{before} to {after}");
    page.press_at("press", "ArrowDown");
    page.until("grip === null");
    rested(page);
    assert!(page.value(area).as_f64().unwrap() > after);
}

/// Steps and loads are scrubbed through the numbers.
fn steps_are_scrubbed(page: &mut Page) {
    page.press_at("scrub", "Home");
    page.until("moment !== null");
    assert!(page.value("moment.numbers.iterations").as_f64().unwrap() <= 1.0);
    page.press_at("scrub", "End");
    page.until("moment === null");
    page.click("sweep");
    page.until("document.body.dataset.sweep === 'ended' && document.body.dataset.busy === 'false'");
    page.press_at("chart-area", "ArrowRight");
    page.until("moment && moment.numbers.number !== undefined");
}

#[test]
fn a_page_without_a_viewer() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "&view=both");
    page.resize([1440, 900]);
    assert_eq!(page.text("document.body.dataset.viewer"), "failed");
    the_picture_takes_the_place_of_the_viewer(&mut page);
    controls_and_hand_work(&mut page);
    steps_are_scrubbed(&mut page);
    assert_eq!(page.value("document.getElementById('fault').hidden"), Value::Bool(true));
}
