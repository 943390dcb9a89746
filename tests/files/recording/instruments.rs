//! The pictures of whole runs, read back from their files.

use super::{chunks, entities, rough_line, rough_surface, stores};
use asperity::contact::{Contact, Dynamics, Each, Gfmd, Masses, Multilevel, PolonskyKeer, Solver, Step};
use asperity::diagnosis::Reference;
use asperity::record::{Options, Recording, Scene};
use asperity::setup::Part;
use asperity::{Problem, Stop};
use rerun::archetypes::StateChange;
use rerun::components::{ImageBuffer, ImageFormat};
use rerun::{ComponentDescriptor, DepthImage, SegmentationImage, StoreKind};
use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

/// Records a run with some parts, whose end is known if `knows_end`.
pub fn record(path: &Path, problem: &Problem, solver: &dyn Solver, what: &[Part], knows_end: bool) -> Contact {
    let end = knows_end.then(|| solver.solve(problem, &Stop::default(), &mut ()).unwrap());
    let reference = end.as_ref().map(|end| Arc::new(Reference::from_contact(end)));
    let scene = Scene { reference, ..Scene::new("it", problem) };
    let options = Options { what: what.iter().copied().collect(), ..Options::default() };
    let recording = Recording::create(path, &[scene], options).unwrap();
    let contact = solver.solve(problem, &Stop::default(), &mut recording.recorder(0)).unwrap();
    recording.finish().unwrap();
    contact
}

/// Width, height and bytes of the last image of an entity.
fn image(path: &Path, entity: &str, [format, buffer]: [ComponentDescriptor; 2]) -> ([usize; 2], Vec<u8>) {
    let stores = stores(path, StoreKind::Recording);
    let of_entity = stores.iter().flat_map(|store| store.iter_physical_chunks());
    let of_entity: Vec<_> = of_entity.filter(|chunk| chunk.entity_path().to_string() == entity).collect();
    let last = |component| {
        let with = of_entity.iter().filter(|chunk| chunk.components_identifiers().any(|other| other == component));
        with.max_by_key(|chunk| chunk.row_id_range()).unwrap_or_else(|| panic!("no {component} of {entity}"))
    };
    // a chunk of what stays holds all of its versions, the last of which counts
    let (of_format, of_buffer) = (last(format.component), last(buffer.component));
    let [format_row, buffer_row] = [of_format, of_buffer].map(|chunk| chunk.num_rows() - 1);
    let format = of_format.component_batch::<ImageFormat>(format.component, format_row).unwrap().unwrap()[0].0;
    let bytes = of_buffer.component_batch::<ImageBuffer>(buffer.component, buffer_row).unwrap().unwrap()[0].0.to_vec();
    ([format.width as usize, format.height as usize], bytes)
}

fn classes(path: &Path, entity: &str) -> ([usize; 2], Vec<u8>) {
    image(path, entity, [SegmentationImage::descriptor_format(), SegmentationImage::descriptor_buffer()])
}

pub fn values(path: &Path, entity: &str) -> ([usize; 2], Vec<f32>) {
    let (size, bytes) = image(path, entity, [DepthImage::descriptor_format(), DepthImage::descriptor_buffer()]);
    (size, bytes.chunks(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap())).collect())
}

/// States of a lane in their order.
fn states(path: &Path, lane: &str) -> Vec<String> {
    let component = StateChange::descriptor_state().component;
    let of_lane =
        chunks(path).into_iter().filter(|chunk| chunk.entity_path().to_string() == format!("/it/decisions/{lane}"));
    let mut states: Vec<(i64, String)> = Vec::new();
    for chunk in of_lane {
        let steps: Vec<i64> =
            chunk.iter_component_indices("step".into(), component).map(|(step, _)| step.as_i64()).collect();
        states.extend(steps.into_iter().zip(chunk.iter_slices::<String>(component).map(|words| words[0].to_string())));
    }
    states.sort();
    states.into_iter().map(|(_, state)| state).collect()
}

