//! Recordings over loads, read back from their files.

use super::{chunks, cylinder, row_counts};
use asperity::contact::{ContactModulus, Load, PolonskyKeer, Solver};
use asperity::error::FileError;
use asperity::plot::{Axis, Figure, Panel};
use asperity::record::{Curve, LoadRecording, Loads, Options, Parts, Scene};
use asperity::setup::Part;
use asperity::{Grid, Indenter, Problem, Stop};
use std::path::Path;

const CAPTIONS: [&str; 3] = ["light", "middling", "heavy"];

fn sphere() -> Problem {
    let grid = Grid::surface([16, 16], [4.0, 4.0]).unwrap();
    Problem::new(Indenter::Sphere { radius: 1.0 }.surface(grid).unwrap(), ContactModulus(1.0), Load::MeanPressure(1e-2))
        .unwrap()
}

fn figure() -> Figure {
    let panel = Panel::new("p", Axis::log("x", [1e-3, 1.0]), Axis::linear("y", [0.0, 1.0]));
    Figure { title: "figure".into(), panels: vec![panel] }
}

fn curve(view: &str, name: &str) -> Curve {
    Curve { view: view.into(), name: name.into(), colour: [0, 0, 0] }
}

fn loads<'a>(scenes: &'a [Scene<'a>], figure: Option<&'a Figure>) -> Loads<'a> {
    Loads {
        title: "loads".into(),
        description: "about".into(),
        captions: CAPTIONS.map(String::from).to_vec(),
        curves: vec![curve("kappa", "kappa_r"), curve("kappa", "kappa"), curve("area", "area")],
        figure: figure.map(|figure| (figure, vec![1e-3, 1e-2, 2.0])),
        scenes,
    }
}

/// Two scenes under three loads, the heaviest first.
fn record(path: &Path, what: Parts) {
    let (problems, figure) = ([cylinder(), sphere()], figure());
    let scenes = [Scene::new("cylinder", &problems[0]), Scene::new("sphere", &problems[1])];
    let options = Options { what, ..Options::default() };
    let recording = LoadRecording::create(path, &loads(&scenes, Some(&figure)), options).unwrap();
    for load in (0..CAPTIONS.len()).rev() {
        recording.values(load, &[1.0, if load == 1 { f64::NAN } else { 2.0 }, f64::INFINITY]).unwrap();
        for (number, problem) in problems.iter().enumerate() {
            let contact = PolonskyKeer.solve(problem, &Stop::default(), &mut ()).unwrap();
            recording.contact(number, load, &contact).unwrap();
        }
    }
    recording.finish().unwrap();
}

fn recorded(what: Parts) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("loads.rrd");
    record(&path, what);
    (folder, path)
}

#[test]
fn each_load_is_drawn_once_and_values_that_are_not_finite_are_left_out() {
    let (_folder, path) = recorded(Parts::USUAL);
    let rows = row_counts(&path);
    for entity in ["cylinder/profile/solid", "cylinder/gap/curves/gap", "sphere/pressure/image", "sphere/caption"] {
        assert_eq!(rows[&format!("/contact/{entity}")], 3, "{entity}");
    }
    for entity in ["/contact/cylinder/patches/cursor", "/figure/0/cursor", "/curve/0"] {
        assert_eq!(rows[entity], 3, "{entity}");
    }
    assert_eq!(rows["/curve/1"], 2);
    assert!(!rows.contains_key("/curve/2"));
    assert!((1..=3).all(|load| rows[&format!("/contact/cylinder/patches/row/{load}")] == 1));
}

#[test]
fn the_one_timeline_counts_loads_from_one_and_captions_follow() {
    let (_folder, path) = recorded(Parts::USUAL);
    let component = rerun::TextDocument::descriptor_text().component;
    let mut texts = std::collections::BTreeMap::new();
    for chunk in chunks(&path) {
        let timelines: Vec<String> = chunk.timelines().keys().map(|name| name.to_string()).collect();
        assert_eq!(timelines, ["load"], "{}", chunk.entity_path());
        if chunk.entity_path().to_string() == "/load" {
            let times = chunk.iter_component_indices("load".into(), component).map(|(time, _)| time.as_i64());
            let documents = chunk.iter_slices::<String>(component).map(|text| text[0].to_string());
            texts.extend(times.zip(documents));
        }
    }
    assert_eq!(texts.keys().copied().collect::<Vec<_>>(), [1, 2, 3]);
    for (text, caption) in texts.values().zip(CAPTIONS) {
        assert!(text.starts_with(&format!("# {caption}\n")) && text.ends_with("about"), "{text}");
    }
    assert!(texts[&1].contains("| kappa | 2.0000 |") && !texts[&2].contains("| kappa |"));
}

#[test]
fn parts_that_are_not_asked_for_are_not_recorded() {
    let (_folder, path) = recorded([Part::Mask].into_iter().collect());
    let entities: Vec<String> = row_counts(&path).into_keys().collect();
    assert!(!entities.iter().any(|entity| entity.starts_with("/curve") || entity.contains("pressure")));
    assert!(entities.iter().any(|entity| entity == "/contact/cylinder/patches/row/3"));
    assert!(entities.iter().any(|entity| entity == "/contact/sphere/contact"));
    let (_folder, path) = recorded([Part::Traces].into_iter().collect());
    let entities: Vec<String> = row_counts(&path).into_keys().collect();
    assert!(entities.iter().any(|entity| entity == "/curve/0"));
    let drawn = |entity: &&String| entity.starts_with("/contact") && !entity.ends_with("/description");
    assert_eq!(entities.iter().find(drawn), None);
}

#[test]
fn a_recording_of_nothing_can_be_finished_and_bad_places_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("empty.rrd");
    LoadRecording::create(&path, &loads(&[], None), Options::default()).unwrap().finish().unwrap();
    assert!(row_counts(&path).is_empty());
    for path in [folder.path().to_path_buf(), folder.path().join("missing/a.rrd")] {
        let created = LoadRecording::create(&path, &loads(&[], None), Options::default());
        assert!(matches!(created, Err(FileError::Target { .. })));
    }
}
