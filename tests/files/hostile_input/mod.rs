//! Bad input: exit code 2, one sentence with what is wrong, nothing on standard output, no file made or touched.

mod bombs;
mod measured;

use crate::command::{Folder, text};
use assert_cmd::Command;
use ndarray::{Array1, Array2, Array3, arr0};
use ndarray_npy::write_npy;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Output;

const LOAD: &str = "--modulus 1 --pressure 0.01";
const CYLINDER: &str = "--indenter cylinder --radius 1 --points 64 --size 4";
const ROUGH: &str = "--hurst 0.8 --rolloff 0.25 --short-cutoff 0.1 --rms-gradient 0.1 --points 64 --size 1";
const OLD: &str = "an older result";

/// Every output that a solve can write.
const OUTPUTS: &str =
    if cfg!(feature = "record") { "--json --out new.npz --record new.rrd" } else { "--json --out new.npz" };

/// A folder with an older result and a sub-folder.
fn folder() -> Folder {
    let folder = Folder::new();
    std::fs::write(folder.join("old"), OLD).unwrap();
    std::fs::create_dir(folder.join("sub")).unwrap();
    folder
}

/// All files below a folder, with what they hold.
fn snapshot(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(snapshot(&path));
        }
        files.insert(path.to_str().unwrap().to_owned(), std::fs::read(&path).unwrap_or_default());
    }
    files
}

/// Runs `line`, which must be refused for bad input without a trace.
fn refuse(folder: &Folder, line: &str) -> String {
    let before = snapshot(&folder.join("."));
    let output = folder.run(line);
    let complaint = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{line}: {complaint}");
    assert!(output.stdout.is_empty(), "{line}: {}", text(&output.stdout));
    assert!(complaint.starts_with("error: ") && !complaint.contains("panicked"), "{line}: {complaint}");
    assert_eq!(snapshot(&folder.join(".")), before, "{line}: {complaint}");
    complaint.to_owned()
}

/// [`refuse`], with one sentence that contains `offence`.
fn refuse_in_one_sentence(folder: &Folder, line: &str, offence: &str) {
    let complaint = refuse(folder, line);
    assert!(complaint.contains(offence), "{line}: {offence} is not in {complaint}");
    assert_one_sentence(&complaint);
}

fn assert_one_sentence(complaint: &str) {
    assert!(complaint.starts_with("error: ") && complaint.ends_with('\n'), "{complaint}");
    assert_eq!(complaint.lines().count(), 1, "{complaint}");
    let said_twice = complaint.split(": ").zip(complaint.split(": ").skip(1)).any(|(a, b)| a.trim() == b.trim());
    assert!(!said_twice, "{complaint}");
}

/// Refuses `solve` with each of `cases`: arguments, and what the sentence must contain.
fn refuse_all(cases: &[(&str, &str)]) {
    let folder = folder();
    for (arguments, offence) in cases {
        refuse_in_one_sentence(&folder, &format!("solve {arguments} {OUTPUTS}"), offence);
    }
}

/// Refuses each of `values` at the place of `{}` in `solve` and the arguments; the sentence must contain the value.
fn refuse_values(arguments: &str, values: &[&str]) {
    let cases: Vec<(String, &str)> = values.iter().map(|value| (arguments.replace("{}", value), *value)).collect();
    refuse_all(&cases.iter().map(|(arguments, value)| (arguments.as_str(), *value)).collect::<Vec<_>>());
}

const NOT_POSITIVE: [&str; 4] = ["0", "-1", "inf", "NaN"];

#[test]
fn loads_that_are_not_positive_and_finite_are_refused() {
    refuse_values(&format!("{CYLINDER} --modulus 1 --pressure {{}}"), &NOT_POSITIVE);
    refuse_values(
        &format!("{CYLINDER} --modulus 1 --pressure={{}}"),
        &["-inf", "-0", "-1e-9", "1e101", "1e-101", "1e-320"],
    );
    refuse_values(&format!("{CYLINDER} --reduced-pressure {{}}"), &NOT_POSITIVE);
    refuse_values(&format!("{CYLINDER} --mean-gap {{}}"), &NOT_POSITIVE);
    refuse_values(&format!("{CYLINDER} --mean-gap={{}}"), &["-inf", "-1e-9", "1e101", "1e-101", "7.25"]);
    refuse_values(&format!("{CYLINDER} --pressure 1 --modulus {{}}"), &NOT_POSITIVE);
    refuse_values(&format!("{CYLINDER} --pressure 1 --poisson 0.3 --young {{}}"), &NOT_POSITIVE);
    refuse_values(&format!("{CYLINDER} --pressure 1 --young 1 --poisson={{}}"), &["-1", "0.51", "inf", "NaN"]);
    refuse_values(&format!("{CYLINDER} --modulus 1 --pressure 1,{{}}"), &NOT_POSITIVE);
    refuse_values(&format!("{CYLINDER} --mean-gap 0.1,{{}}"), &["0", "-1", "7.25"]);
    refuse_values(&format!("{CYLINDER} --reduced-pressure {{}}"), &["1..2", "1..2:1", "1..2:x", "..2:3", "1..:3"]);
}

#[test]
fn lengths_that_are_not_positive_and_finite_are_refused() {
    refuse_values(&format!("--indenter cylinder --radius 1 --points 64 --size {{}} {LOAD}"), &NOT_POSITIVE);
    refuse_values(&format!("--indenter sphere --radius 1 --points 8,8 --size=1,{{}} {LOAD}"), &NOT_POSITIVE);
    refuse_values(&format!("--indenter sphere --radius 1 --points 8,8 --size={{}},1 {LOAD}"), &NOT_POSITIVE);
}

