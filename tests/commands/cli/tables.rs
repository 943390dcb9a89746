//! Tables of paths, spectra and attractions: what is read, and what the sentence about the rest names.

use crate::command::{Folder, text};
use serde_json::Value;

const ROUGH: &str = "solve --hurst 0.8 --rolloff 0.125 --short-cutoff 0.04 --rms-gradient 0.1 --points 64 --size 1 --reduced-pressure 0.05";
const SPECTRUM: &str = "surface --points 256 --size 6.283 --spectrum t.csv";
const STICKY: &str = "solve --indenter sine --amplitude 1um --points 64 --size 10um --modulus 1MPa --mean-gap 1um --adhesion-table t.csv";

fn output(folder: &Folder, table: &str, line: &str) -> std::process::Output {
    std::fs::write(folder.join("t.csv"), table).unwrap();
    folder.run(line)
}

fn found(folder: &Folder, table: &str, line: &str) -> Value {
    let output = output(folder, table, &format!("{line} --json"));
    assert!(output.status.success(), "{table}: {}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The sentence about a table that cannot be read.
fn refused(folder: &Folder, table: &str, line: &str) -> String {
    let output = output(folder, table, line);
    let error = text(&output.stderr).trim().to_owned();
    assert_eq!(output.status.code(), Some(2), "{table}: {error}");
    assert_eq!(error.lines().count(), 1, "{table}: {error}");
    error
}

#[test]
fn separators_and_decimal_commas_are_read_where_they_are_clear() {
    let folder = Folder::new();
    let line = format!("{ROUGH} --creep 9,1 --path t.csv --path-steps 1");
    let states = |table: &str| found(&folder, table, &line)["states"].clone();
    let plain = states("time,load\n0,0.02\n0.5,0.05\n");
    for table in [
        "time;load\n0;0,02\n0,5;0,05\n",
        "time\tload\n0\t0,02\n0,5\t0,05\n",
        "\u{feff}# pressed\ntime ; load\n0 ; 0.02\n500 ms ; 0.05\n",
        "Time;Load\r\n0;0,02\r\n\r\n5e-1;5e-2\r\n",
    ] {
        assert_eq!(states(table), plain, "{table}");
    }
    let attracted = |table: &str| found(&folder, table, STICKY)["adhesion"]["work"].as_f64().unwrap();
    let plain = attracted("gap,traction\n0,1000\n100nm,0\n");
    assert!((plain / 5e-5 - 1.0).abs() < 1e-12);
    assert!((attracted("gap;traction\n0,0;1,0kPa\n0,1um;0\n") / plain - 1.0).abs() < 1e-12);
    let height = |table: &str| found(&folder, table, SPECTRUM)["rms_height"].clone();
    let plain = height("1 0.5\n10 5e-4\n");
    for table in ["q;C\n1,0;0,5\n10;5e-4\n", "1\t0,5\n10\t0,0005\n", "1 0.5 # first\n10 5e-4\n"] {
        assert_eq!(height(table), plain, "{table}");
    }
}

#[test]
fn the_sentence_names_file_row_and_word() {
    let folder = Folder::new();
    let path = format!("{ROUGH} --creep 9,1 --path t.csv --path-steps 1");
    for (line, table, words) in [
        (path.as_str(), "time,load\n0,0,02\n1,0,05\n", &["row 2", "`0`, `0`, `02`", "semicolons"][..]),
        (&path, "time,load\n0;0.02\n", &["row 2", "`0;0.02`"]),
        (&path, "time;load\n0;0,02\n1;nan\n", &["row 3", "`nan`", "load"]),
        (&path, "time,load\n0,inf\n", &["row 2", "`inf`"]),
        (&path, "# a\ntime,load\n0,0.02\n2,0.05\n1,0.05\n", &["row 5", "the time 1 comes after 2"]),
        (&path, "time,load\n0,0.02\n1,soft\n", &["row 3", "`soft`"]),
        (&path, "time,load\n0,0\n1,3 kPa\n", &["row 3", "`3 kPa`", "reduced pressure"]),
        (&path, "time,load\n0,0.02\n1,3 kPa\n", &["row 2", "`0.02`", "3 kPa", "a unit in every row, or in none"]),
        (&path, "time,load\n0,0.02\n1 mm,0.05\n", &["row 3", "`1 mm`", "time"]),
        (&path, "time,load\n0,0.02\n,0.05\n", &["row 3", "no word in the column time"]),
        (&path, "time;load\n0;1.000,5\n", &["row 2", "`1.000,5`"]),
        (STICKY, "gap,traction\n0,1000\n1e-7,much\n", &["row 3", "`much`"]),
        (STICKY, "gap,traction\n0,1000\nNaN,0\n", &["row 3", "`NaN`"]),
        (STICKY, "gap,traction\n0,1000\n2e-7,500\n1e-7,0\n", &["row 4", "1e-7", "2e-7"]),
        (STICKY, "gap,traction\n0,1000\n1e-7,2000\n", &["row 3", "2000"]),
        (STICKY, "gap,traction\n1e-9,1000\n1e-7,0\n", &["row 2", "first gap"]),
        (SPECTRUM, "1 0.5\n10 nan\n", &["row 2", "NaN"]),
        (SPECTRUM, "# q, C\n1,0.5\n10,x\n", &["row 3", "`x`"]),
        (SPECTRUM, "10 0.5\n1 5e-4\n", &["row 2", "1.0", "10.0"]),
        (SPECTRUM, "1 0.5 7\n10 5e-4 7\n", &["row 1", "third word, `7`"]),
        (SPECTRUM, "1,0,5\n10,0,0005\n", &["row 1", "third word, `5`", "decimal points"]),
        (SPECTRUM, "1 0.5\n10 -5e-4\n", &["row 2", "-0.0005"]),
        (SPECTRUM, "1 0.5\nten 5e-4\n", &["row 2", "`ten`"]),
    ] {
        let error = refused(&folder, table, line);
        assert!(error.contains("t.csv"), "{table}: {error}");
        assert!(words.iter().all(|word| error.contains(word)), "{table}: {error}");
    }
}

#[test]
fn ranges_in_paths_have_equal_ratios() {
    let folder = Folder::new();
    let states = |path: &str| {
        let output = folder.run(&format!("{ROUGH} --creep 9,1 {path} --path-steps 1 --json"));
        assert!(output.status.success(), "{path}: {}", text(&output.stderr));
        serde_json::from_slice::<Value>(&output.stdout).unwrap()["states"].clone()
    };
    let range = states("--path-time 0,1e-3..1e-1:3 --path-load 0.01,0.02..0.08:3");
    assert_eq!(range, states("--path-time 0,1e-3,1e-2,1e-1 --path-load 0.01,0.02,0.04,0.08"));
    let timed = folder.run(&format!("{ROUGH} --creep 9,1s --path-time 1ms..4s:3 --path-steps 1"));
    assert!(timed.status.success(), "{}", text(&timed.stderr));
    let wheel = "solve --indenter cylinder --radius 1 --points 64 --size 0.5 --boundary free --modulus 1 --force 0.01 --friction 0.3";
    for (line, sentence) in [
        (format!("{ROUGH} --creep 9,1 --path-time 0..1:3"), "lead from 0 to 1: give ends of one sign that are not 0"),
        (format!("{wheel} --path-tangential -1e-3..1e-3:3"), "give ends of one sign"),
        (format!("{wheel} --path-tangential 1e-3..2e-3"), "first..last:number"),
        (format!("{wheel} --rolling 1e-4kPa..1e3kPa:3"), "same kind"),
    ] {
        let output = folder.run(&line);
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(text(&output.stderr).contains(sentence), "{line}: {}", text(&output.stderr));
    }
    let several = folder.run(&format!("{wheel} --creepage 1e-4..1e-3:3 --json"));
    let several: Value = serde_json::from_slice(&several.stdout).unwrap();
    assert_eq!(several["states"].as_array().unwrap().len(), 3);
}

#[test]
fn what_is_wrong_is_what_the_sentence_names() {
    let folder = Folder::new();
    for (line, sentence) in [
        (
            STICKY.replace("--adhesion-table t.csv", "--adhesion 50mJ/m^2 --adhesion-range 0"),
            "the range of the attraction is 0.0",
        ),
        (STICKY.replace("--adhesion-table t.csv", "--adhesion 0 --adhesion-range 1um"), "the work of adhesion is 0.0"),
        (format!("{ROUGH} --young 1 --poisson 0,3"), "with a decimal point, such as 0.3"),
    ] {
        let output = folder.run(&line);
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(text(&output.stderr).contains(sentence), "{line}: {}", text(&output.stderr));
    }
}
