//! A person with a keyboard: the focus, the keys, and values that are typed.

use super::chromium::installed;
use super::explorer::{opened, rested};
use super::page::Page;
use std::collections::HashSet;

fn focus(page: &mut Page) -> String {
    page.text("document.activeElement.id")
}

/// Tab goes through the page and out of the viewer, and so does Shift-Tab; Esc goes back to the page.
fn the_focus_is_never_trapped(page: &mut Page) {
    assert_eq!(focus(page), "", "the page opens with the focus on nothing");
    let mut seen = Vec::new();
    while !seen.contains(&"theme".to_owned()) || !seen.contains(&"runs".to_owned()) {
        page.press("Tab");
        seen.push(focus(page));
        assert!(seen.len() < 100, "Tab leads round and round: {seen:?}");
    }
    assert_eq!(seen[0], "skip");
    let place = |id: &str| seen.iter().position(|seen| seen == id).unwrap();
    assert!(place("control-load") < place("canvas") && place("canvas") < place("play"), "{seen:?}");
    let named: HashSet<_> = seen.iter().collect();
    assert_eq!(named.len(), seen.len(), "{seen:?}");
    page.value("document.getElementById('canvas').focus()");
    page.press_shifted("Tab");
    assert!(!["", "canvas"].contains(&focus(page).as_str()), "Shift-Tab leads nowhere");
    page.value("document.getElementById('canvas').focus()");
    page.press("Escape");
    assert_eq!(focus(page), "play");
}

fn the_skip_link_leads_to_the_numbers(page: &mut Page) {
    page.press_at("skip", "Enter");
    page.until("document.activeElement.id === 'results'");
}

/// The keys do what they say, wherever the focus is, and letters in a list belong to the list.
fn keys_work_inside_the_viewer_too(page: &mut Page) {
    let seed = |page: &mut Page| page.value("knobs.seed");
    for id in ["canvas", "control-load", "play"] {
        let before = seed(page);
        page.press_at(id, "d");
        assert_ne!(seed(page), before, "the dice key at {id}");
        rested(page);
    }
    page.press_at("canvas", "p");
    page.until("pinned !== null");
    page.press_at("canvas", "p");
    page.until("pinned === null");
    let before = seed(page);
    page.press_at("control-seed", "d");
    assert_eq!(seed(page), before);
    page.press_at("canvas", "t");
    assert_eq!(page.text("document.documentElement.dataset.theme"), "light");
    rested(page);
    assert_eq!(page.text("latest().knobs.theme"), "light");
}

fn values_are_typed(page: &mut Page) {
    page.type_into("control-load-value", "0.02");
    rested(page);
    assert_eq!(page.value("latest().knobs.load"), 0.02);
    assert_eq!(page.text("document.getElementById('control-load').getAttribute('aria-valuetext')"), "0.02");
    page.type_into("control-points-value", "3000");
    rested(page);
    assert_eq!(page.value("latest().knobs.points"), 3000);
    assert_eq!(page.text("document.getElementById('control-rolloff').getAttribute('aria-valuetext')"), "4 waves");
    for (id, value, sentence) in [
        ("control-load-value", "0", "p* cannot be 0: give a number from 0.00001 to 1000."),
        ("control-points-value", "100.5", "Points cannot be 100.5: give a whole number from 4 to 262144."),
        ("control-load-value", "abc", "p* needs a number."),
        ("control-load-value", "1,000.5", "p* needs a number."),
        ("control-seed", "-3", "Seed cannot be -3: give a whole number from 0 to 4294967295."),
        ("control-seed", "1e20", "Seed cannot be 1e20: give a whole number from 0 to 4294967295."),
    ] {
        page.type_into(id, value);
        assert_eq!(page.text("document.getElementById('fault').innerText"), sentence);
    }
    assert_eq!(page.value("[knobs.load, knobs.points]"), serde_json::json!([0.02, 3000]));
    assert_eq!(page.text("document.getElementById('control-load-value').value"), "0.02");
    page.type_into("control-points-value", "4096");
    rested(page);
    assert_eq!(page.value("document.getElementById('fault').hidden"), true);
}

/// A comma is a decimal mark as a point is: it is never dropped.
fn commas_are_decimal_marks(page: &mut Page) {
    for (typed, load) in [("0,05", 0.05), ("1,5e-2", 0.015), (".02", 0.02)] {
        page.type_into("control-load-value", typed);
        rested(page);
        assert_eq!(page.value("latest().knobs.load"), load, "{typed}");
    }
}

/// What the solver refuses is said in the words of the knobs, and the last state that was solved is back: later changes are solved.
fn a_refused_value_is_put_back(page: &mut Page) {
    page.type_into("control-hardness-value", "1e-9");
    let sentence = "The mean pressure is 0.00002 E*, above the hardness of 1e-9 E*. Lower p* or raise the hardness.";
    page.until(&format!("document.getElementById('fault').innerText === '{sentence}'"));
    page.until("knobs.hardness === 0");
    assert_eq!(page.text("document.getElementById('control-hardness-value').value"), "0");
    page.type_into("control-load-value", "0.03");
    rested(page);
    assert_eq!(page.value("[latest().knobs.load, latest().knobs.hardness]"), serde_json::json!([0.03, 0]));
    assert_eq!(page.value("document.getElementById('fault').hidden"), true);
}

/// Tab leads to a control in a few steps.
fn tab_to(page: &mut Page, id: &str) {
    for _ in 0..10 {
        if focus(page) == id {
            return;
        }
        page.press("Tab");
    }
    panic!("{id} is far away");
}

/// A lesson takes the focus along: from the welcome to its question, from a wrong choice to the question again, from an answer to the text, from there to the next
/// question, and at the end to the list of lessons.
fn a_lesson_takes_the_focus_along(page: &mut Page) {
    let is_in_lesson = "['lesson-ask', 'lesson-text'].includes(document.activeElement.id)";
    page.press_at("welcome-lesson", "Enter");
    page.until(is_in_lesson);
    page.value("openLesson('gecko', 1); byId('lesson-ask').focus()");
    tab_to(page, "answer-1");
    page.press("Enter");
    assert_eq!(page.value("byId('answer-1').disabled"), true);
    assert_eq!(focus(page), "lesson-ask");
    tab_to(page, "answer-2");
    page.press("Enter");
    page.until("document.activeElement.id === 'lesson-text'");
    tab_to(page, "lesson-next");
    page.press("Enter");
    page.until(&format!("lesson.at === 2 && {is_in_lesson}"));
    page.press_at("lesson-close", "Enter");
    assert_eq!(focus(page), "lesson");
    rested(page);
}

#[test]
fn a_person_with_a_keyboard() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = opened(&program);
    the_focus_is_never_trapped(&mut page);
    the_skip_link_leads_to_the_numbers(&mut page);
    keys_work_inside_the_viewer_too(&mut page);
    values_are_typed(&mut page);
    commas_are_decimal_marks(&mut page);
    a_refused_value_is_put_back(&mut page);
    a_lesson_takes_the_focus_along(&mut page);
}
