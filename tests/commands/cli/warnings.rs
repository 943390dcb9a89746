//! What makes numbers meaningless is refused or told: a missing modulus, loads and traces that cannot be meant.

use super::*;

/// The lines on standard error that warn.
pub fn warnings(output: &Output) -> Vec<&str> {
    text(&output.stderr).lines().filter_map(|line| line.strip_prefix("warning: ")).collect()
}

#[test]
fn a_mean_pressure_needs_a_modulus_and_may_have_one_of_elastic_constants() {
    let folder = Folder::new();
    for (arguments, load) in
        [(format!("{CYLINDER} --pressure 1e6"), "1000000.0"), (format!("{ROUGH_LINE} --pressure 1MPa --json"), "1MPa")]
    {
        let output = folder.run(&format!("solve {arguments} --out new.npz"));
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        let said = text(&output.stderr);
        let begin = format!("error: the mean pressure {load} is given without a modulus: give");
        assert!(said.starts_with(&begin), "{said}");
        assert!(said.ends_with(" (--modulus, or --young and --poisson)\n"), "{said}");
        assert!(output.stdout.is_empty() && !folder.join("new.npz").exists());
    }
    let (two, _) = solve(&folder, &format!("{ROUGH_LINE} --pressure 1MPa --young 210GPa,70GPa --poisson 0.3,0.2"));
    let expected = 1e9 / (0.91 / 210.0 + 0.96 / 70.0);
    assert_close(number(&two, "contact_modulus"), expected, 1e-14, "two bodies");
    // flags take the place of the other description of the solid
    std::fs::write(folder.join("two.json"), two.to_string()).unwrap();
    for (flags, modulus) in [("--modulus 3GPa", 3e9), ("--young 91GPa --poisson 0.3", 100e9), ("", expected)] {
        let (again, _) = solve(&folder, &format!("--setup-of two.json {flags}"));
        assert_close(number(&again, "contact_modulus"), modulus, 1e-14, flags);
    }
    let told = folder.run(&format!("solve {ROUGH_LINE} --pressure 1MPa --young 91GPa --poisson 0.3"));
    let words = "100 GPa (of one elastic body, E 91 GPa, nu 0.3)";
    assert!(text(&told.stdout).contains(words), "{}", text(&told.stdout));
    let over = folder.run(&format!("solve {ROUGH_LINE} --reduced-pressure 0.01"));
    assert!(
        text(&over.stdout).contains("1.000000e0 (not given: pressures are divided by it)"),
        "{}",
        text(&over.stdout)
    );
}

/// A light contact that is converged by its energy may still have a wrong pressure: by Hertz `p_0 = sqrt(E* F / (pi R))`.
#[test]
fn a_pressure_that_is_not_solved_for_warns() {
    let folder = Folder::new();
    let exact = (1e-5 / std::f64::consts::PI).sqrt();
    for (more, is_loose) in [("--tolerance 1e-4", true), ("--tolerance 1e-4 --pressure-tolerance 0.01", false)] {
        let line = "--indenter cylinder --radius 1 --points 4096 --size 1 --modulus 1 --pressure 1e-5 --solver gfmd";
        let output = folder.run(&format!("solve {line} {more} --json"));
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let is_told =
            warnings(&output).iter().any(|it| it.starts_with("The relative error of the pressure may be 33 %"));
        let error = (number(&json(&output), "max_pressure") / exact - 1.0).abs();
        assert_eq!((is_told, error > 0.1), (is_loose, is_loose), "{more}: {error}, {:?}", warnings(&output));
    }
}

/// Rough steel under 1 MPa would bear 10 GPa where it touches, were it elastic; with the hardness of steel nothing is said, nor for rubber.
#[test]
fn steel_that_would_yield_warns() {
    let folder = Folder::new();
    let line = ROUGH_LINE;
    for (solid, is_told) in [
        ("--young 210GPa --poisson 0.3 --pressure 1GPa", true),
        ("--young 210GPa --poisson 0.3 --pressure 1GPa --hardness 8GPa", false),
        ("--young 3MPa --poisson 0.5 --pressure 14kPa", false),
    ] {
        let output = folder.run(&format!("solve {line} {solid}"));
        let told =
            warnings(&output).iter().any(|it| it.contains("of the contact modulus. Metals yield at lower pressures"));
        assert_eq!(told, is_told, "{solid}: {:?}", text(&output.stderr));
        let strict = folder.run(&format!("solve {line} {solid} --strict")).status.code();
        assert!(!is_told || strict == Some(2), "{strict:?}");
    }
}

