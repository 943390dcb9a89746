//! Results that are read again: what holds comes back as it was, and what does not is said in a sentence.

use asperity::contact::{ResultClaim, State, Status, archive, archive_of_slip, archive_of_states};
use asperity::error::{FileError, StudyError};
use asperity::job::{HistoryOutcome, Job, SavedFound, SavedResult};
use asperity::setup::{Setup, SetupTable};
use asperity::study::LoadCurve;
use asperity::surface::{has_field, read_fields};
use ndarray::{ArrayD, ArrayView1, IxDyn, OwnedRepr};
use ndarray_npy::{NpzReader, NpzWriter};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};

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
    let mut table = SetupTable::from_toml(scene).unwrap();
    let loads = table.take_loads().unwrap();
    let text = SetupTable::from_toml(scene).unwrap().to_toml();
    let setup: Setup = table.setup().unwrap();
    if let Some(loads) = loads {
        let curve = LoadCurve { setup, loads };
        let mut states = Vec::new();
        let problem = curve.problem().unwrap();
        let keep = |load, contact: &asperity::Contact| {
            states.push(State::from_contact(contact.clone(), Some(load)));
            Ok::<_, StudyError>(())
        };
        curve.press(&problem, |_| (), keep).unwrap();
        return archive_of_states(&states, 1, &text).unwrap();
    }
    if setup.is_history().unwrap() {
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

/// An archive in parts, to be changed: arrays of numbers, and texts.
#[derive(Clone)]
struct Parts {
    numbers: BTreeMap<String, ArrayD<f64>>,
    texts: BTreeMap<String, Vec<u8>>,
}

impl Parts {
    fn of(scene: &str) -> Self {
        let mut npz = NpzReader::new(Cursor::new(saved(scene))).unwrap();
        let mut parts = Self { numbers: BTreeMap::new(), texts: BTreeMap::new() };
        for name in npz.names().unwrap() {
            let plain = name.trim_end_matches(".npy").to_owned();
            if let Ok(array) = npz.by_name::<OwnedRepr<f64>, IxDyn>(&name) {
                parts.numbers.insert(plain, array);
            } else if let Ok(text) = npz.by_name::<OwnedRepr<u8>, IxDyn>(&name) {
                parts.texts.insert(plain, text.into_iter().collect());
            }
        }
        parts
    }

    fn with(&self, name: &str, change: impl FnOnce(&mut ArrayD<f64>)) -> Self {
        let mut parts = self.clone();
        change(parts.numbers.get_mut(name).unwrap_or_else(|| panic!("{name}")));
        parts
    }

    fn with_text(&self, name: &str, change: impl FnOnce(&str) -> String) -> Self {
        let mut parts = self.clone();
        let text = String::from_utf8(parts.texts[name].clone()).unwrap();
        let changed = change(&text);
        assert_ne!(changed, text);
        parts.texts.insert(name.into(), changed.into_bytes());
        parts
    }

    fn without(&self, name: &str) -> Self {
        let mut parts = self.clone();
        assert!(parts.numbers.remove(name).is_some() || parts.texts.remove(name).is_some());
        parts
    }

    fn swapped(&self, one: &str, other: &str) -> Self {
        let mut parts = self.clone();
        parts.numbers.insert(one.into(), self.numbers[other].clone());
        parts.numbers.insert(other.into(), self.numbers[one].clone());
        parts
    }

    fn read(&self) -> Result<SavedResult, StudyError> {
        let folder = tempfile::tempdir().unwrap();
        let path: PathBuf = folder.path().join("it.npz");
        let mut npz = NpzWriter::new(std::fs::File::create(&path).unwrap());
        self.numbers.iter().for_each(|(name, array)| npz.add_array(name, array).unwrap());
        self.texts.iter().for_each(|(name, text)| npz.add_array(name, &ArrayView1::from(text)).unwrap());
        npz.finish().unwrap();
        SavedResult::read(&path)
    }
}

/// The states of all contacts of a result.
fn statuses(result: &SavedResult) -> Vec<Status> {
    match &result.found {
        SavedFound::Contact(contact, _) => vec![contact.status],
        SavedFound::Curve(contacts) => contacts.iter().map(|it| it.status).collect(),
        SavedFound::History(outcome) => outcome.states.iter().map(|it| it.contact.status).collect(),
    }
}

#[test]
fn what_was_saved_holds() {
    for (name, scene) in scenes() {
        let parts = Parts::of(&scene);
        let read = parts.read().unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(read.doubts, [""; 0], "{name}");
        assert!(statuses(&read).iter().all(|status| *status == Status::Converged), "{name}");
        if let SavedFound::History(outcome) = &read.found {
            let claims = String::from_utf8(parts.texts["claim"].clone()).unwrap();
            let found: Vec<&str> = outcome.states.iter().map(|state| state.claim.into()).collect();
            assert_eq!(found, claims.lines().collect::<Vec<_>>(), "{name}");
        }
    }
}

/// A result that was changed is not converged, and says why.
fn check_doubted(name: &str, parts: &Parts, words: &str) {
    let read = parts.read().unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(read.doubts.iter().any(|doubt| doubt.contains(words)), "{name}, {words}: {:?}", read.doubts);
    assert!(read.doubts.iter().all(|doubt| doubt.ends_with('.') && !doubt.contains('\n')));
    assert!(statuses(&read).contains(&Status::Unconfirmed), "{name}, {words}");
}

#[test]
fn a_contact_that_does_not_hold_says_why() {
    let scenes: BTreeMap<_, _> = scenes().into_iter().collect();
    let part = Parts::of(&scenes["contact"]);
    let load = |text: &str| text.replace("mean-pressure = 0.002", "mean-pressure = 0.0012");
    check_doubted("load", &part.with_text("setup", load), "The pressures carry 1.667 of the prescribed load");
    let soft = |text: &str| text.replace("contact-modulus = 1.0", "contact-modulus = 2.0");
    check_doubted("modulus", &part.with_text("setup", soft), "does not cause the displacement in it");
    let seed = |text: &str| text.replace("[surface.spectrum]", "[surface]\nseed = 2\n[surface.spectrum]");
    check_doubted("seed", &part.with_text("setup", seed), "does not meet the tolerance");
    let read = part.with_text("setup", seed).read().unwrap();
    assert!(read.doubts[0].starts_with("The heights in ") && read.doubts[0].contains("are not those of its setup"));
    check_doubted("gap", &part.with("gap", |gap| gap.fill(0.0)), "is not that of the pressure in it");
    check_doubted("scaled", &part.with("pressure", |p| *p *= 1.01), "carry 1.010 of the prescribed load");
    check_doubted("turned", &part.with("pressure", |p| *p *= -1.0), "are negative");
    check_doubted("swapped", &part.swapped("gap", "displacement"), "does not cause the displacement");
    let moved = |p: &mut ArrayD<f64>| {
        let last = p.len() - 1;
        p.as_slice_mut().unwrap()[..=last].rotate_left(1);
    };
    check_doubted(
        "moved",
        &part.with("pressure", moved).with("displacement", moved).with("gap", moved),
        "does not meet the tolerance",
    );
    check_doubted("coarse", &part.with("coarser", |it| it.as_slice_mut().unwrap()[0] *= 2.0), "next coarser grid");
    let gap = Parts::of(&scenes["gap"]);
    let other = |text: &str| text.replace("mean-gap = 0.002", "mean-gap = 0.0019");
    check_doubted("mean gap", &gap.with_text("setup", other), "does not meet the tolerance");
    let hard = Parts::of(&scenes["hard"]);
    let softer = |text: &str| text.replace("hardness = 0.05", "hardness = 0.04");
    check_doubted("hardness", &hard.with_text("setup", softer), "exceed the hardness by 25.00 %");
    let stuck = Parts::of(&scenes["stuck"]);
    check_doubted_slip(&stuck.with("stick_pressure", |p| *p *= 1.1));
}

fn check_doubted_slip(parts: &Parts) {
    let read = parts.read().unwrap();
    let SavedFound::Contact(_, Some(slip)) = &read.found else { panic!("it has a slip") };
    assert_eq!((slip.stuck.status, read.doubts.len()), (Status::Unconfirmed, 1), "{:?}", read.doubts);
}

#[test]
fn states_that_do_not_hold_say_why_and_claim_nothing() {
    let scenes: BTreeMap<_, _> = scenes().into_iter().collect();
    let changed = |name: &str, words: &str, change: &dyn Fn(&Parts) -> Parts| {
        let parts = change(&Parts::of(&scenes[name]));
        check_doubted(name, &parts, words);
        let SavedFound::History(outcome) = parts.read().unwrap().found else { panic!("{name} is a history") };
        let is_claimed = |it: &State| it.claim != ResultClaim::Unchecked;
        assert!(outcome.states.iter().all(|it| is_claimed(it) == (it.contact.status == Status::Converged)), "{name}");
    };
    let text =
        |from: &'static str, to: &'static str| move |parts: &Parts| parts.with_text("setup", |it| it.replace(from, to));
    let last = |name: &'static str, by: f64| {
        move |parts: &Parts| {
            parts.with(name, |it| {
                let last = it.shape()[0] - 1;
                it.index_axis_mut(ndarray::Axis(0), last).mapv_inplace(|value| by * value);
            })
        }
    };
    changed("creep", "does not cause the displacement", &text("contact-modulus = 1.0", "contact-modulus = 1.1"));
    changed("creep", "of the prescribed load", &text("0.005", "0.004"));
    changed("creep", "does not cause the displacement", &last("stored_strain", 0.9));
    changed("creep", "of the prescribed load", &last("time", 0.9));
    changed("held", "The mean gap is ", &text("mean-gap = 0.002", "mean-gap = 0.0022"));
    changed("held", "is not that of the pressure", &last("gap", 0.0));
    changed("slip", "exceed the limit of friction", &text("coefficient = 0.5", "coefficient = 0.4"));
    changed("slip", "The mean traction is ", &last("traction", 0.5));
    changed("slip", "does not follow from the state before", &|parts| {
        parts.with("traction", |it| {
            // the last but one, which is no point of the path
            let state = it.shape()[0] - 2;
            it.index_axis_mut(ndarray::Axis(0), state).fill(0.0);
        })
    });
    changed("sliding", "The setup has no speed", &last("speed", 2.0));
    changed("sliding", "does not cause the displacement", &text("creep = [9.0, 1.0]", "creep = [8.0, 1.0]"));
    changed("rolling", "exceed the limit of friction", &last("traction", 1e3));
    changed("rolling", "The setup has no creepage", &last("creepage", 1.1));
    changed("adhesion", "The attraction in ", &text("work = 0.00001", "work = 0.000011"));
    changed("adhesion", "does not cause the displacement", &last("attraction", 0.0));
    changed("adhesion", "of the prescribed load", &text("load = [0.002, 0.0]", "load = [0.001, 0.0]"));
}

