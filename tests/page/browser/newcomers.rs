//! People who come for the first time, with a telephone or before a class: what the page offers them, and where it stands.

use super::appearance::{CUT, PALE, SERIOUS, WIDE, load_axe};
use super::chromium::installed;
use super::explorer::{opened, rested, sketched};
use super::page::Page;
use serde_json::{Value, json};

/// The upper ends of elements on the page.
fn tops(page: &mut Page, ids: &[&str]) -> Vec<f64> {
    let tops = page.value(&format!("{}.map((id) => byId(id).getBoundingClientRect().top + scrollY)", json!(ids)));
    tops.as_array().unwrap().iter().map(|top| top.as_f64().unwrap()).collect()
}

fn height(page: &mut Page, id: &str) -> f64 {
    page.value(&format!("byId('{id}').getBoundingClientRect().height")).as_f64().unwrap()
}

/// Names stand on what they name: the rigid surface above its lowest line, the solid below, the pressure over both.
fn names_stand_where_they_belong(page: &mut Page) {
    let names = "['pressure', 'rigid', 'solid', 'drag'].map((id) => byId(`label-${id}`)).map((it) => [it.checkVisibility(), it.innerText])";
    let named = page.value(names);
    for (i, words) in ["Contact pressure, up to ", "rigid surface", "elastic solid", "drag me"].iter().enumerate() {
        assert_eq!(named[i][0], true, "{words}");
        assert!(named[i][1].as_str().unwrap().starts_with(words), "{named}");
    }
    let stand = "(() => { const at = frame(byId('section')); const top = byId('section').getBoundingClientRect().top; \
        const middle = (id) => { const box = byId(`label-${id}`).getBoundingClientRect(); return box.top + box.height / 2 - top; }; \
        const half = section.rigid.length / 2; \
        return [middle('pressure') < at.top, middle('rigid') < at.y(Math.max(...section.rigid)), middle('solid') > at.y(Math.min(...section.solid))]; })()";
    assert_eq!(page.value(stand), json!([true, true, true]), "a name stands on something else");
}

/// Three ways to begin, once.
fn the_first_half_minute(page: &mut Page) {
    assert_eq!(page.value("byId('welcome').checkVisibility()"), true);
    names_stand_where_they_belong(page);
    page.click("welcome-lesson");
    page.until("document.body.dataset.asked === 'true' && byId('welcome').hidden");
    assert_eq!(page.text("byId('lesson').value"), "hertz-and-rough");
    page.type_into("control-load-value", "0.02");
    page.until("document.body.dataset.asked === 'false' && latest()?.knobs.load === 0.02");
    assert_eq!(page.value("byId('lesson-ask').checkVisibility()"), false, "another contact is no answer");
    page.click("lesson-again");
    page.until("document.body.dataset.asked === 'true' && byId('lesson-ask').checkVisibility()");
    page.click("lesson-close");
    rested(page);
    page.value("globalThis.isOld = true; location.reload(); true");
    page.until("typeof isOld === 'undefined' && document.readyState === 'complete' && typeof byId === 'function' && latest()?.ended");
    assert_eq!(page.value("byId('welcome').hidden"), true, "who has begun is not asked again");
}

