//! What makes sentences.

use super::to_value::ToValue;
use super::words::Sentence;
use std::error::Error;

/// An error whose variants are sentences that keep their values.
pub trait Worded: Error {
    /// The sentence with its values.
    fn sentence(&self) -> Sentence;

    /// The words of all sentences of this type in English, with places as [`format!`] has them.
    fn templates() -> Vec<&'static str>
    where
        Self: Sized;
}

/// The sentence of a template and what stands in its places, by their names. It is not generic, so that what a macro makes of a sentence is small.
pub(crate) fn sentence_of_places(template: &'static str, places: &[(&'static str, &dyn ToValue)]) -> Sentence {
    Sentence::new(template, places.iter().map(|(name, value)| (*name, value.to_value())).collect())
}

/// A [`Sentence`] of a template and the values of its places, with the syntax of [`format!`]; each value is named. A template without a value for
/// each of its places does not compile.
macro_rules! sentence {
    ($template:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {{
        // never evaluated: it lets the compiler compare the places with the names
        let _ = || {
            $(let $name = 0;)*
            format!($template $(, $name = $name)*)
        };
        $crate::sentence::sentence_of_places($template, &[$((stringify!($name), &$crate::sentence::sentence!(@value $name $($value)?))),*])
    }};
    (@value $name:ident) => { $name };
    (@value $name:ident $value:expr) => { ($value) };
}
pub(crate) use sentence;

/// Declares enums of errors whose variants are sentences: [`Worded`], and with it [`Display`](std::fmt::Display), [`Error`] and [`From`].
///
/// A variant looks as the crate `thiserror` has it: `#[error("...")]` with the names of fields in braces, further values by name behind it, such as
/// `#[error("{file} is damaged", file = path.display())]`, or `#[error(transparent)]` for an error that says what the wrapped one says. A value that has
/// the name of a field stands for the field. A field `source` is the source of the error, and `#[from]` makes the conversion from the wrapped one. That
/// crate itself is not used, as its sentences do not keep their values.
macro_rules! worded {
    ($(
        $(#[doc = $doc:expr])*
        #[derive($($derive:path),*)]
        pub enum $name:ident {
            $(
                $(#[doc = $about:expr])*
                #[error($($error:tt)*)]
                $variant:ident
                $({ $($(#[doc = $about_field:expr])* $field:ident : $type:ty),* $(,)? })?
                $(($(#[$from:ident])? $inner:ty))?
            ),* $(,)?
        }
    )*) => {$(
        $(#[doc = $doc])*
        #[derive($($derive),*)]
        pub enum $name {
            $(
                $(#[doc = $about])*
                $variant $({ $($(#[doc = $about_field])* $field: $type),* })? $(($inner))?
            ),*
        }

        #[allow(clippy::redundant_pattern, unused_variables, reason = "an arm binds all that its variant has")]
        impl $crate::sentence::Worded for $name {
            fn sentence(&self) -> $crate::sentence::Sentence {
                match self {$(
                    Self::$variant $({ $($field),* })? $({ 0: inner @ $crate::sentence::worded!(@any $inner) })? =>
                        $crate::sentence::worded!(@sentence [$($error)*] [$($($field)*)?] [$(inner: $inner)?]),
                )*}
            }

            fn templates() -> Vec<&'static str> {
                [$($crate::sentence::worded!(@templates [$($error)*] [$($inner)?])),*].concat()
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                $crate::sentence::Worded::sentence(self).fmt(f)
            }
        }

        #[allow(clippy::redundant_pattern, unused_variables, reason = "an arm binds all that its variant has")]
        impl std::error::Error for $name {
            fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
                match self {$(
                    Self::$variant $({ $($field),* })? $({ 0: inner @ $crate::sentence::worded!(@any $inner) })? =>
                        $crate::sentence::worded!(@source [$($error)*] [$($($field)*)?] [$(inner: $inner)?]),
                )*}
            }
        }

        impl $crate::sentence::ToValue for $name {
            fn to_value(&self) -> $crate::sentence::Value {
                $crate::sentence::Value::Sentence($crate::sentence::Worded::sentence(self))
            }
        }

        $($($($crate::sentence::worded!(@from [$from] $name $variant $inner);)?)?)*
    )*};
    (@any $inner:ty) => { _ };
    (@sentence [transparent] [] [$inner:ident: $type:ty]) => { $crate::sentence::Worded::sentence($inner) };
    (@sentence ["{0}"] [] [$inner:ident: $type:ty]) => { $crate::sentence::Sentence::from($inner.to_string()) };
    (@sentence [$template:literal $(, $name:ident = $value:expr)* $(,)?] [$($field:ident)*] []) => {{
        // never evaluated: it lets the compiler compare the places with the names
        let _ = || {
            $(let $field = 0;)*
            format!($template $(, $name = 0)*)
        };
        $crate::sentence::sentence_of_places($template, &[$((stringify!($name), &$value),)* $((stringify!($field), $field),)*])
    }};
    (@templates [transparent] [$inner:ty]) => { <$inner as $crate::sentence::Worded>::templates() };
    (@templates ["{0}"] [$inner:ty]) => { Vec::new() };
    (@templates [$template:literal $(, $name:ident = $value:expr)* $(,)?] []) => { vec![$template] };
    (@source [transparent] [] [$inner:ident: $type:ty]) => { std::error::Error::source($inner) };
    (@source [$($error:tt)*] [] [$($inner:tt)*]) => { None };
    (@source [$($error:tt)*] [$first:ident $($field:ident)*] []) => {
        $crate::sentence::worded!(@source_in [$($error)*] $first [$first $($field)*])
    };
    (@source_in [$($error:tt)*] $source:tt [source $($field:ident)*]) => { Some($source) };
    (@source_in [$($error:tt)*] $other:tt [$first:ident $($field:ident)*]) => {
        $crate::sentence::worded!(@source [$($error)*] [$($field)*] [])
    };
    (@from [from] $name:ident $variant:ident $inner:ty) => {
        impl From<$inner> for $name {
            fn from(error: $inner) -> Self {
                Self::$variant(error)
            }
        }
    };
}
pub(crate) use worded;
