//! Studies at the command line: on one machine, as a job array, killed and gone on with, and one row of them recorded.

use super::*;
use std::path::Path;
use std::process::{Command as Process, Stdio};
use std::time::{Duration, Instant};

const STUDY: &str = r#"
surface = { spectrum = { hurst = [0.3, 0.8], rolloff-wavelength = 0.125, short-cutoff = 0.004, rms-gradient = 0.1 }, seed = "1-3" }
grid = { points = [[1024], [2048]], size = 1.0 }
load = { reduced-pressure = [0.01, 0.1] }
"#;

fn folder_with(study: &str) -> Folder {
    let folder = Folder::new();
    std::fs::write(folder.join("study.toml"), study).unwrap();
    folder
}

fn bytes(folder: &Folder, name: &str) -> Vec<u8> {
    std::fs::read(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Runs a line that must do well.
fn done(folder: &Folder, line: &str) -> Output {
    let output = folder.run(line);
    assert!(output.status.success(), "{line}: {}", text(&output.stderr));
    output
}

/// A contact of too few nodes has no mean: what is not resolved is left out of it, and counted.
#[test]
fn what_is_not_resolved_is_no_zero() {
    let folder = folder_with(
        r#"
surface = { spectrum = { hurst = 0.8, rolloff-wavelength = 0.125, short-cutoff = 0.02, rms-gradient = 0.1 }, seed = "1-4" }
grid = { points = 256, size = 1.0 }
load = { reduced-pressure = [1e-5, 0.1] }
"#,
    );
    let output = done(&folder, "study study.toml");
    let lines: Vec<Vec<&str>> = text(&output.stdout).lines().map(|line| line.split_whitespace().collect()).collect();
    let of_load = |load: &str| lines.iter().find(|words| words.first() == Some(&load)).unwrap()[1..].to_vec();
    assert_eq!(of_load("1.0000e-5"), ["-", "-", "-", "-", "0", "-", "-", "-", "-", "0"]);
    let rough: Vec<f64> = of_load("1.0000e-1").iter().map(|word| word.parse().unwrap()).collect();
    assert!((rough[0] - 0.22).abs() < 0.01 && (rough[5] - 1.66).abs() < 0.05 && rough[6] > 0.0, "{rough:?}");
    let warned = text(&output.stderr);
    assert!(warned.contains("warning: 4 of 8 rows are not resolved"), "{warned}");
}

/// Paths in lists give a row each, with the last state of a solve along that path. A contact that is apart at the end of its path is no
/// contact of too few nodes.
#[test]
fn paths_in_lists_are_rows() {
    let scene = |times: &str, loads: &str| {
        format!(
            "surface = {{ indenter = {{ shape = \"cylinder\", radius = 1.0 }} }}\ngrid = {{ points = 256, size = 1.0 }}\n\
             load = {{ reduced-pressure = 1e-3 }}\nviscoelastic = {{ relaxation = [0.5, 1.0] }}\n\
             path = {{ time = {times}, load = {loads} }}\n"
        )
    };
    let folder = folder_with(&scene("[[0.0, 1.0], [0.0, 4.0]]", "[[2e-3, 1e-3], [1e-3, 0.0]]"));
    let output = done(&folder, "study study.toml");
    assert!(!text(&output.stderr).contains("not resolved"), "{}", text(&output.stderr));
    let found = rows(&folder.join("study.csv"));
    let alone = [("[0.0, 1.0]", "[2e-3, 1e-3]"), ("[0.0, 1.0]", "[1e-3, 0.0]"), ("[0.0, 4.0]", "[2e-3, 1e-3]")];
    assert_eq!(found.len(), 4);
    for (row, (times, loads)) in found.iter().zip(alone) {
        std::fs::write(folder.join("alone.toml"), scene(times, loads)).unwrap();
        let solved: Value = serde_json::from_slice(&done(&folder, "solve alone.toml --json").stdout).unwrap();
        let states = solved["states"].as_array().unwrap();
        let area = states.last().unwrap()["relative_area"].as_f64().unwrap();
        assert_eq!(row["relative_area"].parse::<f64>().unwrap(), area, "{times} {loads}");
        assert_eq!(row["states"], states.len().to_string());
    }
    assert!(found[0]["relative_area"] != found[2]["relative_area"] && found[1]["relative_area"] == "0.0");
}

/// The sentence of a line that must be refused.
fn refused(folder: &Folder, line: &str) -> String {
    let output = folder.run(line);
    let said = text(&output.stderr).to_owned();
    assert_eq!(output.status.code(), Some(2), "{line}: {said}");
    assert!(said.starts_with("error: ") && said.trim_end().lines().count() == 1, "{said}");
    said
}

/// A row that fails while it is solved is named by its number and its values, of a share as well.
#[test]
fn a_row_that_fails_is_named() {
    let folder = folder_with(
        r#"
surface = { indenter = { shape = "sphere", radius = [1.0, 2.0] } }
grid = { points = [64, 64], size = 4.0 }
solid = { contact-modulus = 1.0 }
law = { hardness = [1.0, 0.03] }
load = { mean-pressure = [0.01, 0.02, 0.05] }
"#,
    );
    for (line, row) in [
        ("--workers 1", "row 6 (radius 1.0, hardness 0.03, p = 0.05)"),
        ("--json --out other.csv --workers 1", "row 6 (radius 1.0, hardness 0.03, p = 0.05)"),
        ("--shard 2/2 --workers 1", "row 6 (radius 1.0, hardness 0.03, p = 0.05)"),
    ] {
        let output = folder.run(&format!("study study.toml {line}"));
        let said = text(&output.stderr);
        assert_eq!((output.status.code(), text(&output.stdout)), (Some(2), ""), "{said}");
        let error = format!("error: {row}: a mean pressure of 0.05 is above the hardness of 0.03");
        assert!(said.lines().last().unwrap().starts_with(&error), "{said}");
    }
}

/// Values from the lists of a study are drawn to the right as well: a curve for each load, a dot for each value, the mean over the seeds.
#[test]
fn a_list_of_a_study_is_an_axis() {
    let folder = folder_with(&STUDY.replace("[[1024], [2048]]", "[1024]").replace("[0.3, 0.8]", "[0.3, 0.5, 0.8]"));
    done(&folder, "study study.toml");
    for x in ["hurst", "surface.spectrum.hurst"] {
        done(&folder, &format!("plot study.csv --x {x} --y relative_area --out hurst.svg"));
        let svg = String::from_utf8(bytes(&folder, "hurst.svg")).unwrap();
        let filled = |colour: &str| svg.matches(&format!("fill=\"{colour}\" fill-opacity=\"1\"")).count();
        // three values and the legend, for each of two loads
        assert_eq!(["#0072b2", "#d55e00", "#009e73"].map(filled), [4, 4, 0]);
        for words in [">hurst</text>", ">reduced pressure 0.01</text>", ">reduced pressure 0.1</text>"] {
            assert!(svg.contains(words), "{words}: {svg}");
        }
    }
    let unknown = refused(&folder, "plot study.csv --x roundness --out no.svg");
    assert!(unknown.contains("it has no roundness: give another quantity, or a value from the lists"), "{unknown}");
}

/// The rows of a table by the names of the columns.
fn rows(path: &Path) -> Vec<std::collections::HashMap<String, String>> {
    csv::Reader::from_path(path).unwrap().into_deserialize().map(Result::unwrap).collect()
}

#[test]
fn a_study_is_a_table_a_figure_and_the_setup_of_each_row() {
    let folder = folder_with(STUDY);
    let output = done(&folder, "study study.toml");
    assert!(
        text(&output.stdout).starts_with("24 rows, means over 3 seeds: with standard deviation (std)"),
        "{}",
        text(&output.stdout)
    );
    let table = rows(&folder.join("study.csv"));
    assert_eq!(table.len(), 24);
    for name in ["study.parquet", "study.svg", "study.png"] {
        assert!(bytes(&folder, name).len() > 1000, "{name}");
    }
    assert!(bytes(&folder, "study.parquet").starts_with(b"PAR1") && bytes(&folder, "study.parquet").ends_with(b"PAR1"));
    // a row is what the scene in it gives, solved from nothing: to the certificate, not to the bit
    let row = &table[16];
    assert_eq!(
        [&row["row"], &row["surface.spectrum.hurst"], &row["surface.seed"], &row["grid.points"]],
        ["17", "0.8", "3", "1024"]
    );
    assert!(!row["scene"].contains('\n'), "{}", row["scene"]);
    std::fs::write(folder.join("row.toml"), &row["scene"]).unwrap();
    let (alone, _) = solve(&folder, "row.toml");
    assert_close(number(&alone, "kappa_r"), row["kappa_r"].parse().unwrap(), 1e-9, "kappa_r of row 17");
    assert_close(number(&alone, "reduced_pressure"), row["load.reduced-pressure"].parse().unwrap(), 1e-12, "its load");
}

#[test]
fn shares_of_a_job_array_are_the_whole_to_the_last_bit() {
    let folder = folder_with(STUDY);
    done(&folder, "study study.toml --out whole.csv --workers 3 --memory 1GB");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/study.slurm");
    let program = Path::new(env!("CARGO_BIN_EXE_asperity")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let shares: Vec<String> = (1..=5).map(|share| format!("study.{share}-of-5.csv")).collect();
    for share in (1..=5).rev() {
        let mut bash = Command::new("bash");
        bash.arg(&script).arg("study.toml").env("PATH", &path).env("SLURM_ARRAY_TASK_COUNT", "5");
        let output =
            folder.finish(bash.env("SLURM_ARRAY_TASK_ID", share.to_string()).env("SLURM_MEM_PER_NODE", "2048"));
        let is_told = text(&output.stderr).lines().all(|line| line.starts_with("warning: The grid is too coarse for "));
        assert!(output.status.success() && is_told, "{}", text(&output.stderr));
    }
    let mut count: Vec<usize> = shares.iter().map(|share| rows(&folder.join(share)).len()).collect();
    count.sort_unstable();
    assert_eq!(count, [4, 4, 4, 6, 6]);
    done(&folder, &format!("merge study.toml {}", shares.join(" ")));
    assert!(bytes(&folder, "study.csv") == bytes(&folder, "whole.csv"));
    assert!(bytes(&folder, "study.parquet") == bytes(&folder, "whole.parquet"));
    let before = std::fs::metadata(folder.join("study.csv")).unwrap().len();
    assert!(done(&folder, "study study.toml").status.success() && before > 0);
    // what is missing, twice there or of another study
    let missing = refused(&folder, &format!("merge study.toml {} --out no.csv", shares[1..].join(" ")));
    assert!(missing.contains(" of 24 rows are missing in the tables, or were changed "), "{missing}");
    let named = |said: &str| said.split_once("row ").unwrap().1.split_once(')').unwrap().0.to_owned();
    let table = rows(&folder.join("study.csv"));
    let row = |number: &str| table.iter().find(|row| row["row"] == number).unwrap();
    for said in [&missing, &refused(&folder, &format!("merge study.toml {0} {0} --out no.csv", shares[0]))] {
        let named = named(said);
        let (number, values) = named.split_once(" (").unwrap();
        let [hurst, seed, points] =
            ["surface.spectrum.hurst", "surface.seed", "grid.points"].map(|name| &row(number)[name]);
        assert_eq!(values, format!("hurst {hurst}, points {points}, seed {seed}"), "{said}");
    }
    let share = std::fs::read_to_string(folder.join(&shares[2])).unwrap();
    let number = share.lines().nth(1).unwrap().split(',').find(|field| field.starts_with("0.")).unwrap();
    std::fs::write(folder.join("edited.csv"), share.replacen(number, "0.25", 1)).unwrap();
    let others = [0, 1, 3, 4].map(|i| shares[i].as_str()).join(" ");
    let edited = refused(&folder, &format!("merge study.toml {others} edited.csv --out no.csv"));
    assert!(edited.contains("edited.csv is damaged: row 1 fails its check sum: solve this share again"), "{edited}");
    std::fs::write(folder.join("other.csv"), "a,b\n1,2\n").unwrap();
    let other = refused(&folder, &format!("merge study.toml {others} other.csv --out no.csv"));
    assert!(other.contains("other.csv is not a valid study file: it is not the table of a share"), "{other}");
    let twice = refused(&folder, &format!("merge study.toml {} study.csv --out no.csv", shares.join(" ")));
    assert!(twice.contains(" is in study.") && twice.contains(" and also in study.csv: give"), "{twice}");
    std::fs::write(folder.join("other.toml"), STUDY.replace("0.8", "0.7")).unwrap();
    let foreign = refused(&folder, &format!("merge other.toml {} --out no.csv", shares.join(" ")));
    assert!(foreign.contains("rows of another study, or of another version: solve this share again"), "{foreign}");
    let own = refused(&folder, "merge study.toml study.1-of-5.csv --out study.1-of-5.csv");
    assert!(own.contains("study.1-of-5.csv: it is also an input file"), "{own}");
    let absent = refused(&folder, "merge study.toml study.9-of-9.csv --out no.csv");
    assert!(absent.contains("there is no table study.9-of-9.csv"), "{absent}");
    assert!(!folder.join("no.csv").exists());
}

#[test]
fn a_study_that_was_killed_goes_on_where_it_was() {
    let study = STUDY.replace("1-3", "1-40").replace("[[1024], [2048]]", "8192");
    let folder = folder_with(&study);
    let mut child = Process::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["study", "study.toml", "--threads", "2"])
        .current_dir(folder.join(""))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    let unfinished = folder.join("study.unfinished");
    let lines = || std::fs::read_to_string(&unfinished).map_or(0, |text| text.lines().count());
    while lines() < 12 {
        assert!(begun.elapsed() < Duration::from_secs(60) && child.try_wait().unwrap().is_none());
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = lines();
    assert!((12..160).contains(&kept) && !folder.join("study.csv").exists());
    let before = std::fs::read_to_string(&unfinished).unwrap();
    done(&folder, "study study.toml");
    done(&folder, "study study.toml --out whole.csv");
    assert!(bytes(&folder, "study.csv") == bytes(&folder, "whole.csv") && !unfinished.exists());
    // the seconds of what was there before are those of then
    let seconds = std::fs::read_to_string(folder.join("study.seconds.csv")).unwrap();
    let first = before.lines().nth(1).unwrap().rsplit(',').nth(1).unwrap();
    assert!(seconds.lines().any(|line| line.ends_with(first)), "{first}");
}

#[test]
fn wrong_studies_are_refused_with_line_and_value() {
    let wrong = |from: &str, to: &str| {
        assert!(STUDY.contains(from));
        let folder = folder_with(&STUDY.replace(from, to));
        let said = refused(&folder, "study study.toml");
        assert!(!folder.join("study.csv").exists());
        said
    };
    let cases = [
        ("\"1-3\"", "\"9-3\"", "study.toml: line 2, surface.seed: `9-3` is not a range: give the first and the last"),
        ("\"1-3\"", "[1, \"2-x\"]", "line 2, surface.seed: `2-x` is not a range"),
        ("\"1-3\"", "[4, \"2-6\"]", "line 2, surface.seed: 4 occurs twice"),
        ("\"1-3\"", "[]", "line 2, surface.seed: the list is empty"),
        ("\"1-3\"", "\"1-1000000000000\"", "the lists make 8000000000000 rows, and a study has at most 10000000"),
        ("\"1-3\"", "\"0-18446744073709551615\"", " rows, and a study has at most 10000000"),
        ("[0.3, 0.8]", "[0.3, 1.8]", "row 13 (hurst 1.8, points 1024, seed 1): the Hurst exponent is 1.8"),
        ("[0.3, 0.8]", "[0.3, \"rough\"]", "line 2, surface.spectrum.hurst: invalid type: text \"rough\""),
        ("[0.01, 0.1]", "[0.01, -0.1]", "reduced pressure is -0.1"),
        ("[0.01, 0.1]", "\"1e-3..1e-1:4000000000\"", "line 4, load: `1e-3..1e-1:4000000000` has too many values"),
        ("size = 1.0", "size = 1.0, pionts = [1, 2]", "grid: unknown key `pionts`"),
        ("[[1024], [2048]]", "[[1024], [2]]", "2 points along x are too few"),
        (
            "load =",
            "record.theme = [\"dark\", \"light\"]\nload =",
            "line 4, record.theme: it does not change the numbers of a study",
        ),
    ];
    for (from, to, expected) in cases {
        let said = wrong(from, to);
        assert!(said.contains(expected), "{to}: {said}");
    }
    let folder = folder_with(STUDY);
    for (flags, expected) in [
        ("--shard 0/4", "is not a share: give its number and the number of shares"),
        ("--shard 5/4", "is not a share"),
        ("--memory 3XB", "give a positive number with kB, MB, GB or TB"),
        ("--memory 1kB", "of memory, but the limit is 1.0 kB"),
        ("--out study.npz", "study.npz"),
    ] {
        let output = folder.run(&format!("study study.toml {flags}"));
        assert_eq!(output.status.code(), Some(2), "{flags}");
        assert!(text(&output.stderr).contains(expected), "{flags}: {}", text(&output.stderr));
    }
    let solved = refused(&folder, "solve study.toml");
    assert!(
        solved.contains("`surface.spectrum.hurst` has 2 values") && solved.contains("`asperity study`"),
        "{solved}"
    );
    let bodies = STUDY.replace("load =", "solid = { young = ['210 GPa', '70 GPa'], poisson = 0.3 }\nload =");
    std::fs::write(folder.join("bodies.toml"), &bodies).unwrap();
    let said = refused(&folder, "study bodies.toml --dry-run");
    assert!(said.contains("a study that varies one body takes lists of lists"), "{said}");
    let varied = bodies.replace("['210 GPa', '70 GPa']", "[['210 GPa'], ['70 GPa']]");
    std::fs::write(folder.join("bodies.toml"), varied).unwrap();
    let said = folder.run("study bodies.toml --dry-run");
    assert!(text(&said.stdout).contains("rows          48 of 48"), "{}{}", text(&said.stdout), text(&said.stderr));
    std::fs::write(folder.join("study.csv"), "a,b\n1,2\n").unwrap();
    for line in ["study study.toml", "study study.toml --fresh"] {
        assert!(refused(&folder, line).contains("it is not a table of a study"));
        assert_eq!(bytes(&folder, "study.csv"), b"a,b\n1,2\n");
    }
}

#[test]
fn a_dry_run_says_what_each_choice_takes_largest_first() {
    let folder = folder_with(STUDY);
    let output = done(&folder, "study study.toml --dry-run --shard 1/2 --workers 2 --memory 1GB");
    let said = text(&output.stdout);
    assert!(said.contains("rows          12 of 24") && said.contains("realisations  6 of 12"), "{said}");
    let (first, last) = (said.find("points 2048").unwrap(), said.rfind("points 1024").unwrap());
    assert!(first < last, "{said}");
    assert_eq!(std::fs::read_dir(folder.join("")).unwrap().count(), 1);
}

#[cfg(feature = "record")]
#[test]
fn a_row_is_recorded_as_the_study_solved_it() {
    let folder = folder_with(STUDY);
    done(&folder, "study study.toml --record-row 14 --record row.rrd");
    let carried = done(&folder, "solve --setup-of row.rrd --dry-run --save-setup x.toml");
    assert!(text(&carried.stdout).contains("points      1024"));
    assert!(!folder.join("study.csv").exists());
    let none = refused(&folder, "study study.toml --record-row 25 --record no.rrd");
    assert!(none.contains("there is no row 25: give a number from 1 to 24"), "{none}");
}

/// Rows on a grid that is too coarse.
const COARSE: &str = r#"
surface = { spectrum = { hurst = 0.8, rolloff-wavelength = 0.25, short-cutoff = 0.05, rms-gradient = 0.1 }, seed = "1-3" }
grid = { points = [[48, 48]], size = 1.0 }
load = { reduced-pressure = [0.001, 0.01] }
"#;

/// Whole studies, shares and what is merged warn alike, and the means have the error of their grid.
#[test]
fn rows_on_a_coarse_grid_are_told_with_their_errors() {
    let folder = folder_with(COARSE);
    let output = done(&folder, "study study.toml --json");
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let table = rows(&folder.join("study.csv"));
    let of = |row: &std::collections::HashMap<String, String>, name: &str| row[name].parse::<f64>().unwrap();
    let is_large = |error: f64| error.is_nan() || error > 0.1;
    let coarse = table.iter().filter(|row| of(row, "kappa_r") > 0.0 && is_large(of(row, "kappa_r_error"))).count();
    assert!(coarse > 0);
    let sentence = format!("The grid is too coarse for {coarse} of 6 rows: their kappa_r may be off by more than 10 %");
    let told = warnings::warnings(&output);
    assert!(told.iter().any(|it| it.starts_with(&sentence)), "{told:?}");
    assert_eq!(found["warnings"], serde_json::json!(told));
    assert_eq!((&found["rows"], &found["converged"]), (&Value::from(6), &Value::from(6)));
    // the means are those of the table: of what is resolved, with the absolute error of the grid
    for (load, mean) in found["means"].as_array().unwrap().iter().enumerate() {
        let kappa_r = &mean["kappa_r"];
        let used: Vec<[f64; 2]> = table
            .iter()
            .filter(|row| of(row, "load_number") == load as f64 + 1.0)
            .map(|row| [of(row, "kappa_r"), of(row, "kappa_r_error")])
            .filter(|[kappa_r, error]| *kappa_r > 0.0 && *error < 1.0)
            .collect();
        let count = used.len() as f64;
        assert_eq!(kappa_r["count"], used.len());
        if used.len() > 1 {
            let average = used.iter().map(|it| it[0]).sum::<f64>() / count;
            let deviation = (used.iter().map(|it| (it[0] - average).powi(2)).sum::<f64>() / (count - 1.0)).sqrt();
            let grid = used.iter().map(|it| it[0] * it[1]).sum::<f64>() / count;
            assert_close(number(kappa_r, "mean"), average, 1e-12, "mean");
            assert_close(number(kappa_r, "standard_deviation"), deviation, 1e-9, "deviation");
            assert_close(number(kappa_r, "standard_error"), deviation / count.sqrt(), 1e-9, "error");
            assert_close(number(kappa_r, "grid_error"), grid, 1e-12, "grid");
        }
    }
    // what the bars of the figure are
    let figure = String::from_utf8(bytes(&folder, "study.svg")).unwrap();
    assert!(figure.contains("bars of standard deviation plus error of the grid"), "{figure}");
    // shares and what is merged
    for share in 1..=2 {
        let output = done(&folder, &format!("study study.toml --shard {share}/2"));
        assert!(text(&output.stderr).contains("warning: The grid is too coarse for "), "{}", text(&output.stderr));
    }
    std::fs::remove_file(folder.join("study.csv")).unwrap();
    let shares = "study.toml study.1-of-2.csv study.2-of-2.csv";
    assert_eq!(warnings::warnings(&done(&folder, &format!("merge {shares}"))), told);
    // warnings as errors: everything is written
    for line in
        ["study study.toml --strict --out strict.csv".to_owned(), format!("merge {shares} --strict --out strict.csv")]
    {
        let strict = refused(&folder, &format!("{line} --quiet"));
        assert!(strict.contains(&sentence), "{strict}");
        std::fs::remove_file(folder.join("strict.csv")).unwrap();
    }
    // a fine grid is silent
    let folder = folder_with(&COARSE.replace("[[48, 48]]", "4096").replace("0.001, 0.01", "0.05, 0.1"));
    assert_eq!(warnings::warnings(&done(&folder, "study study.toml --strict")), [""; 0]);
}

/// The largest pressure and the slope of the roughest rows.
#[test]
fn rows_of_solids_that_would_yield_are_told() {
    let steep = STUDY.replace("rms-gradient = 0.1", "rms-gradient = [0.1, 3.0]");
    let told = done(&folder_with(&steep), "study study.toml").stderr;
    assert!(text(&told).contains("Nearly all solids yield at lower pressures"), "{}", text(&told));
    assert!(text(&told).contains("The rms slope of the contact is "), "{}", text(&told));
    let told = done(&folder_with(STUDY), "study study.toml").stderr;
    assert!(!text(&told).contains("yield") && !text(&told).contains("slope"), "{}", text(&told));
}
