//! Passes the commit and the features of the build to the program.
//!
//! The sources of the command line are not watched, so that a change of them does not build the library anew: after such a
//! change alone a working copy names the commit that the rest of it is of.

use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rustc-env=ASPERITY_COMMIT={}", commit());
    println!("cargo::rustc-env=ASPERITY_FEATURES={}", features());
    for path in ["Cargo.toml", ".cargo_vcs_info.json"].into_iter().filter(|path| Path::new(path).exists()) {
        println!("cargo::rerun-if-changed={path}");
    }
    let entries = std::fs::read_dir("src").into_iter().flatten().flatten().map(|entry| entry.path());
    for path in entries.filter(|path| !(path.ends_with("cli") || path.ends_with("main.rs"))) {
        println!("cargo::rerun-if-changed={}", path.display());
    }
}

/// The commit of a working copy or of a package; otherwise the reason why there is none.
fn commit() -> String {
    match std::fs::read_to_string(".cargo_vcs_info.json") {
        Ok(text) => packaged(&text).unwrap_or_else(|| "unknown, of a package without one".into()),
        Err(_) => working_copy().unwrap_or_else(|| "unknown, built without git".into()),
    }
}

/// The commit that a package says it was made from.
fn packaged(text: &str) -> Option<String> {
    let (_, rest) = text.split_once("\"sha1\"")?;
    let sha1 = rest.split('"').nth(1)?;
    Some(format!("{}, of the package", sha1.get(..10)?))
}

/// The commit of the working copy whose root this is, and whether there are changes.
fn working_copy() -> Option<String> {
    let root = git(&["rev-parse", "--show-toplevel"])?;
    let here = std::env::current_dir().ok()?.canonicalize().ok()?;
    if Path::new(&root).canonicalize().ok()? != here {
        return None;
    }
    let commit = git(&["rev-parse", "--short=10", "HEAD"])?;
    let changes = git(&["status", "--porcelain", "--untracked-files=no"])?;
    Some(if changes.is_empty() { commit } else { format!("{commit} with changes") })
}

/// What git says, if it is there and has something to say.
fn git(words: &[&str]) -> Option<String> {
    let output = Command::new("git").args(words).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().into())
}

/// The features that are built in, by their names.
fn features() -> String {
    let names = std::env::vars().filter_map(|(name, _)| Some(name.strip_prefix("CARGO_FEATURE_")?.to_lowercase()));
    let mut names: Vec<String> = names.filter(|name| name != "default").map(|name| name.replace('_', "-")).collect();
    names.sort();
    names.join(", ")
}
