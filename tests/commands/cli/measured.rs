//! Measured heights from the command line: steps that are chosen, warnings that are errors, and what is recorded of a surface.

use super::warnings::warnings;
use super::*;

/// A part of a rough map with a tilt, in micrometres: the heights of neighbours are a step of 0.1 micrometres apart.
fn write_part(folder: &Folder, name: &str) {
    folder.run("surface --hurst 0.8 --rolloff 64 --short-cutoff 8 --rms-gradient 0.1 --points 128,128 --size 128 --out whole.npy");
    let whole: Array2<f64> = read_npy(folder.join("whole.npy")).unwrap();
    let row = |y: usize| {
        let heights = (0..72).map(|x| format!("{:.6}", whole[[y, x]] + 0.2 * x as f64 - 0.1 * y as f64));
        heights.collect::<Vec<_>>().join("\t")
    };
    let rows: Vec<String> = (0..60).map(row).collect();
    let head = "# Channel: Topography\n# Width: 72 µm\n# Height: 60 µm\n# Value units: µm\n";
    std::fs::write(folder.join(name), format!("{head}{}\n", rows.join("\n"))).unwrap();
}

#[test]
fn steps_that_are_chosen_are_said_and_stored_one_by_one() {
    let folder = Folder::new();
    write_part(&folder, "part.txt");
    let tilted = folder.run("solve part.txt --reduced-pressure 0.05 --json");
    assert!(warnings(&tilted).iter().any(|it| it.contains("--prepare auto")), "{}", text(&tilted.stderr));

    let run = "solve part.txt --reduced-pressure 0.05 --json --out auto.npz";
    let chosen = folder.run(&format!("{run} --prepare auto --save-setup auto.toml"));
    assert_eq!(chosen.status.code(), Some(0), "{}", text(&chosen.stderr));
    let reasons: Vec<&str> = text(&chosen.stderr).lines().filter_map(|line| line.strip_prefix("chosen: ")).collect();
    assert!(reasons.len() == 2 && reasons[1].ends_with("they are mirrored along y and x"), "{reasons:?}");
    assert!(!warnings(&chosen).iter().any(|it| it.contains("across the period")), "{}", text(&chosen.stderr));
    let summary = json(&chosen);
    let steps = serde_json::json!({"detrend": "curvature", "mirror": "both"});
    assert_eq!(summary["setup"]["surface"]["prepare"], steps);
    assert_eq!(summary["points"], serde_json::json!([118, 142]));

    let pressure = |name: &str| -> ArrayD<f64> {
        NpzReader::new(File::open(folder.join(name)).unwrap()).unwrap().by_name("pressure.npy").unwrap()
    };
    let again = folder.run("solve auto.toml --json --out again.npz");
    assert!(!text(&again.stderr).contains("chosen: "), "the steps were chosen before: {}", text(&again.stderr));
    assert_eq!(pressure("again.npz"), pressure("auto.npz"));
    // steps that are given are kept
    let plane = folder.run(&format!("{run} --prepare auto --detrend plane --boundary free"));
    assert_eq!(json(&plane)["setup"]["surface"]["prepare"], serde_json::json!({"detrend": "plane"}));
    let refined = folder.run(&format!("{run} --prepare auto --refine auto --area-tolerance 0.2"));
    assert_eq!(refined.status.code(), Some(0), "{}", text(&refined.stderr));
    let short = "surface = { height = \"part.txt\", prepare = \"auto\" }\nload = { reduced-pressure = 0.05 }";
    std::fs::write(folder.join("short.toml"), short).unwrap();
    assert_eq!(
        json(&folder.run("solve short.toml --json"))["setup"]["surface"]["prepare"],
        summary["setup"]["surface"]["prepare"]
    );
    std::fs::write(folder.join("wrong.toml"), "surface = { height = \"part.txt\", prepare.steps = \"all\" }").unwrap();
    let wrong = folder.run("surface wrong.toml");
    assert_eq!(wrong.status.code(), Some(2));
    assert!(text(&wrong.stderr).contains("\"all\" is not a preparation: give \"auto\""), "{}", text(&wrong.stderr));
}

#[test]
fn strict_commands_refuse_what_others_warn_of() {
    let folder = Folder::new();
    write_part(&folder, "part.txt");
    let outputs = "--json --out new.npz --save-setup new.toml";
    for (command, code) in [
        (format!("solve part.txt --reduced-pressure 0.05 {outputs}"), 0),
        (format!("solve part.txt --reduced-pressure 0.05 {outputs} --strict"), 2),
        (format!("solve part.txt --reduced-pressure 1e-2,5e-2 {outputs} --strict"), 2),
        ("surface part.txt --out new.npy --strict".into(), 2),
        ("surface part.txt --prepare auto --out new.npy --strict".into(), 0),
        // a warning of the contact alone
        (format!("solve {ROUGH_LINE} --reduced-pressure 11 {outputs}"), 0),
        (format!("solve {ROUGH_LINE} --reduced-pressure 11 {outputs} --strict"), 2),
    ] {
        let output = folder.run(&command);
        assert_eq!(output.status.code(), Some(code), "{command}: {}", text(&output.stderr));
        for file in ["new.npz", "new.toml", "new.npy"] {
            let is_written = folder.join(file).exists();
            assert_eq!(is_written, code == 0 && command.contains(file), "{command}: {file}");
            std::fs::remove_file(folder.join(file)).ok();
        }
        if code == 2 {
            assert!(output.stdout.is_empty() && text(&output.stderr).lines().last().unwrap().starts_with("error: "));
        }
    }
}

