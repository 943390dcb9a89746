//! The lessons as a folder of files: all that they show is there, or nothing.

use assert_cmd::Command;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// A lesson of two steps: a load to turn, and a sweep.
pub const LESSON: &str = r#"
    title = "Two loads"
    knobs = { points = 512, cutoff = 64 }
    turn = { load = [0.02, 0.2] }
    [[step]]
    text = "First."
    [[step]]
    text = "Then."
    knobs.body = "sine"
    knobs.roughness = 0
    turn = { load = [0.05] }
    sweep = true
"#;

fn export(lessons: &Path, site: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.args(["explore", "--lessons"]).arg(lessons).arg("--export").arg(site);
    command
}

fn names(folder: &Path) -> BTreeSet<String> {
    std::fs::read_dir(folder).unwrap().map(|it| it.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn all_that_lessons_show_is_solved_beforehand() {
    let folder = tempfile::tempdir().unwrap();
    let (lessons, site) = (folder.path().join("lessons"), folder.path().join("site"));
    std::fs::create_dir(&lessons).unwrap();
    std::fs::write(lessons.join("two.toml"), LESSON).unwrap();
    let output = export(&lessons, &site).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{told}");
    assert!(told.contains("solving 10 of 10"), "{told}");
    assert_eq!(names(folder.path()), ["lessons", "site"].map(String::from).into());
    let files = names(&site);
    for name in ["index.html", "re_viewer.js", "re_viewer_bg.wasm", "solved.js", "explore.js", "explore.css", "run"] {
        assert!(files.contains(name), "{name} is not among {files:?}");
    }
    let html = std::fs::read_to_string(site.join("index.html")).unwrap();
    assert!(html.contains("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "), "{html}");
    for script in html.split("src=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
        assert!(files.contains(script), "{script} is not among {files:?}");
    }
    let script = std::fs::read_to_string(site.join("solved.js")).unwrap();
    let json = script.trim_start_matches("\"use strict\";\nconst SOLVED = ").trim_end().trim_end_matches(';');
    let solved: Value = serde_json::from_str(json).unwrap();
    let runs = solved["runs"].as_array().unwrap();
    let loads: Vec<f64> =
        runs.iter().filter(|run| run["points"].is_null()).map(|run| run["knobs"]["load"].as_f64().unwrap()).collect();
    assert_eq!((runs.len(), loads.len()), (10, 8), "{loads:?}");
    assert!(loads.contains(&0.02) && loads.contains(&0.2) && loads.contains(&0.05), "{loads:?}");
    for run in runs {
        let id = run["id"].as_str().unwrap();
        assert_eq!(run["ended"], true, "{id}");
        assert!(std::fs::metadata(site.join("run").join(format!("{id}.rrd"))).unwrap().len() > 1000, "{id}");
        let is_sweep = !run["points"].is_null();
        let facets = std::fs::read_to_string(site.join("run").join(format!("{id}.js")));
        let has = |name: &str| facets.as_ref().is_ok_and(|script| script.contains(&format!("\"{name}\":")));
        assert_eq!([has("iterations"), has("section"), has("why"), has("patches")], [!is_sweep; 4], "{id}");
        assert!(has("motion"), "{id}");
        assert!(is_sweep || run["numbers"]["status"] == "converged", "{id}");
    }
    assert_eq!(names(&site.join("run")).len(), 2 * runs.len());
    let of_theme = |theme: &str| runs.iter().filter(|run| run["knobs"]["theme"] == theme).count();
    assert_eq!([of_theme("dark"), of_theme("light")], [5, 5]);
    the_bodies_stand_as_they_press(&site, runs);
    assert_eq!(solved["start"], solved["lessons"][0]["steps"][0]["knobs"]);
}

/// The section of every run: the solid is lower where it is pressed, and the rigid surface of the first step has one shape at all loads.
fn the_bodies_stand_as_they_press(site: &Path, runs: &[Value]) {
    let mut shapes = Vec::new();
    for run in runs.iter().filter(|run| run["points"].is_null()) {
        let id = run["id"].as_str().unwrap();
        let script = std::fs::read_to_string(site.join("run").join(format!("{id}.js"))).unwrap();
        let facets = script.split_once(" = ").unwrap().1.trim_end().trim_end_matches(';');
        let section = serde_json::from_str::<Value>(facets).unwrap()["section"].clone();
        let [rigid, solid, pressure] = ["rigid", "solid", "pressure"]
            .map(|name| section[name].as_array().unwrap().iter().map(|z| z.as_f64().unwrap()).collect::<Vec<_>>());
        let mean = |is_pressed: bool| {
            let (sum, count) = (0..solid.len())
                .filter(|&i| (pressure[i] > 0.0) == is_pressed)
                .fold((0.0, 0.0), |(sum, count), i| (sum + solid[i], count + 1.0));
            sum / count
        };
        assert!(mean(true) < mean(false), "{id}: {} below the contact, {} beside it", mean(true), mean(false));
        if run["knobs"]["body"] == "flat" {
            shapes.push(rigid.iter().map(|z| z - rigid[0]).collect::<Vec<_>>());
        }
    }
    let most = shapes[0].iter().map(|z| z.abs()).fold(0.0, f64::max);
    assert_eq!(shapes.len(), 6);
    for shape in &shapes {
        assert!(
            shape.iter().zip(&shapes[0]).all(|(a, b)| (a - b).abs() < 1e-5 * most),
            "the shape changes with the load"
        );
    }
}

#[test]
fn nothing_is_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let lessons = folder.path().join("lessons");
    std::fs::create_dir(&lessons).unwrap();
    std::fs::write(lessons.join("two.toml"), LESSON).unwrap();
    let file = lessons.join("two.toml");
    for (site, reason) in [
        (&lessons, "it is not empty"),
        (&file, "it is not a readable folder"),
        (&folder.path().join("none/site"), "does not exist: create it first"),
        (&lessons.join(".."), "it is not the name of a folder"),
    ] {
        let output = export(&lessons, site).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(reason) && told.contains(site.to_str().unwrap()), "{reason} is not in {told}");
    }
    assert_eq!(names(folder.path()), ["lessons".to_owned()].into());
    let clash = export(&lessons, &folder.path().join("site")).args(["--port", "9"]).output().unwrap();
    assert_eq!(clash.status.code(), Some(2));
}

/// An export that is interrupted leaves nothing behind.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let lessons = folder.path().join("lessons");
    std::fs::create_dir(&lessons).unwrap();
    let endless = "title = \"T\"\n[[step]]\ntext = \"Wait.\"\nknobs = { solver = { method = \"gfmd\" }, points = 32768, stop = { tolerance = 1e-13, max-iterations = 100000 } }\n";
    std::fs::write(lessons.join("long.toml"), endless).unwrap();
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["explore", "--lessons"])
        .arg(&lessons)
        .arg("--export")
        .arg(folder.path().join("site"))
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let mut told = String::new();
    let mut pipe = std::io::BufReader::new(child.stderr.take().unwrap());
    std::io::BufRead::read_line(&mut pipe, &mut told).unwrap();
    assert_eq!(told, "solving 1 of 2\n");
    std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(1));
    std::io::Read::read_to_string(&mut pipe, &mut told).unwrap();
    assert!(told.contains("the export was interrupted: nothing was written"), "{told}");
    assert_eq!(names(folder.path()), ["lessons".to_owned()].into());
}
