//! Results that are read again: what is as it was written comes back, and what is not is said in a sentence.

use asperity::contact::{Contact, FieldKind, ResultClaim, Status, archive, archive_of_slip, archive_of_states};
use asperity::error::{FileError, StudyError};
use asperity::formats::{has_field, read_fields};
use asperity::job::{HistoryOutcome, Job, SavedFound, SavedResult};
use asperity::setup::{Extras, Setup, SetupTable};
use asperity::study::NUMERICS;
use ndarray::{Array1, ArrayD, ArrayView1, IxDyn};
use ndarray_npy::{NpzReader, ReadNpyExt, WriteNpyExt};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::io::{Cursor, Read, Write};
use std::path::{Path, PathBuf};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

const ROUGH: &str =
    "surface = { spectrum = { hurst = 0.8, rolloff-wavelength = 0.25, short-cutoff = 0.02, rms-gradient = 0.1 } }
grid = { points = 256, size = 1.0 }
solid = { contact-modulus = 1.0 }
";

/// A scene for each kind of result.
fn scenes() -> Vec<(&'static str, String)> {
    let with = |rest: &str| format!("{ROUGH}{rest}");
    let sticky = "adhesion = { work = 1e-5, range = 1e-3 }\npath = { load = [2e-3, 0.0], steps = 4 }\n";
    let creeps = "viscoelastic = { creep = [9.0, 1.0] }\n";
    vec![
        ("contact", with("load = { mean-pressure = 2e-3 }\n")),
        ("gap", with("load = { mean-gap = 0.002 }\n")),
        ("hard", with("load = { mean-pressure = 2e-3 }\nlaw = { hardness = 0.05 }\n")),
        ("moving", with(&format!("load = {{ mean-pressure = 2e-3 }}\n{creeps}sliding = {{ speed = 0.01 }}\n"))),
        ("stuck", with("load = { mean-pressure = 2e-3 }\nfriction = { coefficient = 0.5, tangential = 5e-4 }\n")),
        ("curve", with("load = { mean-pressure = [1e-3, 4e-3, 2e-3] }\n")),
        ("hard curve", with("load = { mean-pressure = [1e-3, 4e-3, 2e-3] }\nlaw = { hardness = 0.06 }\n")),
        ("creep", with(&format!("load = {{ mean-pressure = 2e-3 }}\n{creeps}path = {{ time = [0.0, 1.0, 2.0], load = [0.0, 5e-3, 0.0] }}\n"))),
        ("held", with(&format!("load = {{ mean-gap = 0.002 }}\n{creeps}path = {{ time = [3.0], steps = 4 }}\n"))),
        ("slip", with("load = { mean-pressure = 2e-3 }\nfriction = { coefficient = 0.5 }\npath = { tangential = [5e-4, -5e-4, 5e-4], steps = 2 }\n")),
        ("coupled slip", with("load = { mean-pressure = 2e-3 }\nfriction = { coefficient = 0.2 }\npath = { tangential = [2e-4, -1e-4] }\n").replace("contact-modulus = 1.0", "young = 1.0, poisson = 0.2")),
        ("sliding", with(&format!("load = {{ mean-pressure = 2e-3 }}\n{creeps}sliding = {{ speed = [0.01, 0.1] }}\n"))),
        ("rolling", with("load = { mean-pressure = 2e-3 }\nfriction = { coefficient = 0.5 }\nrolling = { creepage = [1e-4, 2e-4] }\n")),
        ("adhesion", with(&format!("load = {{ mean-pressure = 2e-3 }}\n{sticky}"))),
        ("safe adhesion", with(&format!("load = {{ mean-gap = 0.004 }}\n{}", sticky.replace("range = 1e-3", "range = 1e-3, method = \"safe\"").replace("[2e-3, 0.0]", "[0.004, 0.003]")))),
    ]
}

/// The bytes of the archive of a scene.
fn saved(scene: &str) -> Vec<u8> {
    let table = SetupTable::from_toml(scene).unwrap();
    let text = table.to_toml();
    let setup: Setup = table.setup().unwrap();
    if setup.drive_of_states().unwrap().is_some() {
        let outcome = HistoryOutcome::solve(&setup, &setup.problem().unwrap(), &mut ()).unwrap();
        assert!(outcome.ended.is_none());
        return archive_of_states(&outcome.states, 1, &text).unwrap();
    }
    let solved = Job::new(setup).run(&mut ()).unwrap().solved.swap_remove(0);
    match solved.slip {
        Some(slip) => archive_of_slip(&slip, 1, Some(&text)).unwrap(),
        None => archive(&solved.contact, 1, Some(&text)).unwrap(),
    }
}

