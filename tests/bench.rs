//! The contests of the solvers, run for real on shrunk cases.

mod command;
mod rows;

use asperity::Stop;
use asperity::contact::Status;
use asperity::lab::bench::{Contest, Group, Timing};
use asperity::setup::Method;
use command::{Folder, text};
use rows::{assert_refused, rows};
use std::num::NonZeroUsize;

/// All timings of a shrunk group.
fn timings(group: Group, methods: &[Method], stop: Stop, repeats: usize, seed: u64) -> Vec<Timing> {
    let repeats = NonZeroUsize::new(repeats).unwrap();
    let contests = group.contests(true, seed);
    let timings = |contest: &Contest| -> Vec<Timing> {
        contest.timings(methods, stop, repeats, &mut |_| Box::new(())).map(Result::unwrap).collect()
    };
    contests.iter().flat_map(timings).collect()
}

#[test]
fn work_hardly_grows_with_the_grid_at_a_fixed_spectrum() {
    let timings = timings(Group::Growth, Group::Growth.methods(), Stop::default(), 1, 1);
    assert_eq!(timings.len(), 6);
    for timing in &timings {
        assert_eq!((timing.group, timing.status), (Group::Growth, Status::Converged));
        assert!(timing.certificate <= 1e-8 && timing.solve_seconds > 0.0, "{timing:?}");
        assert!(timing.ratio.is_none() && timing.peak_mib.is_some() == cfg!(target_os = "linux"), "{timing:?}");
    }
    for case in ["H 0.8 p* 0.01", "H 0.2 p* 0.01"] {
        let line: Vec<&Timing> = timings.iter().filter(|timing| timing.case == case && timing.ny == 1).collect();
        assert_eq!(line.iter().map(|timing| timing.nx).collect::<Vec<_>>(), [4096, 16384]);
        let growth = line[1].transforms as f64 / line[0].transforms as f64;
        assert!(growth < 2.0, "{case}: {growth}");
    }
}

#[test]
fn several_solvers_are_held_against_the_first() {
    let timings = timings(Group::Peers, Group::Peers.methods(), Stop::new(1e-4, 100_000).unwrap(), 3, 2);
    let solvers: Vec<&str> = timings.iter().map(|timing| timing.solver.as_str()).collect();
    assert_eq!(solvers, ["multilevel", "polonsky-keer"].repeat(2));
    for pair in timings.chunks(2) {
        let ratio = pair[1].solve_seconds / pair[0].solve_seconds;
        assert_eq!((pair[0].ratio, pair[1].ratio), (Some(1.0), Some(ratio)));
        assert!(pair.iter().all(|timing| timing.status == Status::Converged));
    }
}

#[test]
fn a_run_that_does_not_converge_says_so_and_the_others_follow() {
    let folder = Folder::new();
    let output =
        folder.run("bench --quick lines --solver polonsky-keer --max-iterations 3 --repeats 2 --seed 2 --out x.csv");
    assert_eq!(output.status.code(), Some(3));
    assert_eq!(text(&output.stdout).matches("iteration cap").count(), 9);
    let rows = rows(&folder, "x.csv");
    assert_eq!(rows.len(), 9);
    assert!(rows.iter().all(|row| row["status"] == "iteration-cap" && row["iterations"] == "3"), "{rows:?}");
}

#[test]
fn rows_fit_in_120_columns() {
    let output = Folder::new().run("bench --quick smooth --solver multilevel,polonsky-keer");
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).lines().all(|line| line.len() <= 120), "{}", text(&output.stdout));
}

#[test]
fn cases_are_listed_and_not_run() {
    let output = Folder::new().run("bench --list");
    let out = text(&output.stdout);
    assert!(output.status.success() && output.stderr.is_empty());
    for words in ["smooth: ", "fourth power", "2048x2048", "262144", "H 0.2 p* 0.001", "multilevel, polonsky-keer"] {
        assert!(out.contains(words), "{words} in {out}");
    }
    assert!(!out.contains("16384x16384") && !out.contains("converged"), "{out}");
}

#[test]
fn what_cannot_be_is_refused_before_anything_runs() {
    let folder = Folder::new();
    let groups = ["tiny", "smooth", "surfaces", "lines", "growth", "peers", "large"];
    assert_refused(&folder.run("bench tiny"), &groups);
    assert_refused(&folder.run("bench --solver newton"), &["newton", "multilevel", "polonsky-keer", "gfmd"]);
    assert_refused(&folder.run("bench --quick growth --out missing/x.csv"), &["there is no folder missing"]);
    assert_refused(
        &folder.run("bench --quick growth --repeats 0"),
        &["'0' for '--repeats", "give a positive whole number"],
    );
    assert_refused(&folder.run("bench --quick growth --tolerance -1"), &["the tolerance is -1"]);
}