/// PMMA under a load that it cannot bear, and slopes that were meant as degrees; what is usual is not told.
#[test]
fn large_strains_warn() {
    let folder = Folder::new();
    let wedge = "--indenter wedge --points 2048 --size 1 --modulus 1";
    let rough = ROUGH_LINE.replace("--rms-gradient 0.1", "--rms-gradient 5");
    let (soft, steep) = ("Nearly all solids yield at lower pressures", "The rms slope of the contact is ");
    for (line, is_soft, is_steep) in [
        (format!("{CYLINDER} --young 3GPa --poisson 0.35 --pressure 0.4GPa"), true, false),
        (format!("{CYLINDER} --young 3GPa --poisson 0.35 --pressure 50MPa"), false, false),
        (format!("{wedge} --slope 5 --pressure 0.1"), true, true),
        (format!("{wedge} --slope 0.0875 --pressure 0.001"), false, false),
        (format!("{ROUGH_LINE} --reduced-pressure 0.1"), false, false),
        (format!("{rough} --reduced-pressure 0.1"), true, true),
        (format!("{rough} --reduced-pressure 0.1 --modulus 1 --hardness 1"), false, true),
    ] {
        let output = folder.run(&format!("solve {line}"));
        let told = |words: &str| warnings(&output).iter().any(|it| it.contains(words));
        assert_eq!([told(soft), told(steep)], [is_soft, is_steep], "{line}: {}", text(&output.stderr));
    }
    // a history is told of as well
    let slides = "solve --indenter cylinder --radius 1 --points 256 --size 4 --boundary free --modulus 1 --force 1 --friction 0.3 --creepage 1e-4";
    let output = folder.run(slides);
    assert!(warnings(&output).iter().any(|it| it.contains(soft)), "{}", text(&output.stderr));
}

/// What is compared with a modulus has a unit only beside a modulus: it would be over one pascal.
#[test]
fn units_need_a_modulus() {
    let folder = Folder::new();
    let line = "--indenter sine --amplitude 1um --points 64 --size 20um --reduced-pressure 0.05";
    std::fs::write(
        folder.join("study.toml"),
        "surface.indenter = { shape = \"sine\", amplitude = 1e-6 }\ngrid = { points = 64, size = 2e-5 }\n\
         load.reduced-pressure = 0.05\nlaw.hardness = [\"1 MPa\", \"2 MPa\"]\n",
    )
    .unwrap();
    for (given, expected) in [
        (format!("solve {line} --hardness 1GPa"), "the hardness 1GPa has a unit, but no modulus is given"),
        (format!("solve {line} --poisson 0.3 --layer 5um --hardness 1GPa"), "the hardness 1GPa has a unit"),
        (format!("solve {line} --adhesion 50mJ/m^2 --adhesion-range 10nm"), "the work of adhesion 50mJ/m^2 has a unit"),
        (
            format!("solve {line} --yield-stress 1MPa --hardening-modulus 1MPa"),
            "give the contact modulus, or Young's modulus and Poisson's ratio",
        ),
        ("study study.toml --out study.csv".into(), "the hardness 1 MPa has a unit"),
    ] {
        let output = folder.run(&given);
        assert_eq!(output.status.code(), Some(2), "{given}");
        assert!(text(&output.stderr).contains(expected), "{given}: {}", text(&output.stderr));
    }
    assert!(!folder.join("study.csv").exists());
    for given in [
        format!("solve {line} --hardness 0.3"),
        format!("solve {line} --hardness 1GPa --modulus 5GPa"),
        format!("solve {line} --hardness 1GPa --young 5GPa --poisson 0.3"),
    ] {
        let output = folder.run(&given);
        assert_eq!(output.status.code(), Some(0), "{given}: {}", text(&output.stderr));
    }
    // the modulus of a scene serves the hardness of a flag
    for given in
        [format!("solve {line} --modulus 5GPa --save-setup saved.toml"), "solve saved.toml --hardness 1GPa".into()]
    {
        let output = folder.run(&given);
        assert_eq!(output.status.code(), Some(0), "{given}: {}", text(&output.stderr));
    }
}