/// All arrays of an archive of some names, each with its shape; an error where one is damaged.
fn all_fields(path: &Path, names: &[&'static str]) -> Result<Vec<Option<ArrayD<f64>>>, FileError> {
    names.iter().map(|name| has_field(path, name)?.then(|| read_fields(path, name)).transpose()).collect()
}

/// With any bit of an archive wrong, and cut anywhere, it is refused or reads as it was: an array whose name is damaged is not taken for absent.
#[test]
fn damaged_and_cut_archives_are_refused_or_read_as_they_were() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("damaged.npz");
    let bytes = saved(&scenes()[0].1);
    std::fs::write(&path, &bytes).unwrap();
    let names = NpzReader::new(Cursor::new(bytes.clone())).unwrap().names().unwrap();
    let names: Vec<&'static str> =
        names.iter().map(|name| &*String::leak(name.trim_end_matches(".npy").to_owned())).collect();
    // masks and texts are read by other doors
    let names: Vec<&'static str> = names.into_iter().filter(|name| read_fields(&path, name).is_ok()).collect();
    let right = all_fields(&path, &names).unwrap();
    assert!(right.iter().all(Option::is_some) && right.len() > 8);
    // where the heads of members and the directory are, which no check sum covers
    let marks = |at: &usize| bytes[*at..].starts_with(b"PK");
    let heads: Vec<usize> = (0..bytes.len() - 4).filter(marks).flat_map(|at| at..(at + 80).min(bytes.len())).collect();
    let mut random = ChaCha8Rng::seed_from_u64(73);
    let mut refused = 0;
    for number in 0..600 {
        let mut wrong = bytes.clone();
        let at = if number % 2 == 0 {
            heads[random.random_range(0..heads.len())]
        } else {
            random.random_range(0..bytes.len())
        };
        wrong[at] ^= 1 << random.random_range(0..8);
        std::fs::write(&path, &wrong).unwrap();
        match all_fields(&path, &names) {
            Ok(found) => assert_eq!(found, right, "bit of byte {at}"),
            Err(_) => refused += 1,
        }
    }
    assert!(refused > 300, "{refused}");
    for number in 1..100 {
        let cut = bytes.len() * number / 100;
        std::fs::write(&path, &bytes[..cut]).unwrap();
        assert!(all_fields(&path, &names).is_err(), "cut at {cut}");
    }
}

/// The members of an archive in their order, to be changed: the name of each, and its bytes.
#[derive(Clone)]
struct Parts(Vec<(String, Vec<u8>)>);

impl Parts {
    fn new(scene: &str) -> Self {
        let mut archive = ZipArchive::new(Cursor::new(saved(scene))).unwrap();
        let count = archive.len();
        let member = |number: usize| {
            let mut file = archive.by_index(number).unwrap();
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).unwrap();
            (file.name().trim_end_matches(".npy").to_owned(), bytes)
        };
        Self((0..count).map(member).collect())
    }

    fn place(&self, name: &str) -> usize {
        self.0.iter().position(|(other, _)| other == name).unwrap_or_else(|| panic!("{name}"))
    }

    /// The parts with the numbers of an array changed.
    fn with(&self, name: &str, change: impl FnOnce(&mut ArrayD<f64>)) -> Self {
        let (mut parts, place) = (self.clone(), self.place(name));
        let mut array = ArrayD::<f64>::read_npy(self.0[place].1.as_slice()).unwrap();
        change(&mut array);
        parts.0[place].1.clear();
        array.write_npy(&mut parts.0[place].1).unwrap();
        parts
    }

    /// The parts with another text.
    fn with_text(&self, name: &str, change: impl FnOnce(&str) -> String) -> Self {
        let (mut parts, place, text) = (self.clone(), self.place(name), self.text(name));
        let changed = change(&text);
        assert_ne!(changed, text);
        parts.0[place].1.clear();
        ArrayView1::from(changed.as_bytes()).write_npy(&mut parts.0[place].1).unwrap();
        parts
    }

    fn text(&self, name: &str) -> String {
        let bytes = Array1::<u8>::read_npy(self.0[self.place(name)].1.as_slice()).unwrap();
        String::from_utf8(bytes.to_vec()).unwrap()
    }

    fn without(&self, name: &str) -> Self {
        let mut parts = self.clone();
        parts.0.remove(self.place(name));
        parts
    }

    fn swapped(&self, one: &str, other: &str) -> Self {
        let (mut parts, [one, other]) = (self.clone(), [one, other].map(|name| self.place(name)));
        (parts.0[one].1, parts.0[other].1) = (self.0[other].1.clone(), self.0[one].1.clone());
        parts
    }

    /// The archive of the parts, with check sums that are right.
    fn bytes(&self) -> Vec<u8> {
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
        for (name, bytes) in &self.0 {
            archive.start_file(format!("{name}.npy"), stored).unwrap();
            archive.write_all(bytes).unwrap();
        }
        archive.finish().unwrap().into_inner()
    }

    fn read(&self) -> Result<SavedResult, StudyError> {
        read(&self.bytes())
    }
}

