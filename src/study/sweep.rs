//! Surfaces under increasing loads, several at the same time.

use super::expense::Expense;
use super::identity::Identity;
use super::known::Known;
use super::point::Point;
use super::queue::Queue;
use super::realisation::Realisation;
use super::table::Table;
use crate::contact::Contact;
use crate::error::StudyError;
use crate::setup::Extras;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Adds the place of a point to its error: the numbers of its realisation and of its load, from 0.
pub(super) type Locate<'a> = &'a (dyn Fn([usize; 2], StudyError) -> StudyError + Sync);

/// Realisations, each solved under its loads; each solve starts from the contact under the previous load.
///
/// The numbers depend only on the setups and their loads, not on the number of workers, and not on the points that a
/// table already contains.
///
/// ```
/// use asperity::Indenter;
/// use asperity::contact::Load;
/// use asperity::setup::{Cell, Recipe, Setup};
/// use asperity::study::{Realisation, Sweep, Table};
///
/// let recipe = Recipe::indenter(Indenter::Cylinder { radius: 1.0 });
/// let setup = Setup::new(recipe, Cell::line(8192, 4.0), Load::ReducedPressure(1e-3));
/// let cylinder = Realisation { name: "cylinder".into(), setup, loads: Realisation::reduced_pressures(&[1e-3, 2e-3]) };
/// let folder = tempfile::tempdir()?;
/// let sweep = Sweep { realisations: vec![cylinder], workers: 1, memory: None };
/// let points = sweep.run(&Table::new(folder.path().join("cylinder.csv")), &|_| ())?;
/// assert!((points[1].observables.kappa_r / 1.47 - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Sweep {
    /// The setups and their loads.
    pub realisations: Vec<Realisation>,
    /// Realisations solved at the same time, each in its own thread.
    pub workers: usize,
    /// Memory limit of these together, in bytes, if any; a realisation that needs more is solved alone.
    pub memory: Option<f64>,
}

impl Sweep {
    /// Solves the points that are not in `table` yet, writes the finished table and returns its points, realisation by
    /// realisation. `watch` is called for each solved point. Points that did not converge are kept, with this status.
    ///
    /// # Errors
    /// For surfaces and loads that cannot be, files that cannot be read or written, and a table of another study, which would
    /// be lost.
    pub fn run(&self, table: &Table, watch: &(dyn Fn(&Point) + Sync)) -> Result<Vec<Point>, StudyError> {
        let (points, is_new) = self.solved(table, watch, &|_, error| error)?;
        if is_new {
            table.finish(&points)?;
        }
        Ok(points)
    }

    /// Solves the points that are not in `table` yet. Returns all points, realisation by realisation, and whether the
    /// table must be rewritten. `locate` adds the place of a point that fails to its error.
    ///
    /// # Errors
    /// The errors of [`Sweep::run`].
    pub(super) fn solved(
        &self,
        table: &Table,
        watch: &(dyn Fn(&Point) + Sync),
        locate: Locate<'_>,
    ) -> Result<(Vec<Point>, bool), StudyError> {
        self.check()?;
        let identities = self.identities()?;
        let there = Self::there(&identities, table)?;
        let known = Known::new(&there).find_all(&identities);
        let solved = self.solve(&identities, known, table, watch, locate)?;
        let points: Vec<Point> = solved.into_iter().flatten().collect();
        let is_new = points != there;
        Ok((points, is_new))
    }

    /// Refuses impossible surfaces and loads before anything is solved.
    ///
    /// # Errors
    /// The errors of [`Realisation::check`].
    pub fn check(&self) -> Result<(), StudyError> {
        self.realisations.iter().try_for_each(|realisation| Ok(realisation.check().map(drop)?))
    }

    /// Refuses impossible surfaces and loads, and those that do not fit in memory.
    ///
    /// # Errors
    /// The errors of [`Realisation::check`] and [`crate::setup::Cost::check`].
    pub fn check_cost(&self) -> Result<(), StudyError> {
        self.check()?;
        Ok(self.realisations.iter().try_for_each(|it| it.setup.cost(&Extras::default())?.check("a sweep"))?)
    }