#[test]
fn noise_at_the_spacing_is_told_where_it_makes_the_gradient() {
    let folder = Folder::new();
    let wave = |i: usize| (i as f64 * 0.05).sin();
    for (name, noise, is_told) in [("clean.npy", 0.0, false), ("noisy.npy", 0.05, true)] {
        let heights = ndarray::Array1::from_shape_fn(2048, |i| wave(i) + noise * ((i * i) as f64 * 0.7).sin());
        write_npy(folder.join(name), &heights).unwrap();
        for command in ["surface", "solve --reduced-pressure 0.1"] {
            let output = folder.run(&format!("{command} --height {name} --size 2048 --prepare auto --low-pass 4"));
            let output_raw = folder.run(&format!("{command} --height {name} --size 2048"));
            let told = |output: &Output| warnings(output).iter().any(|it| it.starts_with("Noise at the spacing makes"));
            assert_eq!(told(&output_raw), is_told, "{command} {name}: {}", text(&output_raw.stderr));
            assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        }
        let chosen = folder.run(&format!("surface --height {name} --size 2048 --prepare auto"));
        assert_eq!(text(&chosen.stderr).contains("are filtered out"), is_told, "{}", text(&chosen.stderr));
        assert!(!text(&chosen.stderr).contains("Noise at the spacing makes"), "{}", text(&chosen.stderr));
    }
}

#[test]
fn a_description_says_what_heights_are_like() {
    let folder = Folder::new();
    write_part(&folder, "part.txt");
    let output = folder.run("surface part.txt --scales");
    let out = text(&output.stdout);
    for words in [
        "--prepare auto would do: ",
        "Width                     72 µm",
        "tilt                      -1.1",
        "curvature                 ",
        "noise                     ",
        "smooth along x            below wavelengths of ",
        "distance along y          rms step      rms gradient  rms curvature",
    ] {
        assert!(out.contains(words), "{words} in {out}");
    }
    let survey = &json(&folder.run("surface part.txt --json"))["survey"];
    let [along_y, along_x] = [0, 1].map(|i| survey["tilt"][i].as_f64().unwrap());
    assert!((along_y + 0.1).abs() < 0.02 && (along_x - 0.2).abs() < 0.02, "{along_y}, {along_x}");
    assert_eq!(survey["axes"][1]["scales"][0]["distance"].as_f64().unwrap(), 1e-6);
    assert!(survey["spectrum"].as_array().unwrap().len() > 10);
}

/// A filter that takes off all heights would leave a flat surface.
#[test]
fn a_low_pass_filter_longer_than_the_map_is_refused() {
    let folder = Folder::new();
    folder.run(&format!("surface {ROUGH_LINE} --out line.npy"));
    let filtered = |wavelength: &str| folder.run(&format!("surface line.npy --size 1 --low-pass {wavelength}"));
    assert_eq!(filtered("1").status.code(), Some(0));
    let refused = filtered("1.5");
    let sentence =
        "a low-pass filter at the wavelength 1.5 removes all heights: give at most the longer side of the map, 1.0";
    assert!(refused.status.code() == Some(2) && text(&refused.stderr).contains(sentence), "{}", text(&refused.stderr));
}

/// An archive of NumPy without a setup is one of heights, as with `--height`.
#[test]
fn an_archive_of_heights_stands_for_a_scene() {
    let folder = Folder::new();
    folder.run(&format!("surface {ROUGH_LINE} --out line.npy"));
    let heights: ArrayD<f64> = read_npy(folder.join("line.npy")).unwrap();
    let mut archive = ndarray_npy::NpzWriter::new(File::create(folder.join("other.npz")).unwrap());
    archive.add_array("phase", &(2.0 * &heights)).unwrap();
    archive.add_array("z", &heights).unwrap();
    archive.finish().unwrap();
    let refused = folder.run("solve other.npz --size 1 --reduced-pressure 0.01");
    assert!(text(&refused.stderr).contains("choose one of its channels phase, z"), "{}", text(&refused.stderr));
    let numbers = ["solve other.npz", "solve --height line.npy"].map(|from| {
        let channel = if from.ends_with("npz") { "--channel z" } else { "" };
        let found = folder.run(&format!("{from} {channel} --size 1 --reduced-pressure 0.01 --json"));
        assert_eq!(found.status.code(), Some(0), "{}", text(&found.stderr));
        serde_json::from_slice::<Value>(&found.stdout).unwrap()["relative_area"].clone()
    });
    assert!(numbers[0].is_number() && numbers[0] == numbers[1], "{numbers:?}");
}