/// The result in the bytes of an archive.
fn read(bytes: &[u8]) -> Result<SavedResult, StudyError> {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join("it.npz");
    std::fs::write(&path, bytes).unwrap();
    SavedResult::read(&path)
}

/// All contacts of a result.
fn contacts(result: &SavedResult) -> Vec<&Contact> {
    match &result.found {
        SavedFound::Contact(state, _) => vec![&state.contact],
        SavedFound::States(outcome) => outcome.states.iter().map(|state| &state.contact).collect(),
    }
}

/// The numbers and words of a result that a change must not alter without a word: fields, certificates, work, and what each state knows.
fn told(result: &SavedResult) -> String {
    let of_contact = |it: &Contact| {
        let fields = [&it.pressure, &it.gap, &it.displacement]
            .map(|field| field.iter().map(|x| x.to_bits()).fold(0, |a: u64, b| a.rotate_left(5) ^ b));
        format!("{fields:?} {:?} {} {:?} {:?}", it.certificate, it.work.transforms, it.status, it.coarser)
    };
    let states = match &result.found {
        SavedFound::States(outcome) => {
            outcome.states.iter().map(|it| format!("{:?} {:?}", it.claim, it.numbers())).collect()
        }
        SavedFound::Contact(state, slip) => {
            let stick = slip.as_ref().map(|slip| slip.stuck.pressure.sum());
            vec![format!("{:?} {:?} {stick:?}", state.claim, state.numbers())]
        }
    };
    format!("{}\n{:?}\n{states:?}", result.text, contacts(result).into_iter().map(of_contact).collect::<Vec<_>>())
}

/// A result that is as it was written comes back with its certificates, its numbers and its claims, to the bit.
#[test]
fn what_was_saved_comes_back() {
    for (name, scene) in scenes() {
        let parts = Parts::new(&scene);
        let read = parts.read().unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(read.doubts, [""; 0], "{name}");
        assert!(contacts(&read).iter().all(|contact| contact.status == Status::Converged), "{name}");
        let certificates = ArrayD::<f64>::read_npy(parts.0[parts.place("certificate_numbers")].1.as_slice()).unwrap();
        let found = contacts(&read).into_iter().map(|contact| contact.certificate.eta);
        assert!(
            certificates.iter().step_by(9).zip(found).all(|(saved, found)| saved.to_bits() == found.to_bits()),
            "{name}"
        );
        if let SavedFound::States(outcome) = &read.found {
            let found: Vec<&str> = outcome.states.iter().map(|state| state.claim.into()).collect();
            assert_eq!(found, parts.text("claim").lines().collect::<Vec<_>>(), "{name}");
        }
    }
}

/// Flux and pressure of a fluid are in the file, and come back.
#[test]
fn what_flows_comes_back() {
    let scene = format!("{ROUGH}load = {{ mean-pressure = [1e-3, 2e-3] }}\nflow = {{ leakage = true }}\n")
        .replace("points = 256", "points = [32, 32]")
        .replace("0.02", "0.1");
    let setup = Setup::from_toml(&scene).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("it.npz");
    let solved = Job::new(setup)
        .with_extras(Extras { archived: 2, ..Extras::default() })
        .run(&mut ())
        .unwrap()
        .solved
        .swap_remove(0);
    let states = solved.history.unwrap().states;
    std::fs::write(&path, archive_of_states(&states, 2, &SetupTable::from_toml(&scene).unwrap().to_toml()).unwrap())
        .unwrap();
    let read = SavedResult::read(&path).unwrap();
    let SavedFound::States(found) = &read.found else { panic!("it is a list of loads") };
    assert_eq!((found.states.len(), read.doubts.len()), (2, 0));
    for (found, state) in found.states.iter().zip(&states) {
        for kind in [FieldKind::FluxX, FieldKind::FluidPressureX, FieldKind::FluxY, FieldKind::FluidPressureY] {
            let [found, own] = [found.field(kind).unwrap(), state.field(kind).unwrap()];
            let is_same = |(a, b): (&f64, &f64)| a == b || a.is_nan() && b.is_nan();
            assert!(found.iter().zip(own).all(is_same) && own.iter().any(|it| *it > 0.0), "{kind:?}");
        }
    }
}