#[test]
fn indenters_that_are_not_positive_and_finite_are_refused() {
    for shape in [
        "cylinder --radius {}",
        "sine --amplitude {}",
        "wedge --slope {}",
        "power-law --coefficient {} --exponent 2",
        "power-law --coefficient 1 --exponent {}",
        "punch --half-width {} --depth 1",
        "punch --half-width 0.1 --depth {}",
    ] {
        refuse_values(&format!("--indenter {shape} --points 64 --size 1 {LOAD}"), &NOT_POSITIVE);
    }
    for shape in ["sphere --radius {}", "crossed-sine --amplitude {}", "cone --slope {}"] {
        refuse_values(&format!("--indenter {shape} --points 8,8 --size 1 {LOAD}"), &NOT_POSITIVE);
    }
    refuse_values(
        &format!("--indenter punch --half-width {{}} --depth 1 --points 64 --size 1 {LOAD}"),
        &["0.5", "7.25"],
    );
}

#[test]
fn indenters_beyond_the_range_of_numbers_are_refused() {
    refuse_all(&[
        ("--indenter cylinder --radius 1e-320 --points 64 --size 1 --modulus 1 --pressure 0.01", "inf"),
        ("--indenter cylinder --radius 1e300 --points 64 --size 1 --modulus 1 --pressure 0.01", "rms height"),
        ("--indenter cylinder --radius 1 --points 64 --size 1e200 --modulus 1 --pressure 0.01", "inf"),
        ("--indenter cylinder --radius 1 --points 64 --size 1e-320 --modulus 1 --pressure 0.01", "flat"),
        (
            "--indenter power-law --coefficient 1 --exponent 1000 --points 64 --size 1 --modulus 1 --pressure 0.01",
            "rms height",
        ),
    ]);
}

#[test]
fn indenters_on_the_wrong_kind_of_grid_are_refused() {
    for (indenter, name) in [
        ("cylinder --radius 1 --points 8,8", "cylinder"),
        ("sine --amplitude 1 --points 8,8", "sine"),
        ("wedge --slope 1 --points 8,8", "wedge"),
        ("sphere --radius 1 --points 8", "sphere"),
        ("crossed-sine --amplitude 1 --points 8", "crossed sine"),
        ("cone --slope 1 --points 8", "cone"),
    ] {
        refuse_all(&[(&format!("--indenter {indenter} --size 1 {LOAD}"), name)]);
    }
}

#[test]
fn indenters_without_their_parameters_are_refused() {
    for (indenter, missing) in [
        ("cylinder --points 8", "--radius"),
        ("sphere --points 8,8", "--radius"),
        ("sine --points 8", "--amplitude"),
        ("crossed-sine --points 8,8", "--amplitude"),
        ("wedge --points 8", "--slope"),
        ("cone --points 8,8", "--slope"),
        ("power-law --points 8 --exponent 2", "--coefficient"),
        ("power-law --points 8 --coefficient 2", "--exponent"),
        ("punch --points 8 --depth 2", "--half-width"),
        ("punch --points 8 --half-width 0.1", "--depth"),
    ] {
        refuse_all(&[(&format!("--indenter {indenter} --size 1 {LOAD}"), missing)]);
    }
}

#[test]
fn spectra_that_cannot_be_are_refused() {
    let with = |hurst, rolloff, short_cutoff, gradient| {
        format!(
            "--hurst {hurst} --rolloff {rolloff} --short-cutoff {short_cutoff} --rms-gradient {gradient} \
             --points 64 --size 1 {LOAD}"
        )
    };
    refuse_values(&with("{}", "0.25", "0.1", "0.1"), &["0", "1.5", "NaN", "-0.5", "inf"]);
    refuse_values(&with("0.8", "{}", "0.1", "0.1"), &NOT_POSITIVE);
    refuse_values(&with("0.8", "0.25", "{}", "0.1"), &NOT_POSITIVE);
    refuse_values(&with("0.8", "0.25", "0.1", "{}"), &NOT_POSITIVE);
    refuse_all(&[
        (&with("0.8", "0.1", "0.25", "0.1"), "0.25"),
        (&with("0.8", "0.1", "0.1", "0.1"), "0.1"),
        (&with("0.8", "0.25", "0.03", "0.1"), "0.03"),
        (&with("0.8", "1.25", "0.1", "0.1"), "1.25"),
        (&with("0.8", "1", "0.1", "1e200"), "overflow"),
    ]);
}

#[test]
fn spectra_that_are_not_whole_are_refused() {
    refuse_all(&[
        (
            "--hurst 0.8 --short-cutoff 0.1 --rms-gradient 0.1 --points 64 --size 1 --modulus 1 --pressure 1",
            "--rolloff",
        ),
        (
            "--hurst 0.8 --rolloff 0.5 --rms-gradient 0.1 --points 64 --size 1 --modulus 1 --pressure 1",
            "--short-cutoff",
        ),
        (
            "--hurst 0.8 --rolloff 0.5 --short-cutoff 0.1 --points 64 --size 1 --modulus 1 --pressure 1",
            "--rms-gradient",
        ),
    ]);
}

