//! The table of all verdicts, kept from run to run.

use super::item::Item;
use super::verdict::{Evidence, Verdict};
use crate::error::FileError;
use crate::files::read_if_there;
use std::io::{self, Write};
use std::path::Path;

/// The paper's numbers beside those found here, in the order of the paper.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Comparison {
    /// The rows.
    pub verdicts: Vec<Verdict>,
}

impl Comparison {
    /// The table of earlier runs; empty if there is none. A file with other content is not replaced.
    pub(super) fn read(path: &Path) -> Result<Self, FileError> {
        let text = read_if_there(path)?;
        let rows: csv::Result<Vec<Verdict>> = csv::Reader::from_reader(text.as_slice()).into_deserialize().collect();
        let reason = "it is not a comparison with the paper: give another folder, or remove it";
        let verdicts = rows.map_err(|_| FileError::Target { path: path.into(), reason: reason.into() })?;
        Ok(Self { verdicts })
    }

    /// Replaces the earlier verdicts on an item.
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
        let rows: Vec<[String; 5]> = self.verdicts.iter().map(cells).collect();
        let titles = ["quantity", "paper", "here", "deviation", "verdict"].map(String::from);
        let width = |i: usize| rows.iter().chain([&titles]).map(|row| row[i].chars().count()).max().unwrap_or(0);
        let [a, b, c, d] = [0, 1, 2, 3].map(width);
        let mut line = |item: &str, [quantity, paper, here, off, verdict]: &[String; 5]| {
            writeln!(out, "{item:7} {quantity:a$}  {paper:b$}  {here:c$}  {off:d$}  {verdict}")
        };
        line("", &titles)?;
        let mut last = None;
        for (row, Verdict { item, .. }) in rows.iter().zip(&self.verdicts) {
            line(if last == Some(*item) { "" } else { item.name() }, row)?;
            last = Some(*item);
        }
        self.write_sum(out)?;
        self.write_reasons(out)
    }

    /// Writes how many numbers and statements agree, those not counted that are no evidence of their own.
    fn write_sum(&self, out: &mut dyn Write) -> io::Result<()> {
        let own = || self.verdicts.iter().filter(|verdict| verdict.evidence == Evidence::Own);
        let good = own().filter(|verdict| verdict.is_good()).count();
        let undecided = own().filter(|verdict| verdict.is_undecided()).count();
        let rest = self.verdicts.len() - own().count();
        writeln!(
            out,
            "\n{good} of {} agree or hold, {undecided} are undecided within their errors; {rest} are not counted, since they \
             follow from others or are measured differently",
            own().count()
        )
    }

    /// Writes why numbers differ, each reason once.
    fn write_reasons(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut reasons: Vec<&str> = vec![""];
        for Verdict { item, why, .. } in &self.verdicts {
            if !reasons.contains(&why.as_str()) {
                let lead = if reasons.len() == 1 { "\nNotes\n" } else { "" };
                writeln!(out, "{lead}{:7} {why}", item.name())?;
                reasons.push(why);
            }
        }
        Ok(())
    }
}

/// The words of a row.
fn cells(row: &Verdict) -> [String; 5] {
    [row.quantity.clone(), row.paper.clone(), row.found(), row.deviation(), row.verdict.clone()]
}
