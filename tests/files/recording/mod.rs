//! The content of recordings, read back from their files.

use asperity::contact::{
    Contact, ContactModulus, Each, Energy, Gfmd, Load, Multilevel, Observer, PolonskyKeer, Solver, Step,
};
use asperity::error::{FileError, SolveError};
use asperity::record::{Options, Parts, Recording, Scene};
use asperity::setup::Part;
use asperity::surface::{Field, Spectrum};
use asperity::theory::Exact;
use asperity::{Grid, Indenter, Problem, Stop, Surface};
use ndarray::Array2;
use rerun::{ChunkStore, ChunkStoreConfig, Component, ComponentDescriptor, StoreKind};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use strum::IntoEnumIterator;

mod axes;
mod below;
mod bodies;
mod comparison;
#[cfg(feature = "cli")]
mod damaged;
mod ghost;
mod histories;
mod instruments;
mod layout;
mod loads;
mod mirror;
mod numbers;
mod pieces;
mod properties;
mod survey;
mod theme;
mod types;
mod words;
mod yielding;

fn cylinder() -> Problem {
    let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(64, 4.0).unwrap()).unwrap();
    Problem::new(cylinder, ContactModulus(1.0), Load::MeanPressure(1e-2)).unwrap()
}

fn rough(grid: Grid) -> Problem {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.1, rms_gradient: 0.01 };
    let surface = Surface::rough(grid, &spectrum, 5).unwrap();
    Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.1)).unwrap()
}

fn rough_line() -> Problem {
    rough(Grid::line(512, 1.0).unwrap())
}

fn rough_surface() -> Problem {
    rough(Grid::surface([32, 48], [1.0, 1.5]).unwrap())
}

fn record(path: &Path, problem: &Problem, solver: &dyn Solver, exact: Option<Exact>, every: Option<usize>) -> Contact {
    record_with(path, problem, solver, exact, Options { every, ..Options::default() })
}

fn record_with(path: &Path, problem: &Problem, solver: &dyn Solver, exact: Option<Exact>, options: Options) -> Contact {
    let scene = Scene { exact, ..Scene::new("it", problem) };
    let recording = Recording::create(path, &[scene], options).unwrap();
    let contact = solver.solve(problem, &Stop::default(), &mut recording.recorder(0)).unwrap().converged().unwrap();
    recording.finish().unwrap();
    contact
}

fn stores(path: &Path, kind: StoreKind) -> Vec<ChunkStore> {
    let mut file = std::fs::File::open(path).unwrap();
    let all = ChunkStore::from_rrd_reader(&ChunkStoreConfig::ALL_DISABLED, &mut file).unwrap();
    all.into_iter().filter(|(id, _)| id.kind() == kind).map(|(_, store)| store).collect()
}

/// The chunks of a recording that change with time.
fn chunks(path: &Path) -> Vec<rerun::log::Chunk> {
    let stores = stores(path, StoreKind::Recording);
    let chunks = stores.iter().flat_map(|store| store.iter_physical_chunks());
    chunks.filter(|chunk| !chunk.is_static()).map(|chunk| (**chunk).clone()).collect()
}

/// Rows of each entity that changes with time.
fn row_counts(path: &Path) -> BTreeMap<String, usize> {
    let mut rows = BTreeMap::new();
    for chunk in chunks(path) {
        *rows.entry(chunk.entity_path().to_string()).or_default() += chunk.num_rows();
    }
    rows
}

/// The numbers of a trace against a timeline; traces of `it` need no more than their names.
fn trace(path: &Path, name: &str, timeline: &'static str) -> BTreeMap<i64, f64> {
    let component = rerun::Scalars::descriptor_scalars().component;
    let entity = if name.starts_with('/') { name.to_owned() } else { format!("/it/trace/{name}") };
    let mut values = BTreeMap::new();
    for store in stores(path, StoreKind::Recording) {
        for chunk in store.iter_physical_chunks().filter(|chunk| chunk.entity_path().to_string() == entity) {
            let times = chunk.iter_component_indices(timeline.into(), component).map(|(time, _)| time.as_i64());
            values.extend(times.zip(chunk.iter_slices::<f64>(component).map(|value| value[0])));
        }
    }
    values
}