#[test]
fn exactly_one_surface_and_one_load_are_needed() {
    refuse_all(&[
        ("--points 64 --size 1 --modulus 1 --pressure 1", "no surface"),
        ("--points 64 --size 1", "no surface"),
        (
            "--height old --indenter cylinder --radius 1 --size 1 --modulus 1 --pressure 1",
            "old is not a valid height file",
        ),
        ("--height old --hurst 0.8 --size 1 --modulus 1 --pressure 1", "--rolloff"),
        (&format!("{CYLINDER} --hurst 0.8 {LOAD}"), "--rolloff"),
        (CYLINDER, "no load"),
        (&format!("{CYLINDER} --mean-gap 0.1 --solver gfmd"), "gfmd needs a given mean pressure"),
    ]);
}

#[test]
fn grids_that_cannot_be_are_refused() {
    let with = |grid: &str| format!("--indenter power-law --coefficient 1 --exponent 2 {grid} {LOAD}");
    for (grid, offence) in [
        ("--points 0 --size 1", "0 points"),
        ("--points 3 --size 1", "3 points"),
        ("--points 3,8 --size 1", "3 points along y"),
        ("--points 8,1 --size 1", "1 points along x"),
        ("--points 8,8,8 --size 1", "3 axes"),
        ("--points 8 --size 1,1", "2 lengths"),
        ("--points 8,8 --size 1,1,1", "3 lengths"),
        ("--size 1", "the points are missing"),
        ("--points 8", "--size"),
        ("--height old --points 8 --size 1", "points are given, but the height file has its own"),
    ] {
        refuse_all(&[(&with(grid), offence)]);
    }
}

#[test]
fn grids_beyond_memory_are_refused() {
    for points in ["99999999999,99999999999", "4000000,4000000", "18446744073709551615", "9999999999999"] {
        let offence = points.split(',').next().unwrap();
        refuse_all(&[
            (&format!("--indenter power-law --coefficient 1 --exponent 2 --points {points} --size 1 {LOAD}"), offence),
            (&ROUGH.replace("64", points).replace("--size", "--modulus 1 --pressure 1 --size"), offence),
        ]);
        refuse_in_one_sentence(&folder(), &format!("surface {}", ROUGH.replace("64", points)), offence);
    }
}

/// The largest grid that counts as one takes 128 GiB for each field.
#[test]
fn grids_beyond_memory_are_refused_with_what_they_need() {
    let sphere = CYLINDER.replace("cylinder", "sphere");
    let folder = folder();
    for solver in ["multilevel", "polonsky-keer", "gfmd"] {
        let line = format!("solve {} {LOAD} --solver {solver} {OUTPUTS}", sphere.replace("64", "1000000,10000"));
        refuse_in_one_sentence(&folder, &line, "1000000 x 10000 points does not fit in memory");
        refuse_in_one_sentence(&folder, &line, &format!("{solver} needs at least "));
    }
}

#[cfg(feature = "record")]
#[test]
fn parts_that_a_scene_does_not_have_are_refused() {
    let folder = folder();
    let line = format!("solve {CYLINDER} {LOAD} {OUTPUTS}");
    refuse_in_one_sentence(&folder, &format!("{line} --record-what traces,mesh"), "mesh");
    let surface = line.replace("cylinder", "sphere").replace("64", "8,8");
    refuse_in_one_sentence(&folder, &format!("{surface} --record-what profile"), "profile");
    assert!(refuse(&folder, &format!("{line} --record-what colour")).contains("colour"));
    assert!(refuse(&folder, &format!("solve {CYLINDER} {LOAD} --record-what mask")).contains("--record"));
}

#[test]
fn friction_and_stress_that_cannot_be_are_refused() {
    let folder = folder();
    let line = format!("solve {CYLINDER} {LOAD} {OUTPUTS}");
    refuse_in_one_sentence(&folder, &format!("{line} --friction 0.5 --tangential 0.005"), "carries less than 0.005");
    refuse_in_one_sentence(&folder, &format!("{line} --friction 0.5"), "--tangential");
    let apart = format!("solve {CYLINDER} --mean-gap 0.1 {OUTPUTS} --friction 0.5 --tangential 1e-3");
    refuse_in_one_sentence(&folder, &apart, "give a mean pressure");
    let line_in_metres = "solve --indenter cylinder --radius 1m --points 64 --size 1m --modulus 1GPa --friction 0.5";
    for (load, tangential, form) in [
        ("--force 500kN/m", "100kPa", "which is a force: give a force"),
        ("--pressure 1MPa", "1N", "which is a mean pressure: give a mean pressure"),
        ("--reduced-pressure 0.01", "100kPa", "which is a reduced pressure"),
    ] {
        refuse_in_one_sentence(&folder, &format!("{line_in_metres} {load} {OUTPUTS} --tangential {tangential}"), form);
    }
    let several = line.replace("--pressure 0.01", "--pressure 0.01,0.02");
    refuse_in_one_sentence(
        &folder,
        &format!("{several} --friction 0.5 --tangential 1e-3"),
        "several loads outside a path and friction cannot be combined",
    );
    refuse_in_one_sentence(&folder, &format!("{several} --stress new-stress.npz"), "give one");
    refuse_in_one_sentence(&folder, &format!("{line} --stress new-stress.csv"), "npz");
    refuse_in_one_sentence(&folder, &format!("{line} --stress new-stress.npz --stress-row 0"), "leave it out");
    let surface = line.replace("cylinder", "sphere").replace("64", "8,8");
    refuse_in_one_sentence(&folder, &format!("{surface} --stress new-stress.npz --stress-row 8"), "give 0 to 7");
    refuse_values(&format!("{CYLINDER} {LOAD} --tangential 1e-3 --friction {{}}"), &NOT_POSITIVE);
    refuse_values(&format!("{CYLINDER} {LOAD} --friction 0.5 --tangential {{}}"), &NOT_POSITIVE);
}

