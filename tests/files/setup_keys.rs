//! The one table of keys: every key of a scene is in it, and what it says of units holds.

use crate::named_files::{ROUGH, keys_in, sentence};
use asperity::error::SetupError;
use asperity::setup::{Dimension, Key, SetupTable, choices};
use asperity::surface::Indenter;
use std::collections::BTreeSet;

/// The keys below a section, down to some depth. A section has keys of its own; a key that is none has no more below it.
fn keys_below(section: &str, depth: usize, found: &mut BTreeSet<String>) {
    for key in keys_in(section) {
        let below = if depth > 0 { keys_in(&key) } else { Vec::new() };
        if below.is_empty() {
            found.insert(key);
        } else {
            keys_below(&key, depth - 1, found);
        }
    }
}

#[test]
fn every_key_of_a_scene_is_declared_once() {
    let declared: BTreeSet<String> = Key::all().map(|key| key.path.to_owned()).collect();
    assert_eq!(declared.len(), Key::all().count(), "a key is declared twice");
    let mut found = BTreeSet::new();
    keys_below("", 3, &mut found);
    // a section that is chosen by a name lists its keys once the name is given
    let has_keys =
        |path: &String| declared.iter().any(|key| key.strip_prefix(path).is_some_and(|rest| rest.starts_with('.')));
    let missing: Vec<&String> = found.iter().filter(|path| !declared.contains(*path) && !has_keys(path)).collect();
    assert!(missing.is_empty() && found.len() > 80, "{missing:?}");
}

#[test]
fn flags_are_declared_once() {
    let flags: BTreeSet<&str> = Key::with_flags().map(|key| key.flag).collect();
    assert_eq!(flags.len(), Key::with_flags().count());
}

/// A value of a key: a list of a ratio and a time where these belong together.
fn value(key: &Key, number: toml::Value) -> toml::Value {
    if key.section() == "viscoelastic" { vec![0.5.into(), number].into() } else { number }
}

/// What is said of a value of a key; of an indenter's, with each shape.
fn said(key: &Key, number: toml::Value) -> String {
    let value = value(key, number);
    if !key.path.starts_with("surface.indenter.") {
        return sentence(key.path, value);
    }
    let mut said = String::new();
    for (shape, _) in choices::<Indenter>() {
        let mut table = SetupTable::from_toml(ROUGH).unwrap();
        table.lay("surface.indenter.shape", shape.into());
        table.lay(key.path, value.clone());
        said += &table.setup().map_or_else(|error| error.to_string(), |_| String::new());
    }
    said
}

/// Each key whose number measures something takes it with its unit; one without a dimension takes no unit at all.
#[test]
fn a_key_takes_the_units_of_its_dimension_and_no_others() {
    for key in Key::all() {
        let units = match key.dimension {
            Dimension::Length => "mm",
            Dimension::Pressure => "MPa",
            Dimension::Force => "N/m",
            Dimension::EnergyPerArea => "J/m^2",
            Dimension::Time => "s",
            Dimension::Speed => "m/s",
            _ => continue,
        };
        let said = said(key, format!("5{units}").into());
        assert!(!said.contains("unit") || said.contains("modulus"), "{}: {said}", key.path);
    }
    let mut undecided = Vec::new();
    for key in Key::all().filter(|key| key.dimension == Dimension::One) {
        let alone = said(key, 5.into());
        for unit in ["mm", "MPa", "N", "J/m^2", "s", "m/s", "nohm*m"] {
            let with = said(key, format!("5{unit}").into());
            assert!(!with.is_empty(), "{} takes {unit}", key.path);
            if with == alone {
                undecided.push(key.path);
            }
        }
    }
    // what else is wrong with the setup is said first
    undecided.dedup();
    assert!(undecided.len() < 12, "{undecided:?}");
}

/// `--size 1mm --low-pass 5` would mean five metres.
#[test]
fn a_number_alone_beside_a_unit_is_refused_at_every_key() {
    for (dimension, unit) in [(Dimension::Length, "1mm"), (Dimension::Pressure, "1GPa"), (Dimension::Time, "1s")] {
        let keys: Vec<&Key> = Key::of_dimension(dimension).collect();
        assert!(keys.len() >= 3, "{dimension:?}");
        for key in &keys {
            let other = keys.iter().find(|other| other.path != key.path && other.section() != key.section()).unwrap();
            let mut table = SetupTable::default();
            table.lay(other.path, value(other, unit.into()));
            table.check_units().unwrap();
            table.lay(key.path, value(key, 5.into()));
            let refused = table.check_units().unwrap_err();
            assert!(matches!(refused, SetupError::MixedUnits { .. }), "{}: {refused}", key.path);
        }
    }
}
