//! The schema of the knobs: one row of each for the page, links, lessons and documents.

use super::texts::sources;
use super::{Page, with};
use asperity::explore::{KNOBS, Knob, KnobGroup, KnobKind, Knobs, NumericKnob, Start};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// The rough line that the page starts with, solved by GFMD, with one knob set.
fn set(knob: &Knob, value: &Value) -> String {
    let solver = json!({"method": "gfmd"});
    let mut knobs = with(json!({"solver": solver, "body": "power-law", "roughness": 0.001}));
    *place(&mut knobs, knob) = value.clone();
    knobs.to_string()
}

fn place<'a>(knobs: &'a mut Value, knob: &Knob) -> &'a mut Value {
    knob.path.split('.').fold(knobs, |place, name| &mut place[name])
}

fn numbers() -> impl Iterator<Item = (&'static Knob, NumericKnob)> {
    KNOBS.iter().filter_map(|knob| match knob.kind {
        KnobKind::Number(number) => Some((knob, number)),
        _ => None,
    })
}

/// The names that a knob takes, those that stand for several one by one.
fn options(knob: &Knob) -> Option<BTreeSet<&'static str>> {
    match knob.kind {
        KnobKind::Choice { options, .. } if !options.is_empty() => {
            Some(options.iter().copied().filter(|it| !it.is_empty()).collect())
        }
        KnobKind::Choices { options, .. } => Some(options.iter().flat_map(|it| it.split(' ')).collect()),
        _ => None,
    }
}

#[test]
fn values_outside_the_range_of_a_knob_are_refused_by_its_name() {
    let page = Page::open();
    for (knob, NumericKnob { range: [least, most], whole, .. }) in numbers() {
        let json = |value: f64| if whole && value.fract() == 0.0 { json!(value as i64) } else { json!(value) };
        let name = format!("`{}`", knob.path);
        let is_range = |said: &str| said.starts_with(&format!("{name} cannot be ")) && said.contains(" to ");
        for value in [least, most] {
            let answer = page.post("/api/solve", &set(knob, &json(value)));
            assert!(!is_range(answer.text()), "{name} = {value}: {}", answer.text());
        }
        page.post("/api/cancel", "{}");
        let beyond = if whole { most + 1.0 } else { 1.01 * most };
        let answer = page.post("/api/solve", &set(knob, &json(beyond)));
        let is_named = answer.text().contains(&name) || knob.id == "seed" || knob.id == "time-step";
        assert!(answer.status == 400 && is_named, "{name} = {beyond}: {} {}", answer.status, answer.text());
    }
}

/// The schema has the names that the program reads; a recording has parts that no box of the page asks for.
#[test]
fn choices_are_those_that_the_program_reads() {
    for knob in KNOBS {
        let Some(options) = options(knob) else { continue };
        let is_list = matches!(knob.kind, KnobKind::Choices { .. });
        let unknown = if is_list { json!(["nothing"]) } else { json!("nothing") };
        let refusal = Knobs::read(set(knob, &unknown).as_bytes()).unwrap_err().to_string();
        let (_, known) = refusal.split_once("`nothing`, expected ").unwrap_or_else(|| panic!("{refusal}"));
        let known: BTreeSet<&str> = known.split('`').skip(1).step_by(2).collect();
        assert!(if is_list { options.is_subset(&known) } else { options == known }, "{}: {known:?}", knob.path);
    }
}

#[test]
fn the_page_takes_the_schema_of_the_program() {
    let script = Page::open().get("/explore.js");
    let json = script.text().lines().find_map(|line| line.strip_prefix("const KNOBS = ")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(json.trim_end_matches(';')).unwrap(), json!(KNOBS));
    let sources = sources();
    for (knob, scenes) in KNOBS.iter().map(|knob| (knob, json!(knob.scenes))) {
        let file = if knob.group == Some(KnobGroup::File) { "heights.js" } else { "controls.js" };
        let (_, text) = sources.iter().find(|(name, _)| name == file).unwrap();
        let scenes = scenes.as_str().unwrap();
        let is_known = text.contains(&format!(" {scenes}: ")) || text.contains(&format!(" \"{scenes}\": "));
        assert!(is_known, "{file} does not know which states are {scenes}");
    }
}

