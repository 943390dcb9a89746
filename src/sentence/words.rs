//! A sentence and what stands in its places.

use super::shortened::shortened;
use super::template::{TemplatePiece, pieces};
use serde::ser::{Serialize, SerializeStruct, Serializer};
use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::{self, Display, Formatter};

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
pub struct Sentence(Box<SentenceParts>);

/// The parts of a sentence, which are boxed so that an error that holds one stays small.
#[derive(Debug, Clone, PartialEq)]
struct SentenceParts {
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
            None => Self(SentenceParts { template, values }.into()),
        }
    }

    /// The words in English with the names of the places in braces, the same for all values.
    pub fn template(&self) -> String {
        let word = |piece| match piece {
            TemplatePiece::Words(words) => words.to_owned(),
            TemplatePiece::Place { name, .. } => format!("{{{name}}}"),
        };
        pieces(self.0.template).map(word).collect()
    }

    /// What stands in the places, by their names.
    fn places(&self) -> BTreeMap<&'static str, FilledPlace<'_>> {
        let place = |piece| match piece {
            TemplatePiece::Words(_) => None,
            TemplatePiece::Place { name, format } => Some((name, FilledPlace { value: self.value(name)?, format })),
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
            TemplatePiece::Words(words) => words.to_owned(),
            TemplatePiece::Place { name, format } => match self.value(name) {
                Some(Value::Sentence(sentence)) => sentence.in_english(words),
                Some(value) => words(value).unwrap_or_else(|| value.shown(format)),
                None => String::new(),
            },
        };
        pieces(self.0.template).map(said).collect()
    }
}

/// A value, and how its place shows it.
struct FilledPlace<'a> {
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
        Self(SentenceParts { template: WHOLE.0, values: vec![(WHOLE.1, Value::Text(text))] }.into())
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

impl Serialize for FilledPlace<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.value {
            Value::Sentence(sentence) => sentence.serialize(serializer),
            // no unit suits a length that is zero or not finite
            Value::Length(length) if length.is_normal() => serializer.collect_map([("length", length)]),
            value => serializer.serialize_str(&value.shown(self.format)),
        }
    }
}

/// What stands in a place of a sentence.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number, which a front end may show in the words in which it was given. Counts are texts.
    Number(f64),
    /// A length, which a front end may also show in a unit that suits it.
    Length(f64),
    /// A text, such as a name, a count, or a number that is rounded already.
    Text(String),
    /// Another sentence.
    Sentence(Sentence),
}

impl Display for Value {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) | Self::Length(number) => write!(f, "{number:?}"),
            Self::Text(text) => f.write_str(text),
            Self::Sentence(sentence) => sentence.fmt(f),
        }
    }
}

impl Value {
    /// The value as a place shows it whose format is this.
    pub(super) fn shown(&self, format: &str) -> String {
        match self {
            Self::Number(number) | Self::Length(number) => number_as(*number, format),
            Self::Text(text) => text_as(text, format),
            Self::Sentence(sentence) => sentence.to_string(),
        }
    }
}

/// A number as a place shows it: `?` with a decimal point, `e` with an exponent, `.2` and `.2e` with so many decimals.
fn number_as(number: f64, format: &str) -> String {
    let decimals = |digits: &str| digits.strip_prefix('.').and_then(|it| it.parse::<usize>().ok());
    match (format, format.strip_suffix('e').map(decimals)) {
        ("?", _) => format!("{number:?}"),
        (_, Some(Some(decimals))) => format!("{number:.decimals$e}"),
        (_, Some(None)) => format!("{number:e}"),
        _ => match decimals(format) {
            Some(decimals) => format!("{number:.decimals$}"),
            None => number.to_string(),
        },
    }
}

/// A text as a place shows it: `?` in quotes. What a damaged file holds may be of any length, and is cut.
fn text_as(text: &str, format: &str) -> String {
    match format {
        "?" => format!("{:?}", shortened(text)),
        _ => shortened(text).into_owned(),
    }
}
