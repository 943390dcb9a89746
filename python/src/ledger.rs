//! The rows of a study as they come in.

use crate::refusal::{refuse, refused};
use crate::study::Study;
use crate::table::Table;
use asperity::files::{check_named, check_target};
use asperity::study::{self, Plan, Point};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What is known of a study that is solved in pieces: which realisations are missing, and in the end the table of all rows.
///
/// Ledger(study, out=None) keeps what comes in memory, or beside the table `out` (.csv) as well, so that a study that was ended goes on where
/// it was. `asperity.study` uses it; with it a study can be solved by any engine that carries Python objects to workers:
///
///     ledger = asp.Ledger(study, "study.csv")
///     for batch in ledger.batches(workers=8):                                           # on a worker:
///         ledger.enter(batch.realisations, study.solve(batch.realisations))
///     table = ledger.finish()
#[pyclass(frozen, module = "asperity")]
pub struct Ledger {
    plan: Plan,
    out: Option<PathBuf>,
    ledger: Mutex<study::Ledger>,
}

impl Ledger {
    fn ledger(&self) -> MutexGuard<'_, study::Ledger> {
        self.ledger.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Ledger {
    #[new]
    #[pyo3(signature = (study, out=None))]
    fn new(py: Python<'_>, study: &Study, out: Option<PathBuf>) -> PyResult<Self> {
        if let Some(path) = &out {
            check_named(path, &["csv"]).and_then(|()| check_target(path)).map_err(refused)?;
        }
        let plan = study.plan.clone();
        let table = out.as_ref().map(study::Table::new);
        let ledger = py.detach(|| study::Ledger::new(plan.clone(), table)).map_err(refused)?;
        Ok(Self { plan, out, ledger: Mutex::new(ledger) })
    }

    /// How many rows there are.
    #[getter]
    fn rows(&self) -> usize {
        self.plan.rows()
    }

    /// How many rows are known.
    #[getter]
    fn known(&self) -> usize {
        self.ledger().known()
    }

    /// The realisations that are missing, in batches for so many workers, those that take longest first.
    fn batches(&self, py: Python<'_>, workers: usize) -> PyResult<Vec<Batch>> {
        let batches = py.detach(|| self.ledger().batches(workers)).map_err(refused)?;
        Ok(batches.into_iter().map(Batch).collect())
    }

    /// Enters the rows of some realisations, which Study.solve has returned.
    fn enter(&self, py: Python<'_>, realisations: Vec<usize>, rows: Vec<String>) -> PyResult<()> {
        if realisations.len() != rows.len() {
            return refuse(format!("{} realisations come with {} texts of rows", realisations.len(), rows.len()));
        }
        py.detach(|| {
            let points = rows.iter().map(|lines| Point::from_lines(lines.as_bytes()));
            self.ledger().enter(realisations.into_iter().zip(points).collect())
        })
        .map_err(refused)
    }

    /// The table of all rows. Where there is a file for it, that is written, and beside it NAME.parquet, NAME.svg and NAME.png.
    fn finish(&self, py: Python<'_>) -> PyResult<Table> {
        py.detach(|| {
            let points = self.ledger().finish().map_err(refused)?;
            if let Some(out) = &self.out {
                self.plan.write_views(out, &points).map_err(refused)?;
            }
            Table::of(&self.plan, &points)
        })
    }
}

/// Realisations that are solved one after the other.
#[pyclass(frozen, module = "asperity")]
pub struct Batch(study::Batch);

#[pymethods]
impl Batch {
    /// Numbers of the realisations, from 0.
    #[getter]
    fn realisations(&self) -> Vec<usize> {
        self.0.realisations.clone()
    }

    /// Seconds that all of them take on one core, as a model says.
    #[getter]
    fn seconds(&self) -> f64 {
        self.0.expense.seconds
    }

    /// Bytes that the largest of them takes.
    #[getter]
    fn bytes(&self) -> f64 {
        self.0.expense.bytes
    }
}
