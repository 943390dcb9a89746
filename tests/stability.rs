//! `asperity stability`, run for real on small cases.

mod command;
mod rows;

use command::{Folder, text};
use rows::{assert_refused, rows};
use std::collections::BTreeSet;

#[test]
fn every_case_ends_as_it_must() {
    let folder = Folder::new();
    let output = folder.run("stability --quick --out x.csv");
    let out = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{out}{}", text(&output.stderr));
    assert!(!out.contains("WRONG") && out.contains(" 0 wrong"), "{out}");
    let rows = rows(&folder, "x.csv");
    assert!(rows.iter().filter(|row| row["solver"] == "multilevel").all(|row| row["as_demanded"] == "true"), "{out}");
    let listed = folder.run("stability --quick --list");
    let listed: BTreeSet<&str> = text(&listed.stdout).lines().filter_map(|line| line.split(' ').next()).collect();
    assert!(listed.len() > 100);
    assert_eq!(rows.iter().map(|row| row["case"].as_str()).collect::<BTreeSet<_>>(), listed);
}

#[test]
fn cases_and_solvers_can_be_chosen() {
    let folder = Folder::new();
    let output = folder.run("stability spike tolerance-NaN --quick --solver polonsky-keer --out x.csv");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stdout));
    let rows = rows(&folder, "x.csv");
    assert!(rows.iter().all(|row| row["solver"] == "polonsky-keer"));
    let verdicts: BTreeSet<&str> = rows.iter().map(|row| row["verdict"].as_str()).collect();
    assert_eq!(verdicts, ["converged", "refused"].into());
    assert!(rows.iter().all(|row| (row["verdict"] == "refused") == row["eta"].is_empty()), "{rows:?}");
}

#[test]
fn a_budget_that_runs_out_is_no_convergence() {
    let folder = Folder::new();
    let output = folder.run("stability stiff --quick --solver multilevel,gfmd-uniform --budget 1e-6 --out x.csv");
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stdout).contains("not stable: 0 runs are wrong"), "{}", text(&output.stdout));
    assert!(rows(&folder, "x.csv").iter().all(|row| row["verdict"] == "not-converged"));
}

#[test]
fn what_cannot_be_is_refused_before_anything_runs() {
    let folder = Folder::new();
    assert_refused(&folder.run("stability --quick spike spyke"), &["spyke", "--list"]);
    assert_refused(&folder.run("stability --quick --solver newton"), &["newton", "gfmd-uniform"]);
    assert_refused(&folder.run("stability --quick --out missing/x.csv"), &["there is no folder missing"]);
    for budget in ["0", "-1", "NaN", "inf"] {
        assert_refused(&folder.run(&format!("stability --quick --budget {budget}")), &["--budget"]);
    }
}
