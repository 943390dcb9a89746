//! A person in a lesson, which is opened, guessed and played to its end, and viewer and table follow.

use crate::chromium::installed;
use crate::explorer::{Explorer, opened, rested};
use crate::page::Page;
use base64::prelude::{BASE64_STANDARD, Engine};
use serde_json::{Value, json};

/// Keeps a picture of the page in the folder that `SHOTS` names, if it does.
fn keep(page: &mut Page, name: &str) {
    let Some(folder) = std::env::var_os("SHOTS") else { return };
    page.settled();
    let shot = page.chromium.page("Page.captureScreenshot", json!({"format": "png"}));
    let png = BASE64_STANDARD.decode(shot["data"].as_str().unwrap()).unwrap();
    std::fs::write(std::path::Path::new(&folder).join(format!("{name}.png")), png).unwrap();
}

/// Guesses what is asked, and returns what the page says of the guess.
fn guess(page: &mut Page, ask: &Value) -> String {
    assert_eq!(page.value("document.getElementById('lesson-next').disabled"), true, "a guess comes first");
    match ask["kind"].as_str().unwrap() {
        "choose" => page.click(&format!("answer-{}", ask["right"])),
        "number" => {
            page.click("answer-1");
            assert_eq!(page.text("document.body.dataset.asked"), "true", "no number is no guess");
            assert!(page.text("document.getElementById('fault').innerText").ends_with(" needs a number."));
            page.type_into("guess-number", "-0.5");
            page.click("answer-1");
            assert_eq!(page.text("document.body.dataset.asked"), "true", "a negative number is no guess");
            page.type_into("guess-number", "0.5");
            page.click("answer-1");
        }
        _ => {
            page.value("document.querySelector('#lesson-answers input').focus()");
            page.press("End");
            page.until("document.querySelector('#results polyline.guess')", 10);
            page.click("answer-1");
        }
    }
    page.until("document.body.dataset.asked === 'false'", 10);
    assert_eq!(page.value("document.getElementById('lesson-ask').checkVisibility()"), false, "the question stays");
    page.text("document.getElementById('lesson-verdict').innerText")
}

/// Viewer and table show what the step asks for.
fn followed(explorer: &Explorer, page: &mut Page, step: &Value) {
    if step["sweep"] == true {
        page.until("document.body.dataset.sweep === 'ended' && document.body.dataset.busy === 'false'", 120);
        page.until("(document.body.dataset.shown || '').startsWith('sweep-')", 60);
        assert_eq!(page.value("document.querySelectorAll('#results polyline.second').length"), 1);
        return;
    }
    rested(page);
    let told = explorer.state()["run"]["numbers"]["kappa_r_resolved"].as_f64().unwrap();
    let shown = page.text("document.querySelector('#numbers td[data-number=kappa_r_resolved]').innerText");
    let shown: f64 = shown.split(" ±").next().unwrap().parse().unwrap();
    assert!((shown / told - 1.0).abs() < 6e-3, "kappa_r is shown as {shown} and is {told}");
}

/// What became of a guess: the right choice is praised, a number is told.
fn judged(page: &mut Page, ask: &Value, verdict: &str) {
    match ask["kind"].as_str().unwrap() {
        "choose" => assert!(verdict.starts_with("Yes: "), "{verdict}"),
        "number" => {
            let told = format!("figure(latest().numbers.{})", ask["of"].as_str().unwrap());
            page.until(
                &format!("document.getElementById('lesson-verdict').innerText.endsWith(`The run gives ${{{told}}}.`)"),
                30,
            );
        }
        _ => assert!(verdict.contains("dotted"), "{verdict}"),
    }
}

fn play(explorer: &Explorer, page: &mut Page, lesson: &Value) {
    let name = lesson["name"].as_str().unwrap();
    page.value(&format!(
        "(() => {{ const list = byId('lesson'); list.value = '{name}'; list.dispatchEvent(new Event('change')); }})()"
    ));
    let steps = lesson["steps"].as_array().unwrap();
    for (at, step) in steps.iter().enumerate() {
        page.until(&format!("document.body.dataset.lesson === '{at}'"), 20);
        let verdict = if step["ask"].is_object() { guess(page, &step["ask"]) } else { String::new() };
        followed(explorer, page, step);
        if step["ask"].is_object() {
            judged(page, &step["ask"], &verdict);
        }
        let text = page.text("document.getElementById('lesson-text').innerText");
        assert!(text.contains(step["text"]["en"].as_str().unwrap()), "{text}");
        assert_eq!(page.value("document.getElementById('fault').hidden"), true);
        keep(page, &format!("{name}-{}", at + 1));
        let is_last = page.value("document.getElementById('lesson-next').disabled");
        assert_eq!(is_last, at + 1 == steps.len());
        if is_last == false {
            page.click("lesson-next");
        }
    }
    page.click("lesson-close");
    assert_eq!(page.value("document.getElementById('lesson-card').hidden"), true);
    println!("{name} is played.");
}

#[test]
fn a_person_in_a_lesson() {
    let Some(program) = installed() else { return };
    let (explorer, mut page) = opened(&program);
    let names = page.value("[...document.querySelectorAll('#lesson option')].map((it) => it.textContent)");
    assert_eq!(names.as_array().unwrap().len(), 7);
    let lesson = page.value("lessons[0]");
    play(&explorer, &mut page, &lesson);
}

/// All of them take minutes, and are played without a browser in any case.
#[test]
#[ignore = "takes minutes"]
fn a_person_in_all_lessons() {
    let Some(program) = installed() else { return };
    let (explorer, mut page) = opened(&program);
    page.resize([1440, 900]);
    let lessons = page.value("lessons");
    for lesson in lessons.as_array().unwrap() {
        play(&explorer, &mut page, lesson);
    }
}