#[test]
fn what_cannot_be_checked_claims_nothing() {
    let scenes: BTreeMap<_, _> = scenes().into_iter().collect();
    for (name, field) in [("creep", "stored_strain"), ("slip", "traction"), ("adhesion", "attraction")] {
        let read = Parts::of(&scenes[name]).without(field).read().unwrap();
        assert_eq!(read.doubts.len(), 1, "{:?}", read.doubts);
        assert!(
            read.doubts[0].starts_with(&format!("There is no array `{field}`, without which")),
            "{:?}",
            read.doubts
        );
        let SavedFound::History(outcome) = read.found else { panic!("{name} is a history") };
        assert!(outcome.states.iter().all(|state| state.claim == ResultClaim::Unchecked));
    }
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

/// Whatever an archive holds, it is read or refused in one sentence; and what is certified is not left converged if it was changed.
#[test]
fn mutants_are_doubted_or_refused_and_never_panic() {
    for (name, scene) in scenes().into_iter().filter(|(name, _)| MUTATED.contains(name)) {
        let parts = Parts::of(&scene);
        let mut mutants: Vec<(String, Parts)> = Vec::new();
        let is_read = |array: &&String| READ.contains(&array.as_str()) || parts.texts.contains_key(*array);
        for array in parts.numbers.keys().chain(parts.texts.keys()).filter(is_read) {
            mutants.push((format!("without {array}"), parts.without(array)));
        }
        for array in parts.numbers.keys().filter(|array| READ.contains(&array.as_str())) {
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
        for text in parts.texts.keys() {
            mutants.push((format!("other {text}"), parts.with_text(text, |_| "other\u{e9}\n\0".into())));
        }
        for (change, mutant) in mutants {
            match mutant.read() {
                Err(error) => {
                    let sentence = error.to_string();
                    assert!(!sentence.is_empty() && !sentence.contains('\n'), "{name}, {change}: {sentence}");
                }
                Ok(read) => {
                    let field = change.split(' ').next_back().unwrap_or_default();
                    let is_field = ["pressure", "gap", "displacement"].contains(&field);
                    assert!(!is_field || !read.doubts.is_empty(), "{name}, {change}");
                }
            }
        }
    }
}
