//! `asperity patches`: results and scenes, one contact and several.

use super::*;
use crate::rows::assert_refused;
use std::fs;

const SCENE: &str =
    "surface = { spectrum = { hurst = 0.8, rolloff-wavelength = 0.25, short-cutoff = 0.06, rms-gradient = 0.1 } }
grid = { points = [64, 64], size = 1.0 }
load = { reduced-pressure = \"1e-2..0.5:6\" }
";

#[test]
fn a_result_and_its_scene_have_the_same_patches() {
    let folder = Folder::new();
    fs::write(folder.join("scene.toml"), SCENE).unwrap();
    assert!(folder.run("solve scene.toml --out run.npz").status.success());
    let read = json(&folder.run("patches run.npz --json --out read.csv"));
    let solved = json(&folder.run("patches scene.toml --json --out solved.csv"));
    assert_eq!((&read["states"], &read["events"]), (&solved["states"], &solved["events"]));
    let table = fs::read_to_string(folder.join("read.csv")).unwrap();
    assert_eq!(table, fs::read_to_string(folder.join("solved.csv")).unwrap());
    let states = read["states"].as_array().unwrap();
    let events = read["events"].as_array().unwrap();
    let patches = |state: &serde_json::Value| state["patches"].as_array().unwrap().clone();
    assert_eq!((states.len(), table.lines().count() - 1), (6, states.iter().map(|it| patches(it).len()).sum()));
    assert!(table.starts_with("state,patch,nodes,area,load,load_share,kappa_r,x,y,begin,begin_patch,end,end_patch\n"));
    assert!(events.iter().filter(|it| it["event"] == "merged").count() > 5, "{events:?}");
    assert_eq!(table.matches(",merged,").count(), events.iter().filter(|it| it["event"] == "merged").count());
    for state in states {
        // the patches carry all
        let load: f64 = patches(state).iter().map(|it| it["load"].as_f64().unwrap()).sum();
        assert!((load / state["mean_pressure"].as_f64().unwrap() - 1.0).abs() < 1e-12);
        let sizes = state["sizes"].as_array().unwrap();
        let count: u64 = sizes.iter().map(|it| it["patches"].as_u64().unwrap()).sum();
        assert_eq!(count as usize, patches(state).len());
    }
    let said = folder.run("patches run.npz");
    let said = text(&said.stdout);
    for words in ["carries most", "the largest first", "Sizes in state 6", "What happened", "have taken in"] {
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn patches_of_one_contact_have_no_events() {
    let folder = Folder::new();
    let line = "--indenter sine --amplitude 0.01 --points 256 --size 1 --reduced-pressure 0.1";
    let found = json(&folder.run(&format!("patches {line} --json")));
    let states = found["states"].as_array().unwrap();
    assert_eq!((states.len(), found["events"].as_array().unwrap().len()), (1, 0));
    let [patch] = states[0]["patches"].as_array().unwrap().as_slice() else { panic!("one patch: {states:?}") };
    assert_eq!((patch["patch"].as_u64(), patch["load"].as_f64()), (Some(1), states[0]["mean_pressure"].as_f64()));
    let said = folder.run(&format!("patches {line}"));
    assert!(!text(&said.stdout).contains("What happened") && text(&said.stdout).contains("The 1 patch in state 1"));
}

#[test]
fn what_has_no_patches_is_refused() {
    let folder = Folder::new();
    fs::write(folder.join("scene.toml"), SCENE).unwrap();
    fs::write(folder.join("study.toml"), SCENE.replace("0.8", "[0.7, 0.8]")).unwrap();
    fs::write(folder.join("no.npz"), "no").unwrap();
    for (line, words) in [
        ("patches no.npz", "no.npz"),
        ("patches missing.npz", "missing.npz"),
        ("patches study.toml", "this scene is a study"),
        ("patches scene.toml --refine auto", "give a number for --refine"),
        ("patches scene.toml --out scene.toml", ".csv"),
        ("patches scene.toml --out x.txt", ".csv"),
    ] {
        assert_refused(&folder.run(line), &[words]);
    }
}
