//! A person who looks: curves on their axes, contrast, room for everything, and what belongs to another surface.

use super::chromium::installed;
use super::explorer::{opened, rested, sketched};
use super::heights::{drop_on, map};
use super::page::Page;
use serde_json::{Value, json};
use std::collections::HashMap;
use std::io::Write;
use std::time::{Duration, Instant};

/// Texts whose contrast with the ground behind them is below 4.5 (WCAG 2.1, 1.4.3), with their contrast.
pub const PALE: &str = "(() => { \
    const pen = document.createElement('canvas').getContext('2d', { willReadFrequently: true }); \
    const rgba = (css) => { pen.clearRect(0, 0, 1, 1); pen.fillStyle = css; pen.fillRect(0, 0, 1, 1); return [...pen.getImageData(0, 0, 1, 1).data]; }; \
    const bright = ([r, g, b]) => [0.2126, 0.7152, 0.0722].reduce((sum, share, i) => { \
      const c = [r, g, b][i] / 255; return sum + share * (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4); }, 0); \
    const ground = (it) => { for (; it; it = it.parentElement) { const c = rgba(getComputedStyle(it).backgroundColor); if (c[3] === 255) return c; } return [255, 255, 255, 255]; }; \
    const isSeen = (it) => it.checkVisibility() && !it.closest(':disabled') && [...it.childNodes].some((node) => node.nodeType === 3 && node.data.trim()); \
    return [...document.querySelectorAll('body *')].filter(isSeen).map((it) => { \
      const style = getComputedStyle(it); const own = rgba(it instanceof SVGElement ? style.fill : style.color); \
      const [low, high] = [bright(own), bright(ground(it))].sort((a, b) => a - b); \
      return [`${it.tagName} ${it.textContent.trim().slice(0, 30)}`, (high + 0.05) / (low + 0.05)]; }).filter(([, contrast]) => contrast < 4.5); })()";

/// Elements that stick out of the window or, as texts of charts, out of their chart; and controls that lie on one another.
pub const CUT: &str = "(() => { \
    const box = (it) => it.getBoundingClientRect(); const named = (it) => `${it.tagName} ${it.id} ${it.textContent.trim().slice(0, 30)}`; \
    const isIn = (a, b) => a.left >= b.left - 1 && a.right <= b.right + 1 && a.top >= b.top - 1 && a.bottom <= b.bottom + 1; \
    const all = [...document.querySelectorAll('header *, #player *, #lesson-card *, #numbers td, #numbers th, #results figure')].filter((it) => it.checkVisibility() && it.tagName !== 'OPTION'); \
    const out = all.filter((it) => !isIn(box(it), { left: 0, top: 0, right: innerWidth, bottom: innerHeight })); \
    const texts = [...document.querySelectorAll('#results svg text')].filter((it) => !isIn(box(it), box(it.closest('svg')))); \
    const [table, ...figures] = [...document.querySelectorAll('#numbers, #results figure')].map(box); \
    const on = figures.filter((figure) => table.right > figure.left + 1 && table.bottom > figure.top + 1).map(() => 'the table lies on a chart'); \
    return [...out.map(named), ...texts.map(named), ...on]; })()";

/// What a phone shows beyond its width: down the page one gets by a finger, sideways nobody looks.
pub const WIDE: &str = "[...document.querySelectorAll('body *')].filter((it) => it.checkVisibility({ visibilityProperty: true }) && it.tagName !== 'OPTION') \
    .filter((it) => it.getBoundingClientRect().right > innerWidth + 1).map((it) => `${it.tagName} ${it.id}`)";

/// Pictures that are shown and are lower than a fifth of the window.
const SLITS: &str = "['#own', '#viewer'].map((it) => document.querySelector(it)).filter((it) => it.checkVisibility({ visibilityProperty: true })) \
    .filter((it) => it.getBoundingClientRect().height < innerHeight / 5 - 1).map((it) => `${it.id} ${it.getBoundingClientRect().height}`)";

