//! Colours of recordings by their theme, read back from their files.

use super::{cylinder, rough_surface, stores};
use asperity::contact::{PolonskyKeer, Solver};
use asperity::plot::{Axis, Figure, Panel};
use asperity::record::{CurveKind, LoadAxis, LoadRecording, Loads, Options, RecordedCurve, Recording, Scene, Timeline};
use asperity::setup::Theme;
use asperity::{Problem, Stop};
use rerun::components::Color;
use rerun::external::re_sdk_types::blueprint::archetypes::{Background, PlotBackground};
use rerun::{ComponentDescriptor, StoreKind};
use std::collections::BTreeSet;
use std::path::Path;

fn themed(theme: Theme) -> Options {
    Options { theme, ..Options::default() }
}

fn record_steps(path: &Path, problem: &Problem, theme: Theme) {
    let recording = Recording::create(path, &[Scene::new("it", problem)], themed(theme)).unwrap();
    PolonskyKeer.solve(problem, &Stop::default(), &mut recording.recorder(0)).unwrap();
    recording.finish().unwrap();
}

fn record_loads(path: &Path, problem: &Problem, theme: Theme) {
    let panel = Panel::new("p", Axis::log("x", [1e-3, 1.0]), Axis::linear("y", [0.0, 1.0]));
    let figure = Figure { title: "figure".into(), panels: vec![panel] };
    let loads = Loads {
        title: "loads".into(),
        description: "about".into(),
        captions: vec!["light".into()],
        axis: LoadAxis::log("x", vec![0.1]),
        curves: vec![RecordedCurve {
            view: "y".into(),
            name: "y".into(),
            unit: String::new(),
            colour: [0; 3],
            kind: CurveKind::Computed,
        }],
        figure: Some(&figure),
        timeline: Timeline::Loads,
        followed: None,
        scenes: &[Scene::new("it", problem)],
    };
    let recording = LoadRecording::create(path, &loads, themed(theme)).unwrap();
    recording.contact(0, 0, &PolonskyKeer.solve(problem, &Stop::default(), &mut ()).unwrap()).unwrap();
    recording.finish().unwrap();
}

/// The colours under a component of entities whose names end so, red, green and blue.
fn colours(path: &Path, kind: StoreKind, component: &ComponentDescriptor, ending: &str) -> BTreeSet<[u8; 3]> {
    let mut colours = BTreeSet::new();
    for chunk in stores(path, kind).iter().flat_map(|store| store.iter_physical_chunks()) {
        let rows = 0..if chunk.entity_path().to_string().ends_with(ending) { chunk.num_rows() } else { 0 };
        let batches = rows.filter_map(|row| chunk.component_batch::<Color>(component.component, row));
        colours.extend(batches.flat_map(Result::unwrap).map(|colour| {
            let [r, g, b, _] = colour.to_array();
            [r, g, b]
        }));
    }
    colours
}

#[test]
fn grounds_and_words_of_all_pictures_follow_the_theme() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("themed.rrd");
    let expected =
        [(Theme::Dark, [0x12, 0x14, 0x19], [0xe8, 0xea, 0xee]), (Theme::Light, [255; 3], [0x15, 0x18, 0x1d])];
    for (theme, ground, ink) in expected {
        for record in [record_steps, record_loads] {
            for problem in [cylinder(), rough_surface()] {
                record(&path, &problem, theme);
                let grounds = colours(&path, StoreKind::Blueprint, &Background::descriptor_color(), "");
                assert_eq!(grounds, [ground].into(), "{theme:?}");
                let curves = colours(&path, StoreKind::Blueprint, &PlotBackground::descriptor_color(), "");
                assert!(curves.is_empty(), "the viewer draws words in colours of its own on {curves:?}");
                let lines = rerun::LineStrips2D::descriptor_colors();
                let words = colours(&path, StoreKind::Recording, &lines, "/words");
                assert_eq!(words, [ink].into(), "{theme:?}");
                let lines = rerun::LineStrips3D::descriptor_colors();
                let lengths = colours(&path, StoreKind::Recording, &lines, "/relief/labels");
                assert!(lengths.iter().all(|colour| *colour == ink), "{lengths:?}");
                assert_eq!(lengths.is_empty(), problem.surface().grid().is_line());
            }
        }
    }
}
