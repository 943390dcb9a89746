//! The page as a folder of files: all that it needs is there, or nothing.

use assert_cmd::Command;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::io::Write;
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

/// A folder with a lesson, and the name of a site in it.
fn lessons(folder: &Path, text: &str) -> [std::path::PathBuf; 2] {
    let lessons = folder.join("lessons");
    std::fs::create_dir(&lessons).unwrap();
    std::fs::write(lessons.join("two.toml"), text).unwrap();
    [lessons, folder.join("site")]
}

/// The value in a script of a site.
fn data(site: &Path, script: &str) -> Value {
    let script = std::fs::read_to_string(site.join(script)).unwrap();
    let json = script.split_once(" = ").unwrap().1.trim_end().trim_end_matches(';');
    serde_json::from_str(json).unwrap()
}

/// The value in a script of a site that is packed.
fn unpacked(site: &Path, script: &str) -> Value {
    let script = std::fs::read_to_string(site.join(script)).unwrap();
    let packed = script.split_once(" = \"").unwrap().1.split_once('"').unwrap().0;
    let bytes = BASE64_STANDARD.decode(packed).unwrap();
    serde_json::from_reader(flate2::read::GzDecoder::new(&bytes[..])).unwrap()
}

/// What every site has.
const FILES: [&str; 13] = [
    "index.html",
    "explore.js",
    "en.js",
    "de.js",
    "explore.css",
    "favicon.svg",
    "module.js",
    "module.packed",
    "site.js",
    "section.js",
    "lessons.js",
    "offline.js",
    "licences.txt",
];

#[test]
fn a_site_has_all_that_the_page_loads_and_recordings_of_its_lessons() {
    let folder = tempfile::tempdir().unwrap();
    let [lessons, site] = lessons(folder.path(), LESSON);
    let output = export(&lessons, &site).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{told}");
    assert!(told.contains("recording 10 of 10"), "{told}");
    assert_eq!(names(folder.path()), ["lessons", "site"].map(String::from).into());
    let files = names(&site);
    assert_eq!(
        files,
        FILES.into_iter().chain(["re_viewer.js", "re_viewer_bg.wasm", "run"]).map(String::from).collect()
    );
    let html = std::fs::read_to_string(site.join("index.html")).unwrap();
    assert!(html.contains("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "), "{html}");
    for script in html.split("src=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
        assert!(files.contains(script), "{script} is not among {files:?}");
    }
    let lessons = unpacked(&site, "lessons.js");
    let [english, german] =
        [include_str!("../../../assets/explore/texts/en.json"), include_str!("../../../assets/explore/texts/de.json")];
    let [english, german]: [Value; 2] = [english, german].map(|json| serde_json::from_str(json).unwrap());
    assert_eq!(unpacked(&site, "en.js")["texts"], english);
    assert_eq!(unpacked(&site, "de.js")["texts"], german);
    let script = std::fs::read_to_string(site.join("explore.js")).unwrap();
    for texts in [&english, &german] {
        assert!(!script.contains(texts["lesson.none"].as_str().unwrap()), "the texts are scripts of their own");
    }
    let data = data(&site, "site.js");
    let recorded = data["recorded"].as_array().unwrap();
    for run in recorded {
        let id = run["id"].as_str().unwrap();
        assert!(std::fs::metadata(site.join("run").join(format!("{id}.rrd"))).unwrap().len() > 1000, "{id}");
    }
    assert_eq!((recorded.len(), names(&site.join("run")).len()), (10, 10));
    let loads =
        recorded.iter().filter(|run| run["is_sweep"] == false).map(|run| run["knobs"]["load"].as_f64().unwrap());
    let loads: BTreeSet<String> = loads.map(|load| load.to_string()).collect();
    assert_eq!(loads, ["0.02", "0.05", "0.2"].map(String::from).into());
    let of_theme = |theme: &str| recorded.iter().filter(|run| run["knobs"]["theme"] == theme).count();
    assert_eq!([of_theme("dark"), of_theme("light")], [5, 5]);
    assert_eq!(lessons[0]["steps"].as_array().unwrap().len(), 2);
    let offline = std::fs::read_to_string(site.join("offline.js")).unwrap();
    assert!(
        offline.contains("\"module.packed\"")
            && !offline.contains("\"module.js\"")
            && !offline.contains("re_viewer")
            && !offline.contains("{mark}"),
        "{offline}"
    );
}

