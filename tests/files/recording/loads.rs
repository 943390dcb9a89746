//! Recordings over loads, read back from their files.

use super::{chunks, cylinder, row_counts, stores};
use asperity::contact::{ContactModulus, Load, PolonskyKeer, Solver};
use asperity::error::FileError;
use asperity::plot::{Axis, Figure, Panel};
use asperity::record::{CurveKind, LoadAxis, LoadRecording, Loads, Options, Parts, RecordedCurve, Scene, Timeline};
use asperity::setup::Part;
use asperity::{Grid, Indenter, Problem, Stop};
use rerun::components::{LineStrip2D, Position2D, Radius, Scale3D, Text, Translation3D};
use rerun::{Component, ComponentDescriptor, StoreKind};
use std::collections::BTreeMap;
use std::path::Path;

const CAPTIONS: [&str; 3] = ["light", "middling", "heavy"];
const LOADS: [f64; 3] = [1e-3, 1e-2, 2.0];

fn sphere() -> Problem {
    let grid = Grid::surface([16, 16], [4.0, 4.0]).unwrap();
    Problem::new(Indenter::Sphere { radius: 1.0 }.surface(grid).unwrap(), ContactModulus(1.0), Load::MeanPressure(1e-2))
        .unwrap()
}

fn figure() -> Figure {
    let panel = Panel::new("p", Axis::log("x", [1e-3, 1.0]), Axis::linear("y", [0.0, 1.0]));
    Figure { title: "figure".into(), panels: vec![panel] }
}

fn curve(view: &str, name: &str) -> RecordedCurve {
    RecordedCurve {
        view: view.into(),
        name: name.into(),
        unit: String::new(),
        colour: [0, 0, 0],
        kind: CurveKind::Computed,
    }
}

fn loads<'a>(scenes: &'a [Scene<'a>], figure: Option<&'a Figure>) -> Loads<'a> {
    Loads {
        title: "loads".into(),
        description: "about".into(),
        captions: CAPTIONS.map(String::from).to_vec(),
        axis: LoadAxis::log("p*", LOADS.to_vec()),
        curves: vec![curve("kappa", "kappa_r"), curve("kappa", "kappa"), curve("area", "area")],
        figure,
        timeline: Timeline::Loads,
        followed: None,
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
    let mut texts = BTreeMap::new();
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

/// The latest values of a component of an entity at each load; static ones are at load 0.
fn latest<C: Component>(path: &Path, entity: &str, component: &ComponentDescriptor) -> BTreeMap<i64, Vec<C>> {
    let mut rows = BTreeMap::new();
    for chunk in stores(path, StoreKind::Recording).iter().flat_map(|store| store.iter_physical_chunks()) {
        let loads = chunk.timelines().get(&"load".into()).map(|column| column.times_raw().to_vec());
        for (i, id) in chunk.row_ids().enumerate().filter(|_| chunk.entity_path().to_string() == entity) {
            if let Some(values) = chunk.component_batch::<C>(component.component, i) {
                rows.insert(id, (loads.as_ref().map_or(0, |loads| loads[i]), values.unwrap()));
            }
        }
    }
    rows.into_values().collect()
}

fn strips(path: &Path, entity: &str) -> BTreeMap<i64, Vec<Vec<[f32; 2]>>> {
    let rows = latest::<LineStrip2D>(path, entity, &rerun::LineStrips2D::descriptor_strips());
    let points = |strip: &LineStrip2D| strip.0.iter().map(|point| [point.x(), point.y()]).collect();
    rows.into_iter().map(|(load, strips)| (load, strips.iter().map(points).collect())).collect()
}

fn words(path: &Path, entity: &str) -> Vec<String> {
    let words = latest::<Text>(path, entity, &ComponentDescriptor::partial("words")).remove(&0).unwrap();
    words.iter().map(|word| word.to_string()).collect()
}

#[test]
fn curves_grow_with_the_load_on_axes_that_are_named_and_numbered_by_it() {
    let (_folder, path) = recorded(Parts::USUAL);
    let axes = words(&path, "/chart/0/axes/words");
    assert!(["p*", "10⁻³", "10⁻²", "kappa"].iter().all(|word| axes.iter().any(|it| it == word)), "{axes:?}");
    assert_eq!(words(&path, "/chart/0/legend/words"), ["kappa_r", "kappa"]);
    let lines = strips(&path, "/chart/0/lines");
    let lengths: Vec<Vec<usize>> = lines.values().map(|strips| strips.iter().map(Vec::len).collect()).collect();
    assert_eq!(lengths, [[1, 1], [2, 1], [3, 2]]);
    let [left, middle, right] = [0, 1, 2].map(|i| lines[&3][0][i][0]);
    let decades = LOADS.map(f64::log10);
    let share = (decades[1] - decades[0]) / (decades[2] - decades[0]);
    assert!((f64::from((middle - left) / (right - left)) - share).abs() < 1e-5, "{left} {middle} {right}");
    let dots = latest::<Position2D>(&path, "/chart/0/dots", &rerun::Points2D::descriptor_positions());
    let radii = latest::<Radius>(&path, "/chart/0/dots", &rerun::Points2D::descriptor_radii());
    for (load, strips) in &lines {
        let sizes: Vec<f32> = radii[load].iter().map(|radius| radius.0.0.abs()).collect();
        let large = (0..sizes.len()).filter(|&i| sizes[i] > 1.5 * sizes.iter().copied().fold(f32::MAX, f32::min));
        let large: Vec<[f32; 2]> = large.map(|i| [dots[load][i].x(), dots[load][i].y()]).collect();
        let here = strips[0].last().unwrap()[0];
        let ends: Vec<[f32; 2]> =
            strips.iter().filter_map(|strip| strip.last().copied()).filter(|end| end[0] == here).collect();
        assert_eq!(large, if *load == 1 { Vec::new() } else { ends }, "at load {load}");
    }
}

#[test]
fn each_load_has_its_value_for_programs() {
    let (_folder, path) = recorded([Part::Traces].into_iter().collect());
    let values = latest::<rerun::components::Scalar>(&path, "/load/value", &rerun::Scalars::descriptor_scalars());
    let values: Vec<f64> = values.into_values().map(|value| value[0].0.0).collect();
    assert_eq!(values, LOADS);
}

#[test]
fn the_picture_of_patches_is_filled_by_the_loads_that_came() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("loads.rrd");
    let problem = cylinder();
    let scenes = [Scene::new("cylinder", &problem)];
    let values: Vec<f64> = (0..10).map(|load| 1e-3 * 2f64.powi(load)).collect();
    let captions = values.iter().map(|value| format!("p* = {value}")).collect();
    let loads = Loads { captions, axis: LoadAxis::log("p*", values), ..loads(&scenes, None) };
    let recording = LoadRecording::create(&path, &loads, Options::default()).unwrap();
    for load in 0..5 {
        recording.contact(0, load, &PolonskyKeer.solve(&problem, &Stop::default(), &mut ()).unwrap()).unwrap();
    }
    recording.finish().unwrap();
    let map = "/contact/cylinder/patches";
    let frame = strips(&path, &format!("{map}/axes/lines")).remove(&0).unwrap().remove(0);
    let box_height = frame.iter().map(|point| point[1]).fold(0.0, f32::max);
    let rows = format!("{map}/row");
    let scale = latest::<Scale3D>(&path, &rows, &rerun::Transform3D::descriptor_scale())[&0][0].y();
    let shift = latest::<Translation3D>(&path, &rows, &rerun::Transform3D::descriptor_translation())[&0][0].0.y();
    let ends = [1, 5].map(|row| {
        let drawn = strips(&path, &format!("{map}/row/{row}")).remove(&row).unwrap();
        let heights = drawn.iter().flatten().map(|point| shift + scale * point[1]);
        heights.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)])
    });
    let row = box_height / 5.0;
    assert!(ends[1][0] > 0.0 && ends[1][0] < 0.2 * row, "{ends:?}");
    assert!(ends[0][1] < box_height && ends[0][1] > box_height - 0.2 * row, "{ends:?}");
    let axes = words(&path, &format!("{map}/axes/words"));
    assert!(axes.contains(&"p*".into()) && axes.contains(&"0.01".into()), "{axes:?}");
}

