//! Numbers for programs, read back from recordings: as they are, in the units that the documentation says.

use super::{chunks, cylinder, record, rough, rough_line, rough_surface, rows, stores, trace};
use asperity::contact::{ContactModulus, Gfmd, Load, Multilevel, PolonskyKeer, Solver};
use asperity::diagnosis::Reference;
use asperity::record::{Options, Recording, Scene};
use asperity::setup::{Cell, Part, Recipe, Setup, Solid};
use asperity::theory::Exact;
use asperity::{Grid, Indenter, Problem, Stop};
use rerun::StoreKind;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;
use strum::IntoEnumIterator;

const DOCUMENTATION: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/doc/record.md"));

/// Entity and component of each row of the documented table.
fn documented() -> BTreeSet<(String, String)> {
    let rows = DOCUMENTATION.lines().filter(|line| line.starts_with("| `"));
    let cell = |row: &str, i: usize| row.split('|').nth(i).unwrap().trim().trim_matches('`').to_owned();
    rows.map(|row| (cell(row, 1), cell(row, 2))).collect()
}

/// Entity, below the scene `contact`, and component of everything in a recording.
fn recorded(path: &Path) -> BTreeSet<(String, String)> {
    let mut recorded = BTreeSet::new();
    for store in stores(path, StoreKind::Recording) {
        for chunk in store.iter_physical_chunks() {
            let entity = chunk.entity_path().to_string();
            if let Some(below) = entity.strip_prefix("/contact/") {
                recorded.extend(chunk.components_identifiers().map(|it| (below.to_owned(), it.to_string())));
            }
        }
    }
    recorded
}

/// Whether a component holds numbers or texts of the problem.
fn is_number((entity, component): &(String, String)) -> bool {
    component == "Scalars:scalars"
        || !component.contains(':') && component != "words"
        || component.ends_with("Image:buffer")
        || component == "TextDocument:text"
        || entity.starts_with("trace/") && !component.starts_with("Series")
}

#[test]
fn the_documented_table_and_recordings_agree() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let setups = [
        (Indenter::Cylinder { radius: 1.0 }, Cell::line(256, 4.0)),
        (Indenter::Sphere { radius: 1.0 }, Cell::surface([32, 32], [4.0, 4.0])),
    ];
    let mut found = BTreeSet::new();
    for (indenter, cell) in setups {
        let load = Load::MeanPressure(0.01);
        let setup = Setup::new(Recipe::indenter(indenter), cell, load).on(Solid::ContactModulus(1.0));
        let problem = setup.problem().unwrap();
        for solver in [&Multilevel as &dyn Solver, &Gfmd::default()] {
            let end = solver.solve(&problem, &Stop::default(), &mut ()).unwrap();
            let scene = Scene {
                reference: Some(Arc::new(Reference::from_contact(&end))),
                ..Scene::from_setup(&setup, &problem)
            };
            let what = Part::iter().filter(|part| *part != Part::Spectrum).collect();
            let recording = Recording::create(&path, &[scene], Options { what, ..Options::default() }).unwrap();
            solver.solve(&problem, &Stop::default(), &mut recording.recorder(0)).unwrap();
            recording.finish().unwrap();
            found.extend(recorded(&path).into_iter().filter(is_number));
        }
    }
    // the tree of patches is of lists of loads
    let of_one_load = documented().into_iter().filter(|(entity, _)| !entity.starts_with("patch_tree/"));
    assert_eq!(found, of_one_load.collect());
}

#[test]
fn traces_are_in_their_own_units() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let problem = rough_line();
    let contact = record(&path, &problem, &PolonskyKeer, None, None);
    let last = |name| *trace(&path, name, "step").last_key_value().unwrap().1;
    assert_eq!(last("certificate"), contact.certificate.eta);
    assert_eq!(last("certificate_log10"), contact.certificate.eta.log10());
    assert!((last("mean_gap") / contact.mean_gap() - 1.0).abs() < 1e-6);
    let over_rms_height = last("mean_gap") / problem.rms_height();
    assert!((last("mean_gap_over_rms_height") / over_rms_height - 1.0).abs() < 1e-12);
    let certificates = trace(&path, "certificate", "step");
    assert!(certificates.values().all(|&eta| eta > 0.0) && certificates.len() > 5);
}

