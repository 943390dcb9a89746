//! What a recording holds, read back from the file.
#![cfg(feature = "record")]

use asperity::contact::{Contact, Gfmd, PolonskyKeer, Solver, Step};
use asperity::record::{Options, Recording, Scene};
use asperity::surface::Spectrum;
use asperity::theory::Exact;
use asperity::{Grid, Indenter, Problem, Stop, Surface};
use rerun::{ChunkStore, ChunkStoreConfig, StoreKind};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

fn rough(grid: Grid) -> Problem {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.1, rms_gradient: 0.01 };
    Problem::at_reduced_pressure(Surface::rough(grid, &spectrum, 5).unwrap(), 1.0, 0.1).unwrap()
}

fn rough_line() -> Problem {
    rough(Grid::line(512, 1.0).unwrap())
}

fn rough_surface() -> Problem {
    rough(Grid::surface([32, 48], [1.0, 1.5]).unwrap())
}

fn record(path: &Path, problem: &Problem, solver: &dyn Solver, exact: Option<Exact>, every: Option<usize>) -> Contact {
    let scene = Scene { name: "it".into(), title: "It".into(), problem, description: "# It".into(), exact };
    let recording = Recording::create(path, &[scene], Options { every, ..Options::default() }).unwrap();
    let mut recorder = recording.recorder(0);
    let contact = solver.solve(problem, &Stop::default(), &mut recorder).unwrap();
    recorder.close(&contact).unwrap();
    recording.finish().unwrap();
    contact
}

fn stores(path: &Path, kind: StoreKind) -> Vec<ChunkStore> {
    let mut file = std::fs::File::open(path).unwrap();
    let all = ChunkStore::from_rrd_reader(&ChunkStoreConfig::ALL_DISABLED, &mut file).unwrap();
    all.into_iter().filter(|(id, _)| id.kind() == kind).map(|(_, store)| store).collect()
}

/// The numbers of a trace against a timeline.
fn trace(path: &Path, name: &str, timeline: &'static str) -> BTreeMap<i64, f64> {
    let component = rerun::Scalars::descriptor_scalars().component;
    let entity = format!("/it/trace/{name}");
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
        let mut watch = |step: &Step<'_>| {
            seen.insert(step.index() as i64, [step.measures().kappa_r, step.patches().count() as f64, step.energy()]);
            ControlFlow::Continue(())
        };
        solver.solve(&problem, &Stop::default(), &mut watch).unwrap();
        let contact = record(&path, &problem, solver, None, None);
        for (i, name) in ["kappa_r", "patches", "energy"].iter().enumerate() {
            let expected: BTreeMap<i64, f64> = seen.iter().map(|(&step, values)| (step, values[i])).collect();
            assert_eq!(trace(&path, name, "step"), expected, "{name} of {}", solver.name());
        }
        let last = trace(&path, "certificate", "step");
        let (&step, &certificate) = last.last_key_value().unwrap();
        assert_eq!(step as usize, contact.work.iterations);
        assert!((certificate - contact.certificate.eta.log10()).abs() < 1e-9);
        let by_work = trace(&path, "kappa_r", "transforms");
        assert!(by_work.len() > 1 && *by_work.last_key_value().unwrap().0 as u64 <= contact.work.transforms);
        assert!(trace(&path, "kappa_r", "seconds").len() > 1);
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
    let problem = Problem::new(cylinder.surface(grid).unwrap(), 1.0, 0.01).unwrap();
    let exact = Exact::of(&cylinder, &grid, 1.0, 0.01);
    let kappa_r = exact.as_ref().unwrap().kappa_r.unwrap();
    record(&path, &problem, &PolonskyKeer, exact, None);
    assert!(has(&entities(&path), "/it/pressure/curves/exact"));
    assert!(trace(&path, "exact_kappa_r", "step").values().all(|&k| k == kappa_r));
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

/// Starts a run that would take for ever, and kills it when the file has grown beyond its statics.
#[cfg(unix)]
#[test]
fn a_killed_run_leaves_a_recording_that_opens() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("killed.rrd");
    let mut run = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(
            "solve --hurst 0.8 --rolloff 0.25 --short-cutoff 0.01 --rms-gradient 0.01 --points 4096 --size 1"
                .split(' '),
        )
        .args("--reduced-pressure 0.01 --solver gfmd --tolerance 1e-30 --max-iterations 100000000".split(' '))
        .args(["--time-step", "0.01", "--record"])
        .arg(&path)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let size = || std::fs::metadata(&path).map_or(0, |file| file.len());
    let deadline = Instant::now() + Duration::from_secs(60);
    while size() < 1_000_000 && run.try_wait().unwrap().is_none() && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(run.try_wait().unwrap().is_none(), "the run ended by itself");
    run.kill().unwrap();
    run.wait().unwrap();
    let entity = "/contact/profile/solid";
    assert!(steps(&path, entity).len() > 10, "{} frames in {} bytes", steps(&path, entity).len(), size());
    assert_eq!(stores(&path, StoreKind::Blueprint).len(), 1);
}
