//! Earlier solves beside later ones, read back from their files.

use super::{chunks, cylinder, row_counts, stores, trace};
use asperity::contact::{ContactModulus, Gfmd, Load, PolonskyKeer, Solver};
use asperity::record::{Ghost, Options, Recording, Scene};
use asperity::{Grid, Indenter, Problem, Stop};
use rerun::StoreKind;
use std::path::Path;
use std::sync::Arc;

/// Records a quick solve beside `ghost`, and returns its steps.
fn record(path: &Path, ghost: Option<Arc<Ghost>>) -> usize {
    let problem = cylinder();
    let options = Options { ghost, ..Options::default() };
    let recording = Recording::create(path, &[Scene::new("cylinder", &problem)], options).unwrap();
    let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut recording.recorder(0)).unwrap();
    recording.finish().unwrap();
    contact.work.iterations
}

/// Whether the recording draws the pressure of an earlier solve.
fn draws_pressure(path: &Path) -> bool {
    let stores = stores(path, StoreKind::Recording);
    let mut chunks = stores.iter().flat_map(|store| store.iter_physical_chunks());
    chunks.any(|chunk| chunk.entity_path().to_string() == "/cylinder/pressure/curves/ghost")
}

#[test]
fn the_earlier_curves_stand_at_their_own_steps() {
    let mut ghost = Ghost::new("slow");
    let finer = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(96, 4.0).unwrap()).unwrap();
    let finer = Problem::new(finer, ContactModulus(1.0), Load::MeanPressure(1e-2)).unwrap();
    let contact = Gfmd::default().solve(&finer, &Stop::default(), &mut ghost).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.rrd");
    let (steps, earlier) = (record(&path, Some(Arc::new(ghost))), contact.work.iterations);
    assert!(earlier > steps);
    let rows = row_counts(&path);
    // the first steps of a motion have no contact that is resolved, and so no kappa_r
    assert!((steps + 2..=earlier + 1).contains(&rows["/cylinder/ghost/kappa_r"]));
    assert_eq!(trace(&path, "/cylinder/trace/kappa_r", "step").len(), steps + 1);
    let last = |entity: &str| {
        let of_entity = chunks(&path).into_iter().filter(|chunk| chunk.entity_path().to_string() == entity);
        of_entity.map(|chunk| chunk.timelines()[&"step".into()].time_range().max().as_i64()).max()
    };
    assert_eq!(last("/cylinder/ghost/certificate_log10"), Some(earlier as i64));
    assert_eq!(last("/cylinder/trace/certificate"), Some(steps as i64));
    assert!(draws_pressure(&path));
}

#[test]
fn nothing_of_an_earlier_solve_is_recorded_without_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("one.rrd");
    record(&path, None);
    assert!(!row_counts(&path).keys().any(|entity| entity.contains("ghost")));
    assert!(!draws_pressure(&path));
}