/// One column: lesson, picture, load and numbers, and the rest folded; nothing beside the screen.
fn a_telephone(page: &mut Page) {
    let has_axe = load_axe(page);
    page.resize([390, 844]);
    page.until("innerWidth === 390 && document.body.dataset.view === 'picture' && lessons.length > 0");
    page.value("openLesson('yield', 0)");
    page.until("document.body.dataset.unpressed === '0'");
    let tops = tops(page, &["lesson-card", "own", "player", "control-load", "numbers", "group-solver"]);
    assert!(tops.is_sorted_by(|a, b| a < b), "{tops:?}");
    assert_eq!(page.value(WIDE), json!([]));
    assert_eq!(page.value(PALE), json!([]));
    if has_axe {
        assert_eq!(page.value(SERIOUS), json!([]));
    }
    page.tap("answer-3");
    rested(page);
    page.value("lesson.at = lesson.steps.length - 1; showEnd(); true");
    assert_eq!(page.value(WIDE), json!([]), "at the end of a lesson");
    page.value("lesson.at = 0; true");
    assert_eq!(page.value("isDeep() && section.shear !== null"), true, "the lesson on yield shows the stress");
    assert_eq!(page.value("byId('save-rrd').checkVisibility()"), false);
    page.value("byId('more').click()");
    assert_eq!(page.value("byId('theme').checkVisibility()"), true);
    assert_eq!(page.value(WIDE), json!([]), "with more");
    page.value("byId('more').click()");
    page.click("share");
    assert_eq!(page.value("byId('save-rrd').checkVisibility()"), true);
    assert_eq!(page.value(WIDE), json!([]), "with the menu");
    page.press("Escape");
    page.until("!byId('save-rrd').checkVisibility()");
    page.value("openLesson('')");
    rested(page);
    assert_eq!(page.value("isDeep()"), false, "and no longer than that");
}

/// With a lesson the picture has nearly half the height of a small laptop, and all else its place below.
fn a_small_laptop(page: &mut Page) {
    page.resize([1024, 768]);
    page.until("innerWidth === 1024");
    page.value("openLesson('coating', 0)");
    page.until("document.body.dataset.unpressed === '0'");
    let share = height(page, "own") / 768.0;
    assert!(share > 0.4, "the picture has {share} of the height");
    assert_eq!(page.value(CUT), json!([]));
    page.value("openLesson('')");
    rested(page);
}

/// Choices are solved, and undone.
fn choices_and_undo(page: &mut Page) {
    page.resize([1440, 900]);
    page.until("innerWidth === 1440");
    page.click("choice-elastic");
    for (choice, body, layer) in [
        ("rough", "flat", 0.0),
        ("coated", "flat", 0.02),
        ("elastic", "flat", 0.0),
        ("round", "round", 0.0),
        ("rough", "flat", 0.0),
    ] {
        page.click(&format!("choice-{choice}"));
        page.until(&format!("latest().knobs.body === '{body}' && latest().knobs.layer === {layer}"));
        rested(page);
        page.until("states.length && words(states.at(-1)) === words(knobs)");
    }
    page.click("undo");
    page.until("latest().knobs.body === 'round'");
    rested(page);
    assert_eq!(page.text("byId('title').innerText"), "Cylinder, p* = 0.01: converged; exact: cylinder, periodic");
    let exact = "(() => { const { exact, pressure } = section; const most = Math.max(...exact); \
        return exact.every((p, i) => Math.abs(p - pressure[i]) < 0.05 * most) && Math.abs(Math.max(...pressure) / most - 1) < 1e-2; })()";
    assert_eq!(page.value(exact), true, "the exact pressure lies over that of the run");
}

/// A sweep plays in the page's own picture, and its point moves on the curves.
fn a_sweep_plays(page: &mut Page) {
    page.click("sweep");
    page.until("document.body.dataset.sweep === 'ended' && document.body.dataset.busy === 'false'");
    let is_shown =
        |at: &str| format!("facet(runOf(report.sweep.id), 'motion').then((it) => it.sections.at({at}) === section)");
    page.press_at("scrub", "Home");
    page.until(&is_shown("0"));
    page.value(
        "byId('duration').value = 2; globalThis.touching = []; globalThis.dots = new Set(); \
        globalThis.watch = setInterval(() => { touching.push(section.pressure.filter((p) => p > 0).length); \
            dots.add(document.querySelector('#chart-kappa circle.of-second')?.getAttribute('cx')); }); true",
    );
    page.click("play");
    page.until(&is_shown("-1"));
    page.until("playing === null");
    let growth = page.value("clearInterval(watch), touching");
    let growth: Vec<u64> = growth.as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
    assert!(growth.is_sorted() && growth.last() > growth.first(), "contact grows with the load: {growth:?}");
    assert!(page.value("dots.size").as_u64().unwrap() > 2, "the point of the load moves on the curve");
}

