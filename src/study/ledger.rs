//! The points of a study that is solved by several workers.

use super::expense::Expense;
use super::identity::{Identity, key_of};
use super::known::Known;
use super::plan::Plan;
use super::point::Point;
use super::sweep::Sweep;
use super::table::Table;
use crate::error::StudyError;

/// Batches for each worker, so that all end at about the same time.
const BATCHES: f64 = 8.0;
/// Seconds of a batch: long against what it takes to send it, and short enough to be done again where a worker was lost.
const SECONDS: [f64; 2] = [0.25, 20.0];

/// The state of a study that is solved in parts, by workers in other processes or on other machines: the missing
/// realisations, and at the end the points of all.
///
/// ```
/// use asperity::study::{Ledger, Plan};
/// let plan = Plan::from_toml(
///     r#"
///     surface = { spectrum = { hurst = 0.8, rolloff-wavelength = 0.25, short-cutoff = 0.02, rms-gradient = 0.1 }, seed = "1-3" }
///     grid = { points = 256, size = 1.0 }
///     load = { reduced-pressure = [0.01, 0.1] }
///     "#,
/// )?;
/// let mut ledger = Ledger::new(plan.clone(), None)?;
/// for batch in ledger.batches(1)? {
///     let solve = |&realisation: &usize| Ok((realisation, plan.solve(realisation, |_| ())?));
///     ledger.enter(batch.realisations.iter().map(solve).collect::<Result<_, asperity::error::StudyError>>()?)?;
/// }
/// assert_eq!(ledger.finish()?.len(), 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Ledger {
    plan: Plan,
    table: Option<Table>,
    points: Vec<Option<Vec<Point>>>,
}

/// Realisations that are solved one after the other, and their cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    /// Numbers of the realisations, from 0.
    pub realisations: Vec<usize>,
    /// Seconds of all of them, and bytes of the largest.
    pub expense: Expense,
}

impl Ledger {
    /// The ledger of a study. Points that are already in `table` are known, and new points are added to it. Without a
    /// table, points are kept in memory.
    ///
    /// # Errors
    /// The errors of [`Plan::check`], [`StudyError::OtherStudy`] for a table with points of another study, and the errors of [`Table::read`].
    pub fn new(plan: Plan, table: Option<Table>) -> Result<Self, StudyError> {
        plan.check()?;
        let points = match &table {
            None => vec![None; plan.realisations()],
            Some(table) => {
                let all: Vec<usize> = (0..plan.realisations()).collect();
                let realisations = plan.realisations_of(&all)?;
                let identities = realisations.iter().map(Identity::new).collect::<Result<Vec<_>, _>>()?;
                Known::new(&Sweep::there(&identities, table)?).find_all(&identities)
            }
        };
        Ok(Self { plan, table, points })
    }

    /// The number of known rows.
    pub fn known(&self) -> usize {
        self.points.iter().flatten().map(Vec::len).sum()
    }

    /// The missing realisations, in batches for a number of workers, the longest first.
    ///
    /// # Errors
    /// The errors of [`Plan::expenses`].
    pub fn batches(&self, workers: usize) -> Result<Vec<Batch>, StudyError> {
        let groups = self.plan.expenses()?.into_iter().map(|(first, expense)| (self.missing(first), expense));
        let groups: Vec<(Vec<usize>, Expense)> = groups.collect();
        let seconds: f64 = groups.iter().map(|(missing, it)| missing.len() as f64 * it.seconds).sum();
        let aim = (seconds / (BATCHES * workers.max(1) as f64)).clamp(SECONDS[0], SECONDS[1]);
        let mut batches: Vec<Batch> = Vec::new();
        for (missing, Expense { seconds, bytes }) in groups {
            let count = ((aim / seconds) as usize).max(1);
            batches.extend(missing.chunks(count).map(|it| Batch {
                realisations: it.to_vec(),
                expense: Expense { seconds: seconds * it.len() as f64, bytes },
            }));
        }
        batches.sort_by(|a, b| b.expense.seconds.total_cmp(&a.expense.seconds));
        Ok(batches)
    }

    /// The realisations that are missing of the group that begins with the `first`.
    fn missing(&self, first: usize) -> Vec<usize> {
        (first..first + self.plan.seeds()).filter(|&it| self.points[it].is_none()).collect()
    }

    /// Adds the points of some realisations, given by their numbers. After an error, none of them is added.
    ///
    /// # Errors
    /// [`StudyError::OtherPoints`] for points of another realisation or version of the program, [`StudyError::NoRow`] for a realisation that there
    /// is not, and the errors of [`Table::append`].
    pub fn enter(&mut self, solved: Vec<(usize, Vec<Point>)>) -> Result<(), StudyError> {
        solved.iter().try_for_each(|(number, points)| self.check(*number, points))?;
        if let Some(table) = &self.table {
            table.append(solved.iter().flat_map(|(_, points)| points))?;
        }
        solved.into_iter().for_each(|(number, points)| self.points[number] = Some(points));
        Ok(())
    }

    /// Refuses points that are not those of a realisation.
    fn check(&self, number: usize, points: &[Point]) -> Result<(), StudyError> {
        let realisation = self.plan.realisation(self.plan.number(number)?)?;
        let identity = Identity::new(&realisation)?;
        let found: Vec<&Point> = points.iter().filter(|point| key_of(point) == identity.key()).collect();
        if identity.find(&found).is_none_or(|it| it.len() != points.len()) {
            let version = points.first().map(|point| point.version.clone()).unwrap_or_default();
            return Err(StudyError::OtherPoints { values: self.plan.words(number), points: points.len(), version });
        }
        Ok(())
    }

    /// The points of all rows in their order. The table, if there is one, is finished.
    ///
    /// # Errors
    /// [`StudyError::Missing`] while rows are missing, and the errors of [`Plan::finish`].
    pub fn finish(&self) -> Result<Vec<Point>, StudyError> {
        let points = self.plan.put_together(self.points.clone())?;
        if let Some(table) = &self.table {
            let all: Vec<usize> = (0..self.plan.realisations()).collect();
            self.plan.finish(table, &all, &points)?;
        }
        Ok(points)
    }
}
