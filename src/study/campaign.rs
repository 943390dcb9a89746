//! Solving studies: shares of rows, and merging their tables.

use super::check::Checksum;
use super::column::Column;
use super::identity::Identity;
use super::known::Known;
use super::plan::{Plan, StudyRow};
use super::point::Point;
use super::shard::Shard;
use super::sweep::Sweep;
use super::table::Table;
use crate::contact::Observer;
use crate::error::{FileError, StudyError};
use crate::files::write_beside;
use std::io;
use std::path::Path;

/// Rows that are made into columns at a time.
pub(super) const ROWS: usize = 1 << 14;

/// How a study is solved. This does not change its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Campaign {
    /// The share that is solved.
    pub shard: Shard,
    /// Realisations solved at the same time, each in its own thread.
    pub workers: usize,
    /// Memory limit of these together, in bytes, if any; a realisation that needs more is refused.
    pub memory: Option<f64>,
}

impl Plan {
    /// Solves one realisation under all loads; `watch` makes the observer of each load. A worker on another machine
    /// needs only this function. The points of all realisations, in order, are those of [`Plan::run`]; a
    /// [`super::Ledger`] collects them.
    ///
    /// # Errors
    /// The errors of [`super::Realisation::press`], as [`StudyError::Row`].
    pub fn solve<O: Observer>(
        &self,
        realisation: usize,
        watch: impl FnMut(usize) -> O,
    ) -> Result<Vec<Point>, StudyError> {
        let solved = self.realisation(realisation)?;
        Identity::new(&solved)?.points(watch, |_| (), |load, error| self.in_row_of([realisation, load], error))
    }

    /// Solves the rows of a share that are not in `table` yet, largest first. Then it writes the finished table and
    /// returns its points in the order of their rows. `watch` is called for each solved point.
    ///
    /// # Errors
    /// The errors of [`Sweep::run`], [`StudyError::Row`] for a row that fails, and for a realisation that needs more memory than is allowed.
    pub fn run(
        &self,
        campaign: &Campaign,
        table: &Table,
        watch: &(dyn Fn(&Point) + Sync),
    ) -> Result<Vec<Point>, StudyError> {
        let share = self.share(campaign.shard)?;
        let sweep = self.sweep(campaign, &share)?;
        let (points, is_new) =
            sweep.solved(table, watch, &|[i, load], error| self.in_row_of([share[i], load], error))?;
        if is_new || !table.path().exists() {
            self.finish(table, &share, &points)?;
        }
        Ok(points)
    }

    /// The realisations of a share as a sweep.
    ///
    /// # Errors
    /// The errors of [`Plan::realisation`], and [`StudyError::Memory`].
    pub fn sweep(&self, campaign: &Campaign, share: &[usize]) -> Result<Sweep, StudyError> {
        self.check_memory(campaign)?;
        let realisations = self.realisations_of(share)?;
        Ok(Sweep { realisations, workers: campaign.workers, memory: campaign.memory })
    }

    /// Refuses realisations that need more memory than is allowed.
    fn check_memory(&self, campaign: &Campaign) -> Result<(), StudyError> {
        let Some(memory) = campaign.memory else { return Ok(()) };
        let expenses = self.expenses()?;
        match expenses.iter().find(|(_, expense)| expense.bytes > memory) {
            Some(&(i, expense)) => {
                let words = self.words_but_seed(i);
                let values = if words.is_empty() { "a row".into() } else { words };
                Err(StudyError::Memory { values, needed: expense.bytes, memory })
            }
            None => Ok(()),
        }
    }

