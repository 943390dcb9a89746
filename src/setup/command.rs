//! Setups as command lines: flags laid over a setup, and the line that repeats one.

use super::{FlagValue, Key, Setup, SetupTable, Solid};

/// The place of the contact modulus in a setup.
const CONTACT_MODULUS: &str = "solid.contact-modulus";

/// Lays flags with their words over a setup, in the order of [`Key::all`](super::Key::all).
pub fn lay(given: &[(&Key, Vec<String>)], over: &mut SetupTable) {
    if given.iter().any(|(key, _)| key.section() == "load") {
        over.remove("load");
    }
    // a contact modulus and elastic constants take the place of one another
    for (key, _) in given.iter().filter(|(key, _)| key.section() == "solid") {
        over.remove(if key.path == CONTACT_MODULUS { "solid" } else { CONTACT_MODULUS });
    }
    for (key, words) in given {
        if let (FlagValue::Variant(_), Some((beside, _))) = (key.value, key.path.rsplit_once('.')) {
            over.remove(beside);
        }
        over.lay(key.path, read(key, words));
    }
}

/// A whole number, a number, or a text; whole numbers that are too long stay as they are written.
pub(super) fn value(word: &str) -> toml::Value {
    match (word.parse::<i64>(), word.parse()) {
        (Ok(whole), _) if whole.to_string() == word => toml::Value::Integer(whole),
        (_, Ok(number)) if !word.bytes().all(|byte| byte.is_ascii_digit()) => toml::Value::Float(number),
        _ => toml::Value::String(word.into()),
    }
}

/// The command line that repeats a setup, to the last digit, without a recording. A stiffness has no flag: such a setup is repeated from
/// a scene, see [`Setup::to_table`].
pub fn command(setup: &Setup) -> String {
    if let Some(Solid::Stiffness(_)) = setup.solid {
        return "asperity solve scene.toml".into();
    }
    let table = setup.to_table();
    let flags = Key::with_flags().filter(|key| key.section() != "record");
    let written = |key: &Key| {
        let value = table.find(key.path)?;
        Some(match key.value {
            FlagValue::Switch => format!(" --{}", key.flag),
            _ => format!(" --{}{}", key.flag, after_name(&word(value))),
        })
    };
    format!("asperity solve{}", flags.filter_map(written).collect::<String>())
}

/// A word as it stands after the name of its flag: one that begins with a minus would be read as another flag.
fn after_name(word: &str) -> String {
    let between = if word.starts_with('-') { '=' } else { ' ' };
    format!("{between}{word}")
}

/// A value as it is written on a command line.
fn word(value: &toml::Value) -> String {
    match value {
        toml::Value::String(text) => quoted(text),
        toml::Value::Float(number) => format!("{number:e}"),
        toml::Value::Array(values) => values.iter().map(word).collect::<Vec<_>>().join(","),
        other => other.to_string(),
    }
}

/// A text as one word of a shell, in single quotes unless it is plain: the name of a file may hold anything.
fn quoted(text: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./,:+".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        text.into()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

/// The value of the words of a flag.
fn read(key: &Key, words: &[String]) -> toml::Value {
    let is_list = matches!(key.value, FlagValue::Choices(_));
    match words {
        _ if matches!(key.value, FlagValue::Switch) => toml::Value::Boolean(true),
        [one] if !is_list => value(one),
        more => toml::Value::Array(more.iter().map(|word| value(word)).collect()),
    }
}
