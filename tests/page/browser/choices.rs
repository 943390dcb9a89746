//! A person who answers the three questions of the controls: what is pressed, on what, and how; and what stands around them.

use super::appearance::{CUT, SERIOUS, load_axe};
use super::chromium::installed;
use super::explorer::{rested, sketched};
use super::heights::drop_on;
use super::page::Page;
use serde_json::{Value, json};

/// The controls that are seen.
const SEEN: &str =
    "[...document.querySelectorAll('#controls .row')].filter((it) => it.checkVisibility()).map((it) => it.id)";
/// The choices that are marked.
const MARKED: &str =
    "[...document.querySelectorAll('.choices [aria-pressed=true]')].map((it) => it.id.replace('choice-', ''))";
/// What solids and motions put in a state.
const SET: &str =
    "[knobs.hardness > 0, knobs.layer, knobs.creep, knobs.adhesion > 0, knobs.speed, knobs.time, knobs.depth]";

/// A newcomer sees few controls.
fn few_controls_at_first(page: &mut Page) {
    assert_eq!(
        page.value(SEEN),
        json!(["row-domain", "row-hurst", "row-cutoff", "row-seed", "row-material", "row-load"]),
        "the controls at the start"
    );
    assert_eq!(page.value("['solver', 'recording'].map((it) => byId(`group-${it}`).open)"), json!([false, false]));
    assert_eq!(page.value("byId('solving').checkVisibility()"), false, "how it was solved is folded away");
    page.click("show-solving");
    assert_eq!(page.value("byId('solving').innerText.includes('certificate')"), true);
    page.click("show-solving");
}

/// A choice sets what it stands for, clears what others of its question have set, and ends what does not go with it.
fn choices_set_and_clear(page: &mut Page) {
    let none = json!([false, 0, 0, false, 0, 0, 0]);
    for (choice, set, marked, said) in [
        ("coated", json!([false, 0.02, 0, false, 0, 0, 0]), ["rough", "coated", "pressed"], "A thin elastic layer"),
        ("hard", json!([true, 0, 0, false, 0, 0, 0]), ["rough", "hard", "pressed"], "A solid with a hardness"),
        (
            "sliding",
            json!([false, 0, 9, false, 0.5, 0, 0]),
            ["rough", "rubber", "sliding"],
            "Sliding does not go with “Hardness cap”",
        ),
        ("in-time", json!([false, 0, 9, false, 0, 1, 0]), ["rough", "rubber", "in-time"], "The load rests"),
        ("round", json!([false, 0, 9, false, 0, 1, 0]), ["round", "rubber", "in-time"], "A smooth cylinder"),
        (
            "sticky",
            json!([false, 0, 0, true, 0, 0, 0]),
            ["round", "sticky", "pressed"],
            "Sticky does not go with “In time”",
        ),
        ("pulled", json!([false, 0, 0, true, 0, 0, 0.5]), ["round", "sticky", "pulled"], "Pressed, then pulled up"),
        ("elastic", none.clone(), ["round", "elastic", "pressed"], "Elastic does not go with “Pulled off”"),
        ("rough", none, ["rough", "elastic", "pressed"], "A random rough surface"),
    ] {
        page.click(&format!("choice-{choice}"));
        assert_eq!((page.value(SET), page.value(MARKED)), (set, json!(marked)), "{choice}");
        let hint = page.text("byId('hint').innerText");
        assert!(hint.starts_with(said), "{choice}: {hint}");
        rested(page);
        assert_eq!(
            page.value("[latest().numbers.status, byId('fault').hidden]"),
            json!(["converged", true]),
            "{choice}"
        );
    }
}

