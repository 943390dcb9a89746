//! Setups in a few words.

use super::{FlagValue, Key, Setup, SetupTable};

/// The values of some sections of a setup under the names of their flags, such as `reduced-pressure 0.02, gfmd, damping 0.5`.
///
/// ```
/// use asperity::contact::Load;
/// use asperity::setup::{Cell, Recipe, Setup, in_words};
/// use asperity::Indenter;
/// let sine = Recipe::indenter(Indenter::Sine { amplitude: 0.01 });
/// let setup = Setup::new(sine, Cell::line(256, 1.0), Load::ReducedPressure(0.1));
/// assert_eq!(in_words(&setup, &["load", "solver"]), "reduced-pressure 0.1, multilevel");
/// ```
pub fn in_words(setup: &Setup, sections: &[&str]) -> String {
    let table = setup.to_table();
    words(&table, Key::with_flags().filter(|key| sections.contains(&key.section())))
}

/// The differences of setups, without their recordings: for each setup, the values that are not the same in all of
/// them. Settings of a method or a shape that others have not are no difference of their own.
///
/// ```
/// use asperity::contact::{Gfmd, Load};
/// use asperity::setup::{Cell, Method, Recipe, Setup, differences};
/// use asperity::Indenter;
/// let sine = Recipe::indenter(Indenter::Sine { amplitude: 0.01 });
/// let fast = Setup::new(sine, Cell::line(256, 1.0), Load::ReducedPressure(0.1));
/// let gfmd = |damping| Setup { solver: Method::Gfmd(Gfmd { damping, ..Gfmd::default() }), ..fast.clone() };
/// assert_eq!(differences(&[fast.clone(), gfmd(1.0)]), ["multilevel", "gfmd"]);
/// assert_eq!(differences(&[gfmd(1.0), gfmd(0.5)]), ["damping 1.0", "damping 0.5"]);
/// ```
pub fn differences(setups: &[Setup]) -> Vec<String> {
    differences_of_tables(&setups.iter().map(Setup::to_table).collect::<Vec<_>>())
}

/// The settings in which setups differ that are given as tables, such as those of lists of loads: see [`differences`].
pub fn differences_of_tables(tables: &[SetupTable]) -> Vec<String> {
    let differ = |key: &Key| tables.iter().any(|table| table.find(key.path) != tables[0].find(key.path));
    let differ_where_they_are = |key: &Key| {
        let mut values = tables.iter().filter_map(|table| table.find(key.path));
        values.next().is_some_and(|first| values.any(|value| value != first))
    };
    let is_written = |key: &&Key| {
        let is_setting =
            Key::with_flags().any(|it| it.flag != key.flag && is_variant(it) && differ(it) && beside(it, key));
        key.section() != "record" && if is_setting { differ_where_they_are(key) } else { differ(key) }
    };
    tables.iter().map(|table| words(table, Key::with_flags().filter(is_written))).collect()
}

fn is_variant(key: &Key) -> bool {
    matches!(key.value, FlagValue::Variant(_))
}

/// Whether two flags set values of the same table.
fn beside(one: &Key, other: &Key) -> bool {
    one.path.rsplit_once('.').map(|(table, _)| table) == other.path.rsplit_once('.').map(|(table, _)| table)
}

/// The values of flags under their names; that of a method or a shape needs no name.
fn words<'a>(table: &SetupTable, flags: impl Iterator<Item = &'a Key>) -> String {
    let word = |key: &Key| {
        let value = plain(table.find(key.path)?);
        Some(match key.value {
            FlagValue::Variant(_) => value,
            FlagValue::Switch => key.flag.into(),
            _ => format!("{} {value}", key.flag),
        })
    };
    flags.filter_map(word).collect::<Vec<_>>().join(", ")
}

/// A value as a user writes it.
pub(super) fn plain(value: &toml::Value) -> String {
    match value {
        toml::Value::String(text) => text.clone(),
        toml::Value::Float(number) if number.abs() >= 1e5 => format!("{number:e}"),
        toml::Value::Float(number) => format!("{number:?}"),
        toml::Value::Array(values) => values.iter().map(plain).collect::<Vec<_>>().join(" x "),
        other => other.to_string(),
    }
}
