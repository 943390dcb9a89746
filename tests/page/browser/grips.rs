//! A person with a hand on the contact: the rigid surface is pressed and bent, patches and loads are picked.

use super::chromium::installed;
use super::explorer::{opened, rested};
use super::page::Page;
use serde_json::{Value, json};

/// The latest run as the page has it.
fn run(page: &mut Page) -> Value {
    page.value("latest()")
}

fn load(page: &mut Page) -> f64 {
    page.value("knobs.load").as_f64().unwrap()
}

/// Waits until the page's own picture is that of the latest run.
fn pictured(page: &mut Page) {
    rested(page);
    page.until("document.body.dataset.section === latest().id");
}

/// Drags from a place by some pixels, and waits in the middle until the contact has been solved under the hand.
fn drag(page: &mut Page, [x, y]: [f64; 2], [dx, dy]: [f64; 2]) {
    let before = page.value("Number(document.body.dataset.held || 0)");
    page.mouse("mousePressed", [x, y]);
    for part in 1..=8 {
        let share = f64::from(part) / 8.0;
        page.mouse("mouseMoved", [x + share * dx, y + share * dy]);
    }
    page.until(&format!("Number(document.body.dataset.held) > {before} && !holding"));
    page.mouse("mouseReleased", [x + dx, y + dy]);
}

fn middle([x, y, width, height]: [f64; 4]) -> [f64; 2] {
    [x + width / 2.0, y + height / 2.0]
}

/// The handle moves down: the gap closes as much as the handle moves, load and area grow, and what was held is solved as a run.
fn pressing_raises_the_load(page: &mut Page) {
    pictured(page);
    let (before, gap) = (run(page), page.value("section.mean_gap").as_f64().unwrap());
    let scale = page.value("frame(byId('section')).perHeight").as_f64().unwrap();
    let grip = middle(page.place("press"));
    drag(page, grip, [0.0, 5.0]);
    let held = page.value("section.mean_gap").as_f64().unwrap();
    assert!(((gap - held) * scale / 5.0 - 1.0).abs() < 0.02, "{gap} to {held} by 5 pixels of {scale}");
    pictured(page);
    let after = run(page);
    assert_eq!(after["knobs"]["load"].as_f64().unwrap(), load(page));
    let number = |run: &Value, name: &str| run["numbers"][name].as_f64().unwrap();
    for name in ["reduced_pressure", "relative_area"] {
        assert!(number(&after, name) > 1.05 * number(&before, name), "{name}: {before} to {after}");
    }
    let solved = page.value("section.mean_gap").as_f64().unwrap();
    assert!((solved / held - 1.0).abs() < 2e-3, "the run is at the gap {solved}, the hand at {held}");
}

/// A contact that is to be made is made when the hand lets go there, not where it passes through.
fn what_a_hand_passes_is_not_made(page: &mut Page) {
    pictured(page);
    page.value("globalThis.made = 0; setWish({ relative_area: [1.02 * latest().numbers.relative_area, 1] }, () => { made += 1; }); true");
    let grip = middle(page.place("press"));
    page.mouse("mousePressed", grip);
    page.mouse("mouseMoved", [grip[0], grip[1] + 5.0]);
    page.until("moment && moment.numbers.relative_area >= wish.goal.relative_area[0] && !holding");
    assert!(page.text("byId('label-drag').textContent").starts_with("p* "), "the hand is told what it holds");
    assert_eq!(page.value("made"), 0);
    page.mouse("mouseReleased", [grip[0], grip[1] + 5.0]);
    page.until("made === 1");
    pictured(page);
}

/// The largest difference between the rigid surface and what is kept of it, both less their first value, over the largest height.
const BENT: &str =
    "Math.max(...section.rigid.map((z, i) => Math.abs(z - section.rigid[0] - kept[i] + kept[0]))) / section.highest";

