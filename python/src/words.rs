//! Sentences of the library in the words of Python: keywords in place of flags and of the keys of scenes, and values as Python writes them.

use asperity::setup::{FLAGS, Flag, FlagValue};

/// Sections and tables whose keys are keywords of functions; keys of all other sections stand in dictionaries.
const KEYWORDS: [&str; 6] = ["grid", "stop", "load", "surface", "surface.spectrum", "surface.indenter"];

/// Keys that are given by the keyword of their section alone.
const SECTIONS: [&str; 3] = ["solver.method", "surface.prepare.steps", "solid.contact-modulus"];

/// Phrases with flags or in TOML, and the same in Python.
const PHRASES: [(&str, &str); 4] = [
    (" with --record", " (record)"),
    (" = auto", "='auto'"),
    ("{ mean-pressure = 0.01 }", "{'mean_pressure': 0.01}"),
    ("young = [[", "young=[["),
];

/// What the library calls the value of grids that are found.
const AUTO: &str = "text \"auto\"";

/// A sentence without flags, with names in quotes and keys as Python has them.
pub fn in_python(sentence: &str) -> String {
    let sentence = PHRASES.iter().fold(without_flags(sentence), |it, (phrase, python)| it.replace(phrase, python));
    let parts = sentence.split('`').enumerate().map(|(place, part)| match place % 2 {
        1 if part.contains(' ') => format!("`{part}`"),
        1 => format!("'{}'", in_quotes(part)),
        _ => part.to_owned(),
    });
    parts.collect()
}

/// A sentence on what stands at the keys of `place`, such as `stop.max-iterations: `. A place in a text, which has other keys, stays as it is.
pub fn at_place(place: &str, reason: &str) -> String {
    let keys = place.trim_end_matches(": ");
    if !FLAGS.iter().any(|flag| Some(flag.section()) == keys.split('.').next()) {
        return without_flags(&format!("{place}{reason}"));
    }
    let name = keyword(keys);
    let invalid = ["invalid type: ", "invalid value: "].iter().find_map(|it| reason.strip_prefix(it));
    if let Some((found, expected)) = invalid.and_then(|it| it.split_once(", expected ")) {
        let wanted = match (keys, found) {
            ("grid.refine", AUTO) => "a whole number here, or refine='auto' to solve".into(),
            ("grid.points", AUTO) => "whole numbers here, or grid={'points': 'auto', ...} to Setup".into(),
            _ => wanted(keys, expected),
        };
        return format!("{name} is {}: give {}", value(found), in_python(&wanted));
    }
    if reason.contains("unit variant") {
        return format!("{name} is not the name of a choice: give a str");
    }
    if let Some((length, expected)) = reason.strip_prefix("invalid length ").and_then(|it| it.split_once(", expected "))
    {
        return format!("{name} has the length {length}: give {}", in_python(&wanted(keys, expected)));
    }
    if let Some(given) = reason.strip_prefix("unknown value ") {
        return format!("{name} is {}", in_python(given));
    }
    if let Some((unknown, known)) = unknown_key(reason) {
        return format!("{name}: unknown key '{unknown}'{}", in_python(known));
    }
    if let Some((missing, remedy)) = reason.strip_prefix("missing key ").and_then(|it| it.split_once(": ")) {
        return format!("{name}: {} is missing: {}", in_python(missing), in_python(remedy));
    }
    format!("{name}: {}", in_python(reason))
}

/// The keyword that a function does not take and those that it takes, of a sentence on a key of one of the sections whose keys are its keywords.
pub fn unknown_keyword(place: &str, reason: &str, sections: &[&str]) -> Option<(String, Vec<String>)> {
    let (unknown, known) = unknown_key(reason).filter(|_| sections.contains(&place.trim_end_matches(": ")))?;
    let known = known.split_once(": ").map_or(known, |(known, _)| known);
    Some((unknown, known.split('`').skip(1).step_by(2).map(in_quotes).collect()))
}

/// The unknown key of a sentence, with `_` for `-`, and the rest of the sentence.
fn unknown_key(reason: &str) -> Option<(String, &str)> {
    let (unknown, rest) = reason.strip_prefix("unknown key `")?.split_once('`')?;
    Some((unknown.replace('-', "_"), rest))
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
    let flag = FLAGS.iter().find(|flag| flag.name == name)?;
    given_as(flag.path, "...")
}

/// A sentence without the flags of the command line in brackets, such as " (--size)".
pub fn without_flags(sentence: &str) -> String {
    match sentence.split_once(" (--") {
        Some((before, flags)) => {
            format!("{before}{}", without_flags(flags.split_once(')').map_or("", |(_, after)| after)))
        }
        None => sentence.to_owned(),
    }
}

/// What stands in backticks: a key with `_` for `-`, keys with dots as a keyword, and anything else as it is.
fn in_quotes(word: &str) -> String {
    let is_key = |flag: &Flag| flag.path.split('.').any(|key| key == word);
    match word {
        _ if FLAGS.iter().any(is_key) => word.replace('-', "_"),
        // keys without a flag
        "second-spectrum" | "uniform-stiffness" => word.replace('-', "_"),
        _ => word.to_owned(),
    }
}

/// A value as Python writes it.
fn value(found: &str) -> String {
    let bare = |it: &str| it.trim_end_matches('`').to_owned();
    match found.split_once('`').or_else(|| found.split_once(' ')) {
        Some(("number ", number)) => bare(number),
        Some(("boolean ", "true`")) => "True".into(),
        Some(("boolean ", "false`")) => "False".into(),
        Some(("text", text)) => format!("'{}'", text.trim_matches('"')),
        _ if found == "list" => "a list".into(),
        _ if found == "map" => "a dictionary".into(),
        _ => found.to_owned(),
    }
}

/// What is expected at some keys.
fn wanted(keys: &str, expected: &str) -> String {
    let at = |flag: &&Flag| flag.path == keys;
    let section =
        expected.strip_prefix("a section for the").or(expected.strip_prefix("a map").filter(|_| !keys.contains('.')));
    match (section, expected.split_once(' '), FLAGS.iter().find(at).map(|flag| flag.value)) {
        (Some(_), ..) => dictionary(keys),
        (
            None,
            Some(("enum", _)),
            Some(FlagValue::Choice(names) | FlagValue::Choices(names) | FlagValue::Variant(names)),
        ) => {
            let names: Vec<String> = names().iter().map(|(name, _)| format!("'{name}'")).collect();
            names.join(" or ")
        }
        (None, Some(("an", rest)), _) if rest.starts_with("array of length ") => {
            format!("{} values", rest.trim_start_matches("array of length "))
        }
        _ => expected.replace("a boolean", "True or False"),
    }
}

/// The dictionary that a section is, with its keys.
fn dictionary(keys: &str) -> String {
    let key = |flag: &Flag| {
        Some(flag.path.strip_prefix(keys)?.strip_prefix('.')?.replace('-', "_")).filter(|it| !it.contains('.'))
    };
    let names: Vec<String> = FLAGS.iter().filter_map(key).collect();
    let dictionary = format!("a dictionary of {}", names.join(", "));
    match keys {
        "solid" => format!("a number, or {dictionary}"),
        "solver" => format!("a name, or {dictionary}"),
        _ => dictionary,
    }
}