/// A result that is not as it was written says so in one sentence, and nothing in it is converged or claimed.
fn check_unchecked(what: &str, parts: &Parts, words: &str) {
    let read = parts.read().unwrap_or_else(|error| panic!("{what}: {error}"));
    assert!(read.doubts.iter().any(|doubt| doubt.contains(words)), "{what}: {:?}", read.doubts);
    assert!(read.doubts.iter().all(|doubt| doubt.ends_with('.') && !doubt.contains('\n')));
    assert!(contacts(&read).iter().all(|contact| contact.status == Status::Unconfirmed), "{what}");
    if let SavedFound::States(outcome) = &read.found {
        assert!(outcome.states.iter().all(|state| state.claim == ResultClaim::Unchecked), "{what}");
    }
    if let SavedFound::Contact(_, Some(slip)) = &read.found {
        assert_eq!(slip.stuck.status, Status::Unconfirmed, "{what}");
    }
}

#[test]
fn what_was_changed_is_unchecked() {
    const CHANGED: &str = "is not as it was written";
    for (name, scene) in scenes() {
        let parts = Parts::new(&scene);
        // the least change of a number that a person would not see
        let nudge = |it: &mut ArrayD<f64>| it.iter_mut().take(1).for_each(|it| *it = f64::from_bits(it.to_bits() ^ 1));
        for array in ["pressure", "gap", "coarser", "certificate_numbers", "relative_area"] {
            check_unchecked(&format!("{name}, {array}"), &parts.with(array, nudge), CHANGED);
        }
        check_unchecked(&format!("{name}, exchanged"), &parts.swapped("gap", "displacement"), CHANGED);
        let other = parts.with_text("setup", |text| {
            text.replace("contact-modulus = 1.0", "contact-modulus = 1.1").replace("young = 1.0", "young = 1.1")
        });
        check_unchecked(&format!("{name}, setup"), &other, CHANGED);
        check_unchecked(&format!("{name}, removed"), &parts.without("mean_gap"), CHANGED);
        check_unchecked(&format!("{name}, no digest"), &parts.without("digest"), "has no digest");
        check_unchecked(
            &format!("{name}, other digest"),
            &parts.with_text("digest", |text| text.replace("fnv1a-", "fnv1a-0")),
            CHANGED,
        );
    }
}

/// Two archives with the same names and another run each: an array of one of them does not pass for that of the other.
#[test]
fn an_array_of_another_run_is_told() {
    let scene = |load: &str| format!("{ROUGH}load = {{ mean-pressure = {load} }}\n");
    let [light, heavy] = ["1e-3", "3e-3"].map(|load| Parts::new(&scene(load)));
    let mut mixed = light.clone();
    let place = light.place("pressure");
    mixed.0[place] = heavy.0[heavy.place("pressure")].clone();
    check_unchecked("mixed", &mixed, "is not as it was written");
}

/// A certificate of a file that was changed is not taken for that of the pressure beside it.
#[test]
fn a_changed_pressure_has_its_own_certificate() {
    let parts = Parts::new(&scenes()[0].1);
    let [own, scaled] = [1.0, 1.01].map(|by| parts.with("pressure", |p| *p *= by).read().unwrap());
    let eta = |result: &SavedResult| contacts(result)[0].certificate.eta;
    assert!(eta(&own) < 1e-6 && eta(&scaled) > 1e-4, "{:e} and {:e}", eta(&own), eta(&scaled));
    let other = parts.with("certificate_numbers", |it| *it *= 1e-6).read().unwrap();
    assert!((eta(&other) / eta(&own) - 1.0).abs() < 0.5, "{:e} is not of the file", eta(&other));
}

/// A result of other numerics is as it was written, and is unchecked nevertheless.
#[test]
fn a_result_of_other_numerics_is_unchecked() {
    let parts = Parts::new(&scenes()[0].1);
    let own = format!("+numerics.{NUMERICS}");
    let version = parts.text("digest").split_once(' ').unwrap().1.replace(&own, "+numerics.999");
    // the digest, made again here: FNV-1a over the version, and over name, length and CRC-32 of each member
    let fnv = |hash: u64, bytes: &[u8]| {
        bytes.iter().fold(hash, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3))
    };
    const NOTHING: u64 = 0xcbf2_9ce4_8422_2325;
    let digest = parts.0.iter().filter(|(name, _)| name != "digest").fold(
        fnv(NOTHING, version.as_bytes()),
        |digest, (name, bytes)| {
            let own = fnv(fnv(NOTHING, name.as_bytes()), &(bytes.len() as u64).to_le_bytes());
            fnv(digest, &fnv(own, &crc32fast::hash(bytes).to_le_bytes()).to_le_bytes())
        },
    );
    let other = parts.with_text("digest", |_| format!("fnv1a-{digest:016x} {version}"));
    check_unchecked("other numerics", &other, "was written by version");
}