/// Lifted beyond the highest peak it touches nothing: the solid is flat, and the rigid surface is as it was.
fn lifting_lets_go(page: &mut Page) {
    let grip = middle(page.place("press"));
    page.value("globalThis.kept = section.rigid; true");
    page.mouse("mousePressed", grip);
    page.mouse("mouseMoved", [grip[0], grip[1] - 300.0]);
    assert_eq!(page.value("Math.max(...section.pressure)"), 0.0);
    assert_eq!(page.value("section.solid.some((z) => z !== 0)"), false, "the solid is not flat");
    assert!(page.value(BENT).as_f64().unwrap() < 1e-5);
    page.mouse("mouseMoved", [grip[0], grip[1]]);
    page.until("Math.max(...section.pressure) > 0 && !holding");
    assert!(page.value(BENT).as_f64().unwrap() < 1e-5, "{}", page.value(BENT));
    page.mouse("mouseReleased", grip);
    pictured(page);
}

/// What is let go of clear of the solid stays there, with numbers and a title that say so, until it is pressed again.
fn what_is_lifted_clear_stays(page: &mut Page) {
    let (before, grip) = (load(page), middle(page.place("press")));
    page.mouse("mousePressed", grip);
    page.mouse("mouseMoved", [grip[0], grip[1] - 300.0]);
    page.mouse("mouseReleased", [grip[0], grip[1] - 300.0]);
    rested(page);
    assert_eq!(page.value("Math.max(...section.pressure)"), 0.0);
    assert_eq!(page.text("document.getElementById('title').innerText"), "Above the solid: nothing touches");
    let cells = "['relative_area', 'exact relative_area'].map((name) => document.querySelector(`#numbers td[data-number=\"${name}\"]`).innerText)";
    assert_eq!(page.value(cells), json!(["0", ""]));
    assert_eq!(load(page), before);
    let field = "[document.getElementById('control-load-value').value, document.getElementById('load-hand').hidden]";
    assert_eq!(page.value(field), json!(["0", false]), "the field has the load of the hand");
    let grip = middle(page.place("press"));
    let down =
        page.value("(section.mean_gap - 0.5 * section.highest) * frame(byId('section')).perHeight").as_f64().unwrap();
    drag(page, grip, [0.0, down]);
    pictured(page);
    assert!(page.value("latest().numbers.relative_area").as_f64().unwrap() > 0.0);
}

/// While a hand holds the surface, no exact value of another load stands beside its numbers, and the title is of what is held.
fn nothing_stale_stands_beside_the_hand(page: &mut Page) {
    let grip = middle(page.place("press"));
    let before = page.value("Number(document.body.dataset.held || 0)");
    assert_ne!(page.text("document.querySelector('#numbers td[data-number=\"exact kappa_r\"]').innerText"), "");
    page.mouse("mousePressed", grip);
    page.mouse("mouseMoved", [grip[0], grip[1] + 6.0]);
    page.until(&format!("Number(document.body.dataset.held) > {before} && !holding"));
    assert_eq!(page.text("document.querySelector('#numbers td[data-number=\"exact kappa_r\"]').innerText"), "");
    let title = page.text("document.getElementById('title').innerText");
    assert!(title.starts_with("Held by hand: p* = "), "{title}");
    page.mouse("mouseReleased", [grip[0], grip[1] + 6.0]);
    pictured(page);
}

/// How far the rigid surface reaches down and the solid reaches up, in pixels of the picture from above, at a share of its length: the first
/// is filled from the top of its band on, the second from below.
fn seen_at(page: &mut Page, share: f64) -> [f64; 2] {
    let seen = format!(
        "(() => {{ const canvas = byId('section'); const from = Math.ceil(frame(canvas).top) + 2; \
           const {{ data, height }} = canvas.getContext('2d').getImageData(Math.floor({share} * canvas.width), 0, 1, canvas.height); \
           const at = (y) => data.slice(4 * y, 4 * y + 3).join(); \
           let [rigid, solid] = [from, height - 3]; \
           while (at(rigid) === at(from)) rigid++; \
           while (at(solid) === at(height - 3)) solid--; \
           return [rigid, solid]; }})()"
    );
    serde_json::from_value(page.value(&seen)).unwrap()
}