#[test]
fn settings_out_of_range_are_refused() {
    let with = |setting: &str| format!("{CYLINDER} {LOAD} --solver gfmd {setting}");
    refuse_values(&with("--tolerance {}"), &NOT_POSITIVE);
    refuse_values(&with("--pressure-tolerance {}"), &NOT_POSITIVE);
    refuse_values(&with("--time-step {}"), &["0", "1", "1.5", "-0.5", "inf", "NaN"]);
    refuse_values(&with("--damping {}"), &NOT_POSITIVE);
    refuse_values(&with("--max-iterations {}"), &["0"]);
    #[cfg(feature = "record")]
    refuse_values(&with("--record-every {}"), &["0"]);
}

#[test]
fn arguments_that_do_not_belong_are_refused() {
    refuse_all(&[
        (&format!("{CYLINDER} --amplitude 3 {LOAD}"), "unknown key `amplitude`"),
        (
            &format!("{CYLINDER} --solver polonsky-keer --masses stiffness {LOAD}"),
            "`masses` is a setting of the method gfmd, but the method is polonsky-keer",
        ),
        (&format!("{CYLINDER} --damping 0.5 {LOAD}"), "give the method gfmd, or leave `damping` out"),
    ]);
    let folder = folder();
    for (arguments, offence) in [("--rolloff 0.1", "--hurst"), ("--seed 3", "Hurst exponent")] {
        refuse_in_one_sentence(&folder, &format!("solve {CYLINDER} {arguments} {LOAD}"), offence);
    }
    assert!(refuse(&folder, &format!("solve {ROUGH} --radius 1 {LOAD}")).contains("--indenter"));
    refuse_in_one_sentence(&folder, &format!("solve {CYLINDER} {LOAD} --unload"), "but one is given");
}

#[test]
fn words_that_are_no_arguments_are_refused() {
    let folder = folder();
    let solve = format!("solve {CYLINDER} {LOAD} {OUTPUTS}");
    for (line, offence) in [
        ("squeeze".to_owned(), "squeeze"),
        (format!("{solve} --solver newton"), "newton"),
        (format!("{solve} --masses heavy"), "heavy"),
        (format!("{solve} --dynamics wild"), "wild"),
        (format!("{solve} --max-iterations -1"), "-1"),
        (format!("{solve} --max-iterations 1e3"), "1000.0"),
        (format!("{solve} --tolerance small"), "small"),
        (format!("{solve} --seed 1.5"), "1.5"),
        (format!("{solve} --no-such-option"), "--no-such-option"),
        (format!("{solve} --mean-gap 0.1"), "--mean-gap"),
        (format!("{solve} --reduced-pressure 0.1"), "--reduced-pressure"),
        (format!("{solve} --pressure 2"), "--pressure"),
        (format!("{solve} stray"), "stray"),
        (solve.replace("64", "64.5"), "64.5"),
        (solve.replace("64", "64,"), "text \"\""),
        (solve.replace(" 64", "=-64"), "-64"),
        (solve.replace("64", "99999999999999999999999"), "99999999999999999999999"),
        (solve.replace("--size 4", "--size 4,x"), "x"),
        (solve.replace("cylinder", "banana"), "banana"),
        ("surface --json --out".to_owned(), "--out"),
    ] {
        assert!(refuse(&folder, &line).contains(offence), "{line}");
    }
}

/// Height files of every unusable kind, and what is to be said of them.
fn write_bad_heights(folder: &Folder) -> Vec<(&'static str, &'static str)> {
    let good = Array2::from_shape_fn((8, 6), |(i, j)| (i * j) as f64);
    let with = |value: f64| {
        let mut height = good.clone();
        height[[5, 3]] = value;
        height
    };
    let save = |name: &str, height: Array2<f64>| write_npy(folder.join(name), &height).unwrap();
    save("nan.npy", with(f64::NAN));
    save("inf.npy", with(f64::INFINITY));
    save("minus_inf.npy", with(f64::NEG_INFINITY));
    save("huge.npy", with(1e200));
    save("flat.npy", Array2::from_elem((8, 6), 2.5));
    save("narrow.npy", Array2::eye(3));
    save("column.npy", Array2::from_shape_fn((8, 1), |(i, _)| i as f64));
    save("no_rows.npy", Array2::zeros((0, 8)));
    write_npy(folder.join("short.npy"), &Array1::from_vec(vec![0.0, 1.0, 0.5])).unwrap();
    write_npy(folder.join("empty.npy"), &Array1::<f64>::zeros(0)).unwrap();
    write_npy(folder.join("scalar.npy"), &arr0(1.0)).unwrap();
    write_npy(folder.join("cube.npy"), &Array3::<f64>::zeros((4, 5, 6))).unwrap();
    write_npy(folder.join("truths.npy"), &Array1::from_elem(8, true)).unwrap();
    save("truncated.npy", good);
    let whole = std::fs::read(folder.join("truncated.npy")).unwrap();
    std::fs::write(folder.join("truncated.npy"), &whole[..whole.len() - 1]).unwrap();
    std::fs::write(folder.join("head.npy"), &whole[..40]).unwrap();
    std::fs::write(folder.join("long.npy"), [&whole[..], &[0]].concat()).unwrap();
    std::fs::write(folder.join("nothing.npy"), "").unwrap();
    std::fs::write(folder.join("words.txt"), "heights\nof nothing\n").unwrap();
    save("uneven.npy", Array2::from_shape_fn((5, 2), |(i, _)| [0.0, 1.0, 5.0, 6.0, 7.0][i]));
    std::fs::write(folder.join("table.csv"), "0.1,0.2\n0.3,0.4\n").unwrap();
    std::fs::write(folder.join("noise.npy"), (0..=255).cycle().take(5000).collect::<Vec<u8>>()).unwrap();
    vec![
        ("nan.npy", "1 of 48 heights in nan.npy are void"),
        ("inf.npy", "1 of 48 heights in inf.npy are void"),
        ("minus_inf.npy", "1 of 48 heights in minus_inf.npy are void"),
        ("huge.npy", "overflow"),
        ("flat.npy", "2.5"),
        ("narrow.npy", "3 points"),
        ("column.npy", "1 points"),
        ("no_rows.npy", "0 points"),
        ("short.npy", "3 points"),
        ("empty.npy", "0 points"),
        ("scalar.npy", "scalar.npy is not a valid height file: its array has rank 0"),
        ("cube.npy", "cube.npy is not a valid height file: its array has rank 3"),
        ("truths.npy", "b1"),
        ("truncated.npy", "truncated.npy is not a valid height file: it has"),
        ("head.npy", "head.npy is not a valid height file"),
        ("long.npy", "long.npy is not a valid height file: it has"),
        ("nothing.npy", "nothing.npy is not a valid height file"),
        ("table.csv", "2 points"),
        ("words.txt", "words.txt is not a valid height file: it is neither a .npy file nor a text of numbers"),
        ("uneven.npy", "the positions in uneven.npy are not evenly spaced"),
        ("noise.npy", "noise.npy is not a valid height file"),
        ("sub", "sub is not a valid height file: it is a directory"),
        ("missing.npy", "cannot read missing.npy"),
        ("nowhere/h.npy", "cannot read nowhere/h.npy"),
        ("table.csv/h.npy", "cannot read table.csv/h.npy"),
    ]
}

