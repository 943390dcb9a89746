//! What the viewer makes of recordings: their names, their applications, and the axes and colours of their curves.

use super::{cylinder, record, record_with, rough_line, rough_surface, rows, stores};
use asperity::contact::{Gfmd, Load, Multilevel, PolonskyKeer};
use asperity::plot::Colour;
use asperity::record::{Options, Recording, Scene};
use asperity::setup::{Cell, Method, Part, Recipe, Setup};
use asperity::theory::Exact;
use asperity::{Grid, Indenter, Problem};
use rerun::external::re_sdk_types::blueprint::{archetypes, components};
use rerun::external::re_sdk_types::datatypes::TimeRange;
use rerun::{SeriesLines, StoreKind};
use std::collections::BTreeSet;
use std::path::Path;

/// The views of curves, and those that show all times.
fn views_of_curves(path: &Path) -> [BTreeSet<String>; 2] {
    let class = archetypes::ViewBlueprint::descriptor_class_identifier().component;
    let range = archetypes::TimeAxis::descriptor_view_range().component;
    let [mut curves, mut whole] = [BTreeSet::new(), BTreeSet::new()];
    for store in stores(path, StoreKind::Blueprint) {
        for chunk in store.iter_physical_chunks() {
            let entity = chunk.entity_path().to_string();
            if let Some(Ok(classes)) = chunk.component_batch::<components::ViewClass>(class, 0)
                && classes[0].0.as_str() == "TimeSeries"
            {
                curves.insert(entity.clone());
            }
            if let Some(Ok(ranges)) = chunk.component_batch::<components::TimeRange>(range, 0)
                && ranges[0].0 == TimeRange::EVERYTHING
            {
                whole.extend(entity.strip_suffix("/TimeAxis").map(String::from));
            }
        }
    }
    [curves, whole]
}

#[test]
fn every_view_of_curves_opens_on_the_whole_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    for problem in [rough_line(), rough_surface()] {
        record(&path, &problem, &PolonskyKeer, None, None);
        let [curves, whole] = views_of_curves(&path);
        assert!(curves.len() > 5);
        assert_eq!(curves, whole);
    }
}

fn style(path: &Path, entity: &str) -> (String, [u8; 3]) {
    let names = rows::<rerun::components::Name>(path, entity, SeriesLines::descriptor_names());
    let colours = rows::<rerun::components::Color>(path, entity, SeriesLines::descriptor_colors());
    let [r, g, b, _] = colours.last().unwrap().1[0].to_array();
    (names.last().unwrap().1[0].to_string(), [r, g, b])
}

#[test]
fn exact_values_are_green_and_drawn_last() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let (indenter, grid) = (Indenter::Cylinder { radius: 1.0 }, Grid::line(256, 4.0).unwrap());
    let problem = cylinder();
    let problem = Problem::new(indenter.surface(grid).unwrap(), asperity::contact::ContactModulus(1.0), problem.load());
    let problem = problem.unwrap();
    record(&path, &problem, &PolonskyKeer, Exact::new(&indenter, &grid, 1.0, 0.01), None);
    for name in ["kappa_r", "relative_area"] {
        let [computed, exact] = ["", "_theory"].map(|end| format!("/it/trace/{name}{end}"));
        assert!(exact > computed, "the viewer draws in the order of the alphabet");
        assert_eq!(style(&path, &exact).1, Colour::GREEN.0);
        assert_ne!(style(&path, &computed).1, Colour::GREEN.0);
    }
}

/// Application and name of the recording of a setup.
fn identity(path: &Path, setup: &Setup) -> [String; 2] {
    let problem = setup.problem().unwrap();
    let scene = Scene::from_setup(setup, &problem);
    Recording::create(path, &[scene], Options::default()).unwrap().finish().unwrap();
    let store = stores(path, StoreKind::Recording).remove(0);
    let layout = stores(path, StoreKind::Blueprint).remove(0);
    assert_eq!(layout.id().application_id(), store.id().application_id(), "a layout is that of its recording");
    let names =
        rows::<rerun::components::Name>(path, "/__properties", rerun::archetypes::RecordingInfo::descriptor_name());
    [store.id().application_id().to_string(), names[0].1[0].to_string()]
}