/// Quantities of every kind that has units: a number alone beside one with a unit is refused.
#[test]
fn numbers_beside_units_are_refused_for_every_kind() {
    let folder = Folder::new();
    write_npy(folder.join("h.npy"), &hills([12, 24])).unwrap();
    std::fs::write(folder.join("path.csv"), "time,load\n0,1\n1ms,2kPa\n").unwrap();
    let line = "--indenter sine --amplitude 1um --points 64 --size 20um --modulus 1MPa --pressure 10kPa";
    let two =
        "--indenter sine --amplitude 1um --points 64 --size 20um --young 1MPa,1MPa --poisson 0.3,0.3 --pressure 10kPa";
    for (given, expected) in [
        (
            "--height h.npy --size 1mm --low-pass 5 --modulus 1GPa --pressure 1MPa".into(),
            "the low-pass wavelength 5 has no unit",
        ),
        (
            "--height h.npy --size 1mm --high-pass 5 --modulus 1GPa --pressure 1MPa".into(),
            "the high-pass wavelength 5 has no unit",
        ),
        (format!("{line} --path-load 1,2kPa --creep 1,1ms --path-time 0,1ms"), "the load of the path 1 has no unit"),
        (
            format!("{line} --creep 1,1ms --path path.csv"),
            "row 2: `1` in the column load has no unit, but 2kPa has one",
        ),
        (format!("{line} --creep 1,1ms --speed 1,2m/s"), "the speed 1 has no unit"),
        (format!("{two} --friction 0.3 --path-tangential 5,1kPa"), "the tangential load of the path 5 has no unit"),
        (format!("{line} --bumps 0,1um,2um,3,1um,2um"), "the length of a bump 3 has no unit"),
    ] {
        let output = folder.run(&format!("solve {given}"));
        assert_eq!(output.status.code(), Some(2), "{given}");
        assert!(text(&output.stderr).contains(expected), "{given}: {}", text(&output.stderr));
    }
}

/// Both ends of a range have a unit, or none has, and there are two dots between them.
#[test]
fn ranges_with_one_unit_or_three_dots_are_refused() {
    let folder = Folder::new();
    let line = "--indenter sine --amplitude 1um --points 64 --size 20um --modulus 1MPa";
    for (given, expected) in [
        ("--pressure 1..10kPa:4", "give both with a unit, as in 1kPa..10kPa:4"),
        ("--pressure 1kPa..10:4", "give both with a unit, as in 1kPa..10kPa:4"),
        ("--pressure 10kPa --creep 1,1ms --speed 1..100um/s:3", "as in 1um/s..100um/s:3"),
        ("--pressure 10kPa --creep 1,1ms --path-load 1..2kPa:2 --path-time 1ms,2ms", "as in 1kPa..2kPa:2"),
        ("--reduced-pressure 1e-3...1e-1:3", "give two, as in 1e-3..1e-1:3"),
        ("--reduced-pressure 1e-3....1e-1:3", "give two, as in 1e-3..1e-1:3"),
    ] {
        let output = folder.run(&format!("solve {line} {given}"));
        assert_eq!(output.status.code(), Some(2), "{given}");
        assert!(text(&output.stderr).contains(expected), "{given}: {}", text(&output.stderr));
    }
    for given in ["--pressure 1kPa..10kPa:3", "--reduced-pressure 1e-3..1e-1:3"] {
        let output = folder.run(&format!("solve {line} {given}"));
        assert_eq!(output.status.code(), Some(0), "{given}: {}", text(&output.stderr));
    }
}