#[test]
fn what_the_page_starts_with_lies_within_the_ranges() {
    for start in [Start::HertzLine, Start::HertzSurface, Start::RoughLine, Start::RoughSurface] {
        let mut knobs = serde_json::to_value(start.knobs()).unwrap();
        for (knob, NumericKnob { range: [least, most], .. }) in numbers() {
            let value = place(&mut knobs, knob).as_f64();
            assert!(
                value.is_none_or(|value| (least..=most).contains(&value)),
                "{} = {value:?} for {start:?}",
                knob.path
            );
        }
    }
}

/// A surface beside another one keeps the knobs of its group, its file and its bumps; all others are those of the state.
#[test]
fn a_surface_beside_shares_all_but_the_knobs_of_the_surface() {
    let shared = json!({
        "load": 0.2, "hardness": 0.1, "layer": 0.3, "stop": {"tolerance": 1e-6, "max-iterations": 77},
        "solver": {"method": "polonsky-keer"}, "record": ["mask"], "theme": "light",
    });
    let own = json!({
        "body": "round", "roughness": 0.002, "hurst": 0.5, "rolloff": 8, "cutoff": 64, "rolloff-form": "drop", "skewness": 0.5,
        "kurtosis": 4, "seed": 7, "points": 512, "bumps": [[0.25, 1e-4, 0.05]],
    });
    let both = own.as_object().unwrap().iter().chain(shared.as_object().unwrap());
    let expected = with(both.map(|(name, value)| (name.clone(), value.clone())).collect());
    let mut state = with(shared);
    state["beside"] = with(own);
    let read = |state: &Value| Knobs::read(state.to_string().as_bytes()).unwrap();
    let beside = read(&state).beside_with(None).unwrap().unwrap();
    assert_eq!(beside, read(&expected).setup().unwrap());
    assert_ne!(beside, read(&state).setup().unwrap());
}

/// A state that leaves out settings of a solver or of a file has those of the schema.
#[test]
fn defaults_are_those_of_the_program() {
    let knobs = Knobs::read(with(json!({"solver": {"method": "gfmd"}, "heights": {}})).to_string().as_bytes()).unwrap();
    let mut state = serde_json::to_value(knobs).unwrap();
    for knob in KNOBS.iter().filter(|knob| knob.path != "solver.method") {
        let (value, default) = (&*place(&mut state, knob), knob.default());
        assert!(*value == default || value.is_number() && value.as_f64() == default.as_f64(), "{}: {value}", knob.path);
    }
}

/// A value without the quotes of a text.
fn written_plainly(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), String::from)
}

/// The guide for lessons has a row for each knob, with its values and its default.
#[test]
fn the_guide_for_lessons_has_all_knobs() {
    let guide = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/lessons/README.md"));
    for knob in KNOBS.iter().filter(|knob| knob.group != Some(KnobGroup::File)) {
        let start = format!("| `{}` | ", knob.path);
        let row = guide.lines().find_map(|line| line.strip_prefix(&start)).unwrap_or_else(|| panic!("no row {start}"));
        let cells: Vec<&str> = row.split(" | ").collect();
        let names = |cell: &'static str| cell.split('`').skip(1).step_by(2);
        match knob.kind {
            KnobKind::Number(NumericKnob { range, default, .. }) => {
                let written: Vec<f64> = cells[0].split(" to ").map(|it| it.parse().unwrap()).collect();
                assert_eq!((written.as_slice(), cells[1].parse()), (range.as_slice(), Ok(default)), "{start}");
            }
            _ => {
                let default: Vec<String> = names(cells[1]).map(String::from).collect();
                let wanted = knob.default().as_array().cloned().unwrap_or_else(|| vec![knob.default()]);
                let wanted: Vec<String> = wanted.iter().map(written_plainly).collect();
                let is_switch = matches!(knob.kind, KnobKind::Switch { .. });
                let offered = if is_switch { Some(["false", "true"].into()) } else { options(knob) };
                assert_eq!((Some(names(cells[0]).collect()), default), (offered, wanted), "{start}");
            }
        }
    }
}
