//! Messages of the readers of TOML as faults: the only place that reads their English.

use super::Key;
use crate::error::{ExpectedValue, FoundValue, TextFault};
use serde::de::Unexpected;

/// Names of types in the messages of serde, and plain words for them.
const PLAIN: [(&str, &str); 12] = [
    ("floating point `", "number `"),
    ("integer `", "number `"),
    ("string \"", "text \""),
    ("sequence", "list"),
    ("expected usize", "expected a whole number, 0 or more"),
    ("expected u64", "expected a whole number, 0 or more"),
    ("expected f64", "expected a number"),
    ("expected path string", "expected the name of a file"),
    ("expected variant identifier", "expected a name"),
    ("expected internally tagged enum", "expected a section for the"),
    ("expected struct", "expected a section for the"),
    ("there are no fields", "there are none"),
];

impl TextFault {
    /// The fault in a message of the parser of TOML, in plain words where it has none.
    pub(super) fn from_parser(message: &str) -> Self {
        let reason = match one_line(message) {
            it if it.starts_with("invalid mantissa") => {
                "a number has no digits before its point: write 0.1 for .1".into()
            }
            it => it,
        };
        Self::Other { reason, flags: Vec::new() }
    }

    /// The fault in a message of serde about what stands at some keys: for an unknown name with the nearest known one, for a missing key with
    /// its flag on the command line.
    pub(super) fn from_serde(message: &str, keys: &str) -> Self {
        let message = plain(one_line(message));
        let between = |start: &str, middle: &'static str| message.strip_prefix(start)?.split_once(middle);
        if let Some((key, known)) = between("unknown field `", "`, ") {
            let (key, known, nearest) = names(key, known);
            let meant = meant(&key, keys).filter(|meant| known.iter().any(|it| it == meant)).map(String::from);
            return Self::UnknownKey { nearest: meant.or(nearest), key, known };
        }
        if let Some((value, known)) = between("unknown variant `", "`, ") {
            let (value, known, nearest) = names(value, known);
            return Self::UnknownValue { value, known, nearest };
        }
        if let Some((key, _)) = between("missing field `", "`") {
            return Self::MissingKey { key: key.into(), flags: flags(&[key], keys) };
        }
        if let Some((found, expected)) = between("invalid type: ", ", expected ") {
            return Self::WrongType { found: found_value(found), expected: expected_value(expected) };
        }
        if let Some((found, expected)) = between("invalid value: ", ", expected ") {
            return Self::WrongValue { found: found_value(found), expected: expected_value(expected) };
        }
        if let Some((length, expected)) = between("invalid length ", ", expected ") {
            return Self::WrongLength { length: length.into(), expected: expected_value(expected) };
        }
        if message.contains("unit variant") {
            return Self::NoName { reason: message };
        }
        let flags = if message.starts_with("give the") { flags(&quoted(&message), keys) } else { Vec::new() };
        Self::Other { reason: message, flags }
    }
}

/// The keys that lead to an error, which its text ends in.
pub(super) fn keys_of(error: &toml::de::Error) -> String {
    let text = error.to_string();
    let keys = text.lines().find_map(|line| line.trim().strip_prefix("in `")?.strip_suffix('`'));
    keys.unwrap_or_default().into()
}

/// A value as faults call it.
pub(super) fn found_in(value: &toml::Value) -> FoundValue {
    let unexpected = match value {
        toml::Value::String(text) => Unexpected::Str(text),
        toml::Value::Integer(number) => Unexpected::Signed(*number),
        toml::Value::Float(number) => Unexpected::Float(*number),
        toml::Value::Boolean(is_so) => Unexpected::Bool(*is_so),
        toml::Value::Array(_) => Unexpected::Seq,
        toml::Value::Table(_) | toml::Value::Datetime(_) => Unexpected::Map,
    };
    found_value(&plain(unexpected.to_string()))
}

/// A message with plain words for the names of types.
fn plain(message: String) -> String {
    PLAIN.iter().fold(message, |message, (name, plain)| message.replace(name, plain))
}

fn one_line(message: &str) -> String {
    message.lines().map(str::trim).collect::<Vec<_>>().join(" ")
}

/// What stands between backticks.
fn quoted(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// Symbols in place of keys.
const SYMBOLS: [(&str, &str); 4] = [("nu", "poisson"), ("E", "young"), ("H", "hurst"), ("mu", "coefficient")];

/// The key below other keys whose flag, or whose symbol, is given in its place.
fn meant(given: &str, keys: &str) -> Option<&'static str> {
    let of_flag = Key::with_flags().filter(|key| key.flag == given);
    let key = of_flag.filter_map(|key| key.path.strip_prefix(keys)?.strip_prefix('.')).next();
    key.or_else(|| SYMBOLS.iter().find(|(symbol, _)| *symbol == given).map(|(_, key)| *key))
}