/// Steps at which an entity changes.
fn steps(path: &Path, entity: &str) -> BTreeSet<i64> {
    let mut steps = BTreeSet::new();
    for store in stores(path, StoreKind::Recording) {
        for chunk in store.iter_physical_chunks().filter(|chunk| chunk.entity_path().to_string() == entity) {
            steps.extend(
                chunk
                    .timelines()
                    .iter()
                    .filter(|(name, _)| name.as_str() == "step")
                    .flat_map(|(_, column)| column.times().map(|time| time.as_i64()).collect::<Vec<_>>()),
            );
        }
    }
    steps
}

fn entities(path: &Path) -> BTreeSet<String> {
    let of_store = |store: &ChunkStore| {
        store.iter_physical_chunks().map(|chunk| chunk.entity_path().to_string()).collect::<Vec<_>>()
    };
    stores(path, StoreKind::Recording).iter().flat_map(of_store).collect()
}

#[test]
fn every_step_has_its_numbers_on_all_timelines() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("line.rrd");
    let problem = rough_line();
    for solver in [&Gfmd::default() as &dyn Solver, &PolonskyKeer] {
        let mut seen = BTreeMap::new();
        let mut energy_name = "";
        let mut watch = Each(|step: &Step<'_>| {
            let energy = step.energy();
            energy_name = match energy {
                Energy::Complementary(_) => "complementary_energy",
                Energy::Potential(_) => "potential_energy",
            };
            let values = [step.counted().kappa_r, step.patches().count() as f64, energy.value()];
            seen.insert(step.index() as i64, values);
            ControlFlow::Continue(())
        });
        solver.solve(&problem, &Stop::default(), &mut watch).unwrap();
        let contact = record(&path, &problem, solver, None, None);
        for (i, name) in ["kappa_r_counted", "patches", energy_name].iter().enumerate() {
            let expected: BTreeMap<i64, f64> = seen.iter().map(|(&step, values)| (step, values[i])).collect();
            assert_eq!(trace(&path, name, "step"), expected, "{name} of {}", solver.name());
        }
        let last = trace(&path, "certificate", "step");
        let (&step, &certificate) = last.last_key_value().unwrap();
        assert_eq!(step as usize, contact.work.iterations);
        assert_eq!(certificate, contact.certificate.eta);
        let by_work = trace(&path, "kappa_r_counted", "transforms");
        assert!(by_work.len() > 1 && *by_work.last_key_value().unwrap().0 as u64 <= contact.work.transforms);
        assert!(trace(&path, "kappa_r_counted", "seconds").len() > 1);
    }
}

#[test]
fn every_step_has_numbers_and_the_last_state_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cylinder.rrd");
    let contact = record(&path, &cylinder(), &PolonskyKeer, None, None);
    let (steps, rows) = (contact.work.iterations + 1, row_counts(&path));
    assert_eq!(rows["/it/trace/kappa_r_counted"], steps);
    assert_eq!(rows["/it/profile/solid"], steps.min(32) + 1);
    assert!(!rows.contains_key("/it/trace/kappa_r_theory"));
    assert!(!rows.keys().any(|entity| entity.contains("relief")));
}

#[test]
fn places_that_cannot_be_written_are_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let problem = cylinder();
    for path in [folder.path().to_path_buf(), folder.path().join("missing/a.rrd")] {
        let created = Recording::create(&path, &[Scene::new("a", &problem)], Options::default());
        assert!(matches!(created, Err(FileError::Target { .. })));
    }
}

