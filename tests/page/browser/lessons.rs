//! A person in a lesson, which is opened, guessed and played to its end, and viewer and table follow.

use super::chromium::installed;
use super::explorer::{Explorer, opened, rested, sketched};
use super::page::Page;
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

/// What a person has to press buttons with.
#[derive(Clone, Copy)]
pub enum Means {
    Mouse,
    Keyboard,
    Finger,
}

impl Means {
    fn press(self, page: &mut Page, id: &str) {
        match self {
            Self::Mouse => page.click(id),
            Self::Keyboard => page.press_at(id, "Enter"),
            Self::Finger => page.tap(id),
        }
    }
}

/// What the page says of a first answer that is wrong.
fn why(page: &mut Page) -> String {
    page.text("document.getElementById('lesson-why').innerText")
}

/// A text as it is seen, without the names of what its words point at.
fn plain(text: &str) -> String {
    let mut parts = text.split("](");
    let mut seen = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let begin = seen.rfind('[').unwrap();
        seen.remove(begin);
        seen.push_str(part.split_once(')').unwrap().1);
    }
    seen
}

/// What is asked about is shown as it is before it is pressed, with no numbers and nothing of the run before.
fn is_unpressed(page: &mut Page) {
    page.until("document.body.dataset.unpressed === document.body.dataset.lesson");
    let seen = "section.solid.every((z) => z === 0) && section.pressure.every((p) => p === 0) && Math.min(...section.rigid) > 0 \
        && !section.fields?.attraction && !section.fields?.traction && byId('press').hidden \
        && document.querySelector('#numbers td[data-number=relative_area]').innerText === '–'";
    assert_eq!(page.value(seen), true, "the contact is shown before the answer");
}

/// Guesses a number: none, one that cannot be, one that is too large, and one that is too small, as far as there is a second try.
fn guess_number(page: &mut Page, step: &Value, means: Means) {
    let of = step["ask"]["of"].as_str().unwrap();
    // of the work of a solver, of processes and of the conductance nothing is known before
    let is_of_process = step["knobs"]["yield-stress"].as_f64().is_some_and(|stress| stress > 0.0);
    let is_known = !["iterations", "transforms", "stick_share", "conductance"].contains(&of) && !is_of_process;
    let is_share = of.starts_with("relative_area") || ["friction", "stick_share"].contains(&of);
    means.press(page, "answer-1");
    assert_eq!(page.text("document.body.dataset.asked"), "true", "no number is no guess");
    let fault = page.text("document.getElementById('fault').innerText");
    let is_told =
        if is_share { fault == "Type a share such as 0.11 or 11 %." } else { fault.ends_with(" needs a number.") };
    assert!(is_told, "{fault}");
    let tell = |page: &mut Page, value: &str| {
        page.fill("guess-number", value);
        means.press(page, "answer-1");
        page.text("document.body.dataset.asked") == "true"
    };
    assert!(tell(page, "-0.5"), "a negative number is no guess");
    let mut large = "4000";
    if of.starts_with("relative_area") {
        assert!(tell(page, large), "an area above 1 is no guess");
        assert!(page.text("byId('fault').innerText").contains("cannot be 4000"));
        large = "0.9";
    }
    assert_eq!(tell(page, large), is_known, "a number that is known has a second try");
    if is_known {
        assert_eq!(why(page), format!("{large} is too large. Try again."));
        assert!(!tell(page, if is_share { "50 %" } else { "0.5" }), "the second number is an answer");
    }
}

