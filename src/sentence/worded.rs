//! What makes sentences.

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

/// A [`Sentence`] of a template and the values of its places, with the syntax of [`format!`]; each value is named. A template without a value for
/// each of its places does not compile.
macro_rules! sentence {
    ($template:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {{
        #[allow(unused_imports, reason = "a template may have no places")]
        use $crate::sentence::ToValue;
        // never evaluated: it lets the compiler compare the places with the names
        let _ = || {
            $(let $name = 0;)*
            format!($template $(, $name = $name)*)
        };
        let values = vec![$((stringify!($name), $crate::sentence::sentence!(@value $name $($value)?).to_value())),*];
        $crate::sentence::Sentence::new($template, values)
    }};
    (@value $name:ident) => { $name };
    (@value $name:ident $value:expr) => { ($value) };
}
pub(crate) use sentence;

/// Declares enums of errors by `thiserror`, and makes them [`Worded`].
///
/// A variant looks as `thiserror` wants it: `#[error("...")]` with the names of fields in braces, further values by name behind it, such as
/// `#[error("{file} is damaged", file = path.display())]`, or `#[error(transparent)]`. The one difference is that each value has a name; one
/// that has the name of a field stands for the field.
macro_rules! worded {
    ($(
        $(#[doc = $doc:expr])*
        #[derive($($derive:path),*)]
        pub enum $name:ident { $($variants:tt)* }
    )*) => {$(
        $(#[doc = $doc])*
        #[derive($($derive),*)]
        pub enum $name { $($variants)* }

        $crate::sentence::worded!(@implement $name $($variants)*);

        impl $crate::sentence::ToValue for $name {
            fn to_value(&self) -> $crate::sentence::Value {
                $crate::sentence::Value::Sentence($crate::sentence::Worded::sentence(self))
            }
        }
    )*};
    (@implement $name:ident $(
        $(#[doc = $about:expr])*
        #[error($($error:tt)*)]
        $variant:ident
        $({ $($(#[doc = $about_field:expr])* $field:ident : $type:ty),* $(,)? })?
        $(($(#[$from:meta])? $inner:ty))?
    ),* $(,)?) => {
        impl $crate::sentence::Worded for $name {
            #[allow(clippy::redundant_pattern, reason = "the pattern names the type of a wrapped error, of which there may be none")]
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
    };
    (@any $inner:ty) => { _ };
    (@sentence [transparent] [] [$inner:ident: $type:ty]) => { $crate::sentence::Worded::sentence($inner) };
    (@sentence ["{0}"] [] [$inner:ident: $type:ty]) => { $crate::sentence::Sentence::from($inner.to_string()) };
    (@sentence [$template:literal $(, $name:ident = $value:expr)* $(,)?] [$($field:ident)*] []) => {{
        #[allow(unused_imports, reason = "a variant may have no values")]
        use $crate::sentence::ToValue;
        $crate::sentence::Sentence::new(
            $template,
            vec![$((stringify!($name), ($value).to_value()),)* $((stringify!($field), $field.to_value()),)*],
        )
    }};
    (@templates [transparent] [$inner:ty]) => { <$inner as $crate::sentence::Worded>::templates() };
    (@templates ["{0}"] [$inner:ty]) => { Vec::new() };
    (@templates [$template:literal $(, $name:ident = $value:expr)* $(,)?] []) => { vec![$template] };
}
pub(crate) use worded;