#[test]
fn height_files_that_cannot_be_used_are_refused() {
    let folder = folder();
    for (name, offence) in write_bad_heights(&folder) {
        let solve = format!("solve --height {name} --size 1 {LOAD} {OUTPUTS}");
        refuse_in_one_sentence(&folder, &solve, offence);
    }
}

#[test]
fn height_files_that_are_no_surface_are_not_described() {
    let folder = folder();
    for (name, offence) in write_bad_heights(&folder) {
        if !["flat.npy", "huge.npy", "uneven.npy"].contains(&name) && !offence.ends_with("void") {
            refuse_in_one_sentence(&folder, &format!("surface --height {name} --size 1 --json --out new.npy"), offence);
        }
    }
    for (described, words) in
        [("nan.npy", "1 of 48 heights are void"), ("uneven.npy", "The positions are not evenly spaced")]
    {
        let output = folder.run(&format!("surface --height {described} --size 1"));
        assert!(output.status.success() && text(&output.stderr).contains(words), "{output:?}");
    }
    refuse_in_one_sentence(&folder, "surface", "no surface");
    refuse_in_one_sentence(&folder, "surface --height missing.npy --hurst 1", "missing key `rolloff-wavelength`");
}

#[test]
fn places_that_no_file_can_take_are_refused() {
    let folder = folder();
    // a solve of one iteration would warn, if it were begun
    let commands = [
        format!("solve {CYLINDER} {LOAD} --max-iterations 1 --json --out"),
        format!("surface {CYLINDER} --json --out"),
        #[cfg(feature = "record")]
        format!("solve {CYLINDER} {LOAD} --max-iterations 1 --out new.npz --record"),
        #[cfg(feature = "record")]
        "demo --out".to_owned(),
    ];
    let places = ["sub", "sub/", ".", "new/", "nowhere/new", "old/new", "/"];
    let devices: &[&str] = if cfg!(unix) { &["/dev/full", "/dev/null"] } else { &[] };
    for command in &commands {
        for place in places.iter().chain(devices) {
            refuse_in_one_sentence(&folder, &format!("{command} {place}"), &format!("cannot write {place}: "));
        }
    }
}

#[test]
fn names_that_promise_another_content_are_refused() {
    let folder = folder();
    let solve = format!("solve {CYLINDER} {LOAD} --json");
    let curve = format!("solve {CYLINDER} --reduced-pressure 0.1,0.2 --json");
    let sphere = solve.replace("cylinder", "sphere").replace("64", "8,8");
    for (line, offence) in [
        (format!("{solve} --out x.rrd"), "cannot write x.rrd: give a name that ends in .npz or .csv"),
        (format!("{curve} --out x.npy"), "cannot write x.npy: give a name that ends in .npz or .csv"),
        (format!("{solve} --out old"), "cannot write old: give a name that ends in .npz or .csv"),
        (format!("{solve} --save-setup x.npz"), "cannot write x.npz: give a name that ends in .toml"),
        (format!("{sphere} --out x.csv"), "x.csv: a .csv of nodes is for lines only; for a surface give a .npz"),
        (format!("surface {CYLINDER} --out x.npz"), "cannot write x.npz: give a name that ends in .npy or .sdf"),
        ("bench --out x.npz".into(), "cannot write x.npz: give a name that ends in .csv"),
        ("stability --out x".into(), "cannot write x: give a name that ends in .csv"),
        #[cfg(feature = "record")]
        (format!("{solve} --record x.npz"), "cannot write x.npz: give a name that ends in .rrd"),
        #[cfg(feature = "record")]
        (format!("{curve} --record x.csv"), "cannot write x.csv: give a name that ends in .rrd"),
        #[cfg(feature = "record")]
        ("demo --out x.npz".into(), "cannot write x.npz: give a name that ends in .rrd"),
    ] {
        refuse_in_one_sentence(&folder, &line, offence);
    }
}

