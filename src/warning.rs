//! Warnings about results and surfaces: what may be wrong, and what to do about it.

use crate::seen::capital;
use crate::sentence::Sentence;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// A setting that removes the cause of a warning, named by its key in a setup. Each front end words it in its own way: the command line as
/// a flag, Python as a keyword, the page as the name of a knob.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Remedy {
    /// The key of a setup, such as `grid.refine`.
    pub key: &'static str,
    /// The value that helps, such as `auto`, if one value does.
    pub value: Option<String>,
}

/// A reason to doubt a result, and what a person can do about it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Warning {
    /// What may be wrong, where, and how much: a sentence without its full stop, whose first letter may be small.
    pub statement: Sentence,
    /// What to do: a sentence without its full stop.
    pub advice: Sentence,
    /// Settings that do what the advice says; one of them is enough.
    pub remedies: Vec<Remedy>,
}

impl Warning {
    /// A warning without settings that help.
    pub fn new(statement: impl Into<Sentence>, advice: impl Into<Sentence>) -> Self {
        Self { statement: statement.into(), advice: advice.into(), remedies: Vec::new() }
    }

    /// The warning with one more setting that helps.
    pub fn with_remedy(mut self, key: &'static str, value: Option<&str>) -> Self {
        self.remedies.push(Remedy { key, value: value.map(String::from) });
        self
    }

    /// The warning in two sentences, with the remedies that `word` has words for in brackets.
    ///
    /// ```
    /// use asperity::warning::Warning;
    /// let warning = Warning::new("The area may be off by 20 %", "Use a finer grid").with_remedy("grid.refine", Some("auto"));
    /// let text = warning.in_words(|remedy| Some(format!("{} = {}", remedy.key, remedy.value.as_deref()?)));
    /// assert_eq!(text, "The area may be off by 20 %. Use a finer grid (grid.refine = auto).");
    /// assert_eq!(warning.to_string(), "The area may be off by 20 %. Use a finer grid.");
    /// ```
    pub fn in_words(&self, word: impl Fn(&Remedy) -> Option<String>) -> String {
        let Self { statement, advice, remedies } = self;
        let statement = capital(&statement.to_string());
        let words: Vec<String> = remedies.iter().filter_map(word).collect();
        match words.is_empty() {
            true => format!("{statement}. {advice}."),
            false => format!("{statement}. {advice} ({}).", words.join(" or ")),
        }
    }
}

impl Display for Warning {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_words(|_| None))
    }
}