/// Answers what is asked, wrongly first where there is a second try, and returns what the page says of the answer.
fn guess(page: &mut Page, step: &Value, means: Means) -> String {
    let ask = &step["ask"];
    assert_eq!(page.value("document.getElementById('lesson-next').disabled"), true, "a guess comes first");
    if ask["kind"] != "act" {
        is_unpressed(page);
    }
    match ask["kind"].as_str().unwrap() {
        "choose" => {
            let choices = ask["choices"].as_array().unwrap();
            let wrong = 1 + choices.iter().position(|it| it["because"].is_object()).unwrap();
            means.press(page, &format!("answer-{wrong}"));
            let because = plain(choices[wrong - 1]["because"]["en"].as_str().unwrap());
            assert_eq!(why(page), format!("No. {because} Try again."));
            assert_eq!(page.value(&format!("byId('answer-{wrong}').disabled")), true);
            means.press(page, &format!("answer-{}", ask["right"]));
        }
        "act" => {
            page.until("latest()?.ended && words(latest().knobs) === words(knobs)");
            assert_eq!(page.text("document.body.dataset.asked"), "true", "it is done before it is done");
            let [from, to] = ["knobs", "solution"].map(|state| step[state].as_object().unwrap());
            let (knob, value) = to.iter().find(|(knob, value)| from[*knob] != **value).unwrap();
            let control = format!("control-{knob}-value");
            page.type_into(&control, &value.to_string());
        }
        "number" => guess_number(page, step, means),
        _ => {
            page.value("document.querySelector('#lesson-answers input').focus()");
            page.press("End");
            page.until("document.querySelector('#results polyline.guess')");
            let target = page.text("guess.target");
            let [x, y, width, height] = page.place(&target);
            page.mouse("mousePressed", [x + 0.5 * width, y + 0.4 * height]);
            page.mouse("mouseMoved", [x + 0.8 * width, y + 0.6 * height]);
            page.mouse("mouseReleased", [x + 0.8 * width, y + 0.6 * height]);
            let drawn = "(() => { const { points, top } = guess; return [points[0][1] === top, points.some(([, v]) => v > 0.25 * top && v < 0.75 * top && v !== top / 2)]; })()";
            assert_eq!(page.value(drawn), json!([true, true]), "the sliders and the hand draw one curve");
            means.press(page, "answer-1");
        }
    }
    page.until("document.body.dataset.asked === 'false'");
    assert_eq!(page.value("document.getElementById('lesson-ask').checkVisibility()"), false, "the question stays");
    page.text("document.getElementById('lesson-verdict').innerText")
}

/// Viewer and table show what the step asks for; a site has no server that tells its numbers, and no viewer at first.
fn followed(explorer: Option<&Explorer>, page: &mut Page, step: &Value) {
    if step["sweep"] == true {
        page.until("document.body.dataset.sweep === 'ended' && document.body.dataset.busy === 'false'");
        page.until(match explorer {
            Some(_) => "(document.body.dataset.shown || '').startsWith('sweep-')",
            None => "report.sweep.ended && words({ ...report.sweep.knobs, load: 0 }) === words({ ...knobs, load: 0 })",
        });
        assert_eq!(page.value("document.querySelectorAll('#results polyline.second').length"), 1);
        return;
    }
    rested(page);
    let told = match explorer {
        Some(explorer) => explorer.state()["run"]["numbers"]["kappa_r"].clone(),
        None => page.value("latest().numbers.kappa_r"),
    };
    let shown = page.text("document.querySelector('#numbers td[data-number=kappa_r]')?.innerText ?? '–'");
    let Some(told) = told.as_f64() else {
        assert_eq!(shown, "–", "with adhesion, or without contact, there is no kappa_r");
        return;
    };
    let shown: f64 = shown.split(" ±").next().unwrap().replace(',', ".").parse().unwrap();
    assert!((shown - told).abs() <= 6e-3 * told, "kappa_r is shown as {shown} and is {told}");
}