/// The values of each frame of a field: of a line once around its period, of a surface at each pixel.
fn frames(path: &Path, field: &'static str) -> BTreeMap<i64, Vec<f64>> {
    let buffer = rerun::DepthImage::descriptor_buffer();
    let images = rows::<rerun::components::ImageBuffer>(path, &format!("/it/{field}/image"), buffer);
    let pixels = |bytes: &[u8]| -> Vec<f64> {
        bytes.chunks_exact(4).map(|it| f32::from_le_bytes(it.try_into().unwrap()).into()).collect()
    };
    let images = images.into_iter().map(|(step, image)| (step, pixels(&image[0].0)));
    let around = |values: &[f32]| values[1..].iter().map(|value| f64::from(*value)).collect();
    let curves = curve(path, field, field).into_iter().map(|(step, values)| (step, around(&values)));
    images.chain(curves).collect()
}

/// The share of nodes in contact and the mean gap of each frame.
fn drawn(path: &Path) -> BTreeMap<i64, [f64; 2]> {
    let (pressure, gap) = (frames(path, "pressure"), frames(path, "gap"));
    let share = |pressure: &[f64]| pressure.iter().filter(|p| **p > 0.0).count() as f64 / pressure.len() as f64;
    let mean = |gap: &[f64]| gap.iter().sum::<f64>() / gap.len() as f64;
    pressure.iter().map(|(step, pressure)| (*step, [share(pressure), mean(&gap[step])])).collect()
}

/// The numbers of a step are those of the fields that are drawn of it, on coarse grids and at the end too.
#[test]
fn traces_are_those_of_the_fields_of_the_same_step() {
    let short = Stop::new(1e-5, 400).unwrap();
    for problem in [rough_line(), rough(Grid::surface([32, 64], [1.0, 2.0]).unwrap())] {
        for solver in [&Multilevel as &dyn Solver, &PolonskyKeer, &Gfmd::default()] {
            for stop in [Stop::default(), short] {
                check_traces(&problem, solver, &stop);
            }
        }
    }
}

fn check_traces(problem: &Problem, solver: &dyn Solver, stop: &Stop) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let options = Options { every: Some(1), ..Options::default() };
    let recording = Recording::create(&path, &[Scene::new("it", problem)], options).unwrap();
    solver.solve(problem, stop, &mut recording.recorder(0)).unwrap();
    recording.finish().unwrap();
    let [area, gap] = ["relative_area_counted", "mean_gap"].map(|name| trace(&path, name, "step"));
    let frames = drawn(&path);
    assert!(frames.len() > 3);
    for (step, [share, mean]) in frames {
        let what = format!("step {step} of {} on {:?}", solver.name(), problem.surface().grid().shape());
        assert!((area[&step] - share).abs() < 1e-12, "area {} for {share} at {what}", area[&step]);
        let apart = (gap[&step] - mean).abs() / problem.rms_height();
        assert!(apart < 1e-6, "mean gap {} for {mean} at {what}", gap[&step]);
    }
}

/// Steps and values of a component of a curve.
fn curve(path: &Path, field: &str, component: &'static str) -> Vec<(i64, Vec<f32>)> {
    let entity = format!("/it/{field}/curves/{field}");
    let mut frames = Vec::new();
    for chunk in chunks(path).iter().filter(|chunk| chunk.entity_path().to_string() == entity) {
        let component = component.into();
        let steps = chunk.iter_component_indices("step".into(), component).map(|(step, _)| step.as_i64());
        frames.extend(steps.zip(chunk.iter_slices::<f32>(component).map(<[f32]>::to_vec)));
    }
    frames.sort_by_key(|(step, _)| *step);
    frames
}

