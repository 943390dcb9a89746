//! The layers of the crate, held against its source: a file uses its own layer and lower ones, nothing goes round in a circle,
//! and each large dependency stays in its one place.

mod functions;
mod source;
mod types;
mod uses;

use source::{Source, names, tokens};
use std::collections::{BTreeMap, BTreeSet};
use uses::{Uses, circles};

/// Layers by room.
const LAYERS: &[(&str, u8)] = &[
    ("anderson", 0),
    ("chunks", 0),
    ("clock", 0),
    ("digest", 0),
    ("error", 0),
    ("files", 0),
    ("forest", 0),
    ("memory", 0),
    ("quantity", 0),
    ("seen", 0),
    ("sentence", 0),
    ("warning", 0),
    ("fourier", 1),
    ("grid", 1),
    ("elastic", 2),
    ("formats", 2),
    ("surface", 2),
    ("theory", 2),
    ("contact", 3),
    ("adhesion", 4),
    ("diagnosis", 4),
    ("flow", 4),
    ("foreign", 4),
    ("history", 4),
    ("setup", 4),
    ("plot", 5),
    ("study", 5),
    ("record", 6),
    ("job", 7),
    ("explore", 8),
    ("guide", 10),
    ("lab", 8),
    ("paper", 8),
    ("serve", 9),
    ("cli", 10),
    ("lib", 10),
    ("main", 10),
];

/// Crates, and the only places that may name them.
const PLACES: &[(&str, &[&str])] = &[
    ("anyhow", &["cli/", "main.rs"]),
    ("axum", &["serve/"]),
    ("base64", &["plot/svg.rs", "serve/packed.rs"]),
    ("clap", &["cli/", "main.rs"]),
    ("clap_complete", &["cli/completions.rs"]),
    ("clap_mangen", &["cli/man.rs"]),
    ("colorgrad", &["record/"]),
    ("csv", &["files/", "study/", "paper/"]),
    ("dejavu", &["plot/"]),
    ("flate2", &["formats/", "plot/", "serve/"]),
    ("futures_util", &["serve/"]),
    ("glam", &["record/"]),
    ("indicatif", &["cli/", "main.rs"]),
    (
        "libm",
        &["theory/", "contact/forecast.rs", "contact/multilevel/split.rs", "paper/fit.rs", "setup/expected_area.rs"],
    ),
    ("ndarray_npy", &["contact/archive.rs", "formats/"]),
    ("parquet", &["study/parquet.rs"]),
    ("pdf_writer", &["plot/pdf.rs"]),
    ("procfs", &["memory.rs", "lab/"]),
    ("rand", &["surface/random/", "lab/stability/"]),
    ("rand_distr", &["surface/random/"]),
    ("re_web_viewer_server", &["serve/"]),
    ("realfft", &["fourier/"]),
    ("rerun", &["record/"]),
    ("resvg", &["plot/"]),
    ("rustfft", &["fourier/"]),
    ("strsim", &["setup/"]),
    ("tokio", &["cli/interrupt.rs", "serve/"]),
    ("toml", &["explore/lesson.rs", "setup/"]),
    ("uom", &["quantity.rs"]),
];

/// The one mention of `clap` in the library: what the command line chooses from.
const CHOICE: &str = r#"#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]"#;

/// Crates that are gone for good, since others or a few lines do their work.
const GONE: &[&str] = &["gauss_quad", "levenberg_marquardt", "nalgebra", "petgraph", "plotters", "png", "rand_chacha"];

const LONGEST_FILE: usize = 450;

fn layer(room: &str) -> u8 {
    let found = LAYERS.iter().find(|(name, _)| *name == room);
    found.unwrap_or_else(|| panic!("{room} has no layer: give it one in this test")).1
}

#[test]
fn files_use_their_own_layer_and_lower_ones() {
    let sources = Source::all();
    for (source, used) in sources.iter().zip(Uses::new(&sources, true).of) {
        for used in used.into_iter().map(|used| &sources[used]) {
            let [own, other] = [source, used].map(|source| layer(source.room()));
            assert!(other <= own, "{} is in layer {own} and uses {}", source.path, used.path);
        }
    }
}