/// A force acts on a surface, and a force per length on a line; a number alone beside units would be in newtons.
#[test]
fn forces_have_the_unit_of_their_surface() {
    let folder = Folder::new();
    let line = "--indenter cylinder --radius 10mm --points 256 --size 1mm --modulus 1GPa";
    let surface = "--indenter sphere --radius 10mm --points 16,16 --size 1mm --modulus 1GPa";
    for (given, expected) in [
        (format!("{line} --force 1N"), "the force 1N is not per length, as that on a line is: did you mean 1N/m?"),
        (format!("{line} --force 1N..4N:3"), "did you mean 1N/m?"),
        (
            format!("{surface} --force 10mN/m"),
            "the force 10mN/m is per length, as that on a line is, but this is a surface: did you mean 10mN?",
        ),
        (format!("{surface} --force 10mN --friction 0.3 --tangential 1mN/m"), "did you mean 1mN?"),
        (
            format!("{surface} --force 5"),
            "the force 5 has no unit, but the contact modulus 1GPa has one: give it with a unit, such as 5N",
        ),
        (format!("{line} --force 5"), "such as 5N/m"),
        (
            format!("{surface} --force 5N").replace("1GPa", "1000"),
            "the contact modulus 1000 has no unit, but the force 5N has one: give a unit for every pressure, or for none",
        ),
        (
            format!("{surface} --force 5N").replace("10mm", "10").replace("1mm", "1"),
            "the radius 10 has no unit, but the force 5N has one",
        ),
    ] {
        let output = folder.run(&format!("solve {given}"));
        assert_eq!(output.status.code(), Some(2), "{given}");
        assert!(text(&output.stderr).contains(expected), "{given}: {}", text(&output.stderr));
    }
    for given in [
        format!("{line} --force 1N/m"),
        format!("{surface} --force 10mN"),
        format!("{surface} --force 0.01").replace("1GPa", "1e9").replace("10mm", "0.01").replace("1mm", "0.001"),
        // the tangential load of a pressure is another kind, of which another sentence speaks
        format!("{line} --pressure 1kPa"),
    ] {
        let output = folder.run(&format!("solve {given} --save-setup saved.toml"));
        assert_eq!(output.status.code(), Some(0), "{given}: {}", text(&output.stderr));
        assert_eq!(folder.run("solve saved.toml --modulus 2GPa").status.code(), Some(0), "{given}");
    }
    // heights of a file are a line or a surface
    write_npy(folder.join("h.npy"), &hills([12, 24])).unwrap();
    let said = folder.run("solve --height h.npy --size 1mm --modulus 1GPa --force 1N/m");
    assert!(text(&said.stderr).contains("but this is a surface"), "{}", text(&said.stderr));
    // and studies
    let study = "surface.indenter = { shape = 'cylinder', radius = '10 mm' }\ngrid = { points = [[64], [128]], size = '1 mm' }\n\
                 solid.contact-modulus = '1 GPa'\nload.force = ['1 N', '2 N']\n";
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let said = folder.run("study study.toml --dry-run");
    assert!(
        said.status.code() == Some(2) && text(&said.stderr).contains("did you mean 1 N/m?"),
        "{}",
        text(&said.stderr)
    );
}

#[test]
fn a_load_far_beyond_full_contact_warns() {
    let folder = Folder::new();
    for (load, is_warned) in [("--reduced-pressure 11", true), ("--reduced-pressure 9", false)] {
        let output = folder.run(&format!("solve {ROUGH_LINE} {load} --json"));
        assert_eq!(output.status.code(), Some(0));
        let warned = warnings(&output);
        assert_eq!(warned.iter().any(|it| it.starts_with("The reduced pressure 1.100e1 is far above 1")), is_warned);
        assert_eq!(json(&output)["warnings"], serde_json::json!(warned));
    }
}

