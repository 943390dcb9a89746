//! The lines of a text on which the keys of a setup stand.

use crate::error::{SetupError, TextPlace};
use std::ops::Range;
use std::path::Path;
use toml::de::DeTable;

impl SetupError {
    /// The error with the file in front of the keys that it names.
    pub(crate) fn in_file(self, path: &Path) -> Self {
        self.placed(|place| place.in_file(path))
    }

    /// The error with the line of `text` in front of the keys that it names, where they are found.
    pub(crate) fn in_text(self, text: &str) -> Self {
        self.placed(|place| TextPlace { line: line(text, &place.keys).or(place.line), ..place })
    }

    fn placed(self, more: impl FnOnce(TextPlace) -> TextPlace) -> Self {
        match self {
            Self::Text { place, fault } => Self::Text { place: more(place), fault },
            other => other,
        }
    }
}

/// The line of keys that are separated by dots, or of the longest part of them that exists.
fn line(text: &str, path: &str) -> Option<usize> {
    let table = DeTable::parse(text).ok()?;
    let span = span(table.get_ref(), path)?;
    Some(1 + text.get(..span.start)?.matches('\n').count())
}

fn span(table: &DeTable<'_>, path: &str) -> Option<Range<usize>> {
    let (first, rest) = path.split_once('.').unwrap_or((path, ""));
    let (key, value) = table.iter().find(|(key, _)| key.get_ref().as_ref() == first)?;
    let below = value.get_ref().as_table().and_then(|table| span(table, rest));
    Some(below.unwrap_or(key.span()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_found_wherever_they_stand() {
        let text = "load.mean-gap = 1\n[surface]\nseed = 2\nspectrum = { hurst = 3 }\n\n[grid]\npoints = 4\n";
        let paths = ["load.mean-gap", "surface", "surface.seed", "surface.spectrum.hurst", "grid.points", "grid.size"];
        assert_eq!(paths.map(|path| line(text, path)), [1, 2, 3, 4, 7, 6].map(Some));
        assert_eq!([line(text, "solid"), line(text, ""), line("no = = toml", "no")], [None; 3]);
    }
}
