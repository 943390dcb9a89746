//! People of all kinds: who reads German, who has a finger for a pointer, who has it on paper.

use super::appearance::{CUT, PALE, SERIOUS, WIDE, left_of, load_axe};
use super::chromium::installed;
use super::explorer::{rested, sketched};
use super::page::Page;
use base64::prelude::{BASE64_STANDARD, Engine};
use serde_json::{Value, json};

/// Words of controls, tables and lists that are cut off where they stand.
const CLIPPED: &str = "[...document.querySelectorAll('button, label, legend, th, h1, h2, #lesson-card p')] \
    .filter((it) => it.checkVisibility() && it.scrollWidth > it.clientWidth + 1 && it.clientWidth > 0) \
    .map((it) => `${it.tagName} ${it.id} ${it.textContent.trim().slice(0, 30)}`)";

/// Nothing is pale, cut off or in anybody's way, on a telephone, a tablet and a screen.
fn is_well(page: &mut Page, has_axe: bool, when: &str) {
    for size in [[390, 844], [1440, 900], [1024, 768]] {
        page.resize(size);
        page.until(&format!("innerWidth === {}", size[0]));
        let cut = if size[0] < 700 { WIDE } else { CUT };
        for (what, finds) in [("pale", PALE), ("cut off", cut), ("clipped", CLIPPED)] {
            assert_eq!(left_of(page, finds), json!([]), "{what}, {when}, {size:?}");
        }
        if has_axe {
            assert_eq!(page.value(SERIOUS), json!([]), "{when}, {size:?}");
        }
    }
}

/// A map of 16 x 16 heights on the page, as a file that is dropped.
fn drop_heights(page: &mut Page) {
    let row = |y: usize| (0..16).map(|x| format!("{:.3}", ((x * y) as f64 * 0.3).sin())).collect::<Vec<_>>().join("\t");
    let text = (0..16).map(row).collect::<Vec<_>>().join("\n");
    page.value(&format!("takeFile(new File([{}], 'map.txt')).then(() => true)", json!(text)));
    page.until("knobs.body === 'file' && document.querySelector('#heights h3')");
}

#[test]
fn a_person_who_reads_german() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "&language=de");
    assert_eq!(page.text("document.documentElement.lang"), "de");
    for (id, words) in
        [("sweep", "Last steigern"), ("play", "Abspielen"), ("pin", "Anheften"), ("copy-link", "Link kopieren")]
    {
        assert_eq!(page.text(&format!("byId('{id}').innerText")), words);
    }
    let has_axe = load_axe(&mut page);
    page.type_into("control-load-value", "0");
    assert_eq!(
        page.text("byId('fault').innerText"),
        "p* kann nicht 0 sein: Geben Sie eine Zahl von 0,00001 bis 1000 an."
    );
    for theme in ["dark", "light"] {
        page.until(&format!("document.documentElement.dataset.theme === '{theme}'"));
        page.value("openLesson('yield', 2)");
        page.until("document.body.dataset.asked === 'true'");
        is_well(&mut page, has_axe, &format!("a German question, {theme}"));
        page.type_into("guess-number", "0.2");
        page.click("answer-1");
        rested(&mut page);
        page.until("byId('lesson-verdict').innerText.includes('Der Lauf ergibt')");
        is_well(&mut page, has_axe, &format!("a German answer, {theme}"));
        page.click("lesson-close");
        drop_heights(&mut page);
        page.until("byId('fault').innerText.startsWith('Die Datei nennt keine Größe. Geben Sie ihre Breite')");
        page.type_into("heights-width", "10 um");
        page.until("byId('heights').innerText.includes('RMS-Gradient')");
        rested(&mut page);
        let told = page.text("byId('heights').innerText");
        let english = ["the ", "heights", "points", "along", "rms ", " is ", " of "];
        assert!(!english.iter().any(|word| told.contains(word)), "{told}");
        page.value("takeFile(new File(['no numbers'], 'prose.txt')).then(() => true)");
        page.until("byId('fault').innerText.startsWith('prose.txt ist keine brauchbare Datei mit Höhen: Sie ist')");
        is_well(&mut page, has_axe, &format!("a German file, {theme}"));
        page.value("openLesson('hertz-and-rough')");
        page.until("document.body.dataset.asked === 'true'");
        page.click("answer-2");
        rested(&mut page);
        page.click("lesson-close");
        page.click("theme");
    }
    languages_change(&mut page);
}