#[test]
fn frames_are_dense_at_first_and_then_sparse_unless_every_step_is_wished_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("line.rrd");
    let problem = rough_line();
    let contact = record(&path, &problem, &Gfmd::default(), None, None);
    let last = contact.work.iterations as i64;
    let thinned = steps(&path, "/it/profile/solid");
    assert!((0..20).all(|step| thinned.contains(&step)) && thinned.contains(&last));
    assert!(thinned.len() < 120 && last > 200, "{} frames of {last} steps", thinned.len());
    record(&path, &problem, &Gfmd::default(), None, Some(1));
    assert_eq!(steps(&path, "/it/profile/solid"), (0..=last).collect());
    record(&path, &problem, &Gfmd::default(), None, Some(50));
    let regular = (0..=last).filter(|step| step % 50 == 0).chain([last]).collect();
    assert_eq!(steps(&path, "/it/profile/solid"), regular);
}

#[test]
fn a_scene_records_only_what_it_shows() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let has = |entities: &BTreeSet<String>, part: &str| entities.iter().any(|entity| entity.contains(part));
    record(&path, &rough_line(), &PolonskyKeer, None, None);
    let line = entities(&path);
    assert!(has(&line, "/it/profile/solid") && has(&line, "/it/pressure") && has(&line, "/it/contact"));
    assert!(!has(&line, "relief") && !has(&line, "exact"), "{line:?}");
    record(&path, &rough_surface(), &PolonskyKeer, None, None);
    let surface = entities(&path);
    assert!(has(&surface, "relief") && has(&surface, "/it/pressure") && !has(&surface, "profile"), "{surface:?}");
    let cylinder = Indenter::Cylinder { radius: 1.0 };
    let grid = Grid::line(256, 4.0).unwrap();
    let problem = Problem::new(cylinder.surface(grid).unwrap(), ContactModulus(1.0), Load::MeanPressure(0.01)).unwrap();
    let exact = Exact::new(&cylinder, &grid, 1.0, 0.01);
    let kappa_r = exact.as_ref().unwrap().kappa_r.unwrap();
    record(&path, &problem, &PolonskyKeer, exact, None);
    assert!(has(&entities(&path), "/it/pressure/curves/exact"));
    assert!(trace(&path, "kappa_r_theory", "step").values().all(|&k| k == kappa_r));
}

#[test]
fn exact_pressure_lies_in_dashes_over_everything_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    let problem = cylinder();
    let exact = Exact::new(&Indenter::Cylinder { radius: 1.0 }, problem.surface().grid(), 1.0, 0.01);
    record(&path, &problem, &PolonskyKeer, exact, None);
    let order = |name: &str| {
        let order = rerun::LineStrips2D::descriptor_draw_order();
        rows::<rerun::components::DrawOrder>(&path, &format!("/it/{name}"), order)[0].1[0].0.0
    };
    let others = ["pressure/curves/pressure", "contact", "pressure/axes/lines"].map(order);
    assert!(others.into_iter().all(|other| order("pressure/curves/exact") > other), "{others:?}");
    let exact = rerun::LineStrips2D::descriptor_strips();
    let dashes = rows::<rerun::components::LineStrip2D>(&path, "/it/pressure/curves/exact", exact).remove(0).1;
    assert!(dashes.len() > 20, "{} dashes", dashes.len());
}

#[test]
fn lines_have_no_mesh_and_surfaces_no_profile() {
    let line = Parts::on(&Grid::line(4, 1.0).unwrap());
    let surface = Parts::on(&Grid::surface([4, 4], [1.0, 1.0]).unwrap());
    assert!(line.has(Part::Profile) && !line.has(Part::Mesh));
    assert!(surface.has(Part::Mesh) && !surface.has(Part::Profile));
    assert!(surface.has(Part::Flow) && !line.has(Part::Flow));
    let both = [Part::Traces, Part::Fields, Part::Mask, Part::Spectrum, Part::Error, Part::Stress, Part::Fringes]
        .into_iter()
        .chain(Part::OF_A_RUN);
    assert_eq!(line.and(surface), both.collect());
    assert!(line.has(Part::Spectrum) && !Parts::USUAL.and(line).has(Part::Spectrum));
}

