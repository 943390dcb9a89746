//! A person who looks at what a process does: charts over its states, maps of what flows and slips, and units of a solid.

use super::chromium::installed;
use super::downloads::save;
use super::explorer::{opened, rested};
use super::page::Page;
use serde_json::Value;

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
    turned(page, "{ load: 0.06 }");
    page.until("byId('top-note').textContent.includes('plates') && latest().found.hydraulic_gap_x > 0");
    assert!(page.text("document.querySelector('[data-number=hydraulic_gap_x]').innerText").ends_with('m'));
    page.click("map-pressure");
    assert_eq!(page.value("byId('top-note').hidden"), true);
}

/// The places of a curve of the first chart, in pixels.
fn curve(page: &mut Page, style: &str) -> Vec<[f64; 2]> {
    let points =
        format!("[...document.querySelector('#chart-area polyline.{style}').points].map(({{ x, y }}) => [x, y])");
    let pair = |at: &Value| [0, 1].map(|i| at[i].as_f64().unwrap());
    page.value(&points).as_array().unwrap().iter().map(pair).collect()
}

/// A cylinder that sticks is pressed from no load on and pulled off: a loop with two jumps, and a pull-off that stands beside that of theory, on the page
/// and in the files of its numbers.
fn a_cylinder_lets_go(page: &mut Page) {
    let sticky = "{ domain: 'line', body: 'round', roughness: 0, points: 4096, load: 0.02, adhesion: 1e-7, range: 2e-5, pull: 0.08 }";
    turned(page, sticky);
    page.until("latest().found?.pull_off < 0 && document.querySelectorAll('#chart-area polyline.jump').length === 2");
    let [approach, retreat, jump] = ["approach", "computed", "jump"].map(|style| curve(page, style));
    assert!(approach[0][1] > approach.last().unwrap()[1] && approach.last() == retreat.first());
    assert!(retreat.last().unwrap()[1] > approach[0][1] + 10.0, "the retreat goes on below no load");
    assert!(jump[0] == approach[0] && jump[1][0] > retreat.last().unwrap()[0] && jump[1][1] == jump[0][1]);
    assert_eq!(page.value("latest().numbers.relative_area"), 0);
    let ratio = page.value("latest().found.pull_off / latest().pull_off.jkr").as_f64().unwrap();
    assert!((ratio - 1.0).abs() < 2e-3, "{ratio} of the pull-off in theory");
    let across = curve(page, "exact");
    assert!((across[0][1] - retreat.last().unwrap()[1]).abs() < 1.0 && across[0][1] == across[1][1]);
    let told = page.text("document.querySelector('[data-number=\"exact pull_off\"]').innerText");
    assert!(told.ends_with(" E*") && told.starts_with("-1.77e-4"), "{told}");
    let stem = page.text("latest().file_stem");
    let mut table = csv::Reader::from_path(save(page, "save-numbers", &format!("{stem}_numbers.csv"))).unwrap();
    let head = table.headers().unwrap().clone();
    assert_eq!(head.iter().take(3).collect::<Vec<_>>(), ["name", "symbol", "unit"]);
    assert!(
        head[3].starts_with("this run: Cylinder, p* = 0.02") && head.iter().next_back() == Some("exact"),
        "{head:?}"
    );
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    let row = |name: &str| rows.iter().find(|row| &row[0] == name).unwrap();
    let pull_off = row("pull-off pressure");
    let pressure = page.value("latest().found.pull_off / LIMITS.modulus").as_f64().unwrap();
    assert!(
        &pull_off[2] == "E*" && (pull_off[3].parse::<f64>().unwrap() / pressure - 1.0).abs() < 1e-9,
        "{pull_off:?}"
    );
    assert_eq!((&row("relative area")[1], &row("relative area")[3]), ("a_rel", "0"));
    let states = page.value("facet(latest(), 'steps').then((its) => its.step.length)").as_u64().unwrap();
    let mut curves = csv::Reader::from_path(save(page, "save-curve", &format!("{stem}_states.csv"))).unwrap();
    assert!(curves.headers().unwrap().iter().any(|name| name == "mean_pressure"));
    assert_eq!(curves.records().count() as u64, states);
    page.value("Object.assign(knobs, { adhesion: 0, pull: 0 }); show(); changed(); true");
    rested(page);
    page.until("byId('save-curve').disabled");
    assert!(page.text("byId('save-curve-why').textContent").contains("sweep the load"));
    page.value("byId('saves').showPopover(); true");
    assert_eq!(page.value("byId('save-curve-why').checkVisibility() && byId('save-run-why').hidden"), true);
    page.value("byId('saves').hidePopover(); true");
}

