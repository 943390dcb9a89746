//! Refusals of the page.

use crate::error::{FileError, ProblemError, SetupError, SurfaceError};

/// The refusal of an invalid request, in one sentence.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct Refusal(pub String);

impl From<SetupError> for Refusal {
    fn from(error: SetupError) -> Self {
        Self(error.to_string())
    }
}

impl From<FileError> for Refusal {
    fn from(error: FileError) -> Self {
        Self(error.to_string())
    }
}

impl From<ProblemError> for Refusal {
    fn from(error: ProblemError) -> Self {
        Self(error.to_string())
    }
}

impl From<SurfaceError> for Refusal {
    fn from(error: SurfaceError) -> Self {
        Self(error.to_string())
    }
}

/// The fault of a JSON text, in words of the page: names of Rust types are replaced by the values that they accept.
pub fn plain(error: &serde_json::Error) -> String {
    let said = error.to_string();
    let said = said.rsplit_once(" at line ").map_or(said.as_str(), |(said, _)| said);
    if let Some((name, known)) = said.strip_prefix("unknown field ").and_then(|it| it.split_once(", expected one of "))
    {
        return format!("there is no {name} here: choose one of {known}");
    }
    let is_value = said.starts_with("invalid value: ") || said.starts_with("invalid type: ");
    let Some((found, wanted)) = said.split_once(", expected ").filter(|_| is_value) else { return said.into() };
    let value = found.split_once(": ").map_or(found, |(_, value)| value).replace('`', "");
    let kind = ["integer ", "floating point ", "string "].into_iter().find(|kind| value.starts_with(kind));
    let value = kind.map_or(value.as_str(), |kind| &value[kind.len()..]);
    let wanted = if wanted.starts_with("struct ") { "a map" } else { wanted };
    let wanted = WANTED.iter().find(|(rust, _)| *rust == wanted).map_or(wanted, |(_, words)| words);
    format!("{value} is not possible: give {wanted}")
}

/// Types in Rust, and what they take.
const WANTED: [(&str, &str); 5] = [
    ("u32", "a whole number from 0 to 4294967295"),
    ("usize", "a whole number, not negative"),
    ("f64", "a number"),
    ("a sequence", "a list"),
    ("a map", "a table"),
];