#[test]
fn roots_are_safe_and_differ() {
    let folder = tempfile::tempdir().unwrap();
    let (path, problem) = (folder.path().join("many.rrd"), cylinder());
    let scenes = ["a", "a", "b/c d", ""].map(|name| Scene::new(name, &problem));
    Recording::create(&path, &scenes, Options::default()).unwrap().finish().unwrap();
    let described = entities(&path).into_iter();
    let roots = described.filter_map(|entity| entity.strip_suffix("/description").map(String::from));
    assert_eq!(roots.collect::<BTreeSet<String>>(), ["/a", "/a_1", "/b_c_d", "/_3"].map(String::from).into());
}

/// The entities of a part, as far down as their first name below the scene.
fn names(part: Part, is_line: bool) -> &'static [&'static str] {
    match part {
        Part::Traces => &["trace"],
        Part::Profile => &["profile"],
        Part::Fields => &["gap", "pressure"],
        Part::Mask => &["contact"],
        Part::Mesh => &["relief"],
        Part::Spectrum => &["spectrum"],
        Part::Error => &["density"],
        Part::Stress => &["stress"],
        Part::Fringes => &["fringes"],
        Part::Flow => &["fluid_pressure_x", "fluid_pressure_y", "flux_x", "flux_y"],
        Part::Raster if is_line => &["raster"],
        Part::Raster => &["raster_row", "raster_column", "flips"],
        // without a state to hold errors against there are none
        Part::Waterfall => &[],
        Part::Energy => &["energy"],
        Part::Decisions => &["decisions", "lanes"],
        Part::Ritz => &["ritz"],
    }
}

/// What the views of a file show, by the first names below the scene.
fn shown(path: &Path) -> BTreeSet<String> {
    shown_paths(path).iter().map(|path| below(path)).collect()
}

/// What the views of a file show.
fn shown_paths(path: &Path) -> BTreeSet<String> {
    use rerun::external::re_sdk_types::blueprint::{archetypes::ViewContents, components::QueryExpression};
    let query = ViewContents::descriptor_query().component;
    let mut shown = BTreeSet::new();
    for store in stores(path, StoreKind::Blueprint) {
        for chunk in store.iter_physical_chunks() {
            let expressions = (0..chunk.num_rows()).filter_map(|i| chunk.component_batch::<QueryExpression>(query, i));
            shown.extend(expressions.flat_map(Result::unwrap).map(|expression| expression.0.to_string()));
        }
    }
    shown
}

/// The first name below the scene.
fn below(entity: &str) -> String {
    entity.trim_start_matches("/it/").split('/').next().unwrap().to_owned()
}

#[test]
fn each_part_alone_records_just_its_entities_and_has_just_its_panes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    for problem in [rough_line(), rough_surface()] {
        let can_show = Parts::on(problem.surface().grid());
        for part in Part::iter().filter(|&part| can_show.has(part)) {
            let what = [part].into_iter().collect();
            record_with(&path, &problem, &Multilevel, None, Options { what, ..Options::default() });
            let recorded = entities(&path).into_iter().filter(|entity| entity.starts_with("/it/"));
            let recorded: BTreeSet<String> = recorded.map(|entity| below(&entity)).collect();
            let expected = names(part, problem.surface().grid().is_line())
                .iter()
                .map(|name| name.to_string())
                .chain(["description".into()]);
            let captioned = matches!(part, Part::Profile | Part::Fields | Part::Mask | Part::Flow);
            let expected: BTreeSet<String> = expected.chain(captioned.then(|| "caption".into())).collect();
            assert_eq!(recorded, expected, "{part:?}");
            assert_eq!(shown(&path), expected, "{part:?}");
        }
    }
}

