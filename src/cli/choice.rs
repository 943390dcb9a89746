//! Values of flags that are chosen by name, or count something.

use asperity::setup::choices;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::num::NonZeroUsize;
use std::str::FromStr;
use strum::{EnumMessage, IntoEnumIterator, ParseError};

/// One of some names, with a short description each.
pub(crate) fn one_of(names: impl IntoIterator<Item = (&'static str, &'static str)>) -> PossibleValuesParser {
    PossibleValuesParser::new(names.into_iter().map(|(name, help)| PossibleValue::new(name).help(help)))
}

/// One of the variants of an enum.
pub(crate) fn choice<T>() -> impl TypedValueParser<Value = T>
where
    T: IntoEnumIterator + EnumMessage + Into<&'static str> + FromStr<Err = ParseError> + Clone + Send + Sync + 'static,
{
    one_of(choices::<T>()).try_map(|name| name.parse::<T>())
}

/// Bytes, such as `8GB` or `500 MB`.
pub(crate) fn bytes(text: &str) -> Result<f64, String> {
    let number = text.trim_end_matches(|c: char| c.is_alphabetic());
    let unit = match text[number.len()..].to_ascii_lowercase().as_str() {
        "" | "b" => 1.0,
        "kb" => 1e3,
        "mb" => 1e6,
        "gb" => 1e9,
        "tb" => 1e12,
        _ => f64::NAN,
    };
    let bytes = number.trim().parse::<f64>().map_or(f64::NAN, |number| number * unit);
    if bytes.is_finite() && bytes >= 1.0 {
        Ok(bytes)
    } else {
        Err("give a positive number with kB, MB, GB or TB".into())
    }
}

/// A positive whole number.
pub(crate) fn count(text: &str) -> Result<NonZeroUsize, &'static str> {
    text.parse().map_err(|_| "give a positive whole number")
}
