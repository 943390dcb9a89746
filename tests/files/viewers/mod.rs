//! Recordings in the viewers, and under the readers, of the versions of the SDK in `versions.txt`, or of those that the
//! variable `VIEWERS` names.
//!
//! Each version gets a virtual environment of Python of its own, which is kept for the next time. Where there is no Python with
//! pip, no such package, or no driver to draw with, the test says so and passes; the line `viewers: 0.36.3 ok` tells what came out.

mod python;
mod spoiled;

use crate::kinds;
use python::{Python, Skipped};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The versions that a recording must open in: that of our own SDK, and the newest one that was tried.
const VERSIONS: &str = include_str!("versions.txt");
const GUIDE: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/guide/recordings.md"));

/// The end of the program of the guide: asserts that it has read what it says.
const ASSERTIONS: &str = "
assert certificate[last][0] <= 1e-8, certificate
assert len(x[last]) == len(pressure[last]) == 513 and max(pressure[last]) > 0, (x, pressure)
";

/// Says a line past the capture of tests that pass.
fn say(line: &str) {
    writeln!(std::io::stderr(), "{line}").ok();
}

fn versions() -> Vec<String> {
    let named = std::env::var("VIEWERS").unwrap_or_else(|_| VERSIONS.into());
    named.split_whitespace().map(str::to_owned).collect()
}

#[test]
fn recordings_open_with_their_data_and_are_read_by_every_version() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = kinds::record(kinds::KINDS, folder.path());
    let (mut told, mut wrong) = (Vec::new(), Vec::new());
    for version in versions() {
        match tried(&version, &recordings, folder.path()) {
            Err(Skipped(reason)) => told.push(format!("{version} *skipped*, {reason}")),
            Ok(complaints) => {
                told.push(format!("{version} {}", if complaints.is_empty() { "ok" } else { "FAILED" }));
                wrong.extend(complaints.iter().map(|complaint| format!("{version}: {complaint}")));
            }
        }
    }
    say(&format!("viewers: {}", told.join("; ")));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is wrong with the recordings in a version.
fn tried(version: &str, recordings: &[PathBuf], folder: &Path) -> Result<Vec<String>, Skipped> {
    let python = Python::new(version)?;
    let mut wrong = python.look(recordings)?;
    if python.minds_two_types() {
        wrong.extend(spoiled_passes(&python, &recordings[0], folder)?);
    }
    wrong.extend(python.fails(&snippet(), folder));
    wrong.extend(query_fails(&python, recordings, folder));
    Ok(wrong)
}

/// Says so if a recording in which a component has two types is not found to be complained of and empty.
fn spoiled_passes(python: &Python, line: &Path, folder: &Path) -> Result<Option<String>, Skipped> {
    let spoiled = folder.join("spoiled.rrd");
    spoiled::write(line, &spoiled);
    let found = python.look(&[spoiled])?.join("\n");
    let is_found = found.contains("patch_kappa_r") && found.contains("shows no data");
    Ok((!is_found).then(|| format!("a recording with a component of two types: {found}")))
}

/// The program of the guide that reads a recording.
fn snippet() -> String {
    let blocks = GUIDE.split("```python\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let program = blocks.into_iter().find(|block| block.contains("RrdReader")).unwrap();
    program.replace("profile.rrd", "line.rrd") + ASSERTIONS
}

/// What is wrong with the table of a folder of recordings that the example makes.
fn query_fails(python: &Python, recordings: &[PathBuf], folder: &Path) -> Option<String> {
    let runs = folder.join("runs");
    std::fs::create_dir_all(&runs).unwrap();
    std::fs::copy(&recordings[0], runs.join("line.rrd")).unwrap();
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/query_recordings.py");
    let output = python.run(&[example.as_path(), &runs], folder);
    let words = String::from_utf8_lossy(&output.stdout);
    let is_fine = words.contains("kappa_r") && words.contains("multilevel") && words.contains("converged");
    (!is_fine).then(|| format!("{}: {words}{}", example.display(), String::from_utf8_lossy(&output.stderr)))
}
