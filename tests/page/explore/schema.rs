//! The schema of the knobs: one range for the page, for links and for lessons.

use super::texts::sources;
use super::{Page, with};
use asperity::explore::{NUMERIC_KNOBS, NumericKnob, Start};
use serde_json::{Value, json};

/// The rough line that the page starts with, solved by GFMD, with one knob set.
fn set(knob: &NumericKnob, value: f64) -> String {
    let gfmd = json!({"method": "gfmd", "masses": "uniform", "dynamics": "damped", "time-step": 0.5, "damping": 1.0});
    let mut knobs = with(json!({"solver": gfmd, "body": "power-law", "roughness": 0.001}));
    let place = knob.path.iter().fold(&mut knobs, |place, name| &mut place[*name]);
    *place = if knob.whole && value.fract() == 0.0 { json!(value as i64) } else { json!(value) };
    knobs.to_string()
}

#[test]
fn values_outside_the_range_of_a_knob_are_refused_by_its_name() {
    let page = Page::open();
    for knob in &NUMERIC_KNOBS {
        let [least, most] = knob.range;
        let name = format!("`{}`", knob.path.join("."));
        let is_range = |said: &str| said.starts_with(&format!("{name} cannot be ")) && said.contains(" to ");
        for value in [least, most] {
            let answer = page.post("/api/solve", &set(knob, value));
            assert!(!is_range(answer.text()), "{name} = {value}: {}", answer.text());
        }
        page.post("/api/cancel", "{}");
        let beyond = if knob.whole { most + 1.0 } else { 1.01 * most };
        let answer = page.post("/api/solve", &set(knob, beyond));
        let is_named = answer.text().contains(&name) || knob.id == "seed" || knob.id == "time-step";
        assert!(answer.status == 400 && is_named, "{name} = {beyond}: {} {}", answer.status, answer.text());
    }
}

/// The page has a slider or a field for each, and takes its limits from the program.
#[test]
fn the_page_takes_the_schema_of_the_program() {
    let script = Page::open().get("/explore.js");
    let json = script.text().lines().find_map(|line| line.strip_prefix("const NUMERIC_KNOBS = ")).unwrap();
    let served: Vec<Value> = serde_json::from_str(json.trim_end_matches(';')).unwrap();
    let controls = sources().into_iter().find(|(name, _)| name == "controls.js").unwrap().1;
    for (knob, served) in NUMERIC_KNOBS.iter().zip(&served) {
        assert_eq!((json!(knob.id), json!(knob.range)), (served["id"].clone(), served["range"].clone()));
        let row = controls.lines().find(|line| line.contains(&format!("id: \"{}\"", knob.id)));
        let kind = if knob.slider.is_some() { "range" } else { "number" };
        match row {
            Some(row) => assert!(row.contains(&format!("kind: \"{kind}\"")), "{row}"),
            None => assert_eq!(knob.id, "steps", "no control turns {}", knob.id),
        }
    }
    let numeric = controls.lines().filter(|line| line.contains("kind: \"range\"") || line.contains("kind: \"number\""));
    assert_eq!(numeric.filter(|line| line.trim_start().starts_with("{ group")).count() + 1, NUMERIC_KNOBS.len());
}

#[test]
fn what_the_page_starts_with_lies_within_the_ranges() {
    for start in [Start::HertzLine, Start::HertzSurface, Start::RoughLine, Start::RoughSurface] {
        let knobs = serde_json::to_value(start.knobs()).unwrap();
        for NumericKnob { path, range: [least, most], .. } in &NUMERIC_KNOBS {
            let value = path.iter().try_fold(&knobs, |place, name| place.get(name)).and_then(Value::as_f64);
            assert!(value.is_none_or(|value| (*least..=*most).contains(&value)), "{path:?} = {value:?} for {start:?}");
        }
    }
}

/// The guide for lessons has a row for each knob, with its range.
#[test]
fn the_guide_for_lessons_has_all_ranges() {
    let guide = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/lessons/README.md"));
    for knob in &NUMERIC_KNOBS {
        let start = format!("| `{}` | ", knob.path.join("."));
        let row = guide.lines().find_map(|line| line.strip_prefix(&start)).unwrap_or_else(|| panic!("no row {start}"));
        let range: Vec<f64> = row.split('|').filter_map(|cell| cell.trim().parse().ok()).collect();
        assert_eq!(range, knob.range, "{start}");
    }
}
