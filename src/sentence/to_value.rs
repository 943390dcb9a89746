//! What can stand in a place of a sentence.

use super::words::{Sentence, Value};
use std::borrow::Cow;
use std::fmt;
use std::io;
use std::path::{self, PathBuf};

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
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LengthValue(pub f64);

impl ToValue for LengthValue {
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
