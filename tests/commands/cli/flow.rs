//! What flows through a contact, on the command line.

use crate::command::{Folder, text};
use serde_json::Value;
use std::f64::consts::PI;

const SEAL: &str =
    "solve --hurst 0.8 --rolloff 0.125 --short-cutoff 0.03125 --rms-gradient 0.1 --points 128,128 --size 1";

fn json(folder: &Folder, line: &str) -> Value {
    let output = folder.run(&format!("{line} --json"));
    assert!(output.status.success(), "{line}: {}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
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
            little[0] > 0.0 && little[0] <= little[1] && little[1] - little[0] <= 1e-6 * little[1] && little[1] < most
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
        ("--friction 0.3 --path-tangential 0.001,0.002 --flow", "leave them out"),
    ] {
        let output = folder.run(&format!("{line} {flags} --out result.npz"));
        let said = text(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains(sentence), "{flags}: {said}");
        assert!(!folder.join("result.npz").exists(), "{flags}");
    }
}
