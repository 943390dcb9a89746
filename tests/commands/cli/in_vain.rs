//! What would have no effect, or mean something else, is refused or said.

use crate::command::{Folder, text};

const ROUGH: &str = "solve --hurst 0.8 --rolloff 0.125 --short-cutoff 0.02 --rms-gradient 0.1 --points 512 --size 1 --reduced-pressure 0.05";
const CYLINDER: &str = "solve --indenter cylinder --radius 1 --points 256 --size 0.5 --boundary free --modulus 1 --force 0.01 --friction 0.3";

/// The one sentence of a refusal.
fn refused(folder: &Folder, line: &str) -> String {
    let output = folder.run(&format!("{line} --out result.npz"));
    let error = text(&output.stderr).trim().to_owned();
    assert_eq!(output.status.code(), Some(2), "{line}: {error}");
    assert_eq!(error.lines().count(), 1, "{line}: {error}");
    assert!(!folder.join("result.npz").exists(), "{line}");
    error
}

#[test]
fn flags_without_an_effect_are_refused() {
    let folder = Folder::new();
    std::fs::write(folder.join("psd.csv"), "wavenumber,density\n1,1\n100,1e-6\n").unwrap();
    let rough = |rest: &str| format!("{ROUGH} {rest}");
    let cylinder = |rest: &str| format!("{CYLINDER} {rest}");
    for (line, sentence) in [
        (
            rough("--creep 9,1 --path-time 1 --path-steps 3 --time-tolerance 1e-2"),
            "leave the steps out, or the tolerance",
        ),
        (cylinder("--path-tangential 1e-3 --time-tolerance 1e-2"), "only on a solid that creeps"),
        (
            cylinder("--path-tangential 1e-3 --path-steps 2 --path-tolerance 1e-2"),
            "leave the steps out, or the tolerance",
        ),
        (cylinder("--rolling 0 --path-tolerance 1e-2"), "only on a path with friction"),
        (rough("--creep 9,1 --speed 1 --path-steps 3"), "sliding and a path cannot be combined"),
        (
            cylinder("--rolling 0 --solver polonsky-keer"),
            "rolling and a solver other than multilevel cannot be combined",
        ),
        (cylinder("--rolling 0 --time-tolerance 1e-2"), "only on a solid that creeps"),
        (rough("--boundary free --layer 0.1 --poisson 0.3 --datum 5"), "only on a half-space"),
        (rough("--record r.rrd --raster-at 0,0"), "the part raster is not recorded"),
        (rough("--creep 9,1 --path-time 1 --record r.rrd --record-every 2"), "leave it out"),
        (rough("--record r.rrd --record-every 2").replace("0.05", "0.01,0.05"), "leave it out"),
        (rough("--creep 1ms,9 --path-time 1ms"), "`1ms` is a time, but a ratio stands in its place"),
        (rough("--relaxation 0.5,1ms,2ms,0.1 --path-time 1ms"), "`2ms` is a time, but a ratio stands in its place"),
        (rough("--creep 9,1MPa --path-time 1ms"), "1MPa"),
        (
            rough("--creep 9,9ms --path-time 1"),
            "the time of the path 1 has no unit, but the retardation time 9ms has one",
        ),
        (rough("--relaxation 0.5,1ms,0.2,2 --path-time 1ms"), "the relaxation time 2 has no unit"),
        (
            cylinder("--path-tangential 1e-3").replace("0.3", "-1"),
            "the coefficient of friction is -1: give a number above 0",
        ),
        (cylinder("--rolling 0").replace("0.3", "-1"), "the coefficient of friction is -1: give a number above 0"),
    ] {
        let error = refused(&folder, &line);
        assert!(error.contains(sentence), "{line}: {error}");
    }
}

#[test]
fn a_list_in_the_place_of_a_section_is_refused() {
    let folder = Folder::new();
    let scene = |lines: &str| {
        format!(
            "surface.spectrum = {{ hurst = 0.8, rolloff-wavelength = 0.125, short-cutoff = 0.02, rms-gradient = 0.1 }}\n\
             grid = {{ points = 512, size = 1 }}\nload.reduced-pressure = 0.01\n{lines}\n"
        )
    };
    for (lines, section) in [
        ("viscoelastic.creep = [9, 1]\npath = [0, 1]", "path"),
        ("viscoelastic = [9, '9 ms']\npath.time = 1", "viscoelastic"),
        ("friction = [0.3, 0.001]", "friction"),
        ("stop = [1e-6]", "stop"),
        ("law = [0.1]", "law"),
        ("rolling = [1e-4]\nfriction.coefficient = 0.3", "rolling"),
    ] {
        std::fs::write(folder.join("scene.toml"), scene(lines)).unwrap();
        for command in ["solve scene.toml", "study scene.toml"] {
            let error = refused(&folder, command);
            assert!(
                error.contains(&format!("{section}: invalid type: list, expected a section")),
                "{command}: {error}"
            );
        }
    }
}

#[test]
fn what_a_creep_leaves_open_is_said() {
    let folder = Folder::new();
    let two = "--young 1,3 --poisson 0.5,0.5";
    let warnings = |rest: &str| text(&folder.run(&format!("{ROUGH} {rest}")).stderr).to_owned();
    let late = warnings("--creep 9,1 --path-time 1,2 --path-load 0.05,0.02 --path-steps 1");
    assert!(late.contains("begins at the time 1.0, so its first load acts from the time 0 on"), "{late}");
    // what else is told is told of the grid
    for path in ["--path-time 1", "--path-time 0,1"] {
        let told = warnings(&format!("--creep 9,1 {path} --path-steps 1"));
        assert!(told.lines().all(|line| line.contains("on this grid")), "{told}");
    }
    // the compliances of moduli 1 and 3 are as 3 to 1
    for rest in ["--path-time 1 --path-steps 1", "--speed 1"] {
        let shared = warnings(&format!("{two} --creep 9,1 {rest}"));
        assert!(shared.contains("both bodies creep alike") && shared.contains("0.750 for the first"), "{shared}");
    }
    assert!(!warnings("--young 1 --poisson 0.5 --creep 9,1 --path-time 1 --path-steps 1").contains("alike"));
}

#[test]
fn a_file_without_channels_has_none_to_choose() {
    let folder = Folder::new();
    let heights: Vec<f64> = (0..64).map(|i| (f64::from(i) * 0.1).sin()).collect();
    ndarray_npy::write_npy(folder.join("h.npy"), &ndarray::Array1::from(heights)).unwrap();
    let solve = |channel: &str| format!("solve h.npy --size 1 --reduced-pressure 0.01 --channel {channel}");
    for channel in ["3", "Height", "0"] {
        let error = refused(&folder, &solve(channel));
        assert!(error.contains(&format!("without a channel \"{channel}\": leave the channel out")), "{error}");
    }
    assert!(folder.run(&solve("1")).status.success());
}

#[test]
fn as_many_states_as_no_memory_holds_are_refused_by_their_number() {
    let folder = Folder::new();
    for (rest, number) in [
        ("--creep 9,1 --path-time 1 --path-steps 100000000", "100 000 000 states of 512 points need 4.5 TB"),
        ("--creep 9,1 --path-time 0,1 --path-steps 9000000000000000000", "states of 512 points need"),
    ] {
        let error = refused(&folder, &format!("{ROUGH} {rest}"));
        assert!(error.contains(number) && error.ends_with("give fewer steps"), "{error}");
    }
}
