//! Values in sentences.

use super::{Sentence, shortened};
use std::borrow::Cow;
use std::fmt::{self, Display, Formatter};
use std::io;
use std::path::{self, PathBuf};

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

impl<T: ToValue> From<T> for Value {
    fn from(value: T) -> Self {
        value.to_value()
    }
}

/// What can stand in a place of a sentence.
pub trait ToValue {
    /// The value, with what a sentence needs to say of it.
    fn to_value(&self) -> Value;
}

impl<T: ToValue + ?Sized> ToValue for &T {
    fn to_value(&self) -> Value {
        (**self).to_value()
    }
}

impl ToValue for f64 {
    fn to_value(&self) -> Value {
        Value::Number(*self)
    }
}

/// A length in a sentence.
#[derive(Clone, Copy, PartialEq)]
pub struct Length(pub f64);

impl fmt::Debug for Length {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.0, f)
    }
}

impl fmt::LowerExp for Length {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        fmt::LowerExp::fmt(&self.0, f)
    }
}

impl ToValue for Length {
    fn to_value(&self) -> Value {
        Value::Length(self.0)
    }
}

impl ToValue for Sentence {
    fn to_value(&self) -> Value {
        Value::Sentence(self.clone())
    }
}

/// Nothing, where there is none.
impl<T: ToValue> ToValue for Option<T> {
    fn to_value(&self) -> Value {
        self.as_ref().map_or(Value::Text(String::new()), ToValue::to_value)
    }
}

/// Texts in a list are in quotes, as `{:?}` shows them.
impl<T: fmt::Debug> ToValue for [T] {
    fn to_value(&self) -> Value {
        Value::Sentence(format!("{self:?}").into())
    }
}

impl<T: fmt::Debug> ToValue for Vec<T> {
    fn to_value(&self) -> Value {
        self.as_slice().to_value()
    }
}

impl<T: fmt::Debug, const N: usize> ToValue for [T; N] {
    fn to_value(&self) -> Value {
        self.as_slice().to_value()
    }
}

impl ToValue for PathBuf {
    fn to_value(&self) -> Value {
        self.display().to_value()
    }
}

/// Types whose value is the text that they show.
macro_rules! texts {
    ($($type:ty),*) => {$(
        impl ToValue for $type {
            fn to_value(&self) -> Value {
                Value::Text(self.to_string())
            }
        }
    )*};
}

texts!(bool, i64, u32, u64, u128, usize, str, String, Cow<'_, str>, io::Error, path::Display<'_>);

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