/// A cylinder is seen to press a dent: rigid surface and solid are lowest in the middle, and apart at the ends.
fn a_cylinder_presses_a_dent(page: &mut Page) {
    page.value("globalThis.asBefore = structuredClone(knobs); Object.assign(knobs, { body: 'round', roughness: 0, load: 0.1 }); changed()");
    pictured(page);
    let ([tip, dent], [edge, ground]) = (seen_at(page, 0.5), seen_at(page, 0.02));
    assert!(tip > edge + 5.0, "the cylinder ends at {tip} in its middle and at {edge} at its side");
    assert!(dent > ground + 5.0, "the solid begins at {dent} below the cylinder and at {ground} beside it");
    assert!(ground > edge + 5.0 && (dent - tip).abs() < 5.0, "{tip} on {dent}, {edge} above {ground}");
    nothing_stale_stands_beside_the_hand(page);
    page.value("knobs = asBefore; changed()");
    pictured(page);
}

/// A point that is dragged is where the hand is, on the rigid surface that it bends there and nowhere else.
fn a_dragged_point_follows_the_hand(page: &mut Page) {
    pictured(page);
    page.value("globalThis.kept = section.rigid; true");
    let (grip, profile) = (
        middle(page.place("bend")),
        "frame(byId('section')).y(section.rigid[Math.floor(handle * section.rigid.length)])",
    );
    let before = page.value(profile).as_f64().unwrap();
    let held = page.value("Number(document.body.dataset.held || 0)");
    page.mouse("mousePressed", grip);
    page.mouse("mouseMoved", [grip[0], grip[1] + 4.5]);
    page.mouse("mouseMoved", [grip[0], grip[1] + 9.0]);
    page.until(&format!("Number(document.body.dataset.held) > {held} && !holding"));
    let (handle, moved) = (middle(page.place("bend")), page.value(profile).as_f64().unwrap() - before);
    assert!((moved - 9.0).abs() < 1.0, "the profile moved by {moved} pixels, the hand by 9");
    assert!((handle[1] - grip[1] - moved).abs() < 0.1, "the handle moved from {grip:?} to {handle:?}");
    assert!(page.value(BENT).as_f64().unwrap() > 1e-2, "nothing is bent");
    page.mouse("mouseMoved", [grip[0], grip[1]]);
    page.mouse("mouseReleased", grip);
    pictured(page);
    page.value("knobs.bumps = []; changed()");
    pictured(page);
}

/// The keys do the same as the pointer.
fn keys_press(page: &mut Page) {
    let before = load(page);
    page.press_at("press", "ArrowDown");
    page.press_at("press", "ArrowDown");
    pictured(page);
    assert!(load(page) > before);
    let at = page.value("handle").as_f64().unwrap();
    page.press_at("bend", "ArrowRight");
    assert!(page.value("handle").as_f64().unwrap() > at);
}

/// A point of the profile that is dragged down becomes a bump, with which the saved setup repeats the run; all bumps
/// are removed again.
fn bending_changes_the_shape(page: &mut Page) {
    let ours = page.value("latest().numbers.relative_area");
    let grip = middle(page.place("bend"));
    drag(page, grip, [0.0, 9.0]);
    pictured(page);
    let bumps = page.value("latest().knobs.bumps");
    assert_eq!(bumps.as_array().map(Vec::len), Some(1), "{bumps}");
    assert!(bumps[0][1].as_f64().unwrap() > 0.0);
    let after = run(page);
    assert!(after["setup"].as_str().unwrap().contains("bumps = ["), "{after}");
    assert!(after["command"].as_str().unwrap().contains(" --bumps "), "{after}");
    assert_ne!(after["numbers"]["relative_area"], ours);
    page.click("unbend");
    pictured(page);
    assert_eq!(page.value("latest().knobs.bumps"), json!([]));
    assert_eq!(page.value("latest().numbers.relative_area"), ours);
}