/// Two waves, of which one has the higher crest: the other one touches under the second load, and both are one patch under the third.
#[test]
fn patches_are_followed_from_load_to_load() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let grid = Grid::line(256, 2.0).unwrap();
    let crest = |node: f64, waves: f64| (node * waves * std::f64::consts::PI / 128.0).cos();
    let heights = asperity::surface::Field::from_shape_fn(grid.shape(), |(_, node)| {
        0.01 * crest(node as f64, 2.0) + 0.001 * crest(node as f64, 1.0)
    });
    let heights = asperity::Surface::new(grid, heights).unwrap();
    let problem = Problem::new(heights, ContactModulus(1.0), Load::MeanPressure(0.2)).unwrap();
    let scenes = [Scene::new("it", &problem)];
    let axis = LoadAxis::log("p", vec![1e-4, 1e-2, 0.2]);
    let followed = Some(grid.shape());
    let loads = Loads { captions: CAPTIONS.map(String::from).to_vec(), axis, followed, ..loads(&scenes, None) };
    let recording = LoadRecording::create(&path, &loads, Options::default()).unwrap();
    for (number, load) in [1e-4, 1e-2, 0.2].into_iter().enumerate() {
        let problem = problem.clone().with_load(Load::MeanPressure(load)).unwrap();
        let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut ()).unwrap();
        recording.contact(0, number, &contact).unwrap();
    }
    recording.finish().unwrap();
    let numbers = |component: &'static str| -> Vec<(i64, Vec<f64>)> {
        let entity = "/contact/it/patch_tree/events";
        let rows = latest::<rerun::components::Scalar>(&path, entity, &ComponentDescriptor::partial(component));
        rows.into_iter().map(|(load, values)| (load, values.iter().map(|value| value.0.0).collect())).collect()
    };
    assert_eq!(numbers("event_patch"), [(1, vec![]), (2, vec![2.0]), (3, vec![2.0])]);
    assert!(numbers("event_other")[1].1[0].is_nan());
    assert_eq!(numbers("event_other")[2].1, [1.0]);
    let kinds = latest::<Text>(&path, "/contact/it/patch_tree/events", &ComponentDescriptor::partial("event_kind"));
    let kinds: Vec<Vec<String>> =
        kinds.into_values().map(|kinds| kinds.iter().map(|kind| kind.as_str().to_owned()).collect()).collect();
    assert_eq!(kinds, [vec![], vec!["born".to_owned()], vec!["merged".to_owned()]]);
    // the number of patches is that of the contact under the load beside it
    let words = latest::<Text>(&path, "/contact/it/patch_tree/strongest", &ComponentDescriptor::partial("words"));
    let counts: Vec<Vec<String>> =
        words.into_values().map(|all| all.iter().map(|it| it.to_string()).collect()).collect();
    for (all, now) in counts.iter().zip(["now: 1", "now: 2", "now: 1"]) {
        assert!(all.contains(&now.into()) && all.contains(&"in all: 2".into()), "{counts:?}");
    }
    assert_eq!(counts.len(), 3);
}
