//! Values of flags that are chosen by name, or count something.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::num::NonZeroUsize;

/// One of some names, with a few words on each.
pub fn one_of(names: impl IntoIterator<Item = (&'static str, &'static str)>) -> PossibleValuesParser {
    PossibleValuesParser::new(names.into_iter().map(|(name, help)| PossibleValue::new(name).help(help)))
}

/// The value that one of some names stands for.
pub fn choice<T: Clone + Send + Sync + 'static>(
    names: impl IntoIterator<Item = (&'static str, &'static str)>,
    of: fn(&str) -> Option<T>,
) -> impl TypedValueParser<Value = T> {
    one_of(names).try_map(move |name| of(&name).ok_or("it has no meaning"))
}

/// A positive whole number.
pub fn count(text: &str) -> Result<NonZeroUsize, &'static str> {
    text.parse().map_err(|_| "give a positive whole number")
}