/// A patch that is clicked is shown beside its twin; the viewer's pick of the same place chooses the same patch.
fn patches_are_picked(page: &mut Page) {
    let [x, y, width, height] = page.place("section");
    page.mouse("mousePressed", [x + 0.3 * width, y + 0.95 * height]);
    page.mouse("mouseReleased", [x + 0.3 * width, y + 0.95 * height]);
    page.until("document.body.dataset.patch !== 'none' && document.body.dataset.patch");
    let picked = page.text("document.body.dataset.patch");
    let twin = page.value("chosen.twin");
    let [half, most, share, mean, whole] = [
        "chosen.twin.half_width",
        "chosen.twin.max_pressure",
        "chosen.share",
        "latest().numbers.reduced_pressure",
        "section.length",
    ]
    .map(|it| page.value(it).as_f64().unwrap());
    let gradient = page.value("latest().knobs.roughness").as_f64().unwrap();
    // Hertz: the load of a cylinder is pi a p0 / 2
    let carried = share * mean * gradient * whole;
    assert!((carried / (0.5 * std::f64::consts::PI * half * most) - 1.0).abs() < 1e-3, "{twin}");
    assert!((page.value("chosen.twin.kappa_r").as_f64().unwrap() - 1.4702).abs() < 1e-3);
    page.click("patch-close");
    let item = "{ type: 'entity', entity_path: '/contact/pressure/line', position: [300, 90, 0] }";
    page.value(&format!(
        "heardViewer(JSON.stringify({{ type: 'selection_change', recording_id: shownRun, items: [{item}] }}))"
    ));
    page.until(&format!("document.body.dataset.patch === '{picked}'"));
    page.click("patch-close");
    assert_eq!(page.value("document.getElementById('patch').hidden"), true);
}

/// A load that is clicked in a chart is the one of viewer, table and picture; so is one that the viewer goes to.
fn loads_are_picked(page: &mut Page) {
    page.click("sweep");
    page.until("document.body.dataset.sweep === 'ended' && document.body.dataset.busy === 'false'");
    page.until("viewer.get_timeline_time_range(report.sweep.id, 'load')");
    let [x, y, width, height] = page.place("chart-area");
    let place = [x + 0.55 * width, y + 0.5 * height];
    page.mouse("mousePressed", place);
    page.mouse("mouseReleased", place);
    page.until("moment && moment.numbers.number !== undefined");
    page.until("viewer.get_time_for_timeline(report.sweep.id, 'load') === moment.numbers.number");
    let area = page.value("moment.numbers.relative_area").as_f64().unwrap();
    let shown = page.text("document.querySelector('#numbers td[data-number=\"relative_area\"]').innerText");
    assert!((shown.parse::<f64>().unwrap() / area - 1.0).abs() < 1e-4);
    let number = page.value("moment.numbers.number").as_u64().unwrap();
    page.press_at("chart-kappa", "ArrowRight");
    page.until(&format!("moment.numbers.number === {}", number + 1));
    page.value("byId('canvas').dispatchEvent(new PointerEvent('pointerdown'))");
    page.value(&format!("viewer.set_time_for_timeline(report.sweep.id, 'load', {}); wake()", number - 3));
    page.until(&format!("moment.numbers.number === {}", number - 3));
    page.value("showRun(latest().id)");
    assert_eq!(page.value("moment"), Value::Null);
}

/// Drags a surface with adhesion to a gap over its highest peak, and returns the area there, which stays when the hand lets go.
fn area_at(page: &mut Page, gap: f64) -> f64 {
    let up = format!("({gap} * section.highest - section.mean_gap) * frame(byId('section')).perHeight");
    let up = page.value(&up).as_f64().unwrap();
    let grip = middle(page.place("press"));
    drag(page, grip, [0.0, -up]);
    page.until("!grip && !holding");
    let held = page.value("section.mean_gap / section.highest").as_f64().unwrap();
    assert!((held / gap - 1.0).abs() < 0.02, "{held}, not {gap}");
    page.value("moment.numbers.relative_area").as_f64().unwrap()
}

