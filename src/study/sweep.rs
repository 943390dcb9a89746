//! Surfaces under rising loads, several at a time.

use super::realisation::{Pressed, Realisation};
use super::row::{Row, Timed};
use super::table::Table;
use crate::contact::Stop;
use crate::error::StudyError;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Realisations, each pressed with its loads by the multilevel solver, and every load started from the contact of the one
/// before.
///
/// The numbers depend on the realisation, its loads and the tolerance alone: not on how many are solved at a time, nor
/// on what was solved before and kept in a table.
///
/// | field          | meaning                                             |
/// |----------------|-----------------------------------------------------|
/// | `realisations` | the surfaces and their loads                        |
/// | `stop`         | certificate to reach, and the most iterations       |
/// | `workers`      | realisations solved at a time, each in its thread   |
///
/// ```
/// use asperity::study::{Realisation, Shape, Sweep, Table};
/// use asperity::{Grid, Indenter, Stop};
///
/// let cylinder = Realisation {
///     name: "cylinder".into(),
///     grid: Grid::line(8192, 4.0)?,
///     shape: Shape::Smooth(Indenter::Cylinder { radius: 1.0 }),
///     loads: vec![1e-3, 2e-3],
/// };
/// let folder = tempfile::tempdir()?;
/// let sweep = Sweep { realisations: vec![cylinder], stop: Stop::default(), workers: 1 };
/// let points = sweep.run(&Table::new(folder.path().join("cylinder.csv")), &|_| ())?;
/// assert!((points[1].row.kappa_r_corrected / 1.47 - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Sweep {
    /// The surfaces and their loads.
    pub realisations: Vec<Realisation>,
    /// When a solve ends.
    pub stop: Stop,
    /// Realisations solved at a time.
    pub workers: usize,
}

impl Sweep {
    /// Solves what `table` does not hold yet, writes the finished table and returns its points, realisation by realisation.
    /// `watch` sees each point as it is solved. Points that did not converge are kept; their status says so.
    ///
    /// # Errors
    /// For surfaces and loads that cannot be, files that cannot be read or written, and a table of another study, which would
    /// be lost.
    pub fn run(&self, table: &Table, watch: &(dyn Fn(&Row) + Sync)) -> Result<Vec<Timed>, StudyError> {
        self.check()?;
        let there = self.there(table)?;
        let solved = self.solve(self.known(&there), table, watch)?;
        let points: Vec<Timed> = solved.into_iter().flatten().collect();
        if points != there {
            table.finish(&points)?;
        }
        Ok(points)
    }

    /// Refuses surfaces and loads that cannot be, before anything is solved.
    ///
    /// # Errors
    /// As [`Realisation::check`].
    pub fn check(&self) -> Result<(), StudyError> {
        self.realisations.iter().try_for_each(Realisation::check)
    }

    /// Refuses a table that would be lost.
    ///
    /// # Errors
    /// [`StudyError::OtherStudy`] for one with points of another study, [`StudyError::File`] for one that cannot be read.
    pub fn check_table(&self, table: &Table) -> Result<(), StudyError> {
        self.there(table).map(drop)
    }

    /// The points of `table`, if all are its own.
    fn there(&self, table: &Table) -> Result<Vec<Timed>, StudyError> {
        let there = table.read()?;
        let others = there.iter().filter(|timed| !self.includes(&timed.row)).count();
        match others {
            0 => Ok(there),
            points => Err(StudyError::OtherStudy { path: table.path().into(), points }),
        }
    }

    /// How many of its points `table` holds.
    ///
    /// # Errors
    /// As [`Table::read`].
    pub fn points_in(&self, table: &Table) -> Result<usize, StudyError> {
        Ok(self.known(&table.read()?).iter().flatten().map(Vec::len).sum())
    }

    /// Whether a point is one of its own.
    fn includes(&self, row: &Row) -> bool {
        self.realisations.iter().any(|realisation| realisation.includes(row, self.stop.tolerance()))
    }

    /// The points of each realisation, if they are all there.
    fn known(&self, there: &[Timed]) -> Vec<Option<Vec<Timed>>> {
        self.realisations.iter().map(|realisation| realisation.find(there, self.stop.tolerance())).collect()
    }

    /// Points of all realisations.
    pub fn points(&self) -> usize {
        self.realisations.iter().map(|realisation| realisation.loads.len()).sum()
    }

    /// Nodes of all points together, a measure of the work.
    pub fn nodes(&self) -> u64 {
        self.realisations.iter().map(|realisation| (realisation.grid.len() * realisation.loads.len()) as u64).sum()
    }

    /// Solves the realisations that are not known, `workers` at a time, first come first served.
    fn solve(
        &self,
        known: Vec<Option<Vec<Timed>>>,
        table: &Table,
        watch: &(dyn Fn(&Row) + Sync),
    ) -> Result<Vec<Vec<Timed>>, StudyError> {
        let (next, failed) = (AtomicUsize::new(0), AtomicBool::new(false));
        let done = Mutex::new(known.clone());
        let work = || -> Result<(), StudyError> {
            while !failed.load(Ordering::Relaxed) {
                let i = next.fetch_add(1, Ordering::Relaxed);
                let Some(realisation) = self.realisations.get(i) else { break };
                if known[i].is_some() {
                    continue;
                }
                let points = self.press(realisation, watch)?;
                let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
                table.append(&points)?;
                done[i] = Some(points);
            }
            Ok(())
        };
        let guarded = || work().inspect_err(|_| failed.store(true, Ordering::Relaxed));
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..self.workers.max(1)).map(|_| scope.spawn(guarded)).collect();
            workers
                .into_iter()
                .try_for_each(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
        })?;
        let done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
        Ok(done.into_iter().flatten().collect())
    }

    /// The points of a realisation.
    fn press(&self, realisation: &Realisation, watch: &(dyn Fn(&Row) + Sync)) -> Result<Vec<Timed>, StudyError> {
        let mut points = Vec::new();
        realisation.press(&self.stop, |pressed| {
            let Pressed { load, problem, contact } = pressed;
            let row = Row::of(realisation, load, &self.stop, problem, contact);
            watch(&row);
            points.push(Timed { row, seconds: contact.work.seconds });
            Ok::<(), StudyError>(())
        })?;
        Ok(points)
    }
}
