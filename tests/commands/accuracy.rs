//! Error against run time, measured for real on small grids.

use crate::command::{Folder, text};
use asperity::Stop;
use asperity::lab::accuracy::{AccuracyScene, Experiment};
use std::collections::{HashMap, HashSet};
use std::num::NonZeroUsize;

type Row = HashMap<String, String>;

fn rows(folder: &Folder) -> Vec<Row> {
    csv::Reader::from_path(folder.join("out/accuracy.csv")).unwrap().deserialize().map(Result::unwrap).collect()
}

fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} is {:?} in {row:?}", row[column]))
}

fn of_kind<'a>(rows: &'a [Row], kind: &str) -> Vec<&'a Row> {
    rows.iter().filter(|row| row["kind"] == kind).collect()
}

/// The points of one solver on one grid.
fn curve<'a>(rows: &'a [Row], solver: &str, nx: &str) -> Vec<&'a Row> {
    of_kind(rows, "algebraic").into_iter().filter(|row| row["solver"] == solver && row["nx"] == nx).collect()
}

fn quick_sine() -> (Folder, String) {
    let folder = Folder::new();
    let output = folder.run("accuracy --quick sine --out out");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    (folder, text(&output.stdout).to_owned())
}

#[test]
fn the_three_errors_of_a_sine_are_told_apart() {
    let (folder, out) = quick_sine();
    let rows = rows(&folder);
    let kinds: HashSet<&str> = rows.iter().map(|row| row["kind"].as_str()).collect();
    assert_eq!(kinds, HashSet::from(["algebraic", "discretisation", "model"]));
    for words in ["discretisation: ", "algebraic: ", "model: ", "when to stop", "for kappa_r to 1 % use"] {
        assert!(out.contains(words), "{words} in {out}");
    }
    assert!(out.lines().all(|line| line.len() <= 120), "{out}");
    assert_falling_errors(&rows);
    assert_orders(&rows);
    assert_figures(&folder);
}

/// With each halving of the certificate, time and transforms rise, and the error of the pressure hardly ever does.
fn assert_falling_errors(rows: &[Row]) {
    for solver in ["multilevel", "polonsky-keer", "gfmd", "gfmd-uniform"] {
        let curve = curve(rows, solver, "2048");
        for pair in curve.windows(2) {
            let values = |column| [number(pair[0], column), number(pair[1], column)];
            let [before, after] = values("eta");
            assert!(after <= 0.5 * before || after <= 1e-10, "{solver}: {before} to {after}");
            assert!(values("transforms").is_sorted() && values("step").is_sorted(), "{pair:?}");
            let [before, after] = values("pressure_error");
            assert!(after <= 3.0 * before, "{solver}: {before} to {after}");
        }
        let last = curve.last().unwrap();
        assert!(number(last, "pressure_error") <= 5e-8 && number(last, "eta") <= 1e-10, "{last:?}");
        let [least, median, most] = ["least_seconds", "seconds", "most_seconds"].map(|column| number(last, column));
        assert!(0.0 < least && least <= median && median <= most, "{last:?}");
    }
}

/// Area and `kappa_r` fall with the square of the spacing, as the mean gap does, and with the spacing where nodes are counted.
fn assert_orders(rows: &[Row]) {
    let rungs = of_kind(rows, "discretisation");
    let [first, last] = [rungs[0], rungs[rungs.len() - 1]];
    let octaves = (number(last, "nx") / number(first, "nx")).log2();
    let order = |column| (number(first, column) / number(last, column)).log2() / octaves;
    let counted = [("area_counted_error", 1.0), ("kappa_r_counted_error", 1.0)];
    let resolved = [("area_error", 2.0), ("kappa_r_error", 2.0), ("mean_gap_error", 2.0)];
    for (column, expected) in counted.into_iter().chain(resolved) {
        assert!((order(column) - expected).abs() < 0.25, "order of {column}: {}", order(column));
    }
}

fn assert_figures(folder: &Folder) {
    let png = std::fs::read(folder.join("out/sine.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    let svg = std::fs::read_to_string(folder.join("out/sine.svg")).unwrap();
    for words in [
        "<svg",
        "multilevel",
        "polonsky-keer",
        "run time in s",
        "Fourier transforms",
        "relative error",
        "n = 128, 512, 2048",
        "certificate η",
    ] {
        assert!(svg.contains(words), "{words} in the figure");
    }
}

#[test]
fn rough_scenes_are_held_against_finer_grids_and_theories() {
    let [stop, reference] = [1e-10, 1e-13].map(|tolerance| Stop::new(tolerance, 100_000).unwrap());
    let (scene, sides, repeats) = (AccuracyScene::RoughLine, vec![512, 1024], NonZeroUsize::MIN);
    let experiment = Experiment { scene, sides, seed: 3, stop, reference, repeats };
    let findings = experiment.run(|_| Box::new(())).unwrap();
    assert!(
        findings.is_converged(&stop) && findings.to_string().contains("errors compared with 4096 points"),
        "{findings}"
    );
    let theories: Vec<&str> = findings.models.iter().map(|model| model.theory).collect();
    assert_eq!(theories, ["Persson", "Bush-Gibson-Thomas", "Greenwood-Williamson"]);
}

#[test]
fn a_solver_that_is_cut_short_says_so() {
    let folder = Folder::new();
    let output = folder.run("accuracy cylinder --points 64,128 --repeats 1 --seed 3 --max-iterations 100 --out out");
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    assert!(number(curve(&rows(&folder), "gfmd-uniform", "128").last().unwrap(), "eta") > 1e-10);
}

#[test]
fn what_cannot_be_is_refused_before_anything_runs() {
    let folder = Folder::new();
    std::fs::write(folder.join("file"), "").unwrap();
    let refused = [
        ("torus", "rough-surface"),
        ("sine --out missing/out", "the folder missing does not exist"),
        ("sine --out file", "--out is file"),
        ("sine --repeats 0", "'0' for '--repeats <N>': give a positive whole number"),
        ("sine --tolerance -1", "the tolerance is -1"),
        ("sine --points 512,256", "512 to 256"),
        ("sine --points 2,256", "2 points along x are too few"),
        ("rough-line --points 64", "short cut-off"),
    ];
    for (arguments, words) in refused {
        let output = folder.run(&format!("accuracy {arguments}"));
        assert_eq!(output.status.code(), Some(2), "{arguments}: {}", text(&output.stderr));
        assert!(output.stdout.is_empty(), "something ran: {}", text(&output.stdout));
        assert!(text(&output.stderr).contains(words), "{arguments}: {}", text(&output.stderr));
    }
}