#[test]
fn a_raster_has_a_column_for_each_step_and_ends_in_the_contact() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    for (problem, solver) in [(rough_line(), &PolonskyKeer as &dyn Solver), (rough_line(), &Multilevel)] {
        let contact = record(&path, &problem, solver, &[Part::Raster], false);
        let ([width, height], classes) = classes(&path, "/it/raster/image");
        assert_eq!((width, height), (contact.work.iterations + 1, problem.nodes()));
        // rows go down from the last node; classes 1 to 8 are nodes in contact
        let touches = |node: usize| (1..=8).contains(&classes[(height - 1 - node) * width + width - 1]);
        assert!(contact.pressure.iter().enumerate().all(|(node, &p)| touches(node) == (p > 0.0)), "{}", solver.name());
    }
}

#[test]
fn rasters_of_a_surface_run_along_the_row_and_the_column_that_are_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let problem = rough_surface();
    let what = [Part::Raster].into_iter().collect();
    let options = Options { what, raster_at: Some([3, 5]), ..Options::default() };
    let recording = Recording::create(&path, &[Scene::new("it", &problem)], options).unwrap();
    let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut recording.recorder(0)).unwrap();
    recording.finish().unwrap();
    let in_contact = |class: u8| (1..=8).contains(&class);
    let ([width, height], row) = classes(&path, "/it/raster_row/image");
    assert_eq!(height, 48);
    assert!((0..48).all(|x| in_contact(row[(47 - x) * width + width - 1]) == (contact.pressure[[3, x]] > 0.0)));
    let ([width, height], column) = classes(&path, "/it/raster_column/image");
    assert_eq!(height, 32);
    assert!((0..32).all(|y| in_contact(column[(31 - y) * width + width - 1]) == (contact.pressure[[y, 5]] > 0.0)));
    let ([width, height], flips) = values(&path, "/it/flips/image");
    assert!((width, height) == (48, 32) && flips.iter().any(|&flips| flips > 0.0));
}

/// The mask of an inner iteration shows the nodes that may come into contact; the last one shows the contact alone.
#[test]
fn masks_have_the_candidates_of_inner_iterations() {
    const CONTACT: u8 = 1;
    const CANDIDATE: u8 = 3;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let contact = record(&path, &rough_surface(), &Multilevel, &[Part::Mask], false);
    let buffer = SegmentationImage::descriptor_buffer().component;
    let of_mask = chunks(&path).into_iter().filter(|chunk| chunk.entity_path().to_string() == "/it/contact");
    let masks = of_mask.flat_map(|chunk| {
        let mask = |row| chunk.component_batch::<ImageBuffer>(buffer, row).map(|batch| batch.unwrap()[0].0.to_vec());
        (0..chunk.num_rows()).filter_map(mask).collect::<Vec<_>>()
    });
    assert!(masks.into_iter().filter(|mask| mask.contains(&CANDIDATE) && mask.contains(&CONTACT)).count() > 5);
    let ([width, height], last) = classes(&path, "/it/contact");
    let class = |(y, x): (usize, usize)| last[(height - 1 - y) * width + x];
    assert!(contact.pressure.indexed_iter().all(|(node, &p)| class(node) == if p > 0.0 { CONTACT } else { 0 }));
}

#[test]
fn waterfalls_fall_to_the_end_that_they_are_held_against() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let problem = rough_line();
    for solver in [&Gfmd::default() as &dyn Solver, &PolonskyKeer] {
        record(&path, &problem, solver, &[Part::Waterfall], true);
        for entity in ["/it/error_pressure/image", "/it/error_displacement/image"] {
            let ([width, height], values) = values(&path, entity);
            for row in 0..height {
                let [early, late] = [width / 20, width - width / 20].map(|column| values[row * width + column]);
                assert!(late < early - 2.0, "{} {entity} {row}: {early} {late}", solver.name());
            }
        }
    }
    record(&path, &problem, &PolonskyKeer, &[Part::Waterfall], false);
    assert!(!entities(&path).iter().any(|entity| entity.contains("error_")), "errors against nothing");
}

