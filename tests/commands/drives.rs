//! One small setup for each kind of drive, by the words of its command, and what it gives through each door.

use crate::command::{Folder, text};
use ndarray::{Array, IxDyn};
use ndarray_npy::{NpzReader, ReadableElement};
use rerun::{ChunkStore, ChunkStoreConfig, Scalars, StoreKind};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;

const ROUGH: &str = "--hurst 0.8 --rolloff 0.125 --short-cutoff 0.02 --rms-gradient 0.1 --points 256 --size 1";
const SURFACE: &str = "--hurst 0.8 --rolloff 0.5 --short-cutoff 0.2 --rms-gradient 0.1 --points 32,32 --size 1,1";
const CYLINDER: &str = "--indenter cylinder --radius 1 --points 128 --size 0.5 --boundary free --modulus 1";
const HERTZ: &str = "--indenter cylinder --radius 1 --points 256 --size 4";
const STICKY: &str =
    "--indenter sine --amplitude 0.01 --points 256 --size 1 --modulus 1 --adhesion 4e-4 --adhesion-range 5e-3";

const YIELDING: &str = "--indenter cylinder --radius 1 --points 128 --size 1 --young 1 --poisson 0.3 --yield-stress 0.005 --hardening-modulus 0.05";

/// A drive: its name, its surface and solid, and what moves them. All of them but the first kind give several states.
pub struct Drive {
    pub name: &'static str,
    surface: &'static str,
    motion: &'static str,
    /// Whether it is one contact.
    pub is_single: bool,
}

const fn single(name: &'static str, surface: &'static str, motion: &'static str) -> Drive {
    Drive { name, surface, motion, is_single: true }
}

const fn several(name: &'static str, surface: &'static str, motion: &'static str) -> Drive {
    Drive { name, surface, motion, is_single: false }
}

pub static DRIVES: [Drive; 24] = [
    single("rest", ROUGH, "--reduced-pressure 0.05"),
    single("rest with flow", SURFACE, "--modulus 1GPa --reduced-pressure 0.05 --flow --resistivity 1e-7,2e-7"),
    single("rest that yields", ROUGH, "--modulus 1 --reduced-pressure 0.05 --hardness 0.04"),
    single("rest on a layer", ROUGH, "--layer 0.1 --young 1 --poisson 0.3 --reduced-pressure 0.05"),
    single("rest on a free boundary", CYLINDER, "--force 0.01"),
    single("rest at a mean gap", ROUGH, "--mean-gap 0.0015"),
    single("sliding at one speed", ROUGH, "--reduced-pressure 0.05 --creep 9,1 --speed 0.01"),
    several("loads", ROUGH, "--reduced-pressure 0.02,0.05 --unload"),
    single("rest on an indenter", HERTZ, "--reduced-pressure 0.01"),
    several("loads on an indenter", HERTZ, "--reduced-pressure 0.01,0.02"),
    several("loads while sliding", ROUGH, "--reduced-pressure 0.02,0.05 --creep 9,1 --speed 0.01"),
    several("loads by gfmd", ROUGH, "--reduced-pressure 0.02,0.05 --solver gfmd"),
    several("loads with flow", SURFACE, "--modulus 1GPa --reduced-pressure 0.02,0.05 --flow"),
    several("loads that yield", ROUGH, "--modulus 1 --reduced-pressure 0.02,0.05 --unload --hardness 0.04"),
    several(
        "creep",
        ROUGH,
        "--reduced-pressure 0.05 --creep 9,1 --path-time 0.5,1 --path-load 0.05,0.02 --path-steps 3",
    ),
    several(
        "creep with hardness",
        ROUGH,
        "--modulus 1 --reduced-pressure 0.05 --creep 9,1 --path-time 1 --path-steps 3 --hardness 0.04",
    ),
    several("slip", CYLINDER, "--force 0.01 --friction 0.3 --path-tangential 0.001,0.002,-0.002"),
    several("slip of a surface", SURFACE, "--reduced-pressure 0.05 --friction 0.3 --path-tangential 0.005,-0.005"),
    several("sliding", ROUGH, "--reduced-pressure 0.05 --creep 9,1 --speed 1e-3,1e-1"),
    several("rolling", CYLINDER, "--force 0.01 --friction 0.3 --rolling 0.001,0.002"),
    several("adhesion", STICKY, "--mean-gap 0.02 --path-load 0.02,0.005,0.03 --path-steps 6"),
    several("loads that yield below the surface", YIELDING, "--pressure 0.001,0.0015 --unload --path-steps 2"),
    several(
        "loads that yield below a rough surface",
        SURFACE,
        "--young 1 --poisson 0.3 --yield-stress 0.02 --hardening-modulus 0.05 --reduced-pressure 0.05,0.1 --unload",
    ),
    several("adhesion under loads", STICKY, "--pressure 1e-4 --path-load 1e-4,2e-3,-1e-3 --path-steps 4"),
];

/// What a drive gives: numbers by the name of the door and of the number. What has no numbers, such as an entity with a picture, has an empty list.
pub type Found = BTreeMap<String, Vec<f64>>;

/// What this program gives of all drives. Several tests look at it, and it is found once.
pub fn found() -> &'static [(&'static Drive, Found)] {
    static FOUND: OnceLock<Vec<(&Drive, Found)>> = OnceLock::new();
    let program = Path::new(env!("CARGO_BIN_EXE_asperity"));
    FOUND.get_or_init(|| DRIVES.iter().map(|drive| (drive, drive.run(program))).collect())
}

impl Drive {
    /// The words that ask for it.
    pub fn words(&self) -> String {
        format!("solve {} {}", self.surface, self.motion)
    }

