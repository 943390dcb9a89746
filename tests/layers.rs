//! The layers of the crate, held against its source: a file uses its own layer and lower ones, and each large dependency
//! stays in its one place.

use std::path::{Path, PathBuf};

/// Layers by module; the names that the crate root re-exports have the layer of their module.
const LAYERS: &[(&str, u8)] = &[
    ("error", 0),
    ("chunks", 0),
    ("files", 0),
    ("grid", 0),
    ("Grid", 0),
    ("fourier", 0),
    ("surface", 1),
    ("Surface", 1),
    ("Indenter", 1),
    ("elastic", 1),
    ("theory", 1),
    ("contact", 2),
    ("Contact", 2),
    ("Problem", 2),
    ("Stop", 2),
    ("study", 3),
    ("plot", 3),
    ("record", 4),
    ("explore", 5),
    ("cli", 6),
    ("main", 6),
    ("lib", 6),
];

/// The one use of a higher layer: an unconverged contact is inside its error.
const ALLOWED: (&str, &str) = ("error.rs", "use crate::contact::Contact;");

/// Crates, and the only places that may name them.
const PLACES: &[(&str, &[&str])] = &[
    ("rustfft", &["fourier/"]),
    ("realfft", &["fourier/"]),
    ("levenberg_marquardt", &["study/fit.rs"]),
    ("nalgebra", &["study/fit.rs"]),
    ("plotters", &["plot/"]),
    ("png", &["plot/"]),
    ("dejavu", &["plot/"]),
    ("rerun", &["record/"]),
    ("re_web_viewer_server", &["explore/"]),
    ("axum", &["explore/"]),
    ("tokio", &["explore/"]),
    ("futures_util", &["explore/"]),
    ("glam", &["record/"]),
    ("colorgrad", &["record/"]),
    ("clap", &["cli/", "main.rs"]),
    ("indicatif", &["cli/", "main.rs"]),
    ("anyhow", &["cli/", "main.rs"]),
];

const LONGEST_FILE: usize = 450;

/// A source file: its path below `src` and its text.
struct Source {
    path: String,
    text: String,
}

impl Source {
    /// The text without comments, documentation and the use that is allowed.
    fn code(&self) -> String {
        let is_code = |line: &&str| !line.starts_with("//") && (self.path.as_str(), *line) != ALLOWED;
        self.text.lines().map(str::trim).filter(is_code).collect::<Vec<_>>().join("\n")
    }

    /// The module at the top of its path.
    fn module(&self) -> &str {
        self.path.split('/').next().unwrap().trim_end_matches(".rs")
    }
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut folders = vec![root.clone()];
    let mut sources = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path: PathBuf = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let below = path.strip_prefix(&root).unwrap().components();
                let parts: Vec<_> = below.map(|part| part.as_os_str().to_str().unwrap()).collect();
                sources.push(Source { path: parts.join("/"), text: std::fs::read_to_string(&path).unwrap() });
            }
        }
    }
    assert!(sources.len() > 30, "only {} files found", sources.len());
    sources
}

fn layer(name: &str) -> u8 {
    let found = LAYERS.iter().find(|(module, _)| *module == name);
    found.unwrap_or_else(|| panic!("{name} has no layer: give it one in this test")).1
}

/// Names, `::` and single marks.
fn tokens(code: &str) -> Vec<String> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let apart: String = code.chars().map(|c| if is_name(c) { c.into() } else { format!(" {c} ") }).collect();
    apart.replace("::", " :: ").split_whitespace().map(str::to_owned).collect()
}

/// What follows `crate::`: modules, or names that the root re-exports.
fn uses(code: &str) -> Vec<String> {
    let tokens = tokens(code);
    let from_root = |i: usize| match tokens.get(i + 2)?.as_str() {
        _ if tokens[i] != "crate" || tokens[i + 1] != "::" => None,
        "{" => Some(heads(&tokens[i + 2..])),
        name => Some(vec![name.to_owned()]),
    };
    (0..tokens.len()).filter_map(from_root).flatten().collect()
}

/// The first names of the paths in a group of braces.
fn heads(group: &[String]) -> Vec<String> {
    let mut depth = 0;
    let mut heads = Vec::new();
    for pair in group.windows(2) {
        depth += i32::from(pair[0] == "{") - i32::from(pair[0] == "}");
        match pair[0].as_str() {
            _ if depth == 0 => break,
            "{" | "," if depth == 1 && pair[1] != "}" => heads.push(pair[1].clone()),
            _ => {}
        }
    }
    heads
}

/// Whether code names a crate: at the start of a path, or in a bare `use`.
fn names(code: &str, name: &str) -> bool {
    let tokens = tokens(code);
    let is_named = |i: usize| match (i.checked_sub(1).map(|i| tokens[i].as_str()), tokens.get(i + 1)) {
        (Some("::"), _) => false,
        (Some("use"), _) => true,
        (_, next) => next.is_some_and(|next| next == "::"),
    };
    (0..tokens.len()).any(|i| tokens[i] == name && is_named(i))
}

#[test]
fn files_use_their_own_layer_and_lower_ones() {
    for source in sources() {
        let own = layer(source.module());
        for used in uses(&source.code()) {
            assert!(layer(&used) <= own, "{} is in layer {own} and uses crate::{used}", source.path);
        }
    }
}

#[test]
fn uses_are_seen_in_every_form() {
    assert_eq!(uses("use crate::contact::{Problem, chunks};"), ["contact"]);
    assert_eq!(uses("pub(super) use crate::record;"), ["record"]);
    assert_eq!(uses("let x = f(crate::grid::Grid::line(4, 1.0), crate::Stop::default());"), ["grid", "Stop"]);
    assert_eq!(uses("use crate::{Grid, contact::{self, Step}, theory};"), ["Grid", "contact", "theory"]);
    assert_eq!(uses("use crate::{\n    contact::Step,\n    theory::{Exact, crate_::x},\n};"), ["contact", "theory"]);
    assert!(uses("use super::crates::x;").is_empty());
    assert!(names("use rerun::{RecordingStream};", "rerun") && names("let v = glam::Vec3::ZERO;", "glam"));
    assert!(names("use clap;", "clap") && names("#[derive(clap::Args)]", "clap"));
    assert!(
        !names("open it with `rerun {0}`", "rerun") && !names("my_rerun::x", "rerun") && !names("a::clap::b", "clap")
    );
}

#[test]
fn large_dependencies_stay_in_their_places() {
    let sources = sources();
    for &(name, places) in PLACES {
        let named: Vec<&str> =
            sources.iter().filter(|source| names(&source.code(), name)).map(|source| source.path.as_str()).collect();
        assert!(!named.is_empty(), "{name} is named nowhere");
        for path in named {
            assert!(
                places.iter().any(|place| path.starts_with(place)),
                "{path} names {name}, which belongs in {places:?}"
            );
        }
    }
}

#[test]
fn files_are_short_and_say_what_they_are() {
    for source in sources() {
        let lines = source.text.lines().count();
        assert!(lines <= LONGEST_FILE, "{} has {lines} lines", source.path);
        assert!(source.text.starts_with("//! "), "{} does not begin with its documentation", source.path);
    }
}
