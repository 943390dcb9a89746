//! The contests of the solvers, run for real on shrunk cases.

use crate::command::{Folder, text};
use crate::rows::{Row, assert_refused, rows};

/// The rows of a bench with some arguments, which must converge.
fn bench(arguments: &str) -> Vec<Row> {
    let folder = Folder::new();
    let output = folder.run(&format!("bench --quick {arguments} --out x.csv"));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    rows(&folder, "x.csv")
}

fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} is {:?} in {row:?}", row[column]))
}

#[test]
fn work_hardly_grows_with_the_grid_at_a_fixed_spectrum() {
    let rows = bench("growth");
    assert_eq!(rows.len(), 6);
    for row in &rows {
        assert_eq!((row["group"].as_str(), row["status"].as_str()), ("growth", "converged"));
        assert!(number(row, "certificate") <= 1e-8 && number(row, "solve_seconds") > 0.0, "{row:?}");
        assert!(row["ratio"].is_empty() && row["peak_mib"].is_empty() != cfg!(target_os = "linux"), "{row:?}");
    }
    for case in ["H 0.8 p* 0.01", "H 0.2 p* 0.01"] {
        let line: Vec<&Row> = rows.iter().filter(|row| row["case"] == case && row["ny"] == "1").collect();
        assert_eq!(line.iter().map(|row| row["nx"].as_str()).collect::<Vec<_>>(), ["4096", "16384"]);
        let growth = number(line[1], "transforms") / number(line[0], "transforms");
        assert!(growth < 2.0, "{case}: {growth}");
    }
}

#[test]
fn several_solvers_are_held_against_the_first() {
    let rows = bench("peers --tolerance 1e-4 --repeats 3 --seed 2");
    let solvers: Vec<&str> = rows.iter().map(|row| row["solver"].as_str()).collect();
    assert_eq!(solvers, ["multilevel", "polonsky-keer"].repeat(2));
    for pair in rows.chunks(2) {
        let [first, second] = [0, 1].map(|i| number(&pair[i], "solve_seconds"));
        assert_eq!([0, 1].map(|i| number(&pair[i], "ratio")), [1.0, second / first]);
        assert!(pair.iter().all(|row| row["status"] == "converged"));
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
    let output = Folder::new().run("bench --quick smooth contact --solver multilevel,polonsky-keer");
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).lines().all(|line| line.len() <= 120), "{}", text(&output.stdout));
}

/// Each boundary has a series of eight loads; the larger the load, the larger the contact.
#[test]
fn time_is_drawn_against_contact() {
    let folder = Folder::new();
    let output = folder.run("bench contact --quick --out x.csv --figure x.svg");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let areas: Vec<f64> = rows(&folder, "x.csv").iter().map(|row| number(row, "relative_area")).collect();
    assert_eq!(areas.len(), 16);
    assert!(areas.chunks(8).all(|areas| areas.is_sorted() && areas[0] < 1e-3 && areas[7] > 0.4), "{areas:?}");
    let figure = std::fs::read_to_string(folder.join("x.svg")).unwrap();
    for words in ["relative contact area", "seconds in the solver", "periodic", "free"] {
        assert!(figure.contains(words), "{words}");
    }
}

/// A contact that this program does not solve has no time, and nothing is compared with it.
#[test]
fn what_is_not_converged_is_not_compared() {
    let folder = Folder::new();
    let output = folder.run("bench rivals --quick --python no-such-python --max-iterations 2 --out x.csv --threads 1");
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    for row in rows(&folder, "x.csv") {
        assert!(row["seconds"].is_empty() && row["ratio"].is_empty(), "{row:?}");
        assert!(row["code"] != "asperity" || row["skipped"].contains("after 2 iterations"), "{row:?}");
    }
}

/// Without other codes the rows of this one stand alone, and the others say why they have no numbers.
#[test]
fn codes_that_are_missing_are_skipped_with_a_sentence() {
    let folder = Folder::new();
    let output = folder.run("bench rivals --quick --python no-such-python --out x.csv --figure x.svg --threads 1");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let rows = rows(&folder, "x.csv");
    assert_eq!(rows.len(), 12 * 5);
    for (number, row) in rows.iter().enumerate() {
        assert_eq!((row["points"].as_str(), row["threads"].as_str()), ("256x256", "1"));
        if number % 5 == 0 {
            assert!(row["code"] == "asperity" && row["skipped"].is_empty(), "{row:?}");
            assert!(self::number(row, "certificate") <= 1e-8 && self::number(row, "ratio") == 1.0, "{row:?}");
        } else {
            assert!(
                row["certificate"].is_empty() && row["skipped"].contains("no-such-python cannot be run"),
                "{row:?}"
            );
        }
    }
    let codes: Vec<&str> = rows[1..5].iter().map(|row| row["code"].as_str()).collect();
    assert_eq!(codes, ["tamaas", "contact-mechanics", "aspher", "aspher-mixed"]);
    let figure = std::fs::read_to_string(folder.join("x.svg")).unwrap();
    assert!(figure.contains("periodic boundaries") && figure.contains("free boundaries"));
}

/// Histories by this code alone: their errors are told, and the other codes say why they have no numbers.
#[test]
fn histories_have_their_errors() {
    let folder = Folder::new();
    let output = folder.run("bench histories --quick --python no-such-python --out x.csv --threads 1");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let rows = rows(&folder, "x.csv");
    let others = [("tamaas", 1e-2), ("tamaas", 1e-2), ("adhesion", 1e-6), ("aspher", 1e-6)];
    assert_eq!(rows.len(), 2 * others.len());
    for (pair, (code, most)) in rows.chunks(2).zip(others) {
        assert!(self::number(&pair[0], "error") < most && self::number(&pair[0], "ratio") == 1.0, "{pair:?}");
        assert!(pair[1]["code"] == code && pair[1]["skipped"].contains("no-such-python cannot be run"), "{pair:?}");
    }
    assert_refused(&folder.run("bench histories growth"), &["histories", "alone"]);
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
    let groups = ["tiny", "smooth", "surfaces", "lines", "growth", "peers", "contact", "large", "rivals", "histories"];
    assert_refused(&folder.run("bench tiny"), &groups);
    assert_refused(&folder.run("bench --solver newton"), &["newton", "multilevel", "polonsky-keer", "gfmd"]);
    assert_refused(&folder.run("bench --quick growth --out missing/x.csv"), &["the folder missing does not exist"]);
    assert_refused(
        &folder.run("bench --quick growth --repeats 0"),
        &["'0' for '--repeats", "give a positive whole number"],
    );
    assert_refused(&folder.run("bench --quick growth --tolerance -1"), &["the tolerance is -1"]);
    assert_refused(&folder.run("bench --quick rivals growth"), &["rivals", "alone"]);
    assert_refused(&folder.run("bench --quick rivals --solver gfmd"), &["rivals", "without --solver"]);
    assert_refused(&folder.run("bench --quick growth --figure x.svg"), &["--figure", "rivals", "contact"]);
    assert_refused(&folder.run("bench --quick contact growth --figure x.svg"), &["--figure", "one of them alone"]);
    assert_refused(&folder.run("bench --quick contact --figure x.png"), &["x.png", "svg"]);
    assert_refused(&folder.run("bench --quick rivals --figure x.png"), &["x.png", "svg"]);
}