    /// Merges the tables of shares, and returns the points of all rows in order.
    ///
    /// # Errors
    /// [`StudyError::OtherShare`] for a table with points of another study, [`StudyError::Overlap`] for a row that is there twice,
    /// [`StudyError::Damaged`] for a row that was changed, [`StudyError::Missing`] for rows that are in no table, and the errors of [`Table::read`].
    pub fn merge(&self, tables: &[Table]) -> Result<Vec<Point>, StudyError> {
        let all: Vec<usize> = (0..self.realisations()).collect();
        let realisations = self.realisations_of(&all)?;
        let identities = realisations.iter().map(Identity::new).collect::<Result<Vec<_>, _>>()?;
        let mut merged: Vec<Option<Vec<Point>>> = vec![None; identities.len()];
        let mut origin = vec![0; identities.len()];
        for (number, table) in tables.iter().enumerate() {
            let points = table.read().map_err(unreadable)?;
            let known = Known::new(&points);
            let foreign = known.foreign(&identities);
            if foreign > 0 {
                return Err(StudyError::OtherShare { path: table.path().into(), points: foreign });
            }
            for (i, found) in known.find_all(&identities).into_iter().enumerate() {
                let Some(found) = found else { continue };
                let is_twice = known.with_key_of(&identities[i]).len() > found.len();
                if merged[i].is_some() || is_twice {
                    let other = if is_twice { number } else { origin[i] };
                    let [path, other] = [number, other].map(|it| tables[it].path().to_path_buf());
                    return Err(StudyError::Overlap { row: self.first_row(i), values: self.words(i), path, other });
                }
                (merged[i], origin[i]) = (Some(found), number);
            }
        }
        self.put_together(merged).map_err(|error| damaged(tables).unwrap_or(error))
    }

    /// The points of all realisations in their order.
    ///
    /// # Errors
    /// [`StudyError::Missing`] where some are not there.
    pub(super) fn put_together(&self, points: Vec<Option<Vec<Point>>>) -> Result<Vec<Point>, StudyError> {
        let mut missing = points.iter().enumerate().filter(|(_, it)| it.is_none()).map(|(i, _)| i);
        match missing.next() {
            Some(first) => Err(StudyError::Missing {
                rows: (1 + missing.count()) * self.loads().len(),
                first: self.first_row(first),
                values: self.words(first),
                of: self.rows(),
            }),
            None => Ok(points.into_iter().flatten().flatten().collect()),
        }
    }

    /// Writes the finished table of a share: its `points`, each with the values of its row, see [`Plan::columns`], and
    /// its check sum.
    ///
    /// # Errors
    /// [`FileError::Target`] or [`FileError::Write`].
    pub fn finish(&self, table: &Table, share: &[usize], points: &[Point]) -> Result<(), StudyError> {
        self.write_csv(table.path(), share, points)?;
        Ok(table.settle(points)?)
    }

    fn write_csv(&self, path: &Path, share: &[usize], points: &[Point]) -> Result<(), FileError> {
        write_beside(path, |file| {
            let mut csv = csv::Writer::from_writer(file);
            self.in_columns(share, points, |columns, is_first| {
                let names = || columns.iter().map(|column| column.name.clone());
                if is_first {
                    csv.write_record(names().chain([Checksum::NAME.into()]))?;
                }
                let rows = columns.first().map_or(0, |column| column.values.len());
                let words = |i| columns.iter().map(move |column| column.values.word(i));
                let check = |i| Checksum::from_words(names(), words(i));
                (0..rows).try_for_each(|i| csv.write_record(words(i).chain([check(i)])))?;
                Ok(())
            })?;
            csv.flush()
        })
    }

    /// Makes the rows of a share into columns, some thousand at a time. `each` also gets whether they are the first
    /// ones.
    pub(super) fn in_columns(
        &self,
        share: &[usize],
        points: &[Point],
        mut each: impl FnMut(&[Column], bool) -> io::Result<()>,
    ) -> io::Result<()> {
        let rows: Vec<StudyRow> = self.rows_of(share).collect();
        let chunks = rows.chunks(ROWS).zip(points.chunks(ROWS));
        chunks.enumerate().try_for_each(|(i, (rows, points))| {
            let columns = self.columns(rows, points).map_err(io::Error::other)?;
            each(&columns, i == 0)
        })
    }
}

/// The error of a table that is read, and not written.
fn unreadable(error: FileError) -> FileError {
    match error {
        FileError::Target { path, .. } => {
            FileError::Format { path, what: "study", reason: "it is not the table of a share: leave it out".into() }
        }
        error => error,
    }
}

/// The error of the first table with a row that is not as it was written.
fn damaged(tables: &[Table]) -> Option<StudyError> {
    let row = |table: &Table| Some((table.path().to_path_buf(), table.damaged().ok()??));
    tables.iter().find_map(row).map(|(path, row)| StudyError::Damaged { path, row })
}
