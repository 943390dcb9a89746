//! The licences of what is in the program.

use super::*;
use std::collections::BTreeSet;
use std::path::Path;

/// A file of this repository that is written in TOML.
fn table(name: &str) -> toml::Table {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).unwrap().parse().unwrap()
}

/// The versions of a crate in the lock file.
fn locked(lock: &toml::Table, name: &str) -> Vec<String> {
    let packages = lock["package"].as_array().unwrap().iter().filter(|package| package["name"].as_str() == Some(name));
    packages.map(|package| package["version"].as_str().unwrap().to_owned()).collect()
}

/// Each crate that the program or the package for Python names as a dependency is listed with its version: a file that is older than
/// the lock file fails here, also where `cargo-about` is not there to make it again.
#[test]
fn all_direct_dependencies_are_listed_with_their_versions() {
    let output = Folder::new().run("licences");
    let printed = text(&output.stdout);
    assert!(output.status.success() && output.stderr.is_empty(), "{}", text(&output.stderr));
    let listed: BTreeSet<&str> = printed.lines().filter_map(|line| line.strip_prefix("  ")).collect();
    let lock = table("Cargo.lock");
    for manifest in ["Cargo.toml", "python/Cargo.toml"] {
        for (name, dependency) in table(manifest)["dependencies"].as_table().unwrap() {
            if dependency.get("path").is_some() {
                continue;
            }
            let versions = locked(&lock, name);
            let is_listed = versions.iter().any(|version| listed.contains(format!("{name} {version}").as_str()));
            assert!(is_listed, "{name} {versions:?} is not in assets/licences.txt: run .ci/licences");
        }
    }
}

#[test]
fn licences_are_printed_whole() {
    let output = Folder::new().run("licences");
    let printed = text(&output.stdout);
    // Passages of licences that have to come with a program: of libraries, of their notices, and of fonts.
    for passage in [
        "TERMS AND CONDITIONS FOR USE, REPRODUCTION, AND DISTRIBUTION",
        "Mozilla Public License Version 2.0",
        "This product includes software developed at",
        "Bitstream Vera Fonts Copyright",
        "SIL OPEN FONT LICENSE Version 1.1",
        "UBUNTU FONT LICENCE Version 1.0",
    ] {
        assert!(printed.contains(passage), "{passage}");
    }
    assert!(!printed.contains(char::REPLACEMENT_CHARACTER), "a character was not printed as it is");
}