#[test]
fn a_trace_that_jumps_across_the_period_warns_until_it_is_detrended() {
    let folder = Folder::new();
    let wave = |i: usize| 1e-2 * (std::f64::consts::TAU * i as f64 / 128.0).cos();
    let tilted = ndarray::Array1::from_shape_fn(1024, |i| wave(i) + 1e-2 * i as f64 / 16.0);
    write_npy(folder.join("h.npy"), &tilted).unwrap();
    for command in ["surface --height h.npy --size 4", "solve --height h.npy --size 4 --reduced-pressure 0.1"] {
        for (detrend, is_warned) in [("", true), ("--detrend mean", true), ("--detrend plane", false)] {
            let output = folder.run(&format!("{command} {detrend} --json"));
            assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
            let (summary, warned) = (json(&output), warnings(&output));
            let jump = summary["jump_in_rms_steps"][0].as_f64().unwrap();
            assert_eq!(jump > 3.0, is_warned, "{command} {detrend}: {jump}");
            assert_eq!(warned.iter().any(|it| it.contains("across the period along x")), is_warned, "{warned:?}");
            assert_eq!(summary["spacing"][0].as_f64().unwrap(), 4.0 / 1024.0);
        }
    }
    // the result repeats itself, by its setup as well as by its heights
    let run = "--height h.npy --size 4 --reduced-pressure 0.1 --detrend plane";
    let (first, fields) = solve(&folder, &format!("{run} --save-setup flat.toml"));
    std::fs::copy(folder.join("contact.npz"), folder.join("first.npz")).unwrap();
    for source in ["flat.toml", "--setup-of first.npz"] {
        let (again, same) = solve(&folder, source);
        assert_eq!(same.pressure, fields.pressure, "{source}");
        assert_eq!(again["jump_in_rms_steps"], first["jump_in_rms_steps"]);
    }
}

#[test]
fn lengths_that_may_be_swapped_and_patches_of_few_nodes_are_told() {
    let folder = Folder::new();
    write_npy(folder.join("h.npy"), &hills([12, 24])).unwrap();
    for (size, is_told) in [("2,4", false), ("4,2", true)] {
        let output = folder.run(&format!("surface --height h.npy --size {size}"));
        let words = "The spacing is 3.3333e-1 along y (rows) and 8.3333e-2 along x (columns)";
        assert_eq!(warnings(&output).iter().any(|it| it.starts_with(words)), is_told, "{}", text(&output.stderr));
        assert!(text(&output.stdout).contains("(rows), x "), "{}", text(&output.stdout));
    }
    for (load, is_told) in [("1e-4", true), ("0.5", false)] {
        let output = folder.run(&format!("solve {ROUGH_LINE} --reduced-pressure {load} --json"));
        let share = number(&json(&output), "unresolved_share");
        assert_eq!(share > 0.25, is_told, "{share}");
        assert_eq!(
            warnings(&output).iter().any(|it| it.contains("is in patches that are too small to trust")),
            is_told
        );
    }
}

#[test]
fn distances_that_fit_the_size_in_no_unit_are_told() {
    let folder = Folder::new();
    let rows: String = (0..100).map(|i| format!("{},{}\n", 0.25 * i as f64, (i as f64 * 0.2).sin())).collect();
    std::fs::write(folder.join("plain.csv"), format!("x,z\n{rows}")).unwrap();
    std::fs::write(folder.join("um.csv"), format!("x (um),z (um)\n{rows}")).unwrap();
    for (given, is_told) in [
        ("plain.csv", false),
        ("plain.csv --size 25", false),
        ("plain.csv --size 24.75", false),
        ("plain.csv --size 25e-6", false),
        ("plain.csv --size 40um", true),
        ("um.csv", false),
        ("um.csv --size 25um", false),
        ("um.csv --size 25", true),
    ] {
        let output = folder.run(&format!("surface {given}"));
        let words = "apart, but the grid has a spacing of";
        let told = warnings(&output).iter().any(|it| it.contains(words));
        assert_eq!(told, is_told, "{given}: {}", text(&output.stderr));
        assert_eq!(output.status.code(), Some(0));
    }
}

