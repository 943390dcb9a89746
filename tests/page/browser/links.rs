//! Links: what one person sees another sees, and addresses that are none do no harm.

use super::chromium::{Chromium, installed};
use super::explorer::{Explorer, rested, sketched};
use super::page::Page;
use serde_json::{Value, json};
use std::path::Path;

/// What a person sees: the knobs, the numbers of the run and of what it is compared with, and the step of the lesson. Seconds differ.
fn seen(page: &mut Page) -> Value {
    page.value(
        "(() => { const numbers = (run) => { if (!run) return null; const { seconds, ...rest } = run.numbers; return rest; }; \
         return { run: numbers(latest()), knobs: latest().knobs, pinned: numbers(pinned && runOf(pinned)), \
           lesson: lesson && [lesson.name, lesson.at] }; })()",
    )
}

/// The link that the page copies.
fn link(page: &mut Page) -> String {
    let origin = page.text("location.origin");
    let allow = json!({"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"], "origin": origin});
    page.chromium.browser("Browser.grantPermissions", allow);
    page.click("copy-link");
    page.until("byId('hint').innerText.startsWith('Copied: the address')");
    page.text("linked()")
}

/// What the state of a link looks like in another browser, before another server.
fn elsewhere(program: &Path, link: &str) -> Value {
    let explorer = Explorer::start();
    let mut page = Page { chromium: Chromium::without_graphics(program) };
    let (_, state) = link.split_once('#').unwrap();
    page.follow(&explorer.address(&format!("&renderer=webgl&theme=dark&language=de#{state}")));
    page.until("isOpened");
    rested(&mut page);
    assert_eq!(page.text("document.documentElement.lang"), "de", "the reader's language stays");
    assert_eq!(page.value("byId('fault').hidden"), true);
    seen(&mut page)
}

/// A state of knobs with a run that is pinned, and a step of a lesson.
fn links_of_a_person(program: &Path) -> Vec<(String, Value)> {
    let (_explorer, mut page) = sketched(program, "");
    let mut links = Vec::new();
    page.click("pin");
    page.until("pinned !== null");
    page.type_into("control-seed", "77");
    page.type_into("control-load-value", "0.037");
    page.until("knobs.seed === 77 && knobs.load === 0.037");
    rested(&mut page);
    let copied = link(&mut page);
    assert!(!copied.contains('?'), "{copied} holds what is the reader's own");
    links.push((copied, seen(&mut page)));
    page.click("pin");
    page.until("pinned === null");
    page.value("openLesson('coating', 1)");
    page.until("document.body.dataset.lesson === '1'");
    page.click("answer-2");
    rested(&mut page);
    links.push((link(&mut page), seen(&mut page)));
    links
}

#[test]
fn a_link_shows_the_same_numbers_elsewhere() {
    let Some(program) = installed() else { return };
    let links = links_of_a_person(&program);
    let (address, told) = &links[0];
    let other = elsewhere(&program, address);
    assert!(other["run"]["kappa_r"].is_f64() && other["pinned"]["kappa_r"].is_f64());
    assert_eq!((&other["knobs"], &other["run"], &other["pinned"]), (&told["knobs"], &told["run"], &told["pinned"]));
    let (address, told) = &links[1];
    assert_eq!(told["lesson"], json!(["coating", 1]));
    let state = address.split_once('#').unwrap().1;
    let explorer = Explorer::start();
    let mut page = Page { chromium: Chromium::without_graphics(&program) };
    page.follow(&explorer.address(&format!("&renderer=webgl&theme=dark#{state}")));
    page.until("document.body.dataset.lesson === '1'");
    page.click("answer-2");
    rested(&mut page);
    let other = seen(&mut page);
    assert_eq!((&other["knobs"], &other["run"], &other["lesson"]), (&told["knobs"], &told["run"], &told["lesson"]));
}

/// What follows the # in addresses that stand for nothing, in JavaScript, with words of the sentence that refuses each.
const HOSTILE: [(&str, &str); 19] = [
    ("'{'", "JSON"),
    ("'%E0%A4%A'", "URI"),
    ("'x'.repeat(1e6)", "longer than 16384"),
    ("'['.repeat(1e4) + ']'.repeat(1e4)", "longer than 16384"),
    ("'{\"knobs\":' + '['.repeat(5e3) + ']'.repeat(5e3) + '}'", ""),
    ("'[]'", "domain"),
    ("'7'", "contains no state"),
    ("'null'", "contains no state"),
    ("'{\"knobs\":NaN}'", "JSON"),
    ("'{\"__proto__\":{\"lesson\":\"crawl\",\"step\":1}}'", "domain"),
    ("e({ knobs: { ...knobs, load: 1e99 } })", "p* cannot be 1e+99: give a number from 0.00001 to 1000."),
    ("e({ knobs: { ...knobs, seed: -3 } })", "Seed cannot be -3: give a whole number from 0 to 4294967295."),
    ("e({ knobs: { ...knobs, load: '0.1' } })", "is not possible: give a number"),
    ("e({ knobs: { ...knobs, body: '<img src=x onerror=hacked=1>' } })", "unknown variant"),
    ("e({ knobs, pinned: { ...knobs, points: -1 } })", "-1 is not possible: give a whole number"),
    ("e({ lesson: '<script>hacked=1</script>', step: 1 })", "there is no lesson"),
    ("e({ lesson: 'crawl', step: -1 })", "has no step -1"),
    ("e({ lesson: 'crawl', step: 1e99 })", "has no step 1e+99"),
    ("e({ lesson: 'crawl', step: '1' })", "has no step \"1\""),
];

#[test]
fn addresses_that_are_none_do_no_harm() {
    let Some(program) = installed() else { return };
    let (explorer, mut page) = sketched(&program, "");
    page.chromium.page("Page.enable", json!({}));
    let before = seen(&mut page);
    for (address, words) in HOSTILE {
        page.value(&format!(
            "(() => {{ const e = (it) => encodeURIComponent(JSON.stringify(it)); fault(''); location.hash = {address}; }})()"
        ));
        page.until("!byId('fault').hidden");
        let said = page.text("byId('fault').innerText");
        assert!(said.starts_with("This address is not valid: "), "{address}: {said}");
        assert!(said.contains(words) && said.len() < 1000, "{address}: {said}");
    }
    assert_eq!(page.value("typeof hacked"), "undefined");
    assert_eq!(page.chromium.events("Page.javascriptDialogOpening").count(), 0);
    assert_eq!(seen(&mut page), before, "an address that was refused has changed something");
    let hash = page.text("encodeURIComponent(JSON.stringify({ knobs: { ...knobs, load: 1e99 } }))");
    page.open("about:blank");
    page.follow(&explorer.address(&format!("&renderer=webgl&theme=dark#{hash}")));
    page.until("isOpened && byId('fault').innerText.includes('p* cannot be 1e+99')");
    page.click("dice");
    page.until("byId('fault').hidden");
    rested(&mut page);
    assert_eq!(page.text("document.body.dataset.status"), "converged");
}