    /// What a program gives of it: text, JSON, table, archive, recording and the row of a study.
    pub fn run(&self, program: &Path) -> Found {
        let folder = Folder::new();
        let words = self.words();
        let asked = |rest: &str| {
            let line = format!("{words} {rest}");
            let mut command = Command::new(program);
            command.args(line.split_whitespace()).current_dir(folder.join(""));
            let output = command.output().unwrap();
            assert!(output.status.success(), "{}: {line}: {}", self.name, text(&output.stderr));
            output
        };
        let json = asked("--json --out found.npz --record found.rrd").stdout;
        let mut found = Found::new();
        add_rows(&mut found, text(&asked("--save-setup scene.toml").stdout));
        add_json(&mut found, "json", &serde_json::from_slice(&json).unwrap());
        add_archive(&mut found, &folder.join("found.npz"));
        add_recording(&mut found, &folder.join("found.rrd"));
        if !self.is_single {
            asked("--out found.csv");
            add_table(&mut found, "csv", &folder.join("found.csv"));
        }
        if !self.name.starts_with("loads") {
            let mut command = Command::new(program);
            let output = command
                .args(["study", "scene.toml", "--out", "row.csv"])
                .current_dir(folder.join(""))
                .output()
                .unwrap();
            assert!(output.status.success(), "{}: study: {}", self.name, text(&output.stderr));
            add_table(&mut found, "study", &folder.join("row.csv"));
        }
        found
    }
}

/// Adds all numbers of an object; those of lists of objects follow each other. Times that clocks measured are left out.
fn add_json(found: &mut Found, name: &str, value: &Value) {
    match value {
        Value::Object(map) => {
            let told = map.iter().filter(|(key, _)| !["seconds", "setup", "warnings"].contains(&key.as_str()));
            told.for_each(|(key, value)| add_json(found, &format!("{name}/{key}"), value));
        }
        Value::Array(list) => list.iter().for_each(|value| add_json(found, name, value)),
        Value::Number(number) => found.entry(name.into()).or_default().extend(number.as_f64()),
        Value::Bool(is_true) => found.entry(name.into()).or_default().push(f64::from(u8::from(*is_true))),
        Value::Null | Value::String(_) => {}
    }
}

/// Adds all numbers of the columns of a table.
fn add_table(found: &mut Found, door: &str, path: &Path) {
    let mut table = csv::Reader::from_path(path).unwrap();
    let names: Vec<String> = table.headers().unwrap().iter().map(str::to_owned).collect();
    for record in table.records() {
        for (name, cell) in names.iter().zip(&record.unwrap()) {
            let number = match cell {
                "true" => Some(1.0),
                "false" => Some(0.0),
                _ => cell.parse().ok(),
            };
            found.entry(format!("{door}/{name}")).or_default().extend(number);
        }
    }
}

/// Adds the labels of the rows that are printed: two spaces, a label, and values after two or more spaces.
fn add_rows(found: &mut Found, printed: &str) {
    for line in printed.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   ")) {
        let label = line.trim_start().split("  ").next().unwrap_or_default();
        if !label.starts_with(|letter: char| letter.is_ascii_digit() || letter == '-') {
            found.insert(format!("text/{label}"), Vec::new());
        }
    }
}

/// Adds all arrays of numbers of an archive.
fn add_archive(found: &mut Found, path: &Path) {
    let mut archive = NpzReader::new(File::open(path).unwrap()).unwrap();
    for name in archive.names().unwrap() {
        let values = array::<f64>(&mut archive, &name)
            .or_else(|| Some(array::<u64>(&mut archive, &name)?.into_iter().map(|it| it as f64).collect()))
            .or_else(|| {
                Some(array::<bool>(&mut archive, &name)?.into_iter().map(|it| f64::from(u8::from(it))).collect())
            });
        found.extend(values.map(|values| (format!("npz/{name}"), values)));
    }
}

fn array<T: ReadableElement>(archive: &mut NpzReader<File>, name: &str) -> Option<Vec<T>> {
    let array: Array<T, IxDyn> = archive.by_name(name).ok()?;
    Some(array.into_iter().collect())
}

/// Adds all entities of a recording, and scalars in the order of the steps, but for the times that clocks measured. Panes of the viewer are left out.
fn add_recording(found: &mut Found, path: &Path) {
    let component = Scalars::descriptor_scalars().component;
    let stores = ChunkStore::from_rrd_reader(&ChunkStoreConfig::ALL_DISABLED, &mut File::open(path).unwrap()).unwrap();
    let mut scalars: BTreeMap<String, BTreeMap<i64, f64>> = BTreeMap::new();
    for chunk in stores.values().flat_map(|store| store.iter_physical_chunks()).filter(|it| !it.is_static()) {
        let steps = chunk.iter_component_indices("step".into(), component).map(|(step, _)| step.as_i64());
        let values = chunk.iter_slices::<f64>(component).map(|values| values[0]);
        scalars.entry(chunk.entity_path().to_string()).or_default().extend(steps.zip(values));
    }
    let recorded = stores.iter().filter(|(id, _)| id.kind() == StoreKind::Recording);
    for chunk in recorded.flat_map(|(_, store)| store.iter_physical_chunks()) {
        found.insert(format!("entity{}", chunk.entity_path()), Vec::new());
    }
    let told = scalars.into_iter().filter(|(entity, steps)| !steps.is_empty() && !entity.contains("seconds"));
    found.extend(told.map(|(entity, steps)| (format!("rrd{entity}"), steps.into_values().collect())));
}