/// A solid that yields below its surface takes fewer points, as each stands for all layers below, and its load is not swept; what is left
/// has the usual points again.
fn yielding_takes_fewer_points(page: &mut Page) {
    page.click("choice-round");
    rested(page);
    page.click("choice-yielding");
    rested(page);
    let said = "[latest().numbers.status, knobs.points, knobs['yield-stress'] > 0, byId('sweep').disabled, !byId('press').hidden]";
    assert_eq!(page.value(said), json!(["converged", 512, true, true, false]));
    page.until("section.zone.strain.highest > 0");
    assert!(page.text("byId('label-solid').innerText").starts_with("orange: yielded, plastic strain up to "));
    page.click("choice-released");
    rested(page);
    page.until("section.highest_pressure === 0");
    // the imprint is a quarter of the heights that are seen
    let seen = page.value("(axes.high - axes.low) / (Math.max(...section.solid) - Math.min(...section.solid))");
    assert!((seen.as_f64().unwrap() - 4.0).abs() < 1e-3, "{seen}");
    assert_eq!(page.value(MARKED), json!(["round", "yielding", "released"]));
    page.click("choice-hard");
    rested(page);
    assert_eq!(
        page.value("[knobs.points, knobs['yield-stress'], knobs.release, !byId('press').hidden]"),
        json!([4096, 0, false, true])
    );
    page.click("choice-elastic");
    page.click("choice-rough");
    rested(page);
}

/// What is turned by hand marks the choice that it comes to, and what is folded away is counted.
fn turned_knobs_are_choices(page: &mut Page) {
    page.type_into("control-layer-value", "0.1");
    assert_eq!(page.value(MARKED), json!(["rough", "coated", "pressed"]));
    page.type_into("control-skewness-value", "-0.5");
    page.type_into("control-kurtosis-value", "4");
    page.click("more-surface");
    assert_eq!(page.text("byId('more-surface').innerText").trim(), "More (2 changed)");
    page.click("choice-elastic");
    rested(page);
    page.value("Object.assign(knobs, { skewness: 0, kurtosis: 3 }); show(); changed()");
    rested(page);
    assert_eq!(page.text("byId('more-surface').innerText").trim(), "More");
}

/// The lay of a surface is sketched, and its waves are longer along it.
fn a_lay_is_sketched(page: &mut Page) {
    assert_eq!(page.value("byId('lay-sketch').checkVisibility()"), false);
    page.value("Object.assign(knobs, { domain: 'surface', points: 64, cutoff: 32, peklenik: 1, 'lay-angle': 0 }); show(); changed()");
    rested(page);
    page.click("more-surface");
    page.type_into("control-peklenik-value", "8");
    rested(page);
    assert_eq!(page.value("[knobs.cutoff, byId('fault').hidden]"), json!([11, true]), "waves that the points resolve");
    let rough = |by: &str| {
        format!(
            "(() => {{ const it = byId('lay-sketch'); const {{ data }} = it.getContext('2d').getImageData(0, 0, it.width, it.height); \
             let sum = 0; for (let i = 0; i < 4 * it.width * (it.height - 1) - 4; i += 4) sum += Math.abs(data[i] - data[i + {by}]); return sum; }})()"
        )
    };
    let [along, across] = ["4", "4 * it.width"].map(|by| page.value(&rough(by)).as_f64().unwrap());
    assert!(along < 0.5 * across, "{along} along the lay, {across} across it");
    page.click("more-surface");
    page.value("Object.assign(knobs, { domain: 'line', points: 4096, cutoff: 128, peklenik: 1 }); show(); changed()");
    rested(page);
}

#[test]
fn a_person_who_chooses() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "");
    assert_eq!(page.text("document.body.dataset.view"), "picture");
    few_controls_at_first(&mut page);
    choices_set_and_clear(&mut page);
    yielding_takes_fewer_points(&mut page);
    turned_knobs_are_choices(&mut page);
    a_lay_is_sketched(&mut page);
    if load_axe(&mut page) {
        assert_eq!(page.value(SERIOUS), json!([]));
    }
}

/// By the keyboard the first lesson is near, the header has two rows at most, and on a tablet both charts are whole.
#[test]
fn a_person_on_other_screens() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "");
    let mut tabs = 0;
    while page.text("document.activeElement.id") != "welcome-lesson" {
        page.press("Tab");
        tabs += 1;
        assert!(tabs <= 5, "the first lesson is far away");
    }
    page.resize([1280, 720]);
    page.until("innerWidth === 1280");
    let rows = "new Set([...document.querySelectorAll('header h1, nav > *')].filter((it) => it.checkVisibility()) \
        .map((it) => it.getBoundingClientRect()).map(({ top, bottom }) => Math.round((top + bottom) / 2 / 12))).size";
    assert!(page.value(rows).as_f64().unwrap() <= 2.0, "rows of the header");
    page.resize([820, 1180]);
    page.until("innerWidth === 820 && document.querySelector('#chart-kappa svg')");
    assert_eq!(page.value(CUT), json!([]));
}