/// With any bit of an archive wrong it is refused, or told, or all that is read of it is as it was.
///
/// `MUTANTS=10000 cargo test --release --test files saved::` tries more of them.
#[test]
fn each_wrong_bit_is_told_or_changes_nothing() {
    let count: usize = std::env::var("MUTANTS").map_or(200, |count| count.parse().unwrap());
    let scenes: Vec<_> = scenes().into_iter().filter(|(name, _)| MUTATED.contains(name)).collect();
    let mut random = ChaCha8Rng::seed_from_u64(74);
    let mut is_told = 0;
    for (name, scene) in &scenes {
        let bytes = saved(scene);
        let right = told(&read(&bytes).unwrap());
        for _ in 0..count.div_ceil(scenes.len()) {
            let (mut wrong, at) = (bytes.clone(), random.random_range(0..bytes.len()));
            wrong[at] ^= 1 << random.random_range(0..8);
            match read(&wrong) {
                Err(error) => assert!(!error.to_string().contains('\n'), "{name}, byte {at}: {error}"),
                Ok(read) if read.doubts.is_empty() => {
                    assert_eq!(told(&read), right, "{name}, byte {at}");
                    continue;
                }
                Ok(_) => {}
            }
            is_told += 1;
        }
    }
    assert!(is_told as f64 > 0.9 * count as f64, "{is_told} of {count}");
}

/// The scenes whose archives are changed in all ways, and the arrays that are read of them.
const MUTATED: [&str; 6] = ["contact", "stuck", "curve", "creep", "slip", "adhesion"];
const READ: [&str; 14] = [
    "height",
    "pressure",
    "gap",
    "displacement",
    "coarser",
    "iterations",
    "certificate",
    "stiffness",
    "stick_pressure",
    "time",
    "stored_strain",
    "traction",
    "attraction",
    "relative_area",
];

/// The texts of an archive.
const TEXTS: [&str; 6] = ["setup", "claim", "point", "status", "solver", "digest"];

/// Whatever an archive holds, it is told or refused in one sentence.
#[test]
fn mutants_are_told_or_refused_and_never_panic() {
    for (name, scene) in scenes().into_iter().filter(|(name, _)| MUTATED.contains(name)) {
        let parts = Parts::new(&scene);
        let is_text = |name: &str| TEXTS.contains(&name);
        let mut mutants: Vec<(String, Parts)> = Vec::new();
        let names: Vec<&str> = parts.0.iter().map(|(name, _)| name.as_str()).collect();
        for array in names.iter().filter(|array| READ.contains(array) || is_text(array)) {
            mutants.push((format!("without {array}"), parts.without(array)));
        }
        for array in names.iter().filter(|array| READ.contains(array)) {
            let change = |what: &str, change: &dyn Fn(&mut ArrayD<f64>)| {
                (format!("{what} {array}"), parts.with(array, |it| change(it)))
            };
            mutants.push(change("NaN in", &|it| it.iter_mut().take(1).for_each(|it| *it = f64::NAN)));
            mutants.push(change("huge", &|it| *it *= 1e300));
            mutants.push(change("negative", &|it| *it *= -1.0));
            mutants.push(change("zero", &|it| it.fill(0.0)));
            mutants.push(change("longer", &|it| {
                *it =
                    ArrayD::from_shape_vec(IxDyn(&[it.len() + 1]), it.iter().copied().chain([1.0]).collect()).unwrap();
            }));
            mutants.push(change("empty", &|it| *it = ArrayD::zeros(IxDyn(&[0]))));
            mutants.push(change("deep", &|it| *it = ArrayD::zeros(IxDyn(&[2, 2, 2]))));
        }
        for text in names.iter().filter(|name| is_text(name)) {
            mutants.push((format!("other {text}"), parts.with_text(text, |_| "other\u{e9}\n\0".into())));
        }
        // a change such as another sign of nothing leaves an array as it was
        for (change, mutant) in mutants.into_iter().filter(|(_, mutant)| mutant.0 != parts.0) {
            match mutant.read() {
                Err(error) => {
                    let sentence = error.to_string();
                    assert!(!sentence.is_empty() && !sentence.contains('\n'), "{name}, {change}: {sentence}");
                }
                Ok(read) => assert!(!read.doubts.is_empty(), "{name}, {change}"),
            }
        }
    }
}
