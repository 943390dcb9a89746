//! One state at a time: whatever a person does, knobs, numbers, picture and title belong together, or are grey.

use super::chromium::{Chromium, installed};
use super::explorer::sketched;
use super::page::Page;
use super::site::served;

/// A person who does anything.
const PERSON: &str = include_str!("random_person.js");

/// Has such a person do things at the page, and looks at it after each rest: how many times.
fn do_anything(page: &mut Page, seed: u32, actions: u32) -> u64 {
    let found = page.value(&format!("({PERSON})({seed}, {actions})"));
    let looks = found["looks"].as_u64().unwrap();
    println!("{actions} actions from seed {seed}: looked {looks} times");
    assert!(found["wrong"].as_array().unwrap().is_empty(), "{:#}", found["wrong"]);
    looks
}

#[test]
fn any_thousand_actions_leave_one_state() {
    let Some(program) = installed() else { return };
    let (_explorer, mut page) = sketched(&program, "&view=picture&language=en");
    let looks: u64 = (1..=4).map(|seed| do_anything(&mut page, seed, 250)).sum();
    assert!(looks > 1000 / 60, "the page came to rest {looks} times in 1000 actions");
}

#[test]
fn any_actions_on_a_site_leave_one_state() {
    let Some(program) = installed() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut page = Page { chromium: Chromium::without_graphics(&program) };
    page.resize([1440, 900]);
    let _files = served(&mut page, folder.path());
    let looks = do_anything(&mut page, 5, 150);
    assert!(looks > 150 / 60, "the page came to rest {looks} times in 150 actions");
}
