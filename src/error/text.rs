//! Faults of texts that are no setups: where they are, and what is wrong.

use crate::sentence::{ToValue, Value};
use std::fmt::{self, Display, Formatter};
use std::path::{Path, PathBuf};

/// Where a text is wrong: a file, a line, and keys, of which any may be unknown.
///
/// ```
/// use asperity::error::TextPlace;
/// let place = TextPlace { line: Some(3), ..TextPlace::keys("grid.points") };
/// assert_eq!(place.to_string(), "line 3, grid.points: ");
/// assert_eq!(place.in_file("a.toml".as_ref()).to_string(), "a.toml: line 3, grid.points: ");
/// assert_eq!(TextPlace::default().to_string(), "");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TextPlace {
    pub path: Option<PathBuf>,
    /// Counted from 1.
    pub line: Option<usize>,
    /// Keys of a setup, separated by dots; empty where there are none.
    pub keys: String,
}

impl TextPlace {
    /// The place of some keys.
    pub fn keys(keys: impl Into<String>) -> Self {
        Self { keys: keys.into(), ..Self::default() }
    }

    /// The place in a file.
    pub fn in_file(self, path: &Path) -> Self {
        Self { path: Some(path.into()), ..self }
    }
}

impl ToValue for TextPlace {
    fn to_value(&self) -> Value {
        Value::Text(self.to_string())
    }
}

impl Display for TextPlace {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { path, line, keys } = self;
        if let Some(path) = path {
            write!(f, "{}: ", path.display())?;
        }
        match (line, keys.is_empty()) {
            (Some(line), true) => write!(f, "line {line}: "),
            (Some(line), false) => write!(f, "line {line}, {keys}: "),
            (None, true) => Ok(()),
            (None, false) => write!(f, "{keys}: "),
        }
    }
}

/// What is wrong with a text.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TextFault {
    /// A key that its section does not have.
    #[error("unknown key `{key}`, {}", self.alternatives(in_backticks))]
    UnknownKey {
        key: String,
        known: Vec<String>,
        /// The known key that was probably meant.
        nearest: Option<String>,
    },
    /// A name that is not among those to choose from.
    #[error("unknown value `{value}`, {}", self.alternatives(in_backticks))]
    UnknownValue {
        value: String,
        known: Vec<String>,
        /// The known name that was probably meant.
        nearest: Option<String>,
    },
    /// A key that must be there.
    #[error("missing key `{key}`: give it")]
    MissingKey {
        key: String,
        /// Flags of the command line that give it, without dashes.
        flags: Vec<&'static str>,
    },
    #[error("invalid type: {found}, expected {expected}")]
    WrongType { found: FoundValue, expected: ExpectedValue },
    #[error("invalid value: {found}, expected {expected}")]
    WrongValue { found: FoundValue, expected: ExpectedValue },
    #[error("invalid length {length}, expected {expected}")]
    WrongLength { length: String, expected: ExpectedValue },
    /// A value in the place of a name to choose.
    #[error("{reason}")]
    NoName { reason: String },
    #[error("{reason}")]
    Other {
        reason: String,
        /// Flags of the command line that give what is missing, without dashes.
        flags: Vec<&'static str>,
    },
}

impl ToValue for Box<TextFault> {
    fn to_value(&self) -> Value {
        Value::Text(self.to_string())
    }
}

/// A value that was found in a text, as it is written there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FoundValue {
    Number(String),
    Text(String),
    Boolean(bool),
    List,
    Map,
    Other(String),
}

impl Display for FoundValue {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "number `{number}`"),
            Self::Text(text) => write!(f, "text \"{text}\""),
            Self::Boolean(is_so) => write!(f, "boolean `{is_so}`"),
            Self::List => f.write_str("list"),
            Self::Map => f.write_str("map"),
            Self::Other(words) => f.write_str(words),
        }
    }
}

/// What a text should have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ExpectedValue {
    /// A section, called as it is in the library.
    Section(String),
    Map,
    Boolean,
    /// One of some names, called as they are in the library.
    Choice(String),
    /// A list of this number of values.
    Values(usize),
    /// Anything else.
    Words(String),
}

impl Display for ExpectedValue {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Section(name) => write!(f, "a section for the {name}"),
            Self::Map => f.write_str("a map"),
            Self::Boolean => f.write_str("a boolean"),
            Self::Choice(name) => write!(f, "enum {name}"),
            Self::Values(count) => write!(f, "an array of length {count}"),
            Self::Words(words) => f.write_str(words),
        }
    }
}

fn in_backticks(name: &str) -> String {
    format!("`{name}`")
}

impl TextFault {
    /// Flags of the command line that give what is missing, without dashes: one of them is enough.
    pub fn flags(&self) -> &[&'static str] {
        match self {
            Self::MissingKey { flags, .. } | Self::Other { flags, .. } => flags,
            _ => &[],
        }
    }

    /// The known names in place of an unknown key or value, as `quoted` writes them, and what to do; empty for other faults.
    pub fn alternatives(&self, quoted: impl Fn(&str) -> String) -> String {
        let (Self::UnknownKey { known, nearest, .. } | Self::UnknownValue { known, nearest, .. }) = self else {
            return String::new();
        };
        let names: Vec<String> = known.iter().map(|name| quoted(name)).collect();
        let known = match names.as_slice() {
            [] => "there are none".into(),
            [one] => format!("expected {one}"),
            [one, other] => format!("expected {one} or {other}"),
            _ => format!("expected one of {}", names.join(", ")),
        };
        match nearest {
            Some(nearest) => format!("{known}: did you mean {}?", quoted(nearest)),
            None => format!("{known}: leave it out, or choose an option that has it"),
        }
    }
}