/// *Pulled off* moves a cylinder to gaps: the load has no knob, approach and retreat are curves of their own with a jump each, the pull-off is told, and the
/// surfaces have parted. The same of a ball is given by a load.
fn a_cylinder_is_pulled_off_at_gaps(page: &mut Page) {
    turned(page, "{ domain: 'line', body: 'round', roughness: 0, points: 4096, load: 0.02 }");
    page.click("choice-pulled");
    page.until("latest().knobs.depth > 0 && latest().found?.pull_off < 0");
    rested(page);
    assert_eq!(page.value("byId('row-load').hidden && byId('row-pull').hidden && !byId('row-depth').hidden"), true);
    assert_eq!(page.value("document.querySelectorAll('#chart-area polyline.jump').length"), 2);
    assert_eq!(
        page.value("document.querySelectorAll('#chart-area :is(polyline.approach, polyline.computed)').length"),
        4
    );
    let jumps = page.value("[...document.querySelectorAll('#chart-area polyline.jump')].map((it) => it.points[0].x)");
    assert!(jumps[1].as_f64().unwrap() > jumps[0].as_f64().unwrap() + 10.0, "in and out at the same gap: {jumps}");
    assert!(page.text("byId('title').textContent").ends_with(": parted"));
    let ratio = page.value("latest().found.pull_off / latest().pull_off.jkr").as_f64().unwrap();
    assert!((ratio - 1.0).abs() < 1e-2, "{ratio} of the pull-off in theory");
    assert_eq!(page.text("byId('label-pressure').innerText"), "No pressure: the surfaces are apart");
    page.click("choice-pressed");
    rested(page);
    assert_eq!(page.value("knobs.depth === 0 && !byId('row-load').hidden"), true);
    page.value("Object.assign(knobs, { adhesion: 0, pull: 0 }); show(); changed(); true");
    rested(page);
}

/// The state that is shown has its dot at the edge of an axis, too; no note lies on a dot, and the numbers of an axis are not cut off.
fn dots_and_numbers_are_in_sight(page: &mut Page) {
    let round = "domain: 'line', body: 'round', roughness: 0, points: 512, load: 0.05, adhesion: 0, pull: 0, depth: 0";
    turned(page, &format!("{{ {round}, friction: 0.3, sideways: 0.5, rolling: true }}"));
    page.until("document.querySelector('#chart-area polyline.computed') && document.querySelector('#chart-area circle.of-computed')");
    turned(
        page,
        "{ friction: 0, sideways: 0, rolling: false, body: 'flat', roughness: 1e-3, points: 4096, creep: 9, speed: 0.5 }",
    );
    page.until(
        "document.querySelector('#chart-area .note') && document.querySelector('#chart-kappa circle.of-computed')",
    );
    let apart = "['chart-area', 'chart-kappa'].every((id) => { const [dot, note] = ['circle.of-computed', '.note'].map((it) => document.querySelector(`#${id} ${it}`).getBoundingClientRect()); return dot.bottom < note.top || dot.top > note.bottom; })";
    assert_eq!(page.value(apart), true);
    let widest = "Math.min(...[...document.querySelectorAll('#chart-area text')].map((it) => it.getBBox().x))";
    assert!(page.value(widest).as_f64().unwrap() >= 0.0, "a number is cut off");
    page.value("Object.assign(knobs, { creep: 0, speed: 0 }); show(); changed(); true");
    rested(page);
}

/// Surfaces that are pulled apart: the curve ends with the lowest pressure that they held, and what has parted has no pressure and no loss.
fn what_parts_carries_nothing(page: &mut Page) {
    let sticky = "{ domain: 'line', body: 'sine', roughness: 0, points: 512, load: 0.001, adhesion: 6e-7, range: 1e-3";
    turned(page, &format!("{sticky}, pull: 1e-3 }}"));
    page.until("byId('title').textContent.endsWith(': holds')");
    turned(page, &format!("{sticky}, pull: 0.3 }}"));
    page.until("byId('title').textContent.endsWith(': parted') && latest().found && document.querySelector('#chart-area polyline.computed')");
    let held = page.value(
        "facet(latest(), 'steps').then((its) => its.mean_pressure.filter((_, i) => its.mean_attraction[i] > 0))",
    );
    let held: Vec<f64> = held.as_array().unwrap().iter().map(|it| it.as_f64().unwrap()).collect();
    let [approach, retreat] = ["approach", "computed"].map(|style| curve(page, style));
    assert_eq!(approach.len() + retreat.len(), held.len() + 1, "both curves have the state of the largest load");
    let lowest = held.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(page.value("latest().found.pull_off").as_f64(), Some(lowest));
    assert_eq!(page.text("document.querySelector('[data-number=dissipated]').innerText"), "–");
    page.value("Object.assign(knobs, { adhesion: 0, pull: 0 }); show(); changed(); true");
    rested(page);
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
    what_parts_carries_nothing(&mut page);
    a_cylinder_lets_go(&mut page);
    a_cylinder_is_pulled_off_at_gaps(&mut page);
    dots_and_numbers_are_in_sight(&mut page);
    a_solid_has_units(&mut page);
    assert_eq!(page.value("document.getElementById('fault').hidden"), true);
}