#[test]
fn pressure_and_gap_along_a_line_are_those_of_the_contact() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let contact = record(&path, &rough_line(), &PolonskyKeer, None, None);
    for (name, field) in [("pressure", &contact.pressure), ("gap", &contact.gap)] {
        let (x, values) = (curve(&path, name, "x"), curve(&path, name, name));
        assert_eq!(
            x.iter().map(|(step, _)| step).collect::<Vec<_>>(),
            values.iter().map(|(step, _)| step).collect::<Vec<_>>()
        );
        let ((_, x), (step, values)) = (x.last().unwrap(), values.last().unwrap());
        assert_eq!(*step as usize, contact.work.iterations);
        let around = field.iter().chain(field.first());
        assert!(values.iter().eq(around.map(|&value| value as f32).collect::<Vec<_>>().iter()), "{name}");
        for (node, x) in x.iter().enumerate() {
            assert!((x - node as f32 / 512.0).abs() < 1e-6, "{x} of node {node}");
        }
    }
}

#[test]
fn long_lines_keep_their_largest_pressures_and_smallest_gaps() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let contact = record(&path, &rough(Grid::line(8192, 1.0).unwrap()), &Multilevel, None, None);
    let of = |name| curve(&path, name, name).pop().unwrap().1;
    let (pressure, gap) = (of("pressure"), of("gap"));
    assert_eq!([pressure.len(), gap.len()], [1024; 2]);
    assert_eq!(pressure.iter().fold(0.0, |most: f32, &p| most.max(p)), contact.max_pressure() as f32);
    let touching = pressure.iter().zip(&gap).filter(|(p, _)| **p > 0.0).inspect(|(_, gap)| assert!(**gap < 1e-9));
    assert!(touching.count() > 10);
}

#[test]
fn a_window_around_a_contact_lies_at_its_true_place() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let (indenter, grid) = (Indenter::Cylinder { radius: 1.0 }, Grid::line(256, 4.0).unwrap());
    let load = Load::MeanPressure(0.01);
    let surface = indenter.surface(grid).unwrap();
    let problem = Problem::new(surface, ContactModulus(1.0), load).unwrap();
    let contact = record(&path, &problem, &PolonskyKeer, Exact::new(&indenter, &grid, 1.0, 0.01), None);
    let (x, pressure) =
        (curve(&path, "pressure", "x").pop().unwrap().1, curve(&path, "pressure", "pressure").pop().unwrap().1);
    assert!(x.len() < 256);
    for (x, pressure) in x.iter().zip(pressure) {
        let node = (x / 4.0 * 256.0).round() as usize % 256;
        assert_eq!(pressure, contact.pressure[[0, node]] as f32, "at {x}");
    }
}

#[test]
fn images_of_a_surface_hold_pressures_and_gaps() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let contact = record(&path, &rough_surface(), &PolonskyKeer, None, None);
    for (name, field) in [("pressure", &contact.pressure), ("gap", &contact.gap)] {
        let buffer = rerun::DepthImage::descriptor_buffer();
        let images = rows::<rerun::components::ImageBuffer>(&path, &format!("/it/{name}/image"), buffer);
        let bytes = &images.last().unwrap().1[0].0;
        let pixels = bytes.chunks_exact(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap()));
        let down = field.rows().into_iter().rev().flat_map(|row| row.to_vec()).map(|value| value as f32);
        assert!(pixels.eq(down), "{name}");
    }
}

#[test]
fn values_along_a_line_are_of_its_own_cell_on_every_frame() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    record(&path, &cylinder(), &Multilevel, None, None);
    let (x, pressure) = (curve(&path, "pressure", "x"), curve(&path, "pressure", "pressure"));
    let lengths: BTreeSet<usize> = x.iter().map(|(_, x)| x.len()).collect();
    assert!(lengths.len() > 1, "the grids of the levels differ");
    assert!(x.iter().zip(&pressure).all(|((_, x), (_, pressure))| x.len() == pressure.len()));
    assert!(x.iter().all(|(_, x)| x[0] == 0.0 && *x.last().unwrap() == 4.0));
}