/// The solid of a profile at each frame, over width and height of its box.
fn within_box(path: &Path, profile: &str) -> Vec<(i64, Vec<[f32; 2]>)> {
    let (_, frame) = strips(path, &format!("{profile}/axes/lines")).remove(0);
    let size = [0, 1].map(|axis| frame.iter().map(|point| point[axis]).fold(0.0, f32::max));
    let over = |point: [f32; 2]| [point[0] / size[0], point[1] / size[1]];
    let frames = strips(path, &format!("{profile}/solid")).into_iter();
    frames.map(|(step, points)| (step, points.into_iter().map(over).collect())).collect()
}

#[test]
fn parts_together_are_what_they_are_alone() {
    let folder = tempfile::tempdir().unwrap();
    let (path, part) = (folder.path().join("all.rrd"), folder.path().join("part.rrd"));
    let problem = rough_line();
    record(&path, &problem, &PolonskyKeer, None, None);
    let what = [Part::Traces, Part::Profile].into_iter().collect();
    record_with(&part, &problem, &PolonskyKeer, None, Options { what, ..Options::default() });
    let [together, alone] =
        [&path, &part].map(|path| (within_box(path, "/it/profile"), strips(path, "/it/profile/solid")));
    assert_ne!(together.1, alone.1, "each fills its own pane");
    for ((step, these), (other_step, others)) in together.0.iter().zip(&alone.0) {
        assert_eq!((step, these.len()), (other_step, others.len()));
        let is_same = |(a, b): (&[f32; 2], &[f32; 2])| (0..2).all(|i| (a[i] - b[i]).abs() < 1e-6);
        assert!(these.iter().zip(others).all(is_same), "at step {step}");
    }
    assert_eq!(together.0.len(), alone.0.len());
    assert_eq!(trace(&path, "complementary_energy", "step"), trace(&part, "complementary_energy", "step"));
    assert!(!strips(&path, "/it/gap/curves/gap").is_empty() && strips(&part, "/it/gap/curves/gap").is_empty());
}

#[test]
fn the_file_carries_its_own_layout() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    record(&path, &rough_surface(), &PolonskyKeer, None, None);
    let layouts = stores(&path, StoreKind::Blueprint);
    assert_eq!(layouts.len(), 1);
    let parts: BTreeSet<String> =
        layouts[0].iter_physical_chunks().map(|chunk| chunk.entity_path().to_string()).collect();
    assert!(parts.iter().any(|part| part.starts_with("/view/")) && parts.contains("/viewport"), "{parts:?}");
    assert!(parts.contains("/time_panel"), "{parts:?}");
}

/// The problem on the grid that holds every `stride`-th node along each side that has more than one.
fn coarse(problem: &Problem, stride: usize) -> Problem {
    let grid = problem.surface().grid();
    let ([ny, nx], [ly, lx]) = (grid.shape(), grid.size());
    let along_y = if grid.is_line() { 1 } else { stride };
    let shape = [ny / along_y, nx / stride];
    let height = Array2::from_shape_fn(shape, |(y, x)| problem.height()[y * along_y * nx + x * stride]);
    let grid = if grid.is_line() { Grid::line(shape[1], lx) } else { Grid::surface(shape, [ly, lx]) };
    let load = Load::MeanPressure(problem.mean_pressure().unwrap());
    Problem::new(Surface::new(grid.unwrap(), height).unwrap(), ContactModulus(1.0), load).unwrap()
}

