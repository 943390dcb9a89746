//! The table of all verdicts, kept from run to run.

use super::item::Item;
use super::verdict::Verdict;
use crate::error::FileError;
use crate::files::write_csv;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

/// The paper's numbers beside those found here, in the order of the paper.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Comparison {
    /// The rows.
    pub verdicts: Vec<Verdict>,
}

impl Comparison {
    /// The table of earlier runs; an empty one if there is none.
    ///
    /// # Errors
    /// [`FileError::Target`] for a file that holds anything else: it is not ours to replace. [`FileError::Read`] for one that
    /// cannot be read.
    pub fn read(path: &Path) -> Result<Self, FileError> {
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
    pub fn replace(&mut self, item: Item, verdicts: Vec<Verdict>) {
        let order = |name: &str| Item::ALL.iter().position(|item| item.name() == name);
        self.verdicts.retain(|verdict| verdict.item != item.name());
        self.verdicts.extend(verdicts);
        self.verdicts.sort_by_key(|verdict| order(&verdict.item));
    }

    /// The verdicts on some items.
    pub fn of(&self, items: &[Item]) -> Self {
        let is_asked = |verdict: &&Verdict| items.iter().any(|item| item.name() == verdict.item);
        Self { verdicts: self.verdicts.iter().filter(is_asked).cloned().collect() }
    }

    /// Writes the table as CSV.
    ///
    /// # Errors
    /// The errors of [`write_csv`].
    pub fn write_csv(&self, path: &Path) -> Result<(), FileError> {
        write_csv(path, &self.verdicts)
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
        let mut last = "";
        for row in &self.verdicts {
            let item = if row.item == last { "" } else { &row.item };
            last = &row.item;
            line([item, &row.quantity, &row.paper, &row.here, &row.scatter, &row.verdict])?;
        }
        self.write_reasons(out)
    }

    /// Writes why numbers differ, each reason once.
    fn write_reasons(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut told: Vec<&str> = vec![""];
        for Verdict { item, why, .. } in &self.verdicts {
            if !told.contains(&why.as_str()) {
                let lead = if told.len() == 1 { "\nWhere it differs\n" } else { "" };
                writeln!(out, "{lead}{item:7} {why}")?;
                told.push(why);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_of_some_items_keeps_the_verdicts_on_the_others_in_their_order() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("comparison.csv");
        let mut all = Comparison::read(&path).unwrap();
        for (item, key) in [(Item::Beyond, "beyond.n1"), (Item::Table1, "table1.ratio"), (Item::Gw, "gw.finite")] {
            all.replace(item, vec![Verdict::exact(key, "", 2.0)]);
        }
        all.write_csv(&path).unwrap();
        let mut again = Comparison::read(&path).unwrap();
        assert_eq!(again, all);
        again.replace(Item::Gw, vec![Verdict::statement("gw.finite", "now".into(), true)]);
        let items: Vec<&str> = again.verdicts.iter().map(|verdict| verdict.item.as_str()).collect();
        assert_eq!(items, ["table1", "gw", "beyond"]);
        assert_eq!((again.verdicts[1].here.as_str(), &again.verdicts[2]), ("now", &all.verdicts[2]));
        assert_eq!(again.of(&[Item::Gw]).verdicts, again.verdicts[1..2]);
        std::fs::write(&path, "a,b\n1,2\n").unwrap();
        assert!(matches!(Comparison::read(&path), Err(FileError::Target { .. })));
    }
}