/// The plateaus of a clipped profile have no gradient: `kappa_r` is 0.82 on this grid, and 1.67 on fine ones.
#[test]
fn an_error_that_is_not_known_warns() {
    let folder = Folder::new();
    let height = |i: usize| {
        let x = std::f64::consts::PI * i as f64 / 512.0;
        1e-3 * ((6.0 * x).cos() + 0.4 * (14.0 * x + 1.0).cos()).min(0.8)
    };
    write_npy(folder.join("h.npy"), &ndarray::Array1::from_shape_fn(512, height)).unwrap();
    let solve = "solve --height h.npy --size 1 --modulus 1 --reduced-pressure 0.005 --refine 2";
    let output = folder.run(&format!("{solve} --json"));
    assert!(json(&output)["kappa_r_error"].is_null(), "the error is not known");
    let warned = warnings(&output);
    let is_unknown = |it: &&str| it.starts_with("This grid is too coarse for kappa_r and its error estimate");
    assert!(warned.iter().any(is_unknown), "{warned:?}");
    assert_eq!(folder.run(&format!("{solve} --strict")).status.code(), Some(2));
}

/// A punch is flat where it touches, however steep its sides are, and a finer grid gives it no `kappa_r`.
#[test]
fn a_punch_has_no_slope() {
    let folder = Folder::new();
    let output = folder.run("solve --indenter punch --half-width 0.5 --depth 0.1 --points 256 --size 4 --modulus 1 --pressure 1e-3 --verbose");
    let warned = warnings(&output);
    assert!(
        matches!(warned.as_slice(), [one] if one.starts_with("The shape of the surface gives most edges")),
        "{warned:?}"
    );
    assert!(!text(&output.stdout).contains("NaN"), "{}", text(&output.stdout));
}

/// A number alone beside a quantity with a unit would be in pascals or metres.
#[test]
fn numbers_without_units_beside_units_are_refused() {
    let folder = Folder::new();
    let line = format!("solve {CYLINDER} --poisson 0.3");
    let refused = folder.run(&format!("{line} --young 210 --pressure 1kPa"));
    assert_eq!(refused.status.code(), Some(2));
    let sentence = text(&refused.stderr);
    assert!(sentence.contains("Young's modulus 210 has no unit, but the mean pressure 1kPa has one"), "{sentence}");
    let lengths =
        folder.run("solve --indenter sphere --radius 1mm --points 32,32 --size 2 --modulus 1GPa --pressure 1MPa");
    assert!(lengths.status.code() == Some(2) && text(&lengths.stderr).contains("every length"), "{lengths:?}");
    // a unit may end in a digit
    let per_area = folder.run(&format!("{line} --young 210GPa --pressure 1N/mm2"));
    assert_eq!(per_area.status.code(), Some(0), "{}", text(&per_area.stderr));
    // a saved scene has numbers in SI, over which a flag may lay a quantity with a unit
    let saved = folder.run(&format!("{line} --young 210GPa --pressure 1GPa --save-setup scene.toml"));
    assert_eq!(saved.status.code(), Some(0), "{}", text(&saved.stderr));
    assert_eq!(folder.run("solve scene.toml --pressure 2GPa").status.code(), Some(0));
}

/// Units differ by capital letters: a slip is named, and no pressure in millipascals is taken for one in megapascals.
#[test]
fn units_with_wrong_capitals_are_refused_with_the_right_ones() {
    let folder = Folder::new();
    let refused = |given: &str| {
        let output = folder.run(&format!("solve --indenter cylinder --radius 1mm --points 64 --size 4mm {given}"));
        assert_eq!(output.status.code(), Some(2), "{given}");
        text(&output.stderr).to_owned()
    };
    assert!(refused("--modulus 1GPa --pressure 10mPa").contains("`10mPa` is not a pressure: did you mean `10 MPa`?"));
    assert!(refused("--modulus 210GPA --pressure 1MPa").contains("did you mean `210 GPa`?"));
}