/// Stands in for a solver of ever finer grids; each of them starts at step 0.
struct Refining(&'static [usize]);

impl Solver for Refining {
    fn name(&self) -> &str {
        "refining"
    }

    fn settings(&self) -> String {
        String::new()
    }

    fn solve_from(
        &self,
        start: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        for &stride in self.0 {
            PolonskyKeer.solve(&coarse(problem, stride), stop, observer)?;
        }
        PolonskyKeer.solve_from(start, problem, stop, observer)
    }
}

/// Values of a component of an entity, in the order in which they were recorded, each with its step.
fn rows<C: Component>(path: &Path, entity: &str, component: ComponentDescriptor) -> Vec<(i64, Vec<C>)> {
    let mut rows = BTreeMap::new();
    for store in stores(path, StoreKind::Recording) {
        for chunk in store.iter_physical_chunks().filter(|chunk| chunk.entity_path().to_string() == entity) {
            let steps = chunk.timelines().get(&"step".into()).map(|column| column.times_raw().to_vec());
            for (i, id) in chunk.row_ids().enumerate() {
                if let Some(values) = chunk.component_batch::<C>(component.component, i) {
                    rows.insert(id, (steps.as_ref().map_or(0, |steps| steps[i]), values.unwrap()));
                }
            }
        }
    }
    rows.into_values().collect()
}

/// Positions of a strip at each frame.
fn strips(path: &Path, entity: &str) -> Vec<(i64, Vec<[f32; 2]>)> {
    let rows = rows::<rerun::components::LineStrip2D>(path, entity, rerun::LineStrips2D::descriptor_strips());
    let points = |strips: Vec<rerun::components::LineStrip2D>| strips[0].0.iter().map(|p| [p.x(), p.y()]).collect();
    rows.into_iter().map(|(step, strips)| (step, points(strips))).collect()
}

#[test]
fn coarse_grids_of_a_line_are_drawn_in_place_up_to_their_last_states() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("line.rrd");
    let problem = rough_line();
    record(&path, &problem, &Refining(&[8, 4, 2]), None, None);
    let (frames, indenter) = (strips(&path, "/it/profile/solid"), strips(&path, "/it/profile/indenter").remove(0).1);
    assert!(frames.is_sorted_by_key(|(_, points)| points.len()) && frames.len() < 100);
    let steps = [8, 4, 2, 1].map(|stride| {
        let steps = PolonskyKeer.solve(&coarse(&problem, stride), &Stop::default(), &mut ()).unwrap().work.iterations;
        let (last, solid) = frames.iter().rfind(|(_, points)| points.len() == 512 / stride + 1).unwrap();
        assert_eq!(*last as usize, steps, "of every {stride}");
        let mut nearest = f32::INFINITY;
        for (i, point) in solid.iter().enumerate() {
            let [x, edge] = indenter[i * stride];
            assert!((point[0] - x).abs() < 1e-3 && point[1] > edge - 0.1, "{point:?} at {:?}", indenter[i * stride]);
            nearest = nearest.min((point[1] - edge).abs());
        }
        assert!(nearest < 0.01, "{nearest} of every {stride}");
        steps + 1
    });
    let levels = rows::<rerun::components::Scalar>(&path, "/it/trace/phase", rerun::Scalars::descriptor_scalars());
    let steps_of = |level: f64| levels.iter().filter(|(_, values)| values[0].0.0 == level).count();
    assert_eq!([3.0, 2.0, 1.0, 0.0].map(steps_of), steps);
}