/// What held a run up is told in words, and drawn.
fn a_slow_run_is_explained(page: &mut Page) {
    page.value(
        "Object.assign(knobs, { body: 'flat', roughness: 0.001, points: 1024, load: 0.05, \
        solver: { method: 'gfmd', masses: 'uniform', dynamics: 'damped', 'time-step': 0.5, damping: 8 } }); show(); changed()",
    );
    page.until("latest().knobs.points === 1024 && latest().ended");
    page.click("why");
    page.until("document.body.dataset.why === latest().id");
    let told = page.text("byId('why-causes').innerText");
    assert!(told.starts_with("The damping is too strong: 8 times the best one for the longest wave"), "{told}");
    assert!(told.contains("All waves have the same mass") && told.contains("Area and κ_r are within 1 %"), "{told}");
    for id in ["why-contact", "why-errors", "why-decisions"] {
        let drawn = format!(
            "(() => {{ const it = byId('{id}'); const {{ data }} = it.getContext('2d').getImageData(0, 0, it.width, it.height); \
             let count = 0; for (let i = 3; i < data.length; i += 4) count += data[i] > 0; return count / (data.length / 4); }})()"
        );
        let share = page.value(&drawn).as_f64().unwrap();
        assert!((0.01..1.0).contains(&share), "{share} of {id} is drawn on");
    }
    page.press("Escape");
}

/// Letters for a wall are half as large again, and lines thicker, and the picture is as large as before.
fn a_class_before_a_wall(page: &mut Page) {
    let size = "parseFloat(getComputedStyle(byId('numbers')).fontSize)";
    let before = page.value(size).as_f64().unwrap();
    let picture = "(({ width, height }) => [width, height])(byId('section').getBoundingClientRect())";
    let sides = |page: &mut Page| serde_json::from_value::<[f64; 2]>(page.value(picture)).unwrap();
    let [width, high] = sides(page);
    page.click("projector");
    assert!(page.value(size).as_f64().unwrap() >= 1.4 * before);
    let [wide, height] = sides(page);
    assert!(wide >= width && height >= high, "a picture of {width} x {high} has become {wide} x {height}");
    assert_eq!(page.value("lineWidth() > 2"), Value::Bool(true));
    page.click("projector");
    assert_eq!(page.value(size).as_f64(), Some(before));
}

#[test]
fn a_person_who_comes_for_the_first_time() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "");
    the_first_half_minute(&mut page);
    a_telephone(&mut page);
    a_small_laptop(&mut page);
    choices_and_undo(&mut page);
    a_sweep_plays(&mut page);
    a_slow_run_is_explained(&mut page);
    a_class_before_a_wall(&mut page);
}

/// German words are longer.
#[test]
fn a_person_with_a_telephone_who_reads_german() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "&language=de");
    assert_eq!(page.text("byId('title').innerText"), "Raue Linie, p* = 0,05: konvergiert");
    a_telephone(&mut page);
}

/// The viewer is not loaded before it is asked for, and goes on where it was left.
#[test]
fn a_person_who_switches_pictures() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = opened(&program);
    page.click("view-picture");
    assert_eq!(page.value("[viewer, byId('own').checkVisibility()]"), json!([null, true]));
    page.type_into("control-load-value", "0.2");
    page.until("latest().knobs.load === 0.2 && latest().ended && sectionRun === latest().id");
    page.click("view-viewer");
    page.until("byId('own').checkVisibility() === false && document.body.dataset.shown?.startsWith(latest().id)");
    page.click("view-both");
    rested(&mut page);
    page.resize([1024, 768]);
    page.until("document.body.dataset.view === 'picture' && viewer === null");
    page.resize([1440, 900]);
    page.until("document.body.dataset.view === 'both' && viewer !== null");
}