/// With adhesion the contact under the hand goes on from the last one: at one gap a wave touches or not.
fn an_attraction_snaps_in_and_lets_go(page: &mut Page) {
    page.value(
        "Object.assign(knobs, { body: 'sine', roughness: 0, points: 2048, load: 0.001, adhesion: 6e-7, range: 1e-4 }); \
        show(); changed()",
    );
    pictured(page);
    assert!(run(page)["numbers"]["relative_area"].as_f64().unwrap() > 0.3, "it sticks");
    assert!(area_at(page, 1.38) > 0.05, "it holds on while it is pulled up");
    let pull = page.value("moment.numbers.reduced_pressure").as_f64().unwrap();
    assert!(pull < -0.05);
    let field = page.text("document.getElementById('control-load-value').value");
    assert!(
        (field.parse::<f64>().unwrap() / pull - 1.0).abs() < 5e-3,
        "the field has {field}, the hand pulls with {pull}"
    );
    assert_eq!(area_at(page, 1.6), 0.0, "it lets go");
    assert_eq!(area_at(page, 1.38), 0.0, "it stays apart");
    assert!(area_at(page, 1.2) > 0.1, "it snaps in");
    assert_eq!(load(page), 0.001, "no load has the contact alone");
    page.value("Object.assign(knobs, { adhesion: 0 }); show(); changed()");
    pictured(page);
    assert_eq!(page.value("moment"), Value::Null);
}

/// A cylinder beside the surface: both have their names and loads, and the cylinder the curve of its exact pressure.
fn both_halves_say_what_they_are(page: &mut Page) {
    page.value("Object.assign(knobs.beside, { body: 'round', roughness: 0 }); changed(); true");
    pictured(page);
    let [own, other] = ["label-pressure", "label-beside"].map(|id| page.text(&format!("byId('{id}').textContent")));
    let told = |page: &mut Page, of: &str| page.text(&format!("figure(latest(){of}.numbers.reduced_pressure, 3)"));
    let [load, load_beside] = ["", ".beside"].map(|of| told(page, of));
    assert!(own.starts_with(&format!("Rough line, p* = {load}. Contact pressure")), "{own}");
    assert!(other.starts_with(&format!("Cylinder, p* = {load_beside}, same mean pressure. ")), "{other}");
    let green = "(() => { const { width, height } = byId('section-beside'); const want = rgb(colours().green); \
        const { data } = byId('section-beside').getContext('2d').getImageData(0, 0, width, height); let found = 0; \
        for (let i = 0; i < data.length; i += 4) if (want.every((it, j) => Math.abs(it - data[i + j]) < 8)) found += 1; return found; })()";
    assert!(page.value(green).as_u64().unwrap() > 50, "the exact pressure is drawn beside");
    assert!(
        page.value("section.exact").is_null() && !own.ends_with("exact") && other.ends_with("dashed: exact"),
        "{own} {other}"
    );
}

/// Another surface beside, under the same mean pressure.
fn surfaces_stand_side_by_side(page: &mut Page) {
    pictured(page);
    page.click("dice");
    pictured(page);
    page.click("beside");
    pictured(page);
    assert_eq!(page.value("document.getElementById('section-beside-box').hidden"), false);
    page.click("fringes");
    page.until("section.shear && beside.shear");
    page.click("fringes");
    page.until("!section.shear");
    let pressure = |page: &mut Page, of: &str| page.value(&format!("{of}.pressure.reduce((sum, p) => sum + p, 0)"));
    let [one, other] = ["section", "beside"].map(|of| pressure(page, of).as_f64().unwrap());
    assert!((one / other - 1.0).abs() < 0.2, "the sums over columns are {one} and {other}");
    let [first, second] =
        ["latest().numbers", "latest().beside.numbers"].map(|it| page.value(&format!("{it}.relative_area")));
    assert_ne!(first, second);
    both_halves_say_what_they_are(page);
    page.click("beside");
    pictured(page);
    assert_eq!(page.value("document.getElementById('section-beside-box').hidden"), true);
}

#[test]
fn a_person_with_a_hand_on_the_contact() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = opened(&program);
    page.resize([1440, 880]);
    pressing_raises_the_load(&mut page);
    what_a_hand_passes_is_not_made(&mut page);
    lifting_lets_go(&mut page);
    what_is_lifted_clear_stays(&mut page);
    a_cylinder_presses_a_dent(&mut page);
    keys_press(&mut page);
    a_dragged_point_follows_the_hand(&mut page);
    bending_changes_the_shape(&mut page);
    patches_are_picked(&mut page);
    surfaces_stand_side_by_side(&mut page);
    loads_are_picked(&mut page);
    an_attraction_snaps_in_and_lets_go(&mut page);
    assert_eq!(page.value("document.getElementById('fault').hidden"), true);
}