/// Loads the checker of accessibility that `AXE` names, the file `axe.min.js` of the package `axe-core`; without it says so.
pub fn load_axe(page: &mut Page) -> bool {
    let Some(file) = std::env::var_os("AXE") else {
        writeln!(std::io::stderr(), "skipped: AXE names no axe.min.js to check the page with").ok();
        return false;
    };
    page.value(&format!("{}; true", std::fs::read_to_string(file).unwrap()));
    true
}

/// What axe-core finds that is serious or worse.
pub const SERIOUS: &str = "axe.run(document).then(({ violations }) => violations \
    .filter(({ impact }) => ['serious', 'critical'].includes(impact)) \
    .map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.target.join(' ')).join(', ')}`))";

/// The pictures before and after the pointer has moved are the same.
fn curves_stand_on_their_axes(page: &mut Page, when: &str) {
    let before = page.settled();
    let [x, y, width, _] = page.place("canvas");
    page.point([x + 0.3 * width, y + 3.0]);
    page.point([x + 0.3 * width, 2.0]);
    page.value("wake()");
    let after = page.settled();
    let moved = before.iter().zip(&after).filter(|(a, b)| a != b).count();
    assert_eq!(moved, 0, "pixels that changed with the pointer, {when}");
}

fn sweep(page: &mut Page) {
    page.click("sweep");
    page.until("document.body.dataset.sweep === 'ended' && document.body.dataset.busy === 'false'");
}

fn axes_follow_data_layout_and_size(page: &mut Page) {
    sweep(page);
    page.until("(document.body.dataset.shown || '').startsWith('sweep-')");
    curves_stand_on_their_axes(page, "after a sweep");
    page.press_at("lesson", "h");
    page.until("document.body.dataset.lesson === '0'");
    page.click("answer-2");
    rested(page);
    curves_stand_on_their_axes(page, "in a lesson");
    page.click("lesson-close");
    curves_stand_on_their_axes(page, "after a lesson was closed");
    page.resize([1420, 880]);
    curves_stand_on_their_axes(page, "after the window has changed");
}

