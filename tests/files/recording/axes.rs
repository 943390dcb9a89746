//! Axes suit the state that is shown: those of the fields while a run goes on, and those of curves at its end.

use super::{cylinder, record, rough_line, rough_surface, rows, stores, trace};
use asperity::contact::{Each, Gfmd, Load, Multilevel, PolonskyKeer, Solver, Step};
use asperity::record::{Options, Recording, Scene};
use asperity::setup::{Cell, Recipe, Setup};
use asperity::surface::Spectrum;
use asperity::theory::Exact;
use asperity::{Grid, Indenter, Stop};
use rerun::components::{LineStrip2D, Range1D, Scale3D};
use rerun::external::re_sdk_types::blueprint::{archetypes, components};
use rerun::{Component, ComponentDescriptor, LineStrips2D, StoreKind, Transform3D};
use std::path::Path;

/// A view of curves in a layout.
#[derive(Debug, Default, Clone)]
struct Curves {
    title: String,
    entities: Vec<String>,
    range: Option<[f64; 2]>,
    has_legend: bool,
}

/// The views of curves of the last layout of a recording, by the traces in them.
fn curves(path: &Path) -> Vec<Curves> {
    let layouts = stores(path, StoreKind::Blueprint);
    let first = |entity: &str| {
        layouts.iter().flat_map(|it| it.iter_physical_chunks()).any(|it| it.entity_path().to_string() == entity)
    };
    let views: Vec<String> = layouts
        .iter()
        .flat_map(|it| it.iter_physical_chunks())
        .map(|it| it.entity_path().to_string())
        .filter(|it| it.starts_with("/view/") && it.matches('/').count() == 2)
        .collect();
    let view = |view: &String| {
        let contents = values::<components::QueryExpression>(
            path,
            &format!("{view}/ViewContents"),
            &archetypes::ViewContents::descriptor_query(),
        );
        let legend = format!("{view}/PlotLegend");
        let range = values::<Range1D>(path, &format!("{view}/ScalarAxis"), &archetypes::ScalarAxis::descriptor_range());
        let title =
            values::<rerun::components::Name>(path, view, &archetypes::ViewBlueprint::descriptor_display_name());
        let visible =
            values::<rerun::components::Visible>(path, &legend, &archetypes::PlotLegend::descriptor_visible());
        first(&legend).then(|| Curves {
            title: title[0].to_string(),
            entities: contents.iter().map(|it| it.0.to_string()).collect(),
            range: range.last().map(|it| it.0.0),
            has_legend: visible.last().is_none_or(|it| *it.0),
        })
    };
    views.iter().filter_map(view).collect()
}

/// The values of a component of an entity of the last layout that has it.
fn values<C: Component>(path: &Path, entity: &str, component: &ComponentDescriptor) -> Vec<C> {
    let mut found = Vec::new();
    for chunk in stores(path, StoreKind::Blueprint).iter().flat_map(|store| store.iter_physical_chunks()) {
        for (row, id) in chunk.row_ids().enumerate().filter(|_| chunk.entity_path().to_string() == entity) {
            found.extend(chunk.component_batch::<C>(component.component, row).map(|values| (id, values.unwrap())));
        }
    }
    found.sort_by_key(|(id, _)| *id);
    found.pop().map_or(Vec::new(), |(_, values)| values)
}

/// The view of curves that holds a trace as its first entity.
fn view_of(path: &Path, name: &str) -> Curves {
    let trace = format!("/it/trace/{name}");
    let views = curves(path);
    views.iter().find(|view| view.entities.first() == Some(&trace)).cloned().unwrap_or_else(|| panic!("{views:?}"))
}

/// The share of its box that the curve of the last pressure fills, from the lower side to its highest point.
fn filled(path: &Path) -> f32 {
    let strips = LineStrips2D::descriptor_strips();
    let (_, pieces) = rows::<LineStrip2D>(path, "/it/pressure/curves/pressure", strips).pop().unwrap();
    let points: Vec<[f32; 2]> = pieces.iter().flat_map(|piece| &piece.0).map(|point| [point.x(), point.y()]).collect();
    let end = |pick: fn(f32, f32) -> f32| points.iter().map(|point| point[1]).reduce(pick).unwrap();
    let [top, bottom] = [end(f32::min), end(f32::max)];
    let stretch = rows::<Scale3D>(path, "/it/pressure/curves", Transform3D::descriptor_scale()).pop();
    stretch.map_or(1.0, |(_, scale)| scale[0].0.y()) * (bottom - top) / bottom
}