#[test]
fn setups_have_applications_and_names_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let sine = Recipe::indenter(Indenter::Sine { amplitude: 0.01 });
    let setup = Setup::new(sine, Cell::line(64, 1.0), Load::ReducedPressure(0.02));
    let gfmd = |damping| Setup { solver: Method::Gfmd(Gfmd { damping, ..Gfmd::default() }), ..setup.clone() };
    let others = [
        gfmd(1.0),
        gfmd(0.5),
        Setup { load: Load::ReducedPressure(0.03), ..setup.clone() },
        Setup { grid: Cell::line(64, 2.0), ..setup.clone() },
    ];
    let [application, name] = identity(&path, &setup);
    assert_eq!(name, "Sine, p* = 0.02, multilevel");
    assert_eq!(identity(&path, &setup), [application.clone(), name]);
    let applications = others.iter().map(|other| identity(&path, other)[0].clone()).chain([application]);
    assert_eq!(applications.collect::<BTreeSet<_>>().len(), 5);
    assert!(
        identity(&path, &gfmd(0.5))[1].ends_with("gfmd, masses uniform, dynamics damped, time-step 0.5, damping 0.5")
    );
}

/// How many panes stand in each container of a kind that has a name.
fn panes_of(path: &Path, kind: components::ContainerKind, name: &str) -> Vec<usize> {
    use archetypes::ContainerBlueprint as Container;
    let [kinds, names, contents] = [
        Container::descriptor_container_kind(),
        Container::descriptor_display_name(),
        Container::descriptor_contents(),
    ]
    .map(|descriptor| descriptor.component);
    let stores = stores(path, StoreKind::Blueprint);
    let chunks = stores.iter().flat_map(|store| store.iter_physical_chunks());
    let counted = chunks.filter_map(|chunk| {
        let its: rerun::components::Name = chunk.component_batch(names, 0)?.unwrap().remove(0);
        let is_one = chunk.component_batch::<components::ContainerKind>(kinds, 0)?.unwrap()[0] == kind;
        let panes = chunk.component_batch::<components::IncludedContent>(contents, 0)?.unwrap().len();
        (is_one && its.as_str() == name).then_some(panes)
    });
    counted.collect()
}

#[test]
fn three_pictures_of_a_line_share_two_rows_in_a_low_window() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let what = [Part::Profile, Part::Fields, Part::Stress].into_iter().collect();
    for (window, rows, tabs) in [([1600.0, 1000.0], 3, vec![2]), ([720.0, 310.0], 2, vec![3])] {
        record_with(&path, &rough_line(), &Multilevel, None, Options { what, window, ..Options::default() });
        assert_eq!(panes_of(&path, components::ContainerKind::Vertical, "it"), [rows], "{window:?}");
        let pictures = panes_of(&path, components::ContainerKind::Tabs, "pictures");
        let pictures: Vec<usize> = pictures.into_iter().filter(|&panes| panes > 1).collect();
        assert_eq!(pictures, tabs, "{window:?}");
    }
}

#[test]
fn pictures_of_a_surface_and_the_certificate_are_tabs_in_a_low_window() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    for (window, grids, rows) in [([1600.0, 1000.0], vec![4], vec![3]), ([720.0, 310.0], vec![], vec![2])] {
        record_with(&path, &rough_surface(), &Multilevel, None, Options { window, ..Options::default() });
        assert_eq!(panes_of(&path, components::ContainerKind::Grid, "it"), grids, "{window:?}");
        assert_eq!(panes_of(&path, components::ContainerKind::Vertical, "curves"), rows, "{window:?}");
        let tabs = panes_of(&path, components::ContainerKind::Tabs, "it");
        assert_eq!(tabs, if grids.is_empty() { vec![3] } else { Vec::new() }, "{window:?}");
    }
}
