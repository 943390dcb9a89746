//! Sentences for people: words with values in their places.
//!
//! Errors and warnings are sentences that keep their values, so that each front end says them in its own way without searching for words in a text:
//! the command line shows a value with the unit in which a person gave it, and the page looks the words up in the table of its language.
//!
//! [`sentence!`] makes one, and [`worded!`] declares an enum of errors each of whose variants is one.

mod shortened;
mod template;
mod value;
mod worded;

pub(crate) use shortened::shortened;
pub(crate) use template::Piece;
pub use value::{Length, ToValue, Value};
pub use worded::Worded;
pub(crate) use worded::{sentence, worded};

use serde::ser::{Serialize, SerializeStruct, Serializer};
use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::{self, Display, Formatter};
use template::pieces;

/// Words with values in their places, or a text that is known as a whole only.
///
/// ```
/// use asperity::Grid;
/// use asperity::sentence::{Value, Worded};
/// let sentence = Grid::line(128, -1.0).unwrap_err().sentence();
/// assert_eq!(sentence.template(), "the length along {axis} is {length}: give a positive, finite length");
/// assert_eq!(sentence.to_string(), "the length along x is -1.0: give a positive, finite length");
/// let given = |value: &Value| (*value == Value::Length(-1.0)).then(|| "-1m".to_owned());
/// assert_eq!(sentence.in_words(given), "the length along x is -1m: give a positive, finite length");
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Sentence(Box<Parts>);

/// The parts of a sentence, which are boxed so that an error that holds one stays small.
#[derive(Debug, Clone, PartialEq)]
struct Parts {
    /// The words in English, with places as [`format!`] has them, such as `{length:?}`.
    template: &'static str,
    /// The values by the names of their places. Some may have no place.
    values: Vec<(&'static str, Value)>,
}

/// The template of a text that is known as a whole only, and the name of its one place.
const WHOLE: (&str, &str) = ("{text}", "text");

impl Sentence {
    /// The sentence of a template and its values. A template that is a single place gives what stands there.
    pub(crate) fn new(template: &'static str, values: Vec<(&'static str, Value)>) -> Self {
        let is_place = |name: &str| template.strip_prefix('{').and_then(|it| it.strip_suffix('}')) == Some(name);
        match values.iter().find(|(name, _)| is_place(name)) {
            Some((_, Value::Sentence(sentence))) => sentence.clone(),
            Some((_, value)) => value.to_string().into(),
            None => Self(Parts { template, values }.into()),
        }
    }

    /// The words in English with the names of the places in braces, the same for all values.
    pub fn template(&self) -> String {
        let word = |piece| match piece {
            Piece::Words(words) => words.to_owned(),
            Piece::Place { name, .. } => format!("{{{name}}}"),
        };
        pieces(self.0.template).map(word).collect()
    }

    /// What stands in the places, by their names.
    fn places(&self) -> BTreeMap<&'static str, Place<'_>> {
        let place = |piece| match piece {
            Piece::Words(_) => None,
            Piece::Place { name, format } => Some((name, Place { value: self.value(name)?, format })),
        };
        pieces(self.0.template).filter_map(place).collect()
    }

    fn value(&self, place: &str) -> Option<&Value> {
        self.0.values.iter().find(|(name, _)| *name == place).map(|(_, value)| value)
    }

    /// Whether it is a text that is known as a whole only, or has no places.
    fn is_text(&self) -> bool {
        self.0.template == WHOLE.0 || self.places().is_empty()
    }

    /// The sentence in English, where `words` may have its own words for a value, such as those in which it was given.
    pub fn in_words(&self, words: impl Fn(&Value) -> Option<String>) -> String {
        self.in_english(&words)
    }

    fn in_english(&self, words: &dyn Fn(&Value) -> Option<String>) -> String {
        let said = |piece| match piece {
            Piece::Words(words) => words.to_owned(),
            Piece::Place { name, format } => match self.value(name) {
                Some(Value::Sentence(sentence)) => sentence.in_english(words),
                Some(value) => words(value).unwrap_or_else(|| value.shown(format)),
                None => String::new(),
            },
        };
        pieces(self.0.template).map(said).collect()
    }
}

/// A value, and how its place shows it.
struct Place<'a> {
    value: &'a Value,
    format: &'a str,
}

impl Display for Sentence {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_english(&|_| None))
    }
}

impl Error for Sentence {}

impl From<String> for Sentence {
    fn from(text: String) -> Self {
        Self(Parts { template: WHOLE.0, values: vec![(WHOLE.1, Value::Text(text))] }.into())
    }
}

impl From<&str> for Sentence {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

/// In JSON it is a text if it has no places, and otherwise `{"template": ..., "places": {...}}`. A place holds a text, a further sentence, or
/// `{"length": ...}` with a number.
impl Serialize for Sentence {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.is_text() {
            return serializer.collect_str(self);
        }
        let mut parts = serializer.serialize_struct("Sentence", 2)?;
        parts.serialize_field("template", &self.template())?;
        parts.serialize_field("places", &self.places())?;
        parts.end()
    }
}

impl Serialize for Place<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.value {
            Value::Sentence(sentence) => sentence.serialize(serializer),
            Value::Length(length) => serializer.collect_map([("length", length)]),
            value => serializer.serialize_str(&value.shown(self.format)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_is_what_format_makes_of_its_words() {
        let (small, name, shape) = (1e-7, "a \"b\"", [2usize, 3]);
        let said = sentence!(
            "{small:?} {small} {small:e} {small:.3e} {small:.1} of {name:?} {name} {shape:?} {{x}}",
            small,
            name,
            shape
        );
        assert_eq!(
            said.to_string(),
            format!("{small:?} {small} {small:e} {small:.3e} {small:.1} of {name:?} {name} {shape:?} {{x}}")
        );
    }

    #[test]
    fn numbers_have_other_words_also_in_sentences_within() {
        let inner = sentence!("the length is {length:?} of {count}", length = Length(4e-3), count = 4usize);
        let outer = sentence!("line {line}: {inner}", line = 4usize, inner = &inner);
        let words = |value: &Value| (*value == Value::Length(4e-3)).then(|| "4mm".to_owned());
        assert_eq!(outer.in_words(words), "line 4: the length is 4mm of 4");
        assert_eq!(outer.to_string(), "line 4: the length is 0.004 of 4");
        assert_eq!(
            serde_json::to_string(&outer).unwrap(),
            r#"{"template":"line {line}: {inner}","places":{"inner":{"template":"the length is {length} of {count}","places":{"count":"4","length":{"length":0.004}}},"line":"4"}}"#
        );
    }

    #[test]
    fn a_single_place_is_what_stands_there() {
        let inner = sentence!("{count} points", count = 3usize);
        assert_eq!(sentence!("{inner}", inner = &inner), inner);
        assert_eq!(sentence!("{reason}", reason = "{ x = 1 }"), Sentence::from("{ x = 1 }"));
        assert_eq!(serde_json::to_string(&Sentence::from("{ x = 1 }")).unwrap(), "\"{ x = 1 }\"");
    }
}
