//! Setups in a few words.

use super::{FLAGS, Flag, FlagValue, Setup, SetupTable};

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
    words(&table, FLAGS.iter().filter(|flag| sections.contains(&flag.section())))
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
    let differ = |flag: &Flag| tables.iter().any(|table| table.find(flag.path) != tables[0].find(flag.path));
    let differ_where_they_are = |flag: &Flag| {
        let mut values = tables.iter().filter_map(|table| table.find(flag.path));
        values.next().is_some_and(|first| values.any(|value| value != first))
    };
    let is_written = |flag: &&Flag| {
        let is_setting =
            FLAGS.iter().any(|it| it.name != flag.name && is_variant(it) && differ(it) && beside(it, flag));
        flag.section() != "record" && if is_setting { differ_where_they_are(flag) } else { differ(flag) }
    };
    tables.iter().map(|table| words(table, FLAGS.iter().filter(is_written))).collect()
}

fn is_variant(flag: &Flag) -> bool {
    matches!(flag.value, FlagValue::Variant(_))
}

/// Whether two flags set values of the same table.
fn beside(one: &Flag, other: &Flag) -> bool {
    one.path.rsplit_once('.').map(|(table, _)| table) == other.path.rsplit_once('.').map(|(table, _)| table)
}

/// The values of flags under their names; that of a method or a shape needs no name.
fn words<'a>(table: &SetupTable, flags: impl Iterator<Item = &'a Flag>) -> String {
    let word = |flag: &Flag| {
        let value = plain(table.find(flag.path)?);
        Some(match flag.value {
            FlagValue::Variant(_) => value,
            FlagValue::Switch => flag.name.into(),
            _ => format!("{} {value}", flag.name),
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
