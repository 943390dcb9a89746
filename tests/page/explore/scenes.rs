//! Scenes of setup files on the page.

use super::{Page, with};
use asperity::explore::{Knobs, Lesson, SceneFile};
use asperity::serve::{Explorer, Sessions};
use asperity::setup::{Setup, SetupTable};
use assert_cmd::Command;
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;

/// Heights from a file on a cell with free boundaries, pressed by a force, and an indenter of its own on a layer: as flags of `solve`.
const SCENES: [&str; 2] = [
    "--height heights.npy --detrend plane --size 1mm,1mm --boundary free --young 210GPa --poisson 0.3 --force 2N",
    "--indenter sphere --radius 3mm --hurst 0.7 --rolloff 40um --short-cutoff 10um --rms-gradient 0.01 --seed 7 --points 32,48 \
     --size 120um,180um --young 3GPa --poisson 0.4 --layer 20um --base sliding --pressure 1MPa --solver polonsky-keer",
];

/// Writes a scene by the flags of `solve`.
fn scene(folder: &Path, flags: &str) -> Setup {
    let heights = ndarray::Array2::from_shape_fn((24, 24), |(y, x)| {
        1e-6 * ((0.5 * y as f64).sin() * (0.4 * x as f64).cos() + (1.3 * x as f64 + 0.2 * y as f64).sin())
    });
    ndarray_npy::write_npy(folder.join("heights.npy"), &heights).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .current_dir(folder)
        .arg("solve")
        .args(flags.split_whitespace())
        .args(["--save-setup", "scene.toml"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{flags}: {}", String::from_utf8_lossy(&output.stderr));
    SetupTable::read(&folder.join("scene.toml")).unwrap().setup().unwrap()
}

/// A page that starts with a scene.
fn page(setup: Setup) -> (Page, Value) {
    let scene = SceneFile::new(setup).unwrap();
    let knobs = Knobs::from_scene(&scene).unwrap();
    let explorer = Explorer::new(Arc::new(Sessions::with_scene(scene)), knobs, Lesson::all()).unwrap();
    let page = Page::serve(explorer);
    let start = page.get("/api/start").json();
    (page, start)
}

#[test]
fn a_scene_is_pressed_as_its_setup_says_and_its_load_is_turned() {
    for flags in SCENES {
        let folder = tempfile::tempdir().unwrap();
        let setup = scene(folder.path(), flags);
        let (page, start) = page(setup.clone());
        assert_eq!(start["body"], "scene");
        let run = page.solve(&start);
        assert_eq!(run["numbers"]["status"], "converged", "{flags}");
        let problem = setup.problem().unwrap();
        let contact = setup.solver.solver().solve(&problem, &setup.stop, &mut ()).unwrap();
        let area = run["numbers"]["relative_area"].as_f64().unwrap();
        assert!((area / contact.resolved().relative_area - 1.0).abs() < 1e-4, "{area} for {flags}");
        let mut turned = start.clone();
        turned["load"] = json!(2.0 * start["load"].as_f64().unwrap());
        let run = page.solve(&turned);
        assert!(run["numbers"]["relative_area"].as_f64().unwrap() > 1.05 * area, "{flags}");
        repeats(folder.path(), &run);
        page.order("/api/sweep", &turned);
        assert_eq!(page.wait(|state| state["busy"] == false)["sweep"]["ended"], true);
    }
}

/// Setup and command of a run give its numbers again.
fn repeats(folder: &Path, run: &Value) {
    let saved = folder.join("saved.toml");
    std::fs::write(&saved, run["setup"].as_str().unwrap()).unwrap();
    let line = run["command"].as_str().unwrap().replace('\'', "");
    for arguments in [vec!["solve", saved.to_str().unwrap()], line.split(' ').skip(1).collect()] {
        let output = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .current_dir(folder)
            .args(&arguments)
            .arg("--json")
            .output()
            .unwrap();
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        let repeated: Value = serde_json::from_slice(&output.stdout).unwrap();
        for name in ["kappa_r", "certificate", "iterations"] {
            assert_eq!(run["numbers"][name], repeated[name], "{name} of {arguments:?}");
        }
    }
}

#[test]
fn a_state_of_another_scene_says_that_it_is_not_here() {
    let folder = tempfile::tempdir().unwrap();
    let (_, start) = page(scene(folder.path(), SCENES[1]));
    let sentence = "the scene of this state is not loaded: start asperity explore with its setup file";
    let (elsewhere, _) = page(scene(folder.path(), &SCENES[1].replace("--seed 7", "--seed 8")));
    for page in [Page::open(), elsewhere] {
        for path in ["/api/solve", "/api/sweep"] {
            let refused = page.post(path, &start.to_string());
            assert_eq!((refused.status, refused.text()), (400, sentence), "{path}");
        }
        assert_eq!(page.post("/api/solve", &with(json!({"body": "scene"})).to_string()).text(), sentence);
        assert_eq!(page.solve(&with(json!({"points": 256, "cutoff": 64})))["numbers"]["status"], "converged");
    }
}

#[test]
fn what_solve_refuses_is_refused_in_its_words() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    let sphere = "surface = { indenter = { shape = 'sphere', radius = 1.0 } }\nsolid = { contact-modulus = 1.0 }\n";
    for (text, explores) in [
        ("surface = 1".to_owned(), None),
        (format!("{sphere}grid = {{ points = [16, 16], size = 1.0 }}\n"), None),
        (format!("{sphere}grid = {{ points = [1, 16], size = 1.0 }}\nload = {{ reduced-pressure = 0.1 }}\n"), None),
        ("surface = { height = 'none.npy' }\nload = { reduced-pressure = 0.1 }\n".into(), None),
        (
            format!("{sphere}grid = {{ points = [16, 16], size = 1.0 }}\nload = {{ reduced-pressure = [0.1, 0.2] }}\n"),
            Some("the page solves one load at a time"),
        ),
        (
            format!(
                "{sphere}grid = {{ points = [2048, 1024], size = [2.0, 1.0] }}\nload = {{ reduced-pressure = 0.1 }}\n"
            ),
            Some("2048 x 1024 points are too many for the page: give a scene of at most 1048576"),
        ),
    ] {
        std::fs::write(&file, &text).unwrap();
        let said = |command: &str, more: &[&str]| {
            let output =
                Command::new(env!("CARGO_BIN_EXE_asperity")).arg(command).arg(&file).args(more).output().unwrap();
            (output.status.code(), String::from_utf8(output.stderr).unwrap())
        };
        let explored = said("explore", &["--no-open", "--port", "0"]);
        match explores {
            Some(words) => assert!(explored.0 == Some(2) && explored.1.contains(words), "{text}: {explored:?}"),
            None => assert_eq!(explored, said("solve", &[]), "{text}"),
        }
        assert_eq!(explored.0, Some(2), "{text}: {}", explored.1);
    }
}
