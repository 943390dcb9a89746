//! Names and values in headers of text.

use super::format::malformed;
use std::io;
use std::str::FromStr;

/// The most values of a header that a channel carries.
const VALUES: usize = 1000;
/// The most bytes of a value that a channel carries.
const LONGEST: usize = 1000;

/// The names and values of a header, or of one of its parts, in the order of the file.
#[derive(Debug, Clone, Default)]
pub(super) struct Entries {
    all: Vec<(String, String)>,
}

impl Entries {
    /// The lines of a text with a separator in them.
    pub(crate) fn from_lines<'a>(lines: impl Iterator<Item = &'a str>, separator: char) -> Self {
        let pairs = lines.filter_map(|line| line.split_once(separator));
        Self { all: pairs.map(|(name, value)| (name.trim().to_owned(), value.trim().to_owned())).collect() }
    }

    /// Adds a name and its value.
    pub(crate) fn push(&mut self, name: &str, value: &str) {
        self.all.push((name.trim().to_owned(), value.trim().to_owned()));
    }

    /// Adds all names and values of others.
    pub(crate) fn extend(&mut self, others: Self) {
        self.all.extend(others.all);
    }

    /// All names and values.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.all.iter().map(|(name, value)| (name.as_str(), value.as_str()))
    }

    /// The value of a name.
    pub(crate) fn find(&self, name: &str) -> Option<&str> {
        self.iter().find(|it| it.0.eq_ignore_ascii_case(name)).map(|it| it.1)
    }

    /// The value of a name.
    ///
    /// # Errors
    /// If there is none.
    pub(crate) fn need(&self, name: &str) -> io::Result<&str> {
        self.find(name).ok_or_else(|| malformed(format!("its header has no {name}")))
    }

    /// The first word of a value, which is a number.
    ///
    /// # Errors
    /// If it is none, or if there is no such value.
    pub(crate) fn number<T: FromStr>(&self, name: &str) -> io::Result<T> {
        let value = self.need(name)?;
        let number = value.split_whitespace().next().and_then(|word| word.parse().ok());
        number.ok_or_else(|| malformed(format!("its header has the invalid value {name} = {value:?}")))
    }

    /// What a channel carries of it: all values that are neither empty nor very long, up to a number of them.
    pub(crate) fn header(&self) -> Vec<(String, String)> {
        let said = self.all.iter().filter(|it| !it.1.is_empty() && it.1.len() <= LONGEST);
        said.take(VALUES).cloned().collect()
    }
}

/// A part of a header, below a line with its name in square brackets.
#[derive(Debug, Default)]
pub(super) struct EntrySection {
    pub name: String,
    pub entries: Entries,
}

/// The parts of a header whose lines are names and values with a separator between them, without remarks, which begin with `--`.
pub(super) fn sections(text: &str, separator: char) -> Vec<EntrySection> {
    let mut sections: Vec<EntrySection> = Vec::new();
    for line in text.lines().map(str::trim).filter(|line| !line.starts_with("--")) {
        let title = line.strip_prefix('[').and_then(|line| line.strip_suffix(']'));
        match (title, line.split_once(separator), sections.last_mut()) {
            (Some(name), ..) => sections.push(EntrySection { name: name.to_owned(), entries: Entries::default() }),
            (None, Some((name, value)), Some(section)) => section.entries.push(name, value),
            _ => {}
        }
    }
    sections
}