#[test]
fn lanes_tell_what_solvers_decided() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let expected = [
        (&Gfmd::default() as &dyn Solver, vec!["damped", "start"]),
        (
            &Gfmd { masses: Masses::Stiffness, dynamics: Dynamics::Fire, ..Gfmd::default() },
            vec!["accelerate", "coast", "halt", "start"],
        ),
        (&PolonskyKeer, vec!["conjugate", "exchange", "start"]),
        (&Multilevel, vec!["conjugate", "start", "whole-set"]),
    ];
    record(&path, &rough_surface(), &Multilevel, &[Part::Decisions], false);
    assert!(states(&path, "2_step").iter().any(|kind| kind == "single-precision"), "{:?}", states(&path, "2_step"));
    for (solver, expected) in expected {
        record(&path, &rough_line(), solver, &[Part::Decisions], false);
        let met: BTreeSet<String> = states(&path, "2_step").into_iter().collect();
        assert!(expected.iter().all(|&kind| met.contains(kind)), "{}: {met:?}", solver.name());
        assert_eq!(states(&path, "4_end"), ["converged"]);
        let grids = states(&path, "1_grid");
        assert!(grids.last().unwrap() == "512" && (grids.len() > 1) == (solver.name() == "multilevel"), "{grids:?}");
    }
}

#[test]
fn ritz_values_come_with_conjugate_gradients_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    for (solver, has) in [(&PolonskyKeer as &dyn Solver, true), (&Multilevel, true), (&Gfmd::default(), false)] {
        record(&path, &rough_line(), solver, &[Part::Ritz], false);
        assert_eq!(
            chunks(&path).iter().any(|chunk| chunk.entity_path().to_string() == "/it/ritz"),
            has,
            "{}",
            solver.name()
        );
    }
}

#[test]
fn a_run_on_which_an_observer_gave_up_keeps_its_images() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let problem = rough_line();
    let options = Options { what: [Part::Raster].into_iter().collect(), ..Options::default() };
    let recording = Recording::create(&path, &[Scene::new("it", &problem)], options).unwrap();
    let mut stop =
        Each(|step: &Step<'_>| if step.index() < 20 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) });
    Gfmd::default().solve(&problem, &Stop::default(), &mut (recording.recorder(0), &mut stop)).unwrap();
    recording.finish().unwrap();
    assert_eq!(classes(&path, "/it/raster/image").0[0], 21);
}

/// Patches tell of themselves: their nodes and loads add up to those of the contact.
#[test]
fn patches_that_are_pointed_at_tell_their_own_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    for problem in [rough_line(), rough_surface()] {
        let contact = record(&path, &problem, &PolonskyKeer, &[Part::Mask, Part::Raster], false);
        let last = |name: &'static str| {
            let of_entity =
                chunks(&path).into_iter().filter(|chunk| chunk.entity_path().to_string() == "/it/contact/patches");
            let with = of_entity.filter(|chunk| chunk.components_identifiers().any(|it| it.as_str() == name));
            let chunk = with.max_by_key(|chunk| chunk.timelines()[&"step".into()].time_range().max()).unwrap();
            chunk.iter_slices::<f32>(name.into()).last().unwrap().to_vec()
        };
        let cell: f64 = problem.surface().grid().spacing()[1]
            * if problem.surface().grid().is_line() { 1.0 } else { problem.surface().grid().spacing()[0] };
        let [nodes, loads, kappa_r] = ["patch_nodes", "patch_load", "patch_kappa_r"].map(last);
        assert_eq!(nodes.len(), contact.patches().count());
        assert_eq!(nodes.iter().sum::<f32>() as usize, contact.counted().contact_nodes);
        let load = f64::from(loads.iter().sum::<f32>());
        assert!((load / (cell * contact.pressure.sum()) - 1.0).abs() < 1e-5);
        assert!(kappa_r.iter().all(|&kappa_r| kappa_r > 0.5 && kappa_r.is_finite()), "{kappa_r:?}");
    }
}
