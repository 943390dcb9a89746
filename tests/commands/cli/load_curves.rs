//! One load after the other.

use super::*;

#[test]
fn a_load_curve_is_that_of_its_single_loads() {
    let folder = Folder::new();
    let run = format!("{ROUGH_LINE} --modulus 2e9 --tolerance 1e-11");
    let output = folder.run(&format!("solve {run} --reduced-pressure 1e-2..1:5 --unload --json --out curve.npz"));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let curve = json(&output);
    let loads = curve["states"].as_array().unwrap();
    assert_eq!(loads.len(), 9);
    for (i, found) in loads.iter().enumerate() {
        let p = 10f64.powf(-2.0 + 0.5 * (i.min(8 - i)) as f64);
        assert_close(number(found, "reduced_pressure"), p, 1e-12, "load");
        let (alone, fields) = solve(&folder, &format!("{run} --reduced-pressure {p:e}"));
        assert_eq!(found["relative_area_counted"], alone["relative_area_counted"], "load {i}");
        assert_close(number(found, "mean_gap"), number(&alone, "mean_gap"), 1e-6, "mean gap");
        let mut npz = NpzReader::new(File::open(folder.join("curve.npz")).unwrap()).unwrap();
        let pressure: ArrayD<f64> = npz.by_name("pressure").unwrap();
        assert_eq!(pressure.shape(), [9, 255]);
        let highest = fields.pressure.fold(0.0, |high: f64, p| high.max(*p));
        let under = pressure.index_axis(Axis(0), i);
        assert!(under.iter().zip(&fields.pressure).all(|(a, b)| (a - b).abs() < 1e-4 * highest), "load {i}");
        let means: ArrayD<f64> = npz.by_name("mean_pressure").unwrap();
        assert_eq!(means[[i]], number(found, "mean_pressure"));
    }
}

#[test]
fn a_load_curve_is_written_and_repeated_from_its_setup() {
    let folder = Folder::new();
    let run = "--modulus 1GPa --pressure 1MPa,10MPa,30MPa --tolerance 1e-10";
    let output = folder.run(&format!("solve {ROUGH_LINE} {run} --out curve.csv --save-setup curve.toml"));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_eq!(text(&output.stdout).lines().last().unwrap().split_whitespace().nth(1), Some("30"));
    let table = std::fs::read_to_string(folder.join("curve.csv")).unwrap();
    assert!(table.starts_with("state,status,claim,mean_pressure,") && table.lines().count() == 4, "{table}");
    let status = folder.run("solve curve.toml --out again.csv").status;
    assert_eq!((status.code(), std::fs::read_to_string(folder.join("again.csv")).unwrap()), (Some(0), table));
    // a single load takes the place of the list
    let one = folder.run("solve curve.toml --pressure 1e7 --json");
    assert_close(number(&json(&one), "mean_pressure"), 1e7, 1e-12, "load");
    let dry = folder.run("solve curve.toml --dry-run");
    assert!(
        text(&dry.stdout).contains("loads       3, each solved from the contact under the previous load"),
        "{}",
        text(&dry.stdout)
    );
}

#[test]
fn a_load_curve_of_which_one_does_not_converge_ends_with_3() {
    let folder = Folder::new();
    let run = format!("solve {ROUGH_LINE} --reduced-pressure 0.01,0.1 --max-iterations 2 --out curve.csv");
    let output = folder.run(&run);
    assert_eq!(output.status.code(), Some(3));
    let said = text(&output.stderr);
    assert!(said.contains("warning: not converged") && said.contains(" (load 2)"), "{said}");
    assert!(text(&output.stdout).matches("iteration-cap").count() == 2, "{}", text(&output.stdout));
    let told = folder.run(&format!("{run} --json"));
    assert_eq!(json(&told)["warnings"], serde_json::json!(warnings::warnings(&told)));
    assert!(json(&told)["states"].as_array().unwrap().iter().all(|load| load["claim"] == "not-converged"));
    assert_eq!(std::fs::read_to_string(folder.join("curve.csv")).unwrap().matches("iteration-cap").count(), 2);
}

/// The solution of a sine is that of the periodic cell; that of a sphere stands alone, and its neighbours press the solid down beside it.
#[test]
fn a_load_curve_on_an_indenter_has_the_exact_area_beside_it() {
    let folder = Folder::new();
    for (indenter, heading, tolerance) in [
        ("sine --amplitude 0.01 --size 1 --points 512", "exact area", 0.01),
        ("sphere --radius 1 --size 1,1 --points 64,64", "area without neighbouring cells", 0.05),
    ] {
        let run = format!("solve --indenter {indenter} --modulus 1 --pressure 1e-3,2e-3");
        let printed = folder.run(&run);
        assert!(text(&printed.stdout).contains(&format!("   {heading}\n")), "{}", text(&printed.stdout));
        for state in json(&folder.run(&format!("{run} --json")))["states"].as_array().unwrap() {
            assert_close(number(state, "relative_area"), number(&state["exact"], "relative_area"), tolerance, indenter);
        }
    }
}

#[cfg(feature = "record")]
#[test]
fn a_load_curve_is_recorded_over_its_loads() {
    let folder = Folder::new();
    for (surface, gap, last) in [(ROUGH_LINE, "0.004..0.001:4", 0.001), (ROUGH_SURFACE, "0.008,0.002", 0.002)] {
        let output = folder.run(&format!("solve {surface} --mean-gap {gap} --record curve.rrd"));
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        assert!(text(&output.stderr).ends_with("wrote curve.rrd: asperity view curve.rrd\n"));
        assert_is_recording(&folder, "curve.rrd");
        // it carries the setup with all loads
        let again = json(&folder.run("solve --setup-of curve.rrd --json"));
        assert_eq!(again["prescribed"], "mean gap");
        assert_close(number(again["states"].as_array().unwrap().last().unwrap(), "mean_gap"), last, 1e-6, "mean gap");
    }
}

/// A disk that is full ends the recording, not the contacts. A limit of 1 MB for each file stands for it here.
#[test]
#[cfg(unix)]
fn a_load_curve_outlives_its_recording() {
    let folder = Folder::new();
    let run = format!("solve {ROUGH_LINE} --reduced-pressure 1e-3..0.3:12 --record curve.rrd --out curve.csv");
    let whole = folder.run(&run);
    assert_eq!(whole.status.code(), Some(0), "{}", text(&whole.stderr));
    let (table, recording) = (folder.join("curve.csv"), folder.join("curve.rrd"));
    let read = |path| std::fs::read(path).unwrap();
    let (numbers, older) = (read(&table), read(&recording));
    assert!(older.len() > 1_200_000, "the recording has {} bytes", older.len());
    std::fs::remove_file(&table).unwrap();

    let limited = format!("trap '' XFSZ; ulimit -f 2000; exec {} {run}", env!("CARGO_BIN_EXE_asperity"));
    let output = std::process::Command::new("sh").args(["-c", &limited]).current_dir(folder.join("")).output().unwrap();
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("error: writing curve.part-") && said.contains(".rrd failed: File too large\n"), "{said}");
    assert!(said.contains("wrote curve.csv") && !said.contains("wrote curve.rrd"), "{said}");
    assert!(read(&table) == numbers && read(&recording) == older, "the table, and the older recording, are whole");
}