/// What became of a guess: the right choice is praised, a number is told.
fn judged(page: &mut Page, ask: &Value, verdict: &str) {
    match ask["kind"].as_str().unwrap() {
        "choose" => assert!(verdict.starts_with("Yes: "), "{verdict}"),
        "act" => assert_eq!(verdict, "Done."),
        "number" => {
            let told = format!("figure(latest().numbers.{})", ask["of"].as_str().unwrap());
            page.until(
                &format!("document.getElementById('lesson-verdict').innerText.includes(`The run gives ${{{told}}}. Your guess is `)"));
            let verdict = page.text("document.getElementById('lesson-verdict').innerText");
            assert!(verdict.ends_with(" too large.") || verdict.ends_with(" too small."), "{verdict}");
        }
        _ => assert!(verdict.contains("dotted"), "{verdict}"),
    }
}

/// A lesson ends with what was seen, the lesson that follows, and mostly something to do.
fn ended(page: &mut Page, lesson: &Value) {
    page.until("document.body.dataset.lesson === 'end'");
    let text = page.text("document.getElementById('lesson-text').innerText");
    assert!(text.starts_with(&plain(lesson["end"]["seen"]["en"].as_str().unwrap())), "{text}");
    let next = page.text("document.getElementById('lesson-next').innerText");
    assert!(next.starts_with("Next lesson: ") || next == "This was the last lesson", "{next}");
    assert_eq!(
        page.text("byId('lesson-marks').innerText").split(' ').count(),
        lesson["steps"].as_array().unwrap().len()
    );
    keep(page, &format!("{}-end", lesson["name"].as_str().unwrap()));
    if lesson["end"]["challenge"].is_object() {
        assert!(text.contains("Now you: "), "{text}");
    }
    if lesson["name"] == "grip" {
        page.value("Object.assign(knobs, { speed: 0.0316 }); show(); changed()");
        page.until("byId('lesson-challenge').innerText.startsWith('You have done it: ')");
    }
    if lesson["name"] == "hertz-and-rough" {
        page.value("Object.assign(knobs, { rolloff: 6, seed: 3, load: 0.0175 }); show(); changed()");
        page.until("byId('lesson-challenge').innerText.startsWith('You have done it: ')");
    }
}

/// Plays a lesson to its end, with a server or in a site.
pub fn play(explorer: Option<&Explorer>, page: &mut Page, lesson: &Value, means: Means) {
    let name = lesson["name"].as_str().unwrap();
    page.value(&format!(
        "(() => {{ const list = byId('lesson'); list.value = '{name}'; list.dispatchEvent(new Event('change')); }})()"
    ));
    let steps = lesson["steps"].as_array().unwrap();
    for (at, step) in steps.iter().enumerate() {
        page.until(&format!("document.body.dataset.lesson === '{at}'"));
        let verdict = if step["ask"].is_object() { guess(page, step, means) } else { String::new() };
        followed(explorer, page, step);
        if step["ask"].is_object() {
            judged(page, &step["ask"], &verdict);
        }
        let text = page.text("document.getElementById('lesson-text').innerText");
        assert!(text.contains(&plain(step["text"]["en"].as_str().unwrap())), "{text}");
        assert_eq!(page.value("document.getElementById('fault').hidden"), true);
        keep(page, &format!("{name}-{}", at + 1));
        means.press(page, "lesson-next");
    }
    ended(page, lesson);
    means.press(page, "lesson-close");
    assert_eq!(page.value("document.getElementById('lesson-card').hidden"), true);
    println!("{name} is played.");
}

#[test]
fn a_person_in_a_lesson() {
    let Some(program) = installed() else { return };
    let (explorer, mut page) = opened(&program);
    let names = page.value("[...document.querySelectorAll('#lesson option')].map((it) => it.textContent)");
    assert_eq!(names.as_array().unwrap().len(), 14);
    let lesson = page.value("lessons[0]");
    play(Some(&explorer), &mut page, &lesson, Means::Mouse);
}