/// A swipe over the picture moves the page and leaves the contact alone; the handle presses it.
fn a_swipe_scrolls(page: &mut Page) {
    let load = page.value("knobs.load");
    let [x, y, width, height] = page.place("section");
    let swipe = json!({"x": x + width / 3.0, "y": y + height / 2.0, "yDistance": -200, "gestureSourceType": "touch"});
    page.chromium.page("Input.synthesizeScrollGesture", swipe);
    page.until("scrollY > 100");
    assert_eq!(page.value("[grip, knobs.load]"), json!([null, load]));
    let [x, y, width, height] = page.place("press");
    let at = |by: f64| json!([{"x": x + width / 2.0, "y": y + height / 2.0 + by}]);
    for (kind, points) in
        [("touchStart", at(0.0)), ("touchMove", at(12.0)), ("touchMove", at(24.0)), ("touchEnd", json!([]))]
    {
        page.chromium.page("Input.dispatchTouchEvent", json!({"type": kind, "touchPoints": points}));
    }
    page.until(&format!("!grip && !holding && knobs.load > {load}"));
    rested(page);
}

/// A tap on a name says what it does, until the next touch.
fn a_name_is_tapped(page: &mut Page) {
    assert_eq!(page.text("byId('hint').innerText"), "Tap a name to read what it does.");
    page.value("document.querySelector('#row-hurst .name').id = 'name-of-hurst'");
    page.tap("name-of-hurst");
    page.until(
        "byId('hint').innerText.startsWith('Hurst exponent') && getComputedStyle(byId('hint')).position === 'fixed'",
    );
    page.tap("title");
    page.until("getComputedStyle(byId('hint')).position !== 'fixed'");
}

#[test]
fn a_person_with_a_telephone_and_a_finger() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "");
    page.resize([390, 844]);
    page.chromium.page("Emulation.setTouchEmulationEnabled", json!({"enabled": true, "maxTouchPoints": 1}));
    page.value("globalThis.isOld = true; location.reload(); true");
    page.until(
        "typeof isOld === 'undefined' && matchMedia('(pointer: coarse)').matches && document.readyState === 'complete' && typeof byId === 'function'",
    );
    rested(&mut page);
    a_name_is_tapped(&mut page);
    a_swipe_scrolls(&mut page);
}

/// Who wants no motion sees a run in a few pictures.
#[test]
fn a_person_who_wants_no_motion() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "");
    page.chromium.page(
        "Emulation.setEmulatedMedia",
        json!({"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]}),
    );
    page.value(
        "byId('duration').value = 1; globalThis.places = new Set(); \
        globalThis.watch = setInterval(() => { if (playing) places.add(byId('scrub').value); }); true",
    );
    page.click("play");
    page.until("places.size > 4 && playing === null");
    let count = page.value("clearInterval(watch), places.size").as_u64().unwrap();
    assert!(count <= 14, "{count} pictures");
}

/// A file without a size says what it lacks and where to give it; one without content is empty.
#[test]
fn a_person_with_a_poor_file() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "");
    let rows = (0..16).map(|y| (0..16).map(|x| format!("{:.3}", f64::from(x * y).sin())).collect::<Vec<_>>().join(" "));
    drop_on(&mut page, "section", "map.txt", &rows.collect::<Vec<_>>().join("\n"));
    page.until("byId('fault').innerText === 'The file states no size. Type its Width in the marked field.'");
    let field =
        "[document.activeElement.id, byId('heights-width').ariaInvalid, byId('heights-width').checkVisibility()]";
    assert_eq!(page.value(field), json!(["heights-width", "true", true]));
    page.type_into("heights-width", "10 µm");
    rested(&mut page);
    assert_eq!(page.value("[byId('heights-width').ariaInvalid, choiceOf('surface').id]"), json!(["false", "file"]));
    page.value("takeFile(new File([], 'none.txt')).then(() => true)");
    assert_eq!(page.text("byId('fault').innerText"), "none.txt: the file is empty.");
    assert_eq!(page.value("description.name"), Value::from("map.txt"));
}