/// The arrows inside a circle, one a line.
fn arrows<'a>(circle: &[usize], uses: &[BTreeSet<usize>], name: impl Fn(usize) -> &'a str) -> String {
    let inside = |&i: &usize| uses[i].iter().filter(|j| circle.contains(j)).map(move |&j| (i, j));
    circle.iter().flat_map(inside).map(|(i, j)| format!("  {} uses {}\n", name(i), name(j))).collect()
}

#[test]
fn no_files_go_round_in_a_circle() {
    for sources in [Source::all(), Source::python()] {
        let uses = Uses::new(&sources, false);
        let circles = uses.circles();
        let found: Vec<String> = circles.iter().map(|circle| arrows(circle, &uses.of, |i| &uses.files[i])).collect();
        assert!(found.is_empty(), "{} circles:\n{}", found.len(), found.join("\n"));
    }
}

#[test]
fn uses_are_found_in_the_python_package() {
    let uses = Uses::new(&Source::python(), false);
    let index = |path: &str| uses.files.iter().position(|file| file == path).unwrap();
    assert!(uses.of[index("solve.rs")].contains(&index("contact.rs")));
    assert!(!uses.of[index("contact.rs")].contains(&index("solve.rs")));
}

#[test]
fn no_rooms_go_round_in_a_circle() {
    let sources = Source::all();
    let rooms: Vec<&str> = sources.iter().map(Source::room).collect::<BTreeSet<_>>().into_iter().collect();
    let index: BTreeMap<&str, usize> = rooms.iter().enumerate().map(|(i, room)| (*room, i)).collect();
    let mut uses = vec![BTreeSet::new(); rooms.len()];
    for (source, used) in sources.iter().zip(Uses::new(&sources, false).of) {
        let others = used.into_iter().map(|used| sources[used].room()).filter(|room| *room != source.room());
        uses[index[source.room()]].extend(others.map(|room| index[room]));
    }
    let found: Vec<String> = circles(&uses).iter().map(|circle| arrows(circle, &uses, |i| rooms[i])).collect();
    assert!(found.is_empty(), "{} circles:\n{}", found.len(), found.join("\n"));
}

#[test]
fn large_dependencies_stay_in_their_places() {
    let sources = Source::all();
    let tokens: Vec<Vec<String>> = sources.iter().map(|source| tokens(&source.text.replace(CHOICE, ""))).collect();
    let naming = |name: &str| -> Vec<&str> {
        let named = sources.iter().zip(&tokens).filter(|(_, tokens)| names(tokens, name));
        named.map(|(source, _)| source.path.as_str()).collect()
    };
    for &(name, places) in PLACES {
        let named = naming(name);
        assert!(!named.is_empty(), "{name} is named nowhere");
        for path in named {
            let is_in_place = places.iter().any(|place| path.starts_with(place));
            assert!(is_in_place, "{path} names {name}, which belongs in {places:?}");
        }
    }
    for name in GONE {
        assert_eq!(naming(name), [""; 0], "{name} is back");
    }
}

/// Names of the SDK of the viewer that its next release moves or drops, or whose meaning it changes.
const PASSING: &[&str] = &[
    "rerun::datatypes",
    "re_sdk_types::datatypes",
    "RecordingStreamBuilder",
    "send_properties",
    "set_log_tick_enabled",
];

#[test]
fn names_of_the_viewer_that_pass_stay_in_one_file() {
    for source in Source::all().into_iter().filter(|source| source.room() == "record") {
        let named: Vec<&&str> = PASSING.iter().filter(|name| source.text.contains(**name)).collect();
        let is_place = source.path.ends_with("record/sdk.rs");
        assert!(is_place != named.is_empty(), "{} names {named:?}, which belong in record/sdk.rs", source.path);
    }
}

#[test]
fn files_are_short_and_say_what_they_are() {
    for source in Source::all().into_iter().chain(Source::python()) {
        let lines = source.text.lines().count();
        assert!(lines <= LONGEST_FILE, "{} has {lines} lines", source.path);
        assert!(source.text.starts_with("//! "), "{} does not begin with its documentation", source.path);
    }
}