/// Every word that points, in the question, text or end that is shown, lights up something that is on the page.
fn lights_up(page: &mut Page, when: &str) {
    let names = page.value("[...document.querySelectorAll('#lesson-card .point')].filter((it) => it.checkVisibility()).map((it) => it.dataset.point)");
    for (i, name) in names.as_array().unwrap().iter().enumerate() {
        let nth =
            format!("[...document.querySelectorAll('#lesson-card .point')].filter((it) => it.checkVisibility())[{i}]");
        page.value(&format!("{nth}.click()"));
        page.until(&format!("seenBoxOf({name}) && !byId('light').hidden /* {when} */"));
    }
    page.value("document.activeElement.blur(); byId('light').hidden = true");
}

/// Answers what a step asks, rightly or by the button that shows it, once all words of the question that point have lit something up.
fn answer(page: &mut Page, ask: &Value, means: Means, when: &str) {
    page.until("document.body.dataset.asked === 'true'");
    if ask["kind"] != "act" {
        is_unpressed(page);
    }
    lights_up(page, when);
    let right = match ask["kind"].as_str().unwrap() {
        "choose" => ask["right"].as_u64().unwrap(),
        "number" => 2,
        _ => 1,
    };
    means.press(page, &format!("answer-{right}"));
    page.until("document.body.dataset.asked === 'false'");
}

/// A step shows what it is about, in the language of the page, and all words that point light something up.
fn is_shown(page: &mut Page, step: &Value, when: &str) {
    followed(None, page, step);
    let reached = "Object.entries(lesson.steps[lesson.at].ask?.goal ?? {}).every(([of, [least, most]]) => \
         latest().numbers[of] >= least && latest().numbers[of] <= most)";
    assert_eq!(page.value(reached), true, "{when}: what is shown is not what was asked for");
    if let Some(map) = step["show"].as_str() {
        assert_eq!(page.text(&format!("byId('map-{map}').getAttribute('aria-pressed')")), "true", "{when}");
    }
    let language = page.text("document.documentElement.lang");
    let [wanted, seen] = [plain(step["text"][&language].as_str().unwrap()), page.text("byId('lesson-text').innerText")];
    assert!(seen.contains(&wanted), "{when}: {seen}");
    assert_eq!(page.value("byId('fault').hidden"), true, "{when}");
    lights_up(page, when);
}

/// Plays all lessons to their ends by the answers that are right.
pub fn all_are_played(page: &mut Page, means: Means) {
    let calm = json!({"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]}); // what lights up is there at once
    page.chromium.page("Emulation.setEmulatedMedia", calm);
    let lessons = page.value("lessons");
    for lesson in lessons.as_array().unwrap() {
        let name = lesson["name"].as_str().unwrap();
        page.value(&format!("openLesson('{name}')"));
        for (at, step) in lesson["steps"].as_array().unwrap().iter().enumerate() {
            let when = format!("{name}, step {}", at + 1);
            page.until(&format!("document.body.dataset.lesson === '{at}'"));
            if step["ask"].is_object() {
                answer(page, &step["ask"], means, &when);
            }
            is_shown(page, step, &when);
            means.press(page, "lesson-next");
        }
        page.until("document.body.dataset.lesson === 'end'");
        lights_up(page, &format!("{name}, its end"));
        means.press(page, "lesson-close");
        println!("{name} is played, and points.");
    }
}

#[test]
fn every_word_of_a_lesson_that_points_lights_something_up() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "");
    all_are_played(&mut page, Means::Mouse);
}

/// All of them take minutes, and are played without a browser in any case.
#[test]
#[ignore = "takes minutes"]
fn a_person_in_all_lessons() {
    let Some(program) = installed() else { return };
    let (explorer, mut page) = opened(&program);
    page.resize([1440, 900]);
    let lessons = page.value("lessons");
    page.chromium.page("Emulation.setTouchEmulationEnabled", json!({"enabled": true, "maxTouchPoints": 1}));
    for means in [Means::Keyboard, Means::Finger] {
        for lesson in lessons.as_array().unwrap() {
            play(Some(&explorer), &mut page, lesson, means);
        }
    }
}