#[test]
fn a_site_without_recordings_has_a_first_picture_and_no_viewer() {
    let folder = tempfile::tempdir().unwrap();
    let [lessons, site] = lessons(folder.path(), LESSON);
    let output = export(&lessons, &site).args(["--no-recordings", "hertz-line"]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(names(&site), FILES.map(String::from).into());
    let data = data(&site, "site.js");
    assert_eq!((&data["recorded"], &data["start"]["body"]), (&json!([]), &json!("round")));
    assert_eq!(data["first"]["run"]["numbers"]["status"], "converged");
    let section = unpacked(&site, "section.js");
    let [solid, pressure] = ["solid", "pressure"].map(|name| {
        let values = section[name].as_array().unwrap().iter();
        values.map(|z| z.as_f64().unwrap()).collect::<Vec<_>>()
    });
    let mean = |is_pressed: bool| {
        let chosen: Vec<f64> =
            (0..solid.len()).filter(|&i| (pressure[i] > 0.0) == is_pressed).map(|i| solid[i]).collect();
        chosen.iter().sum::<f64>() / chosen.len() as f64
    };
    assert!(mean(true) < mean(false), "the solid is lower where it is pressed");
}

/// The bytes of a file of a site as a web server sends them.
fn sent(path: &Path) -> usize {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(&std::fs::read(path).unwrap()).unwrap();
    encoder.finish().unwrap().len()
}

/// What a browser loads of a site with all lessons, and what of that before its first picture. The licences, and the module in a script for pages
/// that are opened from a folder, lie beside it.
#[test]
fn a_site_is_small() {
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site");
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.args(["explore", "--no-recordings", "--export"]).arg(&site).assert().success();
    let loaded = FILES.iter().filter(|name| !["licences.txt", "module.js"].contains(name));
    let size: u64 = loaded.map(|name| std::fs::metadata(site.join(name)).unwrap().len()).sum();
    let html = std::fs::read_to_string(site.join("index.html")).unwrap();
    let scripts = html.split("<script src=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let first: usize = scripts.chain(["index.html", "explore.css"]).map(|name| sent(&site.join(name))).sum();
    println!("the whole site has {size} bytes, {first} of them are sent before the first picture");
    assert!(size < 1_900_000 && first < 150_000, "{size} bytes, {first} before the first picture");
}

#[test]
fn states_that_are_too_large_for_a_browser_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [lessons, site] = lessons(folder.path(), &LESSON.replace("points = 512", "points = 131072"));
    let output = export(&lessons, &site).output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(told.contains("a step of the lesson two has 131072 points") && told.contains("at most 65536"), "{told}");
    assert!(!site.exists());
}

#[test]
fn nothing_is_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let [lessons, _] = lessons(folder.path(), LESSON);
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
    let site = folder.path().join("site");
    for (arguments, reason) in
        [(&["--port", "9"][..], "cannot be used with"), (&["scene.toml"], "a site cannot begin with a scene")]
    {
        let clash = export(&lessons, &site).args(arguments).output().unwrap();
        let told = String::from_utf8(clash.stderr).unwrap();
        assert_eq!(clash.status.code(), Some(2), "{told}");
        assert!(told.contains(reason), "{told}");
    }
    let alone = Command::new(env!("CARGO_BIN_EXE_asperity")).args(["explore", "--no-recordings"]).output().unwrap();
    assert_eq!(alone.status.code(), Some(2));
}

/// An export that is interrupted leaves nothing behind.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let endless = "title = \"T\"\n[[step]]\ntext = \"Wait.\"\nknobs = { solver = { method = \"gfmd\" }, points = 32768, stop = { tolerance = 1e-13, max-iterations = 100000 } }\n";
    let [lessons, site] = lessons(folder.path(), endless);
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["explore", "--lessons"])
        .arg(&lessons)
        .arg("--export")
        .arg(site)
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let mut told = String::new();
    let mut pipe = std::io::BufReader::new(child.stderr.take().unwrap());
    std::io::BufRead::read_line(&mut pipe, &mut told).unwrap();
    assert_eq!(told, "recording 1 of 2\n");
    std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(1));
    std::io::Read::read_to_string(&mut pipe, &mut told).unwrap();
    assert!(told.contains("the export was interrupted: nothing was written"), "{told}");
    assert_eq!(names(folder.path()), ["lessons".to_owned()].into());
}
