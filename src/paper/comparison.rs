//! The table of all verdicts, kept from run to run.

use super::item::Item;
use super::verdict::Verdict;
use crate::error::FileError;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

/// The paper's numbers beside those found here, in the order of the paper.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Comparison {
    /// The rows.
    pub verdicts: Vec<Verdict>,
}

impl Comparison {
    /// The table of earlier runs; an empty one if there is none. A file that holds anything else is not ours to replace.
    pub(super) fn read(path: &Path) -> Result<Self, FileError> {
        let text = match std::fs::read(path) {
            Err(source) if source.kind() == ErrorKind::NotFound => Vec::new(),
            read => read.map_err(|source| FileError::Read { path: path.into(), source })?,
        };
        let rows: csv::Result<Vec<Verdict>> = csv::Reader::from_reader(text.as_slice()).into_deserialize().collect();
        let reason = "it holds something else than a comparison with the paper: write elsewhere, or remove it";
        let verdicts = rows.map_err(|_| FileError::Target { path: path.into(), reason: reason.into() })?;
        Ok(Self { verdicts })
    }

    /// Puts the verdicts on an item in the place of its earlier ones.
    pub(super) fn replace(&mut self, item: Item, verdicts: Vec<Verdict>) {
        self.verdicts.retain(|verdict| verdict.item != item);
        self.verdicts.extend(verdicts);
        self.verdicts.sort_by_key(|verdict| verdict.item);
    }

    /// Writes the table for reading.
    ///
    /// # Errors
    /// The errors of `out`.
    pub fn write_text(&self, out: &mut dyn Write) -> io::Result<()> {
        let width = |title: &str, of: fn(&Verdict) -> &str| {
            self.verdicts.iter().map(|row| of(row).chars().count()).fold(title.len(), usize::max)
        };
        let quantity = width("quantity", |row| &row.quantity);
        let [paper, here] = [width("paper", |row| &row.paper), width("here", |row| &row.here)];
        let mut line = |cells: [&str; 6]| {
            let [item, a, b, c, scatter, verdict] = cells;
            writeln!(out, "{item:7} {a:quantity$}  {b:paper$}  {c:here$}  {scatter:7}  {verdict}")
        };
        line(["", "quantity", "paper", "here", "scatter", "verdict"])?;
        let mut last = None;
        for row in &self.verdicts {
            let item = if last == Some(row.item) { String::new() } else { row.item.name() };
            last = Some(row.item);
            line([&item, &row.quantity, &row.paper, &row.here, &row.scatter, &row.verdict])?;
        }
        self.write_reasons(out)
    }

    /// Writes why numbers differ, each reason once.
    fn write_reasons(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut told: Vec<&str> = vec![""];
        for Verdict { item, why, .. } in &self.verdicts {
            if !told.contains(&why.as_str()) {
                let lead = if told.len() == 1 { "\nWhere it differs\n" } else { "" };
                writeln!(out, "{lead}{:7} {why}", item.name())?;
                told.push(why);
            }
        }
        Ok(())
    }
}
