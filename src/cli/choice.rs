//! Values of flags that are chosen by name, or count something.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::num::NonZeroUsize;

/// One of some names, with a few words on each, and the value that it stands for.
pub fn choice<T: Clone + Send + Sync + 'static>(
    names: impl IntoIterator<Item = (&'static str, &'static str)>,
    of: fn(&str) -> Option<T>,
) -> impl TypedValueParser<Value = T> {
    let names = names.into_iter().map(|(name, help)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(names).try_map(move |name| of(&name).ok_or("it has no meaning"))
}

/// A positive whole number.
pub fn count(text: &str) -> Result<NonZeroUsize, &'static str> {
    text.parse().map_err(|_| "give a positive whole number")
}