#[test]
fn a_run_that_goes_on_is_drawn_on_axes_that_suit_its_latest_state() {
    let folder = tempfile::tempdir().unwrap();
    let (path, problem) = (folder.path().join("a.rrd"), rough_line());
    for solver in [&Gfmd::default() as &dyn Solver, &Multilevel, &PolonskyKeer] {
        let recording = Recording::create(&path, &[Scene::new("it", &problem)], Options::default()).unwrap();
        let mut recorder = recording.recorder(0);
        let mut without_end = Each(|step: &Step<'_>| asperity::contact::Observer::step(&mut recorder, step).unwrap());
        solver.solve(&problem, &Stop::default(), &mut without_end).unwrap();
        drop(recorder);
        recording.finish().unwrap();
        let filled = filled(&path);
        assert!((0.33..=1.0).contains(&filled), "{}: {filled}", solver.name());
    }
}

#[test]
fn the_pressure_of_a_finished_run_fills_its_axis() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    for solver in [&Gfmd::default() as &dyn Solver, &PolonskyKeer] {
        record(&path, &rough_line(), solver, None, None);
        assert!((0.85..=1.0).contains(&filled(&path)), "{}: {}", solver.name(), filled(&path));
    }
}

#[test]
fn kappa_r_has_an_axis_without_kappa_and_both_end_within_their_axes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let (indenter, grid) = (Indenter::Cylinder { radius: 1.0 }, Grid::line(256, 4.0).unwrap());
    let cylinder = asperity::Problem::new(
        indenter.surface(grid).unwrap(),
        asperity::contact::ContactModulus(1.0),
        cylinder().load(),
    );
    let exact = Exact::new(&indenter, &grid, 1.0, 0.01);
    let wrong = Exact { kappa_r: Some(25.0), ..exact.clone().unwrap() };
    for (problem, exact) in [
        (rough_line(), None),
        (cylinder.clone().unwrap(), exact),
        (cylinder.unwrap(), Some(wrong)),
        (rough_surface(), None),
    ] {
        let known = exact.as_ref().map(|exact| exact.kappa_r);
        record(&path, &problem, &PolonskyKeer, exact, None);
        for name in ["kappa_r", "kappa", "relative_area"] {
            let view = view_of(&path, name);
            let last = *trace(&path, name, "step").last_key_value().unwrap().1;
            let [low, high] = view.range.unwrap();
            assert!(low == 0.0 && (last..=4.0 * last).contains(&high), "{known:?} {name} {last}: {view:?}");
        }
        assert!(!view_of(&path, "kappa_r").entities.iter().any(|it| it.ends_with("/kappa")));
    }
}

#[test]
fn no_legend_covers_curves_that_settle_and_their_titles_say_what_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let window = [900.0, 420.0];
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.1, rms_gradient: 0.01 };
    for cell in [Cell::line(512, 1.0), Cell::surface([32, 32], [1.0, 1.0])] {
        let setup = Setup::new(Recipe::rough(spectrum, 5), cell, Load::ReducedPressure(0.1));
        let problem = setup.problem().unwrap();
        let scene = Scene { name: "it".into(), ..Scene::from_setup(&setup, &problem) };
        let recording = Recording::create(&path, &[scene], Options { window, ..Options::default() }).unwrap();
        PolonskyKeer.solve(&problem, &Stop::default(), &mut recording.recorder(0)).unwrap();
        recording.finish().unwrap();
        for name in ["kappa_r", "relative_area"] {
            let view = view_of(&path, name);
            assert!(!view.has_legend && view.title.contains("grey: nodes counted"), "{view:?}");
        }
        let alone = curves(&path).into_iter().filter(|view| view.entities.len() == 1 && view.has_legend);
        let alone: Vec<String> = alone.map(|view| view.entities[0].clone()).collect();
        assert!(alone.iter().all(|it| it.ends_with("/phase")), "{alone:?}");
    }
}