#[test]
fn bad_input_leaves_an_older_result_alone() {
    let folder = folder();
    ["old.npz", "old.npy", "old.rrd"].iter().for_each(|name| std::fs::write(folder.join(name), OLD).unwrap());
    refuse_in_one_sentence(&folder, &format!("solve {CYLINDER} --modulus 1 --pressure -2 --out old.npz"), "-2");
    refuse_in_one_sentence(&folder, "surface --height missing.npy --size 1 --out old.npy", "missing.npy");
    #[cfg(feature = "record")]
    refuse_in_one_sentence(&folder, &format!("solve {CYLINDER} --modulus 1 --pressure -2 --record old.rrd"), "-2");
    #[cfg(feature = "record")]
    refuse_in_one_sentence(&folder, &format!("solve {CYLINDER} {LOAD} --record old.rrd --out sub"), "sub");
}

#[test]
fn extreme_but_possible_contacts_end_with_numbers() {
    let folder = folder();
    let cases = [
        format!("{CYLINDER} --modulus 1 --pressure 1e99"),
        format!("{CYLINDER} --modulus 1 --pressure 1e-99"),
        format!("{CYLINDER} --pressure 1 --modulus 1e99"),
        format!("{CYLINDER} --pressure 1 --modulus 1e-99"),
        format!("{CYLINDER} --reduced-pressure 1e-30"),
        format!("{CYLINDER} {LOAD} --tolerance 1e-320"),
        format!("{CYLINDER} {LOAD} --tolerance 1e300"),
        format!("--indenter cylinder --radius 1 --points 4 --size 1 {LOAD}"),
        format!("--indenter sphere --radius 1 --points 4,5 --size 1e-9,1e9 {LOAD}"),
        format!("--indenter power-law --coefficient 1 --exponent 1e-20 --points 64 --size 1 {LOAD}"),
        format!("--indenter power-law --coefficient 1 --exponent 90 --points 64 --size 1 {LOAD}"),
        format!("--indenter punch --half-width 1e-9 --depth 1e-90 --points 64 --size 1 {LOAD}"),
    ];
    for case in cases {
        for solver in ["polonsky-keer", "gfmd"] {
            let line = format!("solve {case} --solver {solver} --max-iterations 2000 --json");
            let output = folder.run(&line);
            assert!(matches!(output.status.code(), Some(0 | 3)), "{line}: {}", text(&output.stderr));
            let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
            // a pressure that does not deform the solid has no bound of its error, nobody asks for the stiffness, a periodic half-space has
            // no approach, a contact at rest no friction, and what is not resolved, or that of a punch, has neither gradient nor errors
            let unknown = [
                "pressure_error_bound",
                "stiffness",
                "approach",
                "friction",
                "reduced_pressure_contact",
                "rms_gradient_contact",
                "kappa",
                "kappa_r",
                "relative_area_error",
                "kappa_r_error",
            ];
            let mut values = summary.as_object().unwrap().iter().filter(|(key, _)| !unknown.contains(&key.as_str()));
            assert!(!values.any(|(_, value)| value.is_null()), "{line}: {summary}");
        }
    }
}

/// Runs `script` in a shell, where `"$@"` is `asperity` with the words of `line`.
#[cfg(unix)]
fn shell(folder: &Folder, script: &str, line: &str) -> Output {
    let mut command = Command::new("sh");
    command.args(["-c", script, "sh", env!("CARGO_BIN_EXE_asperity")]).args(line.split_whitespace());
    folder.finish(&mut command)
}

/// The beginning of the name of a recording that is not finished.
#[cfg(unix)]
const RECORDING: &str = "new.part-";

/// Commands that write more than 32 kB, and what they write.
#[cfg(unix)]
fn writers() -> Vec<(String, &'static str)> {
    let fine = CYLINDER.replace("64", "16384");
    vec![
        (format!("solve {fine} {LOAD} --out new.npz"), "new.npz"),
        (format!("surface {fine} --out new.npy"), "new.npy"),
        #[cfg(feature = "record")]
        (format!("solve {fine} {LOAD} --record new.rrd --record-every 1"), RECORDING),
        #[cfg(feature = "record")]
        ("demo --out new.rrd".to_owned(), RECORDING),
    ]
}

/// A write that failed on the way: exit code 1, one sentence that names the file. What a solve found is told all the same where
/// its recording failed, as that may come last.
#[cfg(unix)]
fn assert_write_failed(output: &Output, file: &str) {
    let complaint = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{file}: {complaint}");
    assert!(complaint.contains(file) && (output.stdout.is_empty() || file == RECORDING), "{complaint}");
    assert_one_sentence(complaint);
}

#[cfg(unix)]
#[test]
fn files_that_cannot_grow_are_reported_and_not_left_half_written() {
    for (line, file) in writers() {
        let folder = folder();
        let limited = r#"trap "" XFSZ; ulimit -f 16; exec "$@""#;
        assert_write_failed(&shell(&folder, limited, &line), file);
        // a recording is valid at any moment, so what there is of it stays
        let left = snapshot(&folder.join(".")).into_keys().filter(|name| !name.contains(RECORDING));
        assert_eq!(left.count(), 2, "{line}");
    }
}

