//! Values of flags that are chosen by name, or count something.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::num::NonZeroUsize;

/// One of some names, with a short description each.
pub fn one_of(names: impl IntoIterator<Item = (&'static str, &'static str)>) -> PossibleValuesParser {
    PossibleValuesParser::new(names.into_iter().map(|(name, help)| PossibleValue::new(name).help(help)))
}

/// The value with this name.
pub fn choice<T: Clone + Send + Sync + 'static>(
    names: impl IntoIterator<Item = (&'static str, &'static str)>,
    of: fn(&str) -> Option<T>,
) -> impl TypedValueParser<Value = T> {
    one_of(names).try_map(move |name| of(&name).ok_or("it has no meaning"))
}

/// Bytes, such as `8GB` or `500 MB`.
pub fn bytes(text: &str) -> Result<f64, String> {
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
pub fn count(text: &str) -> Result<NonZeroUsize, &'static str> {
    text.parse().map_err(|_| "give a positive whole number")
}