#[test]
fn coarse_grids_of_a_surface_are_drawn_in_place() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("surface.rrd");
    let problem = rough_surface();
    record(&path, &problem, &Refining(&[4, 2]), None, None);
    let buffer = rerun::DepthImage::descriptor_buffer();
    let images = rows::<rerun::components::ImageBuffer>(&path, "/it/pressure/image", buffer);
    let images = images.into_iter().map(|(_, image)| {
        image[0].0.chunks_exact(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap())).collect::<Vec<f32>>()
    });
    let words = rows::<rerun::components::Text>(&path, "/it/caption", ComponentDescriptor::partial("words"));
    let frames: Vec<(String, Vec<f32>)> = words.iter().map(|(_, words)| words[0].to_string()).zip(images).collect();
    for (stride, level) in [(4, "8 x 12,"), (2, "16 x 24,"), (1, "32 x 48,")] {
        let contact = PolonskyKeer.solve(&coarse(&problem, stride), &Stop::default(), &mut ()).unwrap();
        let (_, image) = frames.iter().rfind(|(words, _)| words.starts_with(level)).unwrap();
        let highest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let highest_pixel = highest(&mut image.iter().map(|&pixel| f64::from(pixel)));
        let scale = highest_pixel / highest(&mut contact.pressure.iter().copied());
        for ((y, x), &pressure) in contact.pressure.indexed_iter() {
            let pixel = f64::from(image[(31 - y * stride) * 48 + x * stride]);
            assert!((pixel - scale * pressure).abs() <= 1e-6 * highest_pixel, "{pixel} at {y}, {x} of every {stride}");
        }
    }
    assert!(frames.last().unwrap().0.starts_with("32 x 48"));
    let positions = rerun::Mesh3D::descriptor_vertex_positions();
    let meshes = rows::<rerun::components::Position3D>(&path, "/it/relief/solid", positions);
    let columns = |mesh: &[rerun::components::Position3D]| {
        mesh.iter().map(|vertex| (vertex.x() * 1e4) as i64).collect::<BTreeSet<_>>().len()
    };
    let counts: BTreeSet<usize> = meshes.iter().map(|(_, mesh)| columns(mesh)).collect();
    assert_eq!(counts, BTreeSet::from([13, 25, 49]));
}

#[test]
fn other_grids_and_solvers_without_levels_leave_no_trace_of_levels() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("line.rrd");
    let problem = rough_line();
    record(&path, &problem, &PolonskyKeer, None, None);
    assert!(trace(&path, "phase", "step").is_empty());
    assert!(!entities(&path).contains("/it/caption"));
    let recording = Recording::create(&path, &[Scene::new("it", &problem)], Options::default()).unwrap();
    let mut recorder = recording.recorder(0);
    let other = PolonskyKeer.solve(&rough_surface(), &Stop::default(), &mut recorder).unwrap();
    drop(recorder);
    recording.finish().unwrap();
    assert_eq!(trace(&path, "kappa_r_counted", "step").len(), other.work.iterations + 1);
    assert!(strips(&path, "/it/profile/solid").is_empty());
}

/// Sees a few steps of another solver and is then dropped, without an end.
#[test]
fn a_run_without_an_end_keeps_its_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let (path, problem) = (folder.path().join("a.rrd"), rough_line());
    let recording = Recording::create(&path, &[Scene::new("it", &problem)], Options::default()).unwrap();
    let mut recorder = recording.recorder(0);
    let mut expected = BTreeMap::new();
    let mut forward = Each(|step: &Step<'_>| {
        expected.insert(step.index() as i64, step.counted().kappa_r);
        recorder.step(step).unwrap()
    });
    Gfmd::default().solve(&problem, &Stop::default(), &mut forward).unwrap();
    drop(recorder);
    recording.finish().unwrap();
    assert!(expected.len() > 200);
    assert_eq!(trace(&path, "kappa_r_counted", "step"), expected);
}

#[test]
fn curves_on_coarse_grids_are_thin_and_those_on_the_finest_one_thick() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.rrd");
    record(&path, &rough_line(), &Multilevel, None, None);
    let finest = trace(&path, "phase", "step").into_iter().find(|(_, level)| *level == 0.0).unwrap().0;
    let width = |entity: &str| {
        rows::<rerun::components::StrokeWidth>(&path, entity, rerun::SeriesLines::descriptor_widths())
            .into_iter()
            .map(|(step, widths)| (step, widths[0].0.0))
            .collect::<Vec<_>>()
    };
    let [(0, coarse), (from, fine)] = width("/it/trace/kappa_r")[..] else { panic!("two widths") };
    assert!(from == finest && fine > 2.0 * coarse, "{coarse} and from step {from} on {fine}");
    record(&path, &rough_line(), &PolonskyKeer, None, None);
    assert_eq!(width("/it/trace/kappa_r"), [(0, fine)]);
}