#[cfg(unix)]
#[test]
fn an_older_result_survives_a_write_that_fails() {
    for (line, file) in writers().into_iter().take(2) {
        let folder = folder();
        std::fs::write(folder.join(file), OLD).unwrap();
        assert_write_failed(&shell(&folder, r#"trap "" XFSZ; ulimit -f 16; exec "$@""#, &line), file);
        assert_eq!(std::fs::read_to_string(folder.join(file)).unwrap(), OLD);
    }
}

/// On a real file system of 64 kB, in a name space of its own; where the system has none to give, nothing is tested.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported() {
    let on_small_disk = |script: &str, line: &str| {
        let folder = folder();
        let mount = r#"unshare -Urm sh -c 'mount -t tmpfs -o size=64k none sub && cd sub || exit 77"#;
        let output = shell(&folder, &format!("{mount}; {script}' sh \"$@\""), line);
        (folder, output)
    };
    let (_folder, trial) = on_small_disk("exit 0", "--version");
    if !trial.status.success() {
        eprintln!("skipped: no file system of its own ({})", text(&trial.stderr).trim());
        return;
    }
    for (line, file) in writers() {
        let (_folder, output) = on_small_disk(r#"exec "$@""#, &line);
        assert_write_failed(&output, file);
        let (_folder, left) = on_small_disk(r#""$@" >/dev/null 2>&1; ls -A"#, &line);
        let is_expected = |name: &str| file == RECORDING && name.starts_with(RECORDING) && name.ends_with(".rrd");
        assert!(text(&left.stdout).lines().all(is_expected), "{line} left {}", text(&left.stdout));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn standard_streams_that_are_full_or_closed_do_not_panic() {
    let folder = folder();
    let solve = format!("solve {CYLINDER} {LOAD} --out new.npz");
    let surface = format!("surface {ROUGH}");
    for line in [&solve, &surface] {
        let full = shell(&folder, r#"exec "$@" >/dev/full"#, line);
        assert_eq!(full.status.code(), Some(1));
        assert_one_sentence(text(&full.stderr));
        for script in [r#"exec "$@" >&-"#, r#"exec "$@" 2>&-"#, r#"exec "$@" 2>/dev/full"#, r#"exec "$@" <&-"#] {
            assert_eq!(shell(&folder, script, line).status.code(), Some(0), "{script}");
        }
        let cut = shell(&folder, r#"("$@"; echo "code $?" >&2) | true"#, line);
        let complaint = text(&cut.stderr);
        assert!(complaint.ends_with("code 0\n") || complaint.ends_with("code 1\n"), "{complaint}");
    }
    let bad = format!("{solve} --size -1");
    for script in [r#"exec "$@" 2>&-"#, r#"exec "$@" 2>/dev/full"#] {
        let code = |line: &str| shell(&folder, script, line).status.code();
        assert_eq!(code(&bad.replace("--size 4", "")), Some(2), "{script}");
        assert_eq!(code(&format!("{solve} --max-iterations 1")), Some(3), "{script}");
    }
}

/// With the address space limited to 4 GB.
#[cfg(target_os = "linux")]
#[test]
fn grids_beyond_the_memory_of_the_machine_are_refused() {
    let folder = folder();
    for surface in [CYLINDER.replace("64", "400000000"), ROUGH.replace("64", "20000,20000")] {
        for line in [format!("solve {surface} {LOAD} {OUTPUTS}"), format!("surface {surface}")] {
            let output = shell(&folder, r#"ulimit -v 4000000; exec "$@""#, &line);
            assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
            assert_one_sentence(text(&output.stderr));
            assert!(text(&output.stderr).contains("0000 points does not fit in memory"), "{}", text(&output.stderr));
        }
    }
}

/// Nothing is solved for a viewer that is not there.
#[cfg(feature = "record")]
#[test]
fn a_missing_viewer_is_said() {
    if std::net::TcpStream::connect(("127.0.0.1", 9876)).is_ok() {
        return; // one runs on this machine, and would be taken
    }
    let folder = folder();
    let line = format!("solve {CYLINDER} {LOAD} --live --record new.rrd");
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    let output = folder.finish(command.args(line.split_whitespace()).env("PATH", folder.join("sub")));
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("pip install rerun-sdk`"), "{}", text(&output.stderr));
    assert!(output.stdout.is_empty() && !folder.join("new.rrd").exists());
}

/// A folder with a sine of eight nodes and fields for it that nobody can use.
fn hostile_fields() -> Folder {
    let folder = folder();
    write_npy(folder.join("h.npy"), &Array1::from(vec![1.0, 0.7, 0.0, -0.7, -1.0, -0.7, 0.0, 0.7])).unwrap();
    write_npy(folder.join("good.npy"), &Array1::from(vec![0.8, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])).unwrap();
    write_npy(folder.join("short.npy"), &Array1::from(vec![1.0; 7])).unwrap();
    write_npy(folder.join("nan.npy"), &Array1::from(vec![0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0, 0.0, 0.0])).unwrap();
    write_npy(folder.join("zero.npy"), &Array1::from(vec![0.0; 8])).unwrap();
    write_npy(folder.join("column.npy"), &Array2::from_elem((8, 1), 1.0)).unwrap();
    write_npy(folder.join("cube.npy"), &Array3::from_elem((2, 2, 8), 1.0)).unwrap();
    write_npy(folder.join("scalar.npy"), &arr0(1.0)).unwrap();
    let bytes = std::fs::read(folder.join("good.npy")).unwrap();
    std::fs::write(folder.join("cut.npy"), &bytes[..bytes.len() - 9]).unwrap();
    std::fs::write(folder.join("noise.npz"), b"PK\x03\x04 nothing of the kind").unwrap();
    folder
}

/// A bit of a result that has changed is found by the check sum of its array, be it in the setup or in a field.
#[test]
fn results_with_a_changed_digit_are_refused() {
    let folder = folder();
    let made = folder.run(&format!("solve {CYLINDER} {LOAD} --out whole.npz"));
    assert!(made.status.success(), "{}", text(&made.stderr));
    let whole = std::fs::read(folder.join("whole.npz")).unwrap();
    let digit = whole.windows(4).position(|bytes| bytes == b"0.01").unwrap() + 3;
    let changed = |place: usize| [&whole[..place], &[whole[place] ^ 1], &whole[place + 1..]].concat();
    std::fs::write(folder.join("setup.npz"), changed(digit)).unwrap();
    refuse_in_one_sentence(
        &folder,
        "solve --setup-of setup.npz",
        "its array `setup` is damaged: it fails its check sum",
    );
    let name = b"pressure.npy";
    let pressure = whole.windows(name.len()).position(|bytes| bytes == name).unwrap() + name.len() + 400;
    std::fs::write(folder.join("field.npz"), changed(pressure)).unwrap();
    let certify = "certify --setup-of whole.npz --pressure";
    assert!(folder.run(&format!("{certify} whole.npz")).status.success());
    refuse_in_one_sentence(&folder, &format!("{certify} field.npz"), "its array `pressure` is damaged");
}

const SINE: &str = "--height h.npy --size 1 --modulus 1";

#[test]
fn results_that_cannot_be_certified_are_refused() {
    let folder = hostile_fields();
    for (arguments, offence) in [
        ("--pressure short.npy", "the pressure of shape [1, 7] does not fit heights of 1 x 8 points"),
        ("--pressure column.npy", "it is transposed"),
        ("--pressure cube.npy", "cube.npy is not a valid pressure file: its array has rank 3"),
        ("--gap scalar.npy", "scalar.npy is not a valid gap file: its array has rank 0"),
        ("--pressure nan.npy", "the pressure at row 0, column 2 is NaN"),
        ("--pressure zero.npy", "the mean pressure is 0"),
        ("--gap zero.npy", "everything touches"),
        ("--displacement good.npy", "no load is given"),
        ("--displacement good.npy", "--mean-pressure"),
        ("--pressure cut.npy", "cut.npy is not a valid pressure file: it has"),
        ("--pressure noise.npz", "noise.npz is not a valid pressure file"),
        ("--pressure none.npy", "cannot read none.npy"),
        ("--pressure sub", "sub is not a valid pressure file: it is a directory"),
        ("--pressure good.npy --mean-pressure -1", "the mean pressure is -1"),
        ("--pressure good.npy --mean-pressure 1,2", "2 loads are given"),
        ("--pressure good.npy --tolerance 0", "the tolerance is 0"),
        ("--pressure good.npy --out new.txt", "new.txt"),
        ("--pressure good.npy --out none/new.npz", "none"),
    ] {
        refuse_in_one_sentence(&folder, &format!("certify {SINE} {arguments} --json"), offence);
    }
    let nothing = refuse(&folder, &format!("certify {SINE} --json"));
    assert!(nothing.contains("--pressure"), "{nothing}");
    write_npy(folder.join("square.npy"), &Array2::from_elem((8, 8), 0.1)).unwrap();
    let sphere = "certify --indenter sphere --radius 1 --points 8,8 --size 4 --modulus 1 --pressure square.npy";
    refuse_in_one_sentence(&folder, &format!("{sphere} --out new.csv"), "a .csv can be written for a line only");
    refuse_in_one_sentence(&folder, &format!("{sphere} --out new.png"), "a .png can be written for a line only");
    let no_modulus = "certify --height h.npy --size 1 --pressure good.npy";
    refuse_in_one_sentence(&folder, no_modulus, "without a modulus");
}

#[test]
fn iterations_that_cannot_be_inspected_are_refused() {
    let folder = hostile_fields();
    for (arguments, offence) in [
        ("good.npy short.npy", "short.npy, step 0 of the file: the pressure of shape [7] does not fit"),
        ("good.npy nan.npy", "nan.npy, step 0 of the file: the pressure at row 0, column 2 is NaN"),
        ("cube.npy", "cube.npy, step 0 of the file: the pressure of shape [2, 2, 8] does not fit"),
        ("sub", "no steps were found"),
        ("none.npy", "cannot read none.npy"),
        ("cut.npy", "cut.npy is not a valid pressure file"),
        ("noise.npz", "noise.npz is not a valid pressure file"),
        ("good.npy --times h.npy", "there are 8 times for 1 steps"),
        ("good.npy --reference short.npy", "does not fit heights"),
        ("--follow none", "cannot read none"),
    ] {
        let line = format!("inspect {SINE} --mean-pressure 0.1 {arguments} --json");
        refuse_in_one_sentence(&folder, &line, offence);
    }
    refuse_in_one_sentence(&folder, &format!("inspect {SINE} good.npy"), "no load is given");
    let nothing = refuse(&folder, &format!("inspect {SINE} --mean-pressure 0.1"));
    assert!(nothing.contains("STEPS"), "{nothing}");
    let idle = refuse(&folder, &format!("inspect {SINE} --mean-pressure 0.1 --follow sub --idle=-1"));
    assert!(idle.contains("seconds"), "{idle}");
}
