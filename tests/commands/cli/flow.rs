//! What flows through a contact, on the command line.

use crate::command::{Folder, text};
use ndarray::{Array2, Array3, Axis};
use ndarray_npy::{NpzReader, write_npy};
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};
use serde_json::Value;
use std::f64::consts::PI;
use std::fs::File;

const SEAL: &str =
    "solve --hurst 0.8 --rolloff 0.125 --short-cutoff 0.03125 --rms-gradient 0.1 --points 128,128 --size 1";

fn json(folder: &Folder, line: &str) -> Value {
    let output = folder.run(&format!("{line} --json"));
    assert!(output.status.success(), "{line}: {}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Where gaps differ by eight orders of magnitude from node to node, the bounds of the leakage stay apart. This is told, and no gap is made of it.
#[test]
fn a_leakage_that_is_not_known_is_told() {
    let folder = Folder::new();
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let mut heights = Array2::from_shape_fn((64, 64), |_| -(10f64.powf(-8.0 * rng.random_range(0.0..1.0))));
    heights[[0, 0]] = 0.0;
    write_npy(folder.join("gaps.npy"), &heights).unwrap();
    let line = "solve --height gaps.npy --size 1,1 --modulus 1e6 --pressure 1e-7 --flow";
    let output = folder.run(line);
    assert!(text(&output.stdout).contains("not known: as between plates"), "{}", text(&output.stdout));
    assert!(text(&output.stderr).contains("warning: The leakage along"), "{}", text(&output.stderr));
    let found = json(&folder, line);
    let along = found["flow"]["along"].as_array().unwrap();
    let unknown = along.iter().filter(|it| it["hydraulic_gap"].is_null()).count();
    assert!(unknown > 0 && !found["warnings"].as_array().unwrap().is_empty(), "{along:?}");
    assert_eq!(folder.run(&format!("{line} --strict")).status.code(), Some(2));
}

/// A rough seal leaks less under more load, with bounds about what leaks, and then nothing.
#[test]
fn a_seal_leaks_until_it_is_closed() {
    let folder = Folder::new();
    let found = [0.05, 0.2, 0.7].map(|load| json(&folder, &format!("{SEAL} --reduced-pressure {load} --flow")));
    let leakage =
        |found: &Value, axis: usize, bound: usize| found["flow"]["along"][axis]["leakage"][bound].as_f64().unwrap();
    for axis in 0..2 {
        assert_eq!(found[0]["flow"]["along"][axis]["axis"], ["x", "y"][axis]);
        let most = found[0]["mean_gap"].as_f64().unwrap().powi(3);
        let [little, more] = [&found[0], &found[1]].map(|it| [leakage(it, axis, 0), leakage(it, axis, 1)]);
        assert!(
            little[0] > 0.0 && little[0] <= little[1] && little[1] - little[0] <= 1e-4 * little[1] && little[1] < most
        );
        assert!(more[1] < 0.5 * little[0], "{more:?} {little:?}");
        assert_eq!([leakage(&found[2], axis, 0), leakage(&found[2], axis, 1)], [0.0, 0.0]);
        assert_eq!(found[2]["flow"]["along"][axis]["open_percolates"], false);
    }
    let told = folder.run(&format!("{SEAL} --reduced-pressure 0.7 --flow"));
    assert!(text(&told.stdout).contains("nothing, the contact seals"), "{}", text(&told.stdout));
}

/// Strips on half of the length have a known resistance, whatever the modulus.
#[test]
fn strips_conduct_as_they_must() {
    let folder = Folder::new();
    let sine = "solve --indenter sine --amplitude 0.01 --points 4096 --size 1";
    for modulus in [1.0, 50.0] {
        let load = format!("--modulus {modulus} --pressure {}", 0.005 * PI * modulus);
        for (given, sum) in [("2", 4.0), ("2,3", 5.0)] {
            let found = json(&folder, &format!("{sine} {load} --resistivity {given}"));
            let per_area = found["flow"]["conductance_per_area"].as_f64().unwrap();
            assert!((per_area * sum * 2f64.ln() / (2.0 * PI) - 1.0).abs() < 3e-3, "{per_area} for {given}");
        }
    }
    let full = json(&folder, &format!("{sine} --modulus 1 --pressure 0.1 --resistivity 1"));
    assert_eq!(full["flow"], serde_json::json!({"is_unconstricted": true}));
}

#[test]
fn what_does_not_flow_is_refused_in_one_sentence() {
    let folder = Folder::new();
    let line = "solve --indenter sine --amplitude 0.01 --points 256 --size 1 --reduced-pressure 0.1";
    for (flags, sentence) in [
        ("--resistivity=-1", "the resistivities are -1.0 and -1.0"),
        ("--resistivity 0", "not both zero"),
        ("--layer 0.1 --poisson 0.3 --modulus 1 --resistivity 1", "leave the layer out"),
        ("--friction 0.3 --path-tangential 0.001,0.002 --resistivity 1", "at rest"),
    ] {
        let output = folder.run(&format!("{line} {flags} --out result.npz"));
        let said = text(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains(sentence), "{flags}: {said}");
        assert!(!folder.join("result.npz").exists(), "{flags}");
    }
}

/// A resistivity is one over a conductivity, in any unit, and the conductance has the unit that follows.
#[test]
fn resistivities_and_conductivities_have_units() {
    let folder = Folder::new();
    let sine = "solve --indenter sine --amplitude 1um --points 1024 --size 100um --modulus 1GPa --reduced-pressure 0.1";
    let of = |flags: &str| json(&folder, &format!("{sine} {flags}"))["flow"].clone();
    let per_area = |flags: &str| of(flags)["conductance_per_area"].as_f64().unwrap();
    let plain = per_area("--resistivity 1.7e-8,2.5e-8");
    for same in [
        "--resistivity 17nohm*m,25nohm*m",
        "--resistivity 1.7uohm*cm,25nohm*m",
        "--conductivity 58.8235294117647MS/m,40MS/m",
    ] {
        assert!((per_area(same) / plain - 1.0).abs() < 1e-12, "{same}");
    }
    // without the resistivities, only the constriction is left
    let both = of("--resistivity 1.7e-8,2.5e-8")["conductance_times_resistivity"].as_f64().unwrap();
    assert!((both / (plain * 4.2e-8) - 1.0).abs() < 1e-12);
    for (flags, unit) in [
        ("--conductivity 58MS/m", "S/m²\n"),
        ("--conductivity 400W/mK", "W/(m² K)\n"),
        ("--resistivity 0.0025mK/W", "W/(m² K)\n"),
    ] {
        let told = folder.run(&format!("{sine} {flags}"));
        let row = text(&told.stdout).split_once("conductance per area").unwrap().1.to_owned();
        assert!(row.lines().next().is_some_and(|row| row.ends_with(unit.trim())), "{flags}: {row}");
    }
    for (flags, sentence) in [
        ("--conductivity 58MS/m,400W/(m*K)", "58MS/m is electrical and 400W/(m*K) is thermal"),
        ("--resistivity 1 --conductivity 1", "both resistivities and conductivities are given: give one of them"),
        ("--conductivity 0", "the conductivities are 0.0 and 0.0"),
        ("--resistivity 1,2,3", "3 resistivities or conductivities are given"),
        ("--conductivity 17nohm*m", "expected a conductivity"),
        ("--resistivity 3m", "resistivity"),
    ] {
        let output = folder.run(&format!("{sine} {flags}"));
        let said = text(&output.stderr);
        assert!(
            output.status.code() == Some(2) && said.contains(sentence) && said.lines().count() == 1,
            "{flags}: {said}"
        );
    }
}

/// Sweeps write what flows into their table, and its fields into their archive.
#[test]
fn a_sweep_has_the_flow_in_its_files() {
    let folder = Folder::new();
    let sweep = format!("{SEAL} --reduced-pressure 0.05,0.7 --flow --resistivity 0.5");
    let found = json(&folder, &format!("{sweep} --out sweep.csv"));
    let table = std::fs::read_to_string(folder.join("sweep.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let column = |name: &str| {
        let at = rows[0].iter().position(|it| *it == name).unwrap_or_else(|| panic!("{name}: {:?}", rows[0]));
        [rows[1][at], rows[2][at]]
    };
    let states = &found["states"];
    assert_eq!(column("open_percolates_x"), ["true", "false"]);
    let upper = column("leakage_upper_y").map(|it| it.parse::<f64>().unwrap());
    assert_eq!(upper, [0, 1].map(|i| states[i]["leakage_upper_y"].as_f64().unwrap()));
    assert_eq!(column("conductance_per_area")[0].parse::<f64>().unwrap(), states[0]["conductance_per_area"]);

    assert!(folder.run(&format!("{sweep} --out sweep.npz")).status.success());
    let mut archive = NpzReader::new(File::open(folder.join("sweep.npz")).unwrap()).unwrap();
    let [flux, pressure]: [Array3<f64>; 2] = ["flux_x", "fluid_pressure_x"].map(|name| archive.by_name(name).unwrap());
    assert_eq!((flux.dim(), pressure.dim()), ((2, 128, 128), (2, 128, 128)));
    assert!(
        flux.index_axis(Axis(0), 0).iter().all(|it| *it >= 0.0)
            && flux.index_axis(Axis(0), 0).iter().any(|it| *it > 2.0)
    );
    assert!(flux.index_axis(Axis(0), 1).iter().all(|it| *it == 0.0));
    assert!(pressure.index_axis(Axis(0), 1).iter().all(|it| it.is_nan()));
    assert!(folder.run(&format!("{SEAL} --reduced-pressure 0.05 --flow --out one.npz")).status.success());
    let mut archive = NpzReader::new(File::open(folder.join("one.npz")).unwrap()).unwrap();
    let alone: Array2<f64> = archive.by_name("flux_x").unwrap();
    assert!(alone.iter().zip(flux.index_axis(Axis(0), 0)).all(|(a, b)| (a - b).abs() < 1e-2 * (1.0 + b)));
    // the archive carries the request
    let again = json(&folder, "solve --setup-of one.npz");
    assert_eq!(again["flow"]["along"][0]["open_percolates"], true);
}

/// The rows of a study say what flows, and are found again.
#[test]
fn a_study_has_the_flow_in_its_rows() {
    let folder = Folder::new();
    let study = r#"
surface = { spectrum = { hurst = 0.8, rolloff-wavelength = 0.25, short-cutoff = 0.0625, rms-gradient = 0.1 }, seed = "1-2" }
grid = { points = [64, 64], size = 1.0 }
load = { reduced-pressure = [0.05, 0.7] }
flow = { leakage = true, resistivity = 0.5 }
"#;
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let output = folder.run("study study.toml");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let table = std::fs::read_to_string(folder.join("study.csv")).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    let names: Vec<&str> = rows[0].split(',').collect();
    let value = |row: usize, name: &str| {
        let at = names.iter().position(|it| *it == name).unwrap_or_else(|| panic!("{name} in {names:?}"));
        rows[row].split(',').nth(at).unwrap().to_owned()
    };
    assert_eq!([1, 2, 3, 4].map(|row| value(row, "open_percolates_x")), ["true", "false", "true", "false"]);
    for row in [1, 3] {
        let [lower, upper, gap, conductance] =
            ["leakage_lower_x", "leakage_upper_x", "hydraulic_gap_x", "conductance_times_resistivity"]
                .map(|name| value(row, name).parse::<f64>().unwrap());
        assert!(lower > 0.0 && lower <= upper && (gap.powi(3) / upper - 1.0).abs() < 1e-12 && conductance > 0.0);
    }
    assert!(folder.run("study study.toml").status.success());
    assert_eq!(std::fs::read_to_string(folder.join("study.csv")).unwrap(), table);
}

/// The load that seals lies between two contacts, one of which leaks.
#[test]
fn the_load_that_seals_is_found() {
    let folder = Folder::new();
    let surface = SEAL.replacen("solve", "seal", 1);
    let found = json(&folder, &format!("{surface} --axis y --width 0.01"));
    let sealing = &found["sealing"][0];
    assert!(found["sealing"].as_array().unwrap().len() == 1 && sealing["axis"] == "y", "{sealing}");
    let of = |state: &str, name: &str| sealing[state][name].as_f64().unwrap();
    let [open, shut] = ["open", "sealed"].map(|state| of(state, "reduced_pressure"));
    assert!(open < shut && shut - open <= 0.01 * shut, "{sealing}");
    assert!(of("open", "relative_area_counted") <= of("sealed", "relative_area_counted"), "{sealing}");
    for (load, opens) in [(open, true), (shut, false)] {
        let contact = json(&folder, &format!("{SEAL} --reduced-pressure {load} --flow"));
        assert_eq!(contact["flow"]["along"][1]["open_percolates"], opens);
    }
    let told = folder.run(&format!("{surface} --width 0.1"));
    assert!(told.status.success() && text(&told.stdout).matches("is shut").count() == 2, "{}", text(&told.stdout));
    for (line, sentence) in [
        ("seal --indenter sine --amplitude 0.01 --points 256 --size 1", "a line is sealed by one node that touches"),
        (&format!("{surface} --width 2"), "the relative width of the load is 2.0"),
    ] {
        let output = folder.run(line);
        assert!(output.status.code() == Some(2) && text(&output.stderr).contains(sentence), "{}", text(&output.stderr));
    }
}

/// A recording shows where all of the fluid has to pass.
#[test]
fn a_recording_shows_the_flux() {
    let folder = Folder::new();
    for load in ["0.05", "0.05,0.1"] {
        let output = folder.run(&format!("{SEAL} --reduced-pressure {load} --flow --record flow.rrd"));
        assert!(output.status.success(), "{}", text(&output.stderr));
        let bytes = std::fs::read(folder.join("flow.rrd")).unwrap();
        let has = |name: &str| bytes.windows(name.len()).any(|it| it == name.as_bytes());
        assert!(has("/contact/flux_x/image") && has("/contact/fluid_pressure_y/image"), "{load}");
    }
    let line = "solve --indenter sine --amplitude 0.01 --points 256 --size 1 --reduced-pressure 0.1";
    let refused = folder.run(&format!("{line} --record line.rrd --record-what flow"));
    let said = text(&refused.stderr);
    assert!(
        refused.status.code() == Some(2) && said.contains("the recording part flow does not exist for a line"),
        "{said}"
    );
    // the flow of a line has no picture, and needs none
    assert!(folder.run(&format!("{line} --record line.rrd --flow")).status.success());
}
