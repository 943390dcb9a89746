//! One setup by command line, study, page and library: the same numbers to the bit, and the same warnings.

use super::{Page, said};
use asperity::explore::{Knobs, Lesson, SceneFile};
use asperity::job::Job;
use asperity::serve::{Explorer, Sessions};
use asperity::setup::SetupTable;
use assert_cmd::Command;
use serde_json::Value;
use std::path::Path;
use std::sync::Arc;

/// Measured heights that are prepared and refined, under a load at which a part yields, on few nodes.
const SCENE: &str = r#"
[surface]
height = "heights.npy"
prepare = { detrend = "plane", mirror = "both" }
[grid]
size = [1e-3, 1e-3]
refine = 2
[solid]
contact-modulus = 1e9
[law]
hardness = 3e7
[load]
reduced-pressure = 0.02
"#;

const NUMBERS: [&str; 5] = ["mean_pressure", "relative_area", "kappa_r", "max_pressure", "certificate"];

fn heights(folder: &Path) {
    let heights = ndarray::Array2::from_shape_fn((24, 24), |(y, x)| {
        let [y, x] = [y, x].map(|i| i as f64);
        1e-5 * ((0.5 * y).sin() * (0.4 * x).cos() + (1.3 * x + 0.2 * y).sin()) + 1e-6 * x
    });
    ndarray_npy::write_npy(folder.join("heights.npy"), &heights).unwrap();
    std::fs::write(folder.join("scene.toml"), SCENE).unwrap();
}

fn run(folder: &Path, line: &str) -> Vec<u8> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    let output = command.current_dir(folder).args(line.split(' ')).output().unwrap();
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// The statements of warnings, which stand before what each front end says of the remedy.
fn statements(warnings: &[String]) -> Vec<&str> {
    warnings.iter().map(|it| it.rsplit_once(". ").unwrap().0).collect()
}

fn texts(list: &Value) -> Vec<String> {
    list.as_array().unwrap().iter().map(|it| it.as_str().unwrap().to_owned()).collect()
}

#[test]
fn one_setup_gives_the_same_numbers_and_warnings_everywhere() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    heights(folder);

    let command_line: Value =
        serde_json::from_slice(&run(folder, "solve scene.toml --json --save-setup saved.toml")).unwrap();
    let setup = SetupTable::read(&folder.join("saved.toml")).unwrap().setup().unwrap();
    let solved = Job::new(setup.clone()).run(&mut ()).unwrap().solved.swap_remove(0);
    let observables = serde_json::to_value(asperity::contact::Observables::new(&solved.contact)).unwrap();

    run(folder, "study scene.toml --out study.csv");
    let mut table = csv::Reader::from_path(folder.join("study.csv")).unwrap();
    let row: std::collections::HashMap<String, String> = table.deserialize().next().unwrap().unwrap();

    let scene = SceneFile::new(setup).unwrap();
    let knobs = Knobs::from_scene(&scene).unwrap();
    let explorer = Explorer::new(Arc::new(Sessions::with_scene(scene)), knobs, Lesson::all()).unwrap();
    let page = Page::serve(explorer);
    let shown = page.solve(&page.get("/api/start").json());

    for name in NUMBERS {
        let number = observables[name].as_f64().unwrap();
        assert_eq!(command_line[name].as_f64(), Some(number), "{name} on the command line");
        assert_eq!(shown["numbers"][name].as_f64(), Some(number), "{name} on the page");
        assert_eq!(row[name].parse(), Ok(number), "{name} of the study");
    }
    let own: Vec<String> = solved.warnings().iter().map(ToString::to_string).collect();
    assert!(!own.is_empty(), "a contact of few nodes is doubtful");
    assert_eq!(statements(&texts(&command_line["warnings"])), statements(&own));
    let shown = shown["warnings"].as_array().unwrap();
    assert_eq!(shown.iter().map(|it| said(&it["statement"])).collect::<Vec<_>>(), statements(&own));
}