/// Keys and flags that there are not are answered by those that are meant; angles have units.
#[test]
fn names_and_angles_are_understood() {
    let folder = Folder::new();
    let rough = "grid = { points = [32, 32], size = 1.0 }\nload.reduced-pressure = 0.1\n[surface.spectrum]\nhurst = 0.8\nshort-cutoff = 0.1\nrms-gradient = 0.1\n";
    let scene = |text: String| {
        std::fs::write(folder.join("scene.toml"), text).unwrap();
        folder.run("solve scene.toml --json")
    };
    let said = scene(format!("{rough}rolloff = 0.5\n"));
    assert!(text(&said.stderr).contains("did you mean `rolloff-wavelength`?"), "{}", text(&said.stderr));
    let said = scene(format!("solid = {{ young = 1e9, nu = 0.3 }}\n{rough}rolloff-wavelength = 0.5\n"));
    assert!(text(&said.stderr).contains("did you mean `poisson`?"), "{}", text(&said.stderr));
    let said = scene(format!("solid = {{ zz = 1e9 }}\n{rough}rolloff-wavelength = 0.5\n"));
    assert!(text(&said.stderr).contains("unknown key `zz`") && !text(&said.stderr).contains("did you mean"));
    for (flag, expected) in
        [("--load 3", "there is no flag --load: name the kind of the load"), ("--nu 0.3", "give --poisson")]
    {
        let said = folder.run(&format!("solve {CYLINDER} {flag}"));
        assert!(said.status.code() == Some(2) && text(&said.stderr).contains(expected), "{}", text(&said.stderr));
        assert_eq!(text(&said.stderr).lines().count(), 1);
    }
    let turned =
        |angle: &str| json(&scene(format!("{rough}rolloff-wavelength = 0.5\npeklenik = 2\nlay-angle = {angle}\n")));
    assert_eq!(turned("30")["kappa_r"], turned("\"30deg\"")["kappa_r"]);
    assert_ne!(turned("30")["kappa_r"], turned("60")["kappa_r"]);
    let wedge = |slope: &str| {
        json(&folder.run(&format!(
            "solve --indenter wedge --slope {slope} --points 256 --size 1 --reduced-pressure 0.1 --json"
        )))
    };
    assert_close(
        number(&wedge("5deg"), "mean_gap"),
        number(&wedge("0.08748866352592401"), "mean_gap"),
        1e-12,
        "5 degrees",
    );
    let said = folder.run("solve --indenter wedge --slope 95deg --points 256 --size 1 --reduced-pressure 0.1");
    assert!(
        said.status.code() == Some(2) && text(&said.stderr).contains("a slope: a number"),
        "{}",
        text(&said.stderr)
    );
}

/// A contact of one node has no gradient, and so no reduced pressure by it.
#[test]
fn what_a_contact_of_one_node_does_not_have_is_absent() {
    let folder = Folder::new();
    let line = "solve --indenter sphere --radius 1 --points 16,16 --size 4 --modulus 1 --pressure 1e-9";
    assert_eq!(folder.run(&format!("{line} --out one.npz")).status.code(), Some(0));
    let mut npz = ndarray_npy::NpzReader::new(File::open(folder.join("one.npz")).unwrap()).unwrap();
    let names = npz.names().unwrap();
    let has = |name: &str| names.iter().any(|it| it == name);
    assert!(has("relative_area") && has("reduced_pressure") && !has("reduced_pressure_contact"), "{names:?}");
    assert_eq!(folder.run(&format!("{line},1e-8 --out one.csv")).status.code(), Some(0));
    let table = std::fs::read_to_string(folder.join("one.csv")).unwrap();
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    assert!(reader.headers().unwrap().iter().all(|it| it != "reduced_pressure_contact"), "{table}");
    assert_eq!(reader.records().count(), 2, "{table}");
    assert!(!table.contains("NaN"), "{table}");
    // heights of which the squares overflow
    write_npy(folder.join("h.npy"), &hills([12, 24]).mapv(|height| 1e300 * height)).unwrap();
    let said = folder.run("solve --height h.npy --size 1 --reduced-pressure 0.1");
    assert!(
        said.status.code() == Some(2) && text(&said.stderr).contains("so large numbers overflow"),
        "{}",
        text(&said.stderr)
    );
}