/// An unknown name, the known ones, and the nearest of them.
fn names(unknown: &str, known: &str) -> (String, Vec<String>, Option<String>) {
    let known = quoted(known);
    let nearest = nearest(unknown, &known).map(String::from);
    (unknown.into(), known.into_iter().map(String::from).collect(), nearest)
}

/// The flags of keys below other keys.
fn flags(names: &[&str], keys: &str) -> Vec<&'static str> {
    let is_of = |key: &Key, name: &str| key.path.strip_prefix(keys) == Some(&format!(".{name}"));
    names.iter().filter_map(|name| Key::with_flags().find(|key| is_of(key, name))).map(|key| key.flag).collect()
}

fn found_value(words: &str) -> FoundValue {
    let in_marks = |start: &str, mark: char| words.strip_prefix(start)?.strip_suffix(mark).map(String::from);
    match words {
        "list" => FoundValue::List,
        "map" => FoundValue::Map,
        "boolean `true`" => FoundValue::Boolean(true),
        "boolean `false`" => FoundValue::Boolean(false),
        _ => (in_marks("number `", '`').map(FoundValue::Number))
            .or(in_marks("text \"", '"').map(FoundValue::Text))
            .unwrap_or_else(|| FoundValue::Other(words.into())),
    }
}

fn expected_value(words: &str) -> ExpectedValue {
    let after = |start: &str| words.strip_prefix(start).map(String::from);
    match words {
        "a map" => ExpectedValue::Map,
        "a boolean" => ExpectedValue::Boolean,
        _ => (after("a section for the ").map(ExpectedValue::Section))
            .or(after("enum ").map(ExpectedValue::Choice))
            .or(after("an array of length ").and_then(|it| it.parse().ok()).map(ExpectedValue::Values))
            .unwrap_or_else(|| ExpectedValue::Words(words.into())),
    }
}

/// Names that are farther from each other than this have nothing in common.
#[cfg(feature = "units")]
const FAR: f64 = 0.6;

/// The known name that is nearest to an unknown one, first of all one that begins with it, then one that it is a part of, of
/// several the shortest; none where all are far from it. Parts of fewer than three letters say nothing.
#[cfg(feature = "units")]
fn nearest<'a>(unknown: &str, known: &[&'a str]) -> Option<&'a str> {
    let nearness = |name: &str| match name.find(unknown).filter(|at| *at == 0 || unknown.len() > 2) {
        Some(0) => 2.0 + unknown.len() as f64 / name.len() as f64,
        Some(_) => 1.0 + unknown.len() as f64 / name.len() as f64,
        None => strsim::jaro_winkler(unknown, name),
    };
    let near = known.iter().copied().filter(|name| nearness(name) > FAR);
    near.max_by(|a, b| nearness(a).total_cmp(&nearness(b)))
}

#[cfg(not(feature = "units"))]
fn nearest<'a>(_: &str, _: &[&'a str]) -> Option<&'a str> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_become_data_and_plain_sentences() {
        let fault = TextFault::from_serde("invalid type: string \"x\", expected f64", "stop.tolerance");
        let (found, expected) = (FoundValue::Text("x".into()), ExpectedValue::Words("a number".into()));
        assert_eq!(fault, TextFault::WrongType { found, expected });
        assert_eq!(fault.to_string(), "invalid type: text \"x\", expected a number");
        let fault = TextFault::from_serde("invalid length 1, expected an array of length 2", "");
        assert_eq!(fault, TextFault::WrongLength { length: "1".into(), expected: ExpectedValue::Values(2) });
        let fault = TextFault::from_serde("missing field `poisson`", "solid");
        assert_eq!(fault, TextFault::MissingKey { key: "poisson".into(), flags: vec!["poisson"] });
        assert_eq!(fault.to_string(), "missing key `poisson`: give it");
        let fault = TextFault::from_serde("unknown field `tme`, expected `time` or `load`", "path");
        assert!(
            matches!(&fault, TextFault::UnknownKey { key, known, .. } if key == "tme" && known.len() == 2),
            "{fault:?}"
        );
        assert!(fault.to_string().starts_with("unknown key `tme`, expected `time` or `load`: "), "{fault}");
    }
}
