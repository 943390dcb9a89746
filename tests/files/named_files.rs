//! The files that a setup names: one list of them, of which all that a setup reads follows.

#[cfg(feature = "cli")]
use crate::command::{Folder, text};
use crate::height_files::directory;
use asperity::formats::write_heights;
use asperity::setup::{Dimension, Key, Setup, SetupTable};
use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::Path;

pub const ROUGH: &str =
    "surface = { spectrum = { hurst = 0.8, rolloff-wavelength = 0.25, short-cutoff = 0.05, rms-gradient = 0.1 } }
grid = { points = 128, size = 1.0 }
load = { reduced-pressure = 0.05 }
";

const SPECTRUM: &str =
    "surface = { spectrum = { table = \"psd.txt\", heights-like = \"like.txt\", convention = \"profile\" } }
grid = { points = 128, size = 1.0 }
load = { reduced-pressure = 0.05 }
";

const STICKY: &str = "surface = { indenter = { shape = \"sine\", amplitude = 0.01 } }
grid = { points = 128, size = 1.0 }
solid = { contact-modulus = 1.0 }
load = { mean-pressure = 0.001 }
adhesion = { table = \"att.csv\" }
path = { file = \"path.csv\" }
";

/// Writes the files that the scenes name.
fn write_files(folder: &Path) {
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    write("psd.txt", "20 1e-6\n100 1e-8\n");
    write("like.txt", &(0..32).map(|i| format!("{}\n", (i * i) % 37)).collect::<String>());
    write("att.csv", "gap,traction\n0,0.02\n0.001,0.01\n0.004,0\n");
    write("path.csv", "load\n0.002\n-0.001\n");
    let heights: Vec<f64> = (0..64).map(|i| (f64::from(i) * 0.3).sin()).collect();
    write_heights(folder.join("h.npy"), ndarray::Array1::from(heights).into_dyn().view()).unwrap();
}

/// The keys of files, as they are declared.
fn file_keys() -> impl Iterator<Item = &'static str> {
    Key::of_dimension(Dimension::File).map(|key| key.path)
}

/// The sentence about a value at a path of keys.
pub fn sentence(path: &str, value: toml::Value) -> String {
    let mut table = SetupTable::from_toml(ROUGH).unwrap();
    table.lay(path, value);
    table.setup().map_or_else(|error| error.to_string(), |_| String::new())
}

/// The keys of a section, as its refusal of an unknown one lists them; none where it is no section.
pub fn keys_in(section: &str) -> Vec<String> {
    let unknown = if section.is_empty() { "no-such".to_owned() } else { format!("{section}.no-such") };
    let refused = sentence(&unknown, 1.into());
    let Some((_, known)) = refused.split_once("unknown key `no-such`, expected ") else { return Vec::new() };
    let known = known.split(": did you").next().unwrap_or_default();
    let of = |key: &str| if section.is_empty() { key.to_owned() } else { format!("{section}.{key}") };
    known.split('`').skip(1).step_by(2).map(of).collect()
}

/// All keys at and below a section whose values must be names of files.
fn keys_of_files(section: &str, depth: usize, found: &mut BTreeSet<String>) {
    for key in keys_in(section) {
        if sentence(&key, 1.into()).contains("expected the name of a file") {
            found.insert(key);
        } else if depth > 0 {
            keys_of_files(&key, depth - 1, found);
        }
    }
}

#[test]
fn every_key_and_every_flag_whose_value_is_a_file_is_in_the_list() {
    let mut found = BTreeSet::new();
    keys_of_files("", 3, &mut found);
    let flags: Vec<&str> =
        Key::with_flags().filter(|key| key.placeholder.starts_with("FILE")).map(|key| key.path).collect();
    assert!(flags.len() >= 6 && flags.iter().all(|key| found.contains(*key)), "{found:?}");
    assert_eq!(found, file_keys().map(str::to_owned).collect());
}

#[test]
fn a_setup_lists_the_files_of_all_its_keys_and_is_saved_with_their_digests() {
    let folder = tempfile::tempdir().unwrap();
    write_files(folder.path());
    let scene = "surface.height = \"h.npy\"
surface.against = \"h.npy\"
surface.spectrum = { table = \"psd.txt\", heights-like = \"like.txt\" }
surface.second-spectrum = { table = \"psd.txt\", heights-like = \"like.txt\" }
load = { mean-pressure = 0.001 }
solid = { contact-modulus = 1.0 }
adhesion = { table = \"att.csv\" }
path = { file = \"path.csv\" }
";
    let table = SetupTable::from_toml(scene).unwrap().beside(&folder.path().join("scene.toml")).unwrap();
    assert_eq!(table.files().len(), file_keys().count());
    let setup = table.clone().setup().unwrap();
    let listed: Vec<_> = setup.files().map(|file| file.path().to_path_buf()).collect();
    assert_eq!(listed, table.files());
    let saved = setup.to_saved_toml();
    let digests = saved.split_once("[files]").unwrap().1;
    for name in ["h.npy", "psd.txt", "like.txt", "att.csv"] {
        assert!(digests.lines().any(|line| line.contains(name) && line.contains("\"fnv1a-")), "{name}: {digests}");
    }
    let again = Setup::from_toml(&saved).unwrap();
    // the lists of the path are in the setup, and its file is not needed again
    assert_eq!(again.files().count(), file_keys().count() - 1);
    assert_eq!(again.path.unwrap().load, [0.002, -0.001]);
}

/// Results are given to others: the folders of a person stay at home, and the file that the result was made from is found by what is in it.
#[cfg(feature = "cli")]
#[test]
fn saved_results_tell_no_folder_and_find_their_files_by_digests() {
    let home = Folder::new();
    let run = |line: &str| home.run(line);
    let refused = |line: &str, why: &str| {
        let output = home.run(line);
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(text(&output.stderr).contains(why), "{line}: {}", text(&output.stderr));
    };
    std::fs::create_dir(home.join("maps")).unwrap();
    std::fs::create_dir(home.join("out")).unwrap();
    let solve = "solve --height maps/h.npy --size 1 --reduced-pressure 0.05";
    for (seed, name) in [(1, "h"), (2, "other")] {
        let rough = format!(
            "surface --points 64 --size 1 --hurst 0.8 --rms-gradient 0.1 --rolloff 0.25 --short-cutoff 0.05 --seed {seed}"
        );
        assert!(run(&format!("{rough} --out maps/{name}.npy")).status.success());
    }
    let made = run(&format!("{solve} --out out/r.npz --record out/r.rrd --save-setup out/s.toml --json"));
    assert!(made.status.success(), "{}", text(&made.stderr));
    std::fs::write(home.join("out/r.json"), &made.stdout).unwrap();
    let folder = home.join("").to_str().unwrap().to_owned();
    for name in ["out/r.npz", "out/r.rrd", "out/s.toml", "out/r.json"] {
        let bytes = std::fs::read(home.join(name)).unwrap();
        assert!(!bytes.windows(folder.len()).any(|part| part == folder.as_bytes()), "{name}");
    }
    for setup in ["--setup-of out/r.rrd", "--setup-of out/r.json", "--setup-of out/r.npz", "out/s.toml"] {
        let again = run(&format!("solve {setup} --json"));
        assert!(again.status.success(), "{setup}: {}", text(&again.stderr));
        let area = |bytes: &[u8]| -> serde_json::Value { serde_json::from_slice(bytes).unwrap() };
        assert_eq!(area(&again.stdout)["relative_area"], area(&made.stdout)["relative_area"], "{setup}");
    }
    // another file of the same name is not taken for it, and the right one is found beside the result
    std::fs::rename(home.join("maps/h.npy"), home.join("h.npy")).unwrap();
    refused("solve --setup-of out/r.rrd", "maps/h.npy is not there");
    std::fs::rename(home.join("maps/other.npy"), home.join("maps/h.npy")).unwrap();
    refused("solve --setup-of out/r.rrd", "maps/h.npy is another file now");
    refused("solve out/s.toml", "maps/h.npy is another file now");
    assert!(run("solve --setup-of out/r.rrd --height h.npy").status.success());
    std::fs::rename(home.join("h.npy"), home.join("out/h.npy")).unwrap();
    assert!(run("solve --setup-of out/r.rrd").status.success());
    assert!(run("solve --setup-of out/r.npz").status.success());
}

#[test]
fn files_are_found_beside_their_scene_and_by_a_saved_setup() {
    let folder = tempfile::tempdir().unwrap();
    write_files(folder.path());
    for (name, scene) in [("spectrum.toml", SPECTRUM), ("sticky.toml", STICKY)] {
        fs::write(folder.path().join(name), scene).unwrap();
        let setup = SetupTable::read(&folder.path().join(name)).unwrap().setup().unwrap();
        setup.problem().unwrap();
        let elsewhere = tempfile::tempdir().unwrap();
        setup.write(&elsewhere.path().join("saved.toml")).unwrap();
        let saved = SetupTable::read(&elsewhere.path().join("saved.toml")).unwrap().setup().unwrap();
        assert_eq!(saved.fingerprint().unwrap(), setup.fingerprint().unwrap());
        saved.problem().unwrap();
    }
}

#[test]
fn a_fingerprint_depends_on_what_is_in_the_files_and_not_on_their_names() {
    let folder = tempfile::tempdir().unwrap();
    write_files(folder.path());
    let setup =
        |scene: &str| SetupTable::from_toml(scene).unwrap().beside(&folder.path().join("it")).unwrap().setup().unwrap();
    let of = |scene: &str| setup(scene).fingerprint().unwrap();
    for (scene, name) in [(SPECTRUM, "psd.txt"), (SPECTRUM, "like.txt"), (STICKY, "att.csv"), (STICKY, "path.csv")] {
        let (before, text) = (of(scene), fs::read_to_string(folder.path().join(name)).unwrap());
        fs::write(folder.path().join("other"), &text).unwrap();
        assert_eq!(of(&scene.replace(name, "other")), before, "{name}");
        fs::write(folder.path().join(name), text.replace('1', "2")).unwrap();
        assert_ne!(of(scene), before, "{name}");
    }
}

/// A device may have no end, a pipe may never begin, and a file with holes is as long as it says.
#[cfg(unix)]
#[test]
fn no_key_takes_a_device_or_a_file_without_end() {
    let folder = tempfile::tempdir().unwrap();
    write_files(folder.path());
    let endless = folder.path().join("endless").to_string_lossy().into_owned();
    fs::File::create(&endless).unwrap().set_len(1 << 40).unwrap();
    for (name, reason) in
        [("/dev/zero", "it is a directory or a device: give a file"), (&*endless, ": give a smaller file")]
    {
        refuse_everywhere(folder.path(), name, reason);
    }
    let read = SetupTable::read(Path::new("/dev/zero")).unwrap_err().to_string();
    assert_eq!(read, "cannot read /dev/zero: it is a directory or a device: give a file");
    let read = SetupTable::read(Path::new(&endless)).unwrap_err().to_string();
    assert!(read.ends_with("it has 1.1 TB, and a text may have 34 MB: give a smaller file"), "{read}");
}

/// A result whose setup is longer than any scene: an archive with one member, whose bytes are a hole.
#[cfg(unix)]
#[test]
fn a_setup_in_a_result_has_an_end() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.npz");
    let (name, length) = (b"setup.npy", 1_u32 << 30);
    let mut head = b"PK\x03\x04".to_vec();
    head.resize(18, 0);
    head.extend([length.to_le_bytes(), length.to_le_bytes()].concat());
    head.extend([name.len() as u8, 0, 0, 0]);
    head.extend(name);
    head.extend(b"\x93NUMPY\x01\0\x76\0{'descr': '|u1', 'fortran_order': False, 'shape': (1073741696,), }");
    head.resize(30 + name.len() + 127, b' ');
    head.push(b'\n');
    fs::write(&path, &head).unwrap();
    let end = (30 + name.len()) as u64 + u64::from(length);
    let mut file = fs::File::options().append(true).open(&path).unwrap();
    file.set_len(end).unwrap();
    file.write_all(&directory(&head)).unwrap();
    let read = SetupTable::read(&path).unwrap_err().to_string();
    assert!(read.ends_with("it has 1.1 GB, and a text may have 34 MB: give a smaller file"), "{read}");
}

/// Each key of a file refuses it, for a reason.
#[cfg(unix)]
fn refuse_everywhere(folder: &Path, file: &str, reason: &str) {
    for key in file_keys() {
        let base = match key.split('.').next() {
            Some("adhesion" | "path") => STICKY,
            _ => SPECTRUM,
        };
        let mut table = SetupTable::from_toml(base).unwrap().beside(&folder.join("it")).unwrap();
        if key == "surface.against" || key == "surface.height" {
            table.remove("grid.points");
            table.lay("surface.height", folder.join("h.npy").to_string_lossy().into_owned().into());
        }
        if key.starts_with("surface.second-spectrum.") {
            let spectrum = folder.join("psd.txt").to_string_lossy().into_owned();
            table.lay("surface.second-spectrum.table", spectrum.into());
        }
        table.lay(key, file.into());
        let refused = table.setup().and_then(|setup| setup.problem().map(drop)).unwrap_err().to_string();
        assert!(refused.contains(file) && refused.ends_with(reason), "{key}: {refused}");
    }
}