    /// Refuses a table that would be lost.
    ///
    /// # Errors
    /// [`StudyError::OtherStudy`] for one with points of another study, [`StudyError::File`] for one that cannot be read.
    pub fn check_table(&self, table: &Table) -> Result<(), StudyError> {
        Self::there(&self.identities()?, table).map(drop)
    }

    /// How many points of the sweep `table` holds.
    ///
    /// # Errors
    /// The errors of [`Table::read`], and for a height file that cannot be read.
    pub fn points_in(&self, table: &Table) -> Result<usize, StudyError> {
        let there = table.read()?;
        Ok(Known::new(&there).find_all(&self.identities()?).iter().flatten().map(Vec::len).sum())
    }

    /// The identities of the realisations.
    fn identities(&self) -> Result<Vec<Identity<'_>>, StudyError> {
        self.realisations.iter().map(Identity::new).collect()
    }

    /// The points of `table`, if all belong to the sweep.
    pub(super) fn there(identities: &[Identity<'_>], table: &Table) -> Result<Vec<Point>, StudyError> {
        let there = table.read()?;
        match Known::new(&there).foreign(identities) {
            0 => Ok(there),
            points => Err(StudyError::OtherStudy { path: table.path().into(), points }),
        }
    }

    /// Number of points of all realisations.
    pub fn points(&self) -> usize {
        self.realisations.iter().map(|realisation| realisation.loads.len()).sum()
    }

    /// Nodes of all points together, a measure of the work.
    ///
    /// # Errors
    /// The errors of [`Realisation::check`].
    pub fn nodes(&self) -> Result<u64, StudyError> {
        let nodes = |it: &Realisation| Ok((it.check()?.len() * it.loads.len()) as u64);
        self.realisations.iter().map(nodes).sum()
    }

    /// Solves all realisations, keeps no table, and returns what `see` makes of each contact, realisation by realisation.
    ///
    /// # Errors
    /// For surfaces and loads that cannot be.
    pub fn map<T: Send>(&self, see: &(dyn Fn(&Point, &Contact) -> T + Sync)) -> Result<Vec<Vec<T>>, StudyError> {
        self.check()?;
        let identities = self.identities()?;
        self.in_parallel(|i| {
            let mut seen = Vec::new();
            identities[i].press(|_| (), |point, contact| seen.push(see(&point, contact)))?;
            Ok(seen)
        })
    }

    /// Solves the realisations that are not known, and adds them to the table.
    fn solve(
        &self,
        identities: &[Identity<'_>],
        known: Vec<Option<Vec<Point>>>,
        table: &Table,
        watch: &(dyn Fn(&Point) + Sync),
        locate: Locate<'_>,
    ) -> Result<Vec<Vec<Point>>, StudyError> {
        let appended = Mutex::new(());
        self.in_parallel(|i| {
            if let Some(points) = &known[i] {
                return Ok(points.clone());
            }
            let points = identities[i].points(|_| (), watch, |load, error| locate([i, load], error))?;
            let _one_at_a_time = appended.lock().unwrap_or_else(PoisonError::into_inner);
            table.append(&points)?;
            Ok(points)
        })
    }

    /// Does a task for each realisation, by its number, `workers` at a time if memory allows, those with the most work
    /// first; the results are in order. After a failure none is begun.
    fn in_parallel<T: Send>(&self, task: impl Fn(usize) -> Result<T, StudyError> + Sync) -> Result<Vec<T>, StudyError> {
        let expenses = self.realisations.iter().map(Expense::new).collect::<Result<Vec<_>, _>>()?;
        let tasks: Vec<(f64, f64)> = expenses.iter().map(|it| (it.seconds, it.bytes)).collect();
        let queue = Queue::new(&tasks, self.memory.unwrap_or(f64::INFINITY));
        let done: Mutex<BTreeMap<usize, T>> = Mutex::default();
        let work = || -> Result<(), StudyError> {
            while let Some(taken) = queue.take() {
                let result = task(taken.number).inspect_err(|_| queue.close())?;
                done.lock().unwrap_or_else(PoisonError::into_inner).insert(taken.number, result);
            }
            Ok(())
        };
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..self.workers.max(1)).map(|_| scope.spawn(work)).collect();
            workers
                .into_iter()
                .try_for_each(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
        })?;
        Ok(done.into_inner().unwrap_or_else(PoisonError::into_inner).into_values().collect())
    }
}
