//! Sentences of the library in the words of Python: keywords in place of flags and of the keys of scenes, and values as Python writes them.

use asperity::error::{ExpectedValue, FoundValue, TextFault, TextPlace};
use asperity::setup::{FlagValue, Key};

/// Sections and tables whose keys are keywords of functions; keys of all other sections stand in dictionaries.
const KEYWORDS: [&str; 6] = ["grid", "stop", "load", "surface", "surface.spectrum", "surface.indenter"];

/// Keys that are given by the keyword of their section alone.
const SECTIONS: [&str; 3] = ["solver.method", "surface.prepare.steps", "solid.contact-modulus"];

/// Phrases in TOML, and the same in Python.
const PHRASES: [(&str, &str); 3] =
    [(" = auto", "='auto'"), ("{ mean-pressure = 0.01 }", "{'mean_pressure': 0.01}"), ("young = [[", "young=[[")];

/// What the library calls the value of grids that are found.
const AUTO: &str = "auto";

/// A sentence with names in quotes and keys as Python has them.
pub fn in_python(sentence: &str) -> String {
    let sentence = PHRASES.iter().fold(sentence.to_owned(), |it, (phrase, python)| it.replace(phrase, python));
    let parts = sentence.split('`').enumerate().map(|(place, part)| match place % 2 {
        1 if part.contains(' ') => format!("`{part}`"),
        1 => quoted(part),
        _ => part.to_owned(),
    });
    parts.collect()
}

/// A sentence on a fault of what stands at some keys. A fault in a file or a line of a text, which has other keys, keeps its words.
pub fn at_place(place: &TextPlace, fault: &TextFault) -> String {
    let keys = &place.keys;
    let is_of_setup = Key::with_flags().any(|key| Some(key.section()) == keys.split('.').next());
    if place.path.is_some() || place.line.is_some() || !is_of_setup {
        return format!("{place}{fault}");
    }
    let name = keyword(keys);
    match fault {
        TextFault::WrongType { found, expected } | TextFault::WrongValue { found, expected } => {
            let wanted = match (keys.as_str(), found) {
                ("grid.refine", FoundValue::Text(text)) if text == AUTO => {
                    "a whole number here, or refine='auto' to solve".into()
                }
                ("grid.points", FoundValue::Text(text)) if text == AUTO => {
                    "whole numbers here, or grid={'points': 'auto', ...} to Setup".into()
                }
                _ => wanted(keys, expected),
            };
            format!("{name} is {}: give {}", value(found), in_python(&wanted))
        }
        TextFault::NoName { .. } => format!("{name} is not the name of a choice: give a str"),
        TextFault::WrongLength { length, expected } => {
            format!("{name} has the length {length}: give {}", in_python(&wanted(keys, expected)))
        }
        TextFault::UnknownValue { value, .. } => {
            format!("{name} is {}, {}", in_python(&format!("`{value}`")), fault.alternatives(quoted))
        }
        TextFault::UnknownKey { key, .. } => {
            format!("{name}: unknown key '{}', {}", key.replace('-', "_"), fault.alternatives(quoted))
        }
        TextFault::MissingKey { key, .. } => format!("{name}: {} is missing: give it", in_python(&format!("`{key}`"))),
        TextFault::Other { reason, .. } => format!("{name}: {}", in_python(reason)),
    }
}

/// The keyword that a function does not take and those that it takes, of a fault of one of the sections whose keys are its keywords.
pub fn unknown_keyword(place: &TextPlace, fault: &TextFault, sections: &[&str]) -> Option<(String, Vec<String>)> {
    let TextFault::UnknownKey { key, known, .. } = fault else { return None };
    let known = || known.iter().map(|name| in_quotes(name)).collect();
    let is_of_function = *place == TextPlace::keys(&place.keys) && sections.contains(&place.keys.as_str());
    is_of_function.then(|| (key.replace('-', "_"), known()))
}

/// The name under which Python takes what stands at some keys of a setup: a keyword, or a key of a dictionary.
pub fn keyword(keys: &str) -> String {
    let name = |key: &str| key.replace('-', "_");
    match keys.rsplit_once('.') {
        Some((section, _)) if SECTIONS.contains(&keys) => keyword(section),
        Some((section, key)) if !KEYWORDS.contains(&section) => format!("{}['{}']", keyword(section), name(key)),
        Some((_, key)) => name(key),
        None => name(keys),
    }
}

/// How a keyword gives a value to some keys of a setup, such as `refine='auto'` and `law={'hardness': ...}`.
pub fn given_as(keys: &str, value: &str) -> Option<String> {
    let (section, key) = keys.rsplit_once('.')?;
    let key = key.replace('-', "_");
    Some(match section {
        _ if SECTIONS.contains(&keys) => format!("{}={value}", keyword(section)),
        _ if KEYWORDS.contains(&section) => format!("{key}={value}"),
        "record" => format!("recording={{'{key}': {value}}}"),
        _ => format!("{}={{'{key}': {value}}}", keyword(section)),
    })
}

/// The keyword that gives what a flag of the command line gives.
pub fn keyword_of_flag(name: &str) -> Option<String> {
    let name = name.replace('_', "-");
    let key = Key::with_flags().find(|key| key.flag == name)?;
    given_as(key.path, "...")
}

/// What stands in backticks: a key with `_` for `-`, keys with dots as a keyword, and anything else as it is.
fn in_quotes(word: &str) -> String {
    let is_key = |key: &Key| key.path.split('.').any(|key| key == word);
    if Key::all().any(is_key) { word.replace('-', "_") } else { word.to_owned() }
}

fn quoted(name: &str) -> String {
    format!("'{}'", in_quotes(name))
}

/// A value as Python writes it.
fn value(found: &FoundValue) -> String {
    match found {
        FoundValue::Number(number) => number.clone(),
        FoundValue::Boolean(true) => "True".into(),
        FoundValue::Boolean(false) => "False".into(),
        FoundValue::Text(text) => format!("'{text}'"),
        FoundValue::List => "a list".into(),
        FoundValue::Map => "a dictionary".into(),
        FoundValue::Other(words) => words.clone(),
    }
}

/// What is expected at some keys.
fn wanted(keys: &str, expected: &ExpectedValue) -> String {
    let at = |key: &&Key| key.path == keys;
    match (expected, Key::with_flags().find(at).map(|key| key.value)) {
        (ExpectedValue::Section(_), _) => dictionary(keys),
        (ExpectedValue::Map, _) if !keys.contains('.') => dictionary(keys),
        (
            ExpectedValue::Choice(_),
            Some(FlagValue::Choice(names) | FlagValue::Choices(names) | FlagValue::Variant(names)),
        ) => {
            let names: Vec<String> = names().iter().map(|(name, _)| format!("'{name}'")).collect();
            names.join(" or ")
        }
        (ExpectedValue::Values(count), _) => format!("{count} values"),
        (ExpectedValue::Boolean, _) => "True or False".into(),
        _ => expected.to_string(),
    }
}

/// The dictionary that a section is, with its keys.
fn dictionary(keys: &str) -> String {
    let key = |key: &Key| {
        Some(key.path.strip_prefix(keys)?.strip_prefix('.')?.replace('-', "_")).filter(|it| !it.contains('.'))
    };
    let names: Vec<String> = Key::with_flags().filter_map(key).collect();
    let dictionary = format!("a dictionary of {}", names.join(", "));
    match keys {
        "solid" => format!("a number, or {dictionary}"),
        "solver" => format!("a name, or {dictionary}"),
        _ => dictionary,
    }
}
