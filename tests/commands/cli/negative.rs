//! Negative numbers after flags.

use crate::command::{Folder, text};
use asperity::setup::{FlagValue, Key};

const WHEEL: &str = "solve --indenter cylinder --radius 1 --points 64 --size 0.5 --boundary free --modulus 1 --force 0.01 --friction 0.3";

/// What the parser adds to its own errors.
const OF_THE_PARSER: &str = "try '--help'";

#[test]
fn every_flag_of_a_setup_takes_negative_numbers_lists_and_units() {
    let folder = Folder::new();
    let takes_numbers = Key::with_flags().filter(|key| matches!(key.value, FlagValue::One | FlagValue::List));
    for key in takes_numbers.filter(|key| key.section() != "record") {
        for value in ["-1", "-1e-4", "-.5", "-150,150", "-3kPa", "-8E-1", "-inf"] {
            let output = folder.run(&format!("solve --{} {value}", key.flag));
            let error = text(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "--{} {value}: {error}", key.flag);
            assert!(!error.contains(OF_THE_PARSER), "--{} {value}: {error}", key.flag);
        }
    }
}

#[test]
fn a_negative_number_means_the_same_with_and_without_an_equals_sign() {
    let folder = Folder::new();
    let rough = "surface --hurst 0.8 --rolloff 0.2 --short-cutoff 0.1 --rms-gradient 0.1 --points 24,24 --size 1 --kurtosis 4 --json";
    for (line, flag, value) in [
        (format!("{WHEEL} --json"), "creepage", "-1e-4"),
        (format!("{WHEEL} --json"), "path-tangential", "-1e-3,1e-3"),
        (rough.to_owned(), "skewness", "-8e-1"),
    ] {
        let [apart, joined] = [" ", "="].map(|sign| folder.run(&format!("{line} --{flag}{sign}{value}")));
        assert!(apart.status.success(), "--{flag}: {}", text(&apart.stderr));
        let numbers = |bytes: &[u8]| {
            let mut found: serde_json::Value = serde_json::from_slice(bytes).unwrap();
            found.as_object_mut().unwrap().retain(|name, _| name != "seconds");
            found
        };
        assert_eq!(numbers(&apart.stdout), numbers(&joined.stdout), "--{flag}");
    }
}

#[test]
fn flags_and_files_are_no_numbers() {
    let folder = Folder::new();
    for line in [
        format!("{WHEEL} --creepage --json"),
        format!("{WHEEL} --creepage -h"),
        format!("{WHEEL} --creepage"),
        "solve -- --creepage -1".into(),
    ] {
        let output = folder.run(&line);
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(text(&output.stderr).contains(OF_THE_PARSER), "{line}: {}", text(&output.stderr));
    }
}