/// A run that would take for ever, under a limit on the length of files.
#[cfg(all(unix, feature = "cli"))]
#[test]
fn a_recording_that_cannot_grow_ends_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("short.rrd");
    let output = Command::new("sh")
        .args(["-c", r#"trap "" XFSZ; ulimit -f 16000; exec "$@""#, "sh", env!("CARGO_BIN_EXE_asperity")])
        .args(ENDLESS.split(' '))
        .arg(&path)
        .output()
        .unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{complaint}");
    let draft = draft_of(&path).unwrap();
    assert!(complaint.contains(draft.file_name().unwrap().to_str().unwrap()) && !path.exists(), "{complaint}");
    assert!(trace(&draft, "/contact/trace/kappa_r_counted", "step").len() > 100);
}

/// An older recording stays as it is until the new one is whole, which has its name then.
#[test]
fn an_older_recording_stays_until_the_new_one_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("it.rrd");
    let problem = rough(Grid::line(64, 1.0).unwrap());
    let write = || {
        let recording = Recording::create(&path, &[Scene::new("it", &problem)], Options::default()).unwrap();
        Multilevel.solve(&problem, &Stop::default(), &mut recording.recorder(0)).unwrap();
        recording
    };
    write().finish().unwrap();
    assert_eq!(draft_of(&path), None);
    let old = std::fs::read(&path).unwrap();
    let recording = write();
    assert_eq!(std::fs::read(&path).unwrap(), old, "the old one is whole");
    assert!(
        !steps(&draft_of(&path).unwrap(), "/it/pressure/curves/pressure").is_empty(),
        "the new one can be opened as it grows"
    );
    drop(recording);
    assert_eq!(std::fs::read(&path).unwrap(), old, "a run that ends before its time leaves the old one");
    let left = draft_of(&path).unwrap();
    write().finish().unwrap();
    assert_ne!(std::fs::read(&path).unwrap(), old);
    assert_eq!(draft_of(&path), Some(left), "what an earlier run left is not touched");
}

/// The file in which a recording grows, or has grown until it was killed.
fn draft_of(path: &Path) -> Option<PathBuf> {
    let begin = format!("{}.part-", path.file_stem().unwrap().to_str().unwrap());
    let entries = std::fs::read_dir(path.parent().unwrap()).unwrap().map(|entry| entry.unwrap().path());
    entries.into_iter().find(|it| it.file_name().unwrap().to_str().unwrap().starts_with(&begin))
}

/// A run that would take for ever, less the name of its recording.
#[cfg(all(unix, feature = "cli"))]
const ENDLESS: &str = "solve --hurst 0.8 --rolloff 0.25 --short-cutoff 0.01 --rms-gradient 0.01 --points 4096 --size 1 \
     --reduced-pressure 0.01 --solver gfmd --tolerance 1e-30 --max-iterations 100000000 --time-step 0.01 --record";

/// Starts a run that would take for ever, and kills it when the file has grown beyond its statics and first frames, which
/// are written entity by entity.
#[cfg(all(unix, feature = "cli"))]
#[test]
fn a_killed_run_leaves_a_recording_that_opens() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("killed.rrd");
    let mut run = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(ENDLESS.split(' '))
        .arg(&path)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let size = || draft_of(&path).map_or(0, |draft| std::fs::metadata(draft).unwrap().len());
    let deadline = Instant::now() + Duration::from_secs(60);
    while size() < 4_000_000 && run.try_wait().unwrap().is_none() && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(run.try_wait().unwrap().is_none(), "the run ended by itself");
    run.kill().unwrap();
    run.wait().unwrap();
    assert!(!path.exists());
    let path = draft_of(&path).unwrap();
    let size = || std::fs::metadata(&path).unwrap().len();
    let entity = "/contact/profile/solid";
    assert!(steps(&path, entity).len() > 10, "{} frames in {} bytes", steps(&path, entity).len(), size());
    assert_eq!(stores(&path, StoreKind::Blueprint).len(), 1);
}
