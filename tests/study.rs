//! Sweeps and their tables: the same numbers however they are solved, stopped and gone on with.

use asperity::error::StudyError;
use asperity::study::{Realisation, Row, Shape, Sweep, Table};
use asperity::surface::{Indenter, Spectrum};
use asperity::{Grid, Stop};
use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

fn line(hurst: f64, seed: u64, loads: &[f64]) -> Realisation {
    let spectrum = Spectrum { hurst, rolloff_wavelength: 0.125, short_cutoff: 0.004, rms_gradient: 1e-3 };
    Realisation {
        name: "rough line".into(),
        grid: Grid::line(2048, 1.0).unwrap(),
        shape: Shape::Rough { spectrum, seed },
        loads: loads.to_vec(),
    }
}

fn sweep(workers: usize) -> Sweep {
    let loads = [0.003, 0.004, 0.02, 0.1];
    let realisations = (1..=3).flat_map(|seed| [0.3, 0.8].map(|hurst| line(hurst, seed, &loads))).collect();
    Sweep { realisations, stop: Stop::default(), workers }
}

/// The bytes of the finished table of a fresh run.
fn table_of(sweep: &Sweep, path: &Path) -> Vec<u8> {
    sweep.run(&Table::new(path), &|_| ()).unwrap();
    fs::read(path).unwrap()
}

fn paths(folder: &Path, name: &str) -> [PathBuf; 2] {
    ["csv", "unfinished"].map(|ending| folder.join(format!("{name}.{ending}")))
}

#[test]
fn a_table_is_the_same_to_the_last_bit_for_any_number_of_workers() {
    let folder = tempfile::tempdir().unwrap();
    let alone = table_of(&sweep(1), &folder.path().join("alone.csv"));
    let together = table_of(&sweep(5), &folder.path().join("together.csv"));
    assert!(alone.len() > 1000 && alone == together);
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(one_thread.install(|| table_of(&sweep(1), &folder.path().join("thread.csv"))), alone);
}

#[test]
fn what_a_killed_run_left_is_kept_and_the_rest_added() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, _] = paths(folder.path(), "whole");
    let expected = table_of(&sweep(1), &whole);
    for cut in [0, 1, 57, 900, 1800, usize::MAX] {
        let [path, unfinished] = paths(folder.path(), &format!("cut{cut}"));
        let table = Table::new(&path);
        let points = sweep(1).run(&Table::new(&whole), &|_| ()).unwrap();
        table.append(&points[8..16]).unwrap();
        let left = fs::read(&unfinished).unwrap();
        fs::write(&unfinished, &left[..cut.min(left.len())]).unwrap();
        let solved = Mutex::new(Vec::new());
        sweep(2).run(&table, &|row: &Row| solved.lock().unwrap().push(row.seed)).unwrap();
        let solved = solved.into_inner().unwrap().len();
        assert_eq!(fs::read(&path).unwrap(), expected, "cut at {cut}");
        assert!(!unfinished.exists());
        match cut {
            0..=57 => assert_eq!(solved, 24),
            usize::MAX => assert_eq!(solved, 16),
            _ => assert!(solved == 24 || solved == 20, "cut at {cut}: {solved}"),
        }
    }
}

#[test]
fn a_finished_table_is_not_solved_again_and_grows_by_what_is_new() {
    let folder = tempfile::tempdir().unwrap();
    let [path, _] = paths(folder.path(), "x");
    let first = Sweep { realisations: sweep(1).realisations[..2].to_vec(), ..sweep(1) };
    first.run(&Table::new(&path), &|_| ()).unwrap();
    let solved = Mutex::new(Cell::new(0));
    let count = |_: &Row| {
        let solved = solved.lock().unwrap();
        solved.set(solved.get() + 1);
    };
    first.run(&Table::new(&path), &count).unwrap();
    assert_eq!(solved.lock().unwrap().get(), 0);
    sweep(1).run(&Table::new(&path), &count).unwrap();
    assert_eq!(solved.lock().unwrap().get(), 16);
    let seconds = fs::read_to_string(folder.path().join("x.seconds.csv")).unwrap();
    assert_eq!(seconds.lines().count(), 25);
    assert!(seconds.lines().skip(1).all(|line| line.rsplit(',').next().unwrap().parse::<f64>().unwrap() > 0.0));
}

#[test]
fn the_points_of_another_study_are_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let [path, unfinished] = paths(folder.path(), "x");
    let table = Table::new(&path);
    let first = Sweep { realisations: sweep(1).realisations[..2].to_vec(), ..sweep(1) };
    let points = first.run(&table, &|_| ()).unwrap();
    let there = fs::read(&path).unwrap();
    let others = [
        Sweep { realisations: sweep(1).realisations[1..].to_vec(), ..sweep(1) },
        Sweep { stop: Stop::new(1e-9, 100).unwrap(), ..first.clone() },
        Sweep { realisations: vec![line(0.3, 1, &[0.003, 0.004])], ..sweep(1) },
    ];
    for other in others {
        let refused = other.run(&table, &|_| ()).unwrap_err();
        assert!(matches!(refused, StudyError::OtherStudy { points: 2.., .. }), "{refused}");
        assert_eq!(fs::read(&path).unwrap(), there);
    }
    table.clear().unwrap();
    assert!(!path.exists());
    table.append(&points).unwrap();
    let other = Sweep { realisations: vec![line(0.3, 9, &[0.003])], ..sweep(1) };
    assert!(matches!(other.run(&table, &|_| ()), Err(StudyError::OtherStudy { points: 8, .. })));
    assert!(unfinished.exists());
    fs::write(&path, "a,b\n1,2\n").unwrap();
    let refused = first.run(&table, &|_| ()).unwrap_err().to_string();
    assert!(refused.contains("something else than the points of a study"), "{refused}");
    assert_eq!(fs::read(&path).unwrap(), b"a,b\n1,2\n");
}

#[test]
fn what_does_not_converge_is_kept_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let hasty = Sweep { stop: Stop::new(1e-12, 2).unwrap(), ..sweep(1) };
    let points = hasty.run(&Table::new(folder.path().join("x.csv")), &|_| ()).unwrap();
    assert_eq!(points.len(), 24);
    assert!(points.iter().all(|timed| !timed.row.is_converged() && timed.row.certificate > 1e-12));
}

#[test]
fn surfaces_and_loads_that_cannot_be_are_refused_before_anything_is_solved() {
    let folder = tempfile::tempdir().unwrap();
    let table = Table::new(folder.path().join("x.csv"));
    let fails = |realisation: Realisation| {
        let sweep = Sweep { realisations: vec![line(0.5, 1, &[0.1]), realisation], ..sweep(1) };
        sweep.run(&table, &|row| panic!("solved {row:?}")).unwrap_err().to_string()
    };
    assert!(fails(line(1.5, 1, &[0.1])).contains("Hurst exponent is 1.5"));
    assert!(fails(line(0.5, 1, &[0.1, -1.0])).contains("reduced pressure is -1.0"));
    assert!(fails(line(0.5, 1, &[f64::NAN])).contains("reduced pressure is NaN"));
    let wide = Shape::Smooth(Indenter::Sphere { radius: 1.0 });
    assert!(fails(Realisation { shape: wide, ..line(0.5, 1, &[0.1]) }).contains("needs a surface"));
    assert!(!table.path().exists());
}
