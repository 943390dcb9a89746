//! A person who looks at what a process does: charts over its states, maps of what flows and slips, and units of a solid.

use super::chromium::installed;
use super::explorer::{opened, rested};
use super::page::Page;

/// Turns knobs, and waits for the section of the run.
fn turned(page: &mut Page, knobs: &str) {
    page.value(&format!("Object.assign(knobs, {knobs}); show(); changed(); true"));
    rested(page);
    page.until("document.body.dataset.section === latest().id");
}

/// A cycle of a pull is a loop in the chart, whose states can be picked.
fn a_pull_is_a_loop(page: &mut Page) {
    turned(page, "{ body: 'round', roughness: 0, points: 512, load: 0.01, friction: 0.3, sideways: 0.6 }");
    page.until("document.querySelector('#chart-area polyline.computed')?.points.numberOfItems === 24");
    assert!(page.text("document.querySelector('#chart-area .title').textContent").contains("mean traction"));
    assert!(page.text("byId('label-pressure').textContent").contains("traction"));
    let sticks = "Number(document.querySelector('[data-number=stick_share]').textContent.replace(',', '.'))";
    let end = page.value(sticks).as_f64().unwrap();
    assert!(0.5 < end && end < 0.8, "{end} sticks");
    page.press_at("chart-area", "ArrowLeft");
    page.until("moment?.step === 23");
    let before = page.value(sticks).as_f64().unwrap();
    assert!(before > end, "{before} sticks before {end}");
    let green = "section.fields.traction.some((value) => value > 0)";
    assert_eq!(page.value(green), true);
}

/// The viewer beside the picture follows the keys of a chart, and the picture stays with it.
fn keys_move_the_state_beside_the_viewer(page: &mut Page) {
    page.click("view-both");
    rested(page);
    for step in [22, 21] {
        page.press_at("chart-area", "ArrowLeft");
        page.until(&format!("moment?.step === {step} && read().endsWith(' {step}')"));
    }
    for step in [22, 23] {
        page.press_at("chart-area", "ArrowRight");
        page.until(&format!("moment?.step === {step}"));
    }
    page.press_at("chart-area", "ArrowRight");
    page.until("moment === null");
    page.click("view-picture");
}

/// A surface that is pulled has maps of its traction and slip, one at rest has none, and both have a leak.
fn maps_are_those_of_the_state(page: &mut Page) {
    let hidden = |page: &mut Page, name: &str| page.value(&format!("byId('map-{name}').hidden")) == true;
    turned(page, "{ domain: 'surface', body: 'flat', roughness: 0.001, points: 64, cutoff: 16, load: 0.05 }");
    page.until("above && !byId('top-box').hasAttribute('data-stale')");
    assert!(!hidden(page, "traction") && !hidden(page, "slip") && hidden(page, "attraction"));
    turned(page, "{ friction: 0, sideways: 0 }");
    page.until("byId('map-traction').hidden");
    page.click("map-flux");
    page.until("byId('top-note').textContent.includes('plates')");
    let flows = "(() => { const map = document.querySelector('#chart-kappa circle'); return Boolean(map); })()";
    page.until(flows);
    page.click("map-pressure");
    assert_eq!(page.value("byId('top-note').hidden"), true);
}

/// Pressures of steel are in megapascals, and a cell of twice the length has lengths twice as long.
fn a_solid_has_units(page: &mut Page) {
    let scale = "byId('label-pressure').textContent";
    assert!(page.text(scale).contains("E*"));
    page.value("(() => { const it = byId('material'); it.value = 'steel'; it.dispatchEvent(new Event('change')); return true; })()");
    let shown = page.text(scale);
    assert!(shown.contains("Pa") && !shown.contains("E*"), "{shown}");
    let [ratio, modulus] = ["axes.pressure", "210e9 / (1 - 0.3 ** 2)"].map(|of| page.value(of).as_f64().unwrap());
    let told = page.text("withUnit(axes.pressure * LIMITS.modulus, 'pressure')");
    let (number, unit) = told.split_once(' ').unwrap();
    let size = [("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3)].into_iter().find(|(name, _)| *name == unit).unwrap().1;
    let pascals = number.parse::<f64>().unwrap() * size;
    assert!((pascals / (ratio * modulus) - 1.0).abs() < 5e-3, "{told} for {ratio} E*");
    assert_eq!(page.text("withUnit(LIMITS.cell, 'length')"), "160 µm");
    page.value(
        "(() => { const it = byId('cell'); it.value = '320'; it.dispatchEvent(new Event('change')); return true; })()",
    );
    assert_eq!(page.text("withUnit(LIMITS.cell, 'length')"), "320 µm");
    page.value(
        "(() => { const it = byId('material'); it.value = ''; it.dispatchEvent(new Event('change')); return true; })()",
    );
    assert!(page.text(scale).contains("E*"));
}

#[test]
fn a_person_who_looks_at_a_process() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = opened(&program);
    page.click("view-picture");
    a_pull_is_a_loop(&mut page);
    keys_move_the_state_beside_the_viewer(&mut page);
    maps_are_those_of_the_state(&mut page);
    a_solid_has_units(&mut page);
    assert_eq!(page.value("document.getElementById('fault').hidden"), true);
}