/// What an expression finds, once the page has followed its window: nothing, or what it still finds after a while.
pub fn left_of(page: &mut Page, expression: &str) -> Value {
    let deadline = Instant::now() + Duration::from_secs(60);
    loop {
        let found = page.value(expression);
        if found == json!([]) || Instant::now() > deadline {
            return found;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
}

/// Every text is read in both themes, all of the page has room in both sizes, and nothing keeps anybody out.
///
/// A lesson asks meanwhile, and another theme does not answer for the person.
fn all_is_read_and_nothing_is_cut(page: &mut Page) {
    let has_axe = load_axe(page);
    page.press_at("lesson", "h");
    page.until("document.body.dataset.lesson === '0' && document.body.dataset.unpressed === '0'");
    for theme in ["dark", "light"] {
        page.until(&format!("document.documentElement.dataset.theme === '{theme}'"));
        for size in [[390, 844], [1024, 768], [1440, 900]] {
            page.resize(size);
            page.until(&format!("innerWidth === {} && document.querySelector('#results svg')", size[0]));
            for finds in [PALE, if size[0] < 700 { WIDE } else { CUT }, SLITS] {
                assert_eq!(left_of(page, finds), json!([]), "{theme}, {size:?}");
            }
            if has_axe {
                assert_eq!(page.value(SERIOUS), json!([]), "{theme}, {size:?}");
            }
        }
        page.click("theme");
    }
    rested(page);
    assert_eq!(
        page.value("[document.body.dataset.asked, moment.isClear, section.pressure.some((p) => p > 0)]"),
        json!(["true", true, false])
    );
    page.click("lesson-close");
}

/// The viewer draws on the ground of the theme, after each change of it.
fn the_viewer_has_the_ground_of_the_theme(page: &mut Page) {
    for theme in ["dark", "light"] {
        page.until(&format!("document.documentElement.dataset.theme === '{theme}'"));
        rested(page);
        let mut counts = HashMap::new();
        page.settled().into_iter().for_each(|pixel| *counts.entry(pixel).or_insert(0) += 1);
        let (ground, _) = counts.into_iter().max_by_key(|(_, count)| *count).unwrap();
        assert_eq!(ground[0] > 128, theme == "light", "the viewer's ground in the theme {theme} is {ground:?}");
        page.click("theme");
    }
    rested(page);
}

/// The page takes what is dropped on the viewer, and the viewer shows its contact.
fn a_file_dropped_on_the_viewer_is_seen_in_it(page: &mut Page) {
    let before = page.settled();
    drop_on(page, "canvas", "map.txt", &map());
    page.until("knobs.body === 'file'");
    rested(page);
    page.until_redrawn(&before, 0.1);
}

/// A sweep that has one load yet is drawn, though its axis has no length.
fn the_first_load_of_a_sweep_is_drawn(page: &mut Page) {
    let drawn = "(() => { const { sweep } = report; \
        report.sweep = { ...sweep, points: [{ ...sweep.points[0], reduced_pressure: 1e-4 }] }; charts(); \
        const points = document.querySelector('#chart-kappa polyline.second').points.numberOfItems; \
        report.sweep = sweep; charts(); return points; })()";
    assert_eq!(page.value(drawn), 1);
}

/// A sweep of another surface is grey and says so, and is drawn as before when its surface is back.
fn stale_curves_say_so(page: &mut Page) {
    sweep(page);
    let note = "[...document.querySelectorAll('#chart-kappa .note')].map((it) => it.textContent).join(', ')";
    assert_eq!(page.text(note), "");
    the_first_load_of_a_sweep_is_drawn(page);
    let colour = "getComputedStyle(document.querySelector('#chart-kappa polyline.second')).stroke";
    let fresh = page.text(colour);
    let seed = page.value("knobs.seed").to_string();
    page.click("dice");
    assert_eq!(page.text(note), "Changed: sweep again");
    assert_ne!(page.text(colour), fresh);
    rested(page);
    page.type_into("control-seed", &seed);
    rested(page);
    assert_eq!((page.text(note), page.text(colour)), (String::new(), fresh));
}

/// A pin is set aside in a lesson and comes back after it; its numbers outlive a reload.
fn a_pin_keeps_its_numbers(page: &mut Page) {
    page.click("pin");
    page.until("pinned !== null");
    let pin = page.text("pinned");
    let kappa = page.text("document.querySelector('#numbers td[data-number=kappa]').innerText");
    assert_eq!(
        page.text("document.querySelector('#numbers td[data-number=kappa] + td').innerText"),
        kappa,
        "its own column"
    );
    page.click("dice");
    rested(page);
    let rival = "document.querySelector('#numbers td[data-number=kappa] + td').innerText";
    assert_eq!(page.text(rival), kappa);
    page.press_at("lesson", "h");
    page.until("document.body.dataset.lesson === '0' && pinned === null");
    page.click("answer-2");
    rested(page);
    page.click("lesson-close");
    page.until(&format!("pinned === '{pin}'"));
    let address = page.text("location.href");
    page.open("about:blank");
    page.open(&address);
    page.until("pinned !== null");
    rested(page);
    assert_eq!((page.text("pinned"), page.text(rival)), (pin, kappa));
    assert_eq!(page.text("document.getElementById('rival').innerText"), "pinned");
    page.click("pin");
}

/// What the table says of a symbol in the dialog *Glossary*.
fn words_are_explained(page: &mut Page) {
    page.click("words");
    let words = page.value("[...document.querySelectorAll('#glossary dt')].map((it) => it.innerText)");
    assert_eq!(
        words,
        json!(["E*", "a_rel", "p*", "κ", "κ_r", "η", "ḡ, ḡ_r", "h_rms", "H_c", "Y, H", "t, L", "f, τ", "V, T", "w, ρ"])
    );
    assert_eq!(page.value("document.getElementById('glossary').open"), true);
    page.press("Escape");
    assert_eq!(page.value("document.getElementById('glossary').open"), Value::Bool(false));
}

/// The slider of the steps and *Play* move the page's own picture, without the viewer too.
fn steps_move_the_picture(page: &mut Page) {
    page.press_at("control-solver", "ArrowDown");
    rested(page);
    page.until("latest().steps && sectionRun === latest().id");
    page.value("globalThis.end = section; true");
    page.press_at("scrub", "Home");
    page.until("moment?.step === 0 && section !== end");
    assert_eq!(page.value("section.solid.every((z, i) => z === end.solid[i])"), false);
    page.value(
        "document.getElementById('duration').value = 0.9; globalThis.pictures = new Set(); \
        globalThis.watch = setInterval(() => pictures.add(section)); true",
    );
    page.click("play");
    page.until("document.getElementById('play').textContent === 'Play' && sectionRun === latest().id");
    assert!(page.value("clearInterval(watch), pictures.size").as_u64().unwrap() > 2);
    page.press_at("control-solver", "Home");
    rested(page);
}

/// Another theme leaves the sweep that is drawn as it is, and solves nothing where no viewer shows recordings.
fn the_theme_keeps_what_is_drawn(page: &mut Page) {
    let drawn = "document.querySelector('#chart-kappa polyline.second').points.numberOfItems";
    let (points, run) = (page.value(drawn), page.value("latest().id"));
    page.click("theme");
    assert_eq!((page.value(drawn), page.value("latest().id"), page.value("report.busy")), (points, run, false.into()));
    page.click("theme");
}

/// Another theme while the load is swept keeps the points that are drawn, and the sweep comes to its end in the other colours.
fn the_theme_changes_during_a_sweep(page: &mut Page) {
    sweep(page);
    let all = page.value("report.sweep.points.length");
    page.value(
        "globalThis.counts = []; globalThis.first = report.sweep.id; globalThis.theme = knobs.theme; \
        globalThis.watch = setInterval(() => counts.push([knobs.theme, report.sweep.points.length])); true",
    );
    page.click("sweep");
    page.until("report.sweep.id !== first && report.sweep.points.length > 1");
    page.click("theme");
    page.until(
        "report.sweep.ended && !report.busy && report.sweep.knobs.theme === knobs.theme && knobs.theme !== theme",
    );
    let [drawn, least] = [
        "Math.max(...counts.filter(([it]) => it === theme).map(([, points]) => points).slice(-1))",
        "Math.min(...counts.filter(([it]) => it !== theme).map(([, points]) => points))",
    ]
    .map(|count| page.value(count).as_u64().unwrap());
    page.value("clearInterval(watch), true");
    assert!(least >= drawn, "points before the theme changed: {drawn}, and the fewest after it: {least}");
    assert_eq!(page.value("report.sweep.points.length"), all);
    assert_eq!(page.value("runs.filter(({ ended }) => !ended)"), json!([]));
    page.click("theme");
    page.until("report.sweep.ended && !report.busy && report.sweep.knobs.theme === knobs.theme");
}

/// Persson's curve is drawn for rough flats on a half-space, and for nothing else; the axis of kappa holds all curves.
fn persson_is_about_rough_flats(page: &mut Page) {
    let persson = "document.querySelectorAll('#results polyline.persson').length";
    assert_eq!(page.value(persson), 2);
    page.type_into("control-layer-value", "0.02");
    rested(page);
    sweep(page);
    page.until("report.sweep.knobs.layer === 0.02 && report.sweep.ended");
    assert_eq!(page.value(persson), 0);
    let tops = "[3.9, 9.5, 14].map((value) => topOf([{ points: [[0.1, value]] }]))";
    assert_eq!(page.value(tops), json!([4, 10, 10]));
    assert_eq!(page.value("topOf([], [], 14)"), 20, "the state that is shown is on the axis");
    page.type_into("control-layer-value", "0");
    rested(page);
}

#[test]
fn a_person_who_looks() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = opened(&program);
    axes_follow_data_layout_and_size(&mut page);
    all_is_read_and_nothing_is_cut(&mut page);
    the_viewer_has_the_ground_of_the_theme(&mut page);
    a_file_dropped_on_the_viewer_is_seen_in_it(&mut page);
}

#[test]
fn a_person_who_compares() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "");
    stale_curves_say_so(&mut page);
    the_theme_keeps_what_is_drawn(&mut page);
    persson_is_about_rough_flats(&mut page);
    steps_move_the_picture(&mut page);
    a_pin_keeps_its_numbers(&mut page);
    words_are_explained(&mut page);
}

#[test]
fn a_person_who_changes_the_theme() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = opened(&program);
    the_theme_changes_during_a_sweep(&mut page);
}