/// Another language is chosen in the list: the page says the same of the same state, and remembers it.
fn languages_change(page: &mut Page) {
    page.type_into("control-load-value", "0.02");
    page.until("latest().knobs.load === 0.02");
    rested(page);
    let before = page.value("latest().numbers.kappa_r");
    page.value(
        "(() => { const list = byId('language'); list.value = 'en'; list.dispatchEvent(new Event('change')); return true; })()",
    );
    page.until(
        "document.readyState === 'complete' && document.documentElement.lang === 'en' && typeof byId === 'function'",
    );
    page.until("document.body.dataset.viewer");
    rested(page);
    assert_eq!(page.text("byId('sweep').innerText"), "Sweep the load");
    assert_eq!(page.value("[knobs.load, latest().numbers.kappa_r]"), json!([0.02, before]));
    assert_eq!(page.text("localStorage.getItem('language')"), "en");
}

/// Controls that a finger may miss: less than 40 pixels high, or wide. Words that point stand in a sentence and are as high as its lines.
const SMALL: &str = "[...document.querySelectorAll('button:not(.point), select, input:not([type=file]):not([type=checkbox]), .checks label')] \
    .filter((it) => it.checkVisibility()).map((it) => [it, it.getBoundingClientRect()]) \
    .filter(([, box]) => box.height < 39.5 || box.width < 39.5).map(([it, box]) => `${it.tagName} ${it.id} ${box.width} ${box.height}`)";

#[test]
fn a_person_with_a_finger() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "");
    page.chromium.page("Emulation.setTouchEmulationEnabled", json!({"enabled": true, "maxTouchPoints": 1}));
    page.until("matchMedia('(pointer: coarse)').matches");
    page.resize([1024, 768]);
    page.until("innerWidth === 1024");
    assert_eq!(page.value(SMALL), json!([]));
    let seed = page.value("knobs.seed");
    page.tap("dice");
    page.until(&format!("knobs.seed !== {seed}"));
    rested(&mut page);
    page.value("openLesson('coating')");
    page.until("document.body.dataset.asked === 'true'");
    assert_eq!(page.value(SMALL), json!([]), "in a lesson");
    page.tap("answer-1");
    page.until("document.body.dataset.asked === 'false'");
    rested(&mut page);
    page.tap("lesson-next");
    page.until("document.body.dataset.lesson === '1'");
    page.tap("lesson-close");
    page.until("byId('lesson-card').hidden");
    page.tap("theme");
    page.until("document.documentElement.dataset.theme === 'light'");
}

#[test]
fn a_person_with_a_sheet_of_paper() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "");
    page.value("openLesson('hertz-and-rough', 4)");
    page.until("document.body.dataset.asked === 'true'");
    page.click("answer-1");
    page.until("document.body.dataset.sweep === 'ended' && document.body.dataset.busy === 'false'");
    let told = page.chromium.page("Page.printToPDF", json!({"printBackground": false, "preferCSSPageSize": true}));
    let sheet = BASE64_STANDARD.decode(told["data"].as_str().unwrap()).unwrap();
    if let Some(folder) = std::env::var_os("SHOTS") {
        std::fs::write(std::path::Path::new(&folder).join("sheet.pdf"), &sheet).unwrap();
    }
    let text = String::from_utf8_lossy(&sheet);
    let pages = text.matches("/Type /Page").count() - text.matches("/Type /Pages").count();
    assert!((1..=3).contains(&pages), "{pages} pages are printed");
    page.chromium.page("Emulation.setEmulatedMedia", json!({"media": "print"}));
    let is_seen = |page: &mut Page, id: &str| page.value(&format!("byId('{id}').checkVisibility()"));
    for (id, wanted) in [
        ("numbers", true),
        ("chart-area", true),
        ("lesson-text", true),
        ("section", true),
        ("title", true),
        ("controls", false),
        ("lesson-next", false),
        ("play", false),
        ("language", false),
    ] {
        assert_eq!(is_seen(&mut page, id), Value::Bool(wanted), "{id} on paper");
    }
    assert_eq!(page.text("getComputedStyle(document.body).backgroundColor"), "rgb(255, 255, 255)");
    page.chromium.page("Emulation.setEmulatedMedia", json!({"media": ""}));
    assert_eq!(
        page.text("document.documentElement.dataset.theme"),
        "dark",
        "the page is as it was before it was printed"
    );
}
