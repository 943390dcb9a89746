//! The rows of a study that is solved by several workers.

use crate::detached::Detached;
use crate::error::{bail, py_error};
use crate::study::Study;
use crate::table::Table;
use crate::warnings::warn;
use asperity::files::{check_apart, check_named, check_target};
use asperity::plot::FigureStyle;
use asperity::study::{self, Plan, Point};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The progress of a study that is solved in parts: the missing realisations, and at the end the table of all rows.
///
/// Ledger(study, out=None) keeps the rows in memory. With `out`, the file of a table (.csv), it keeps them on disk as well, so that a study
/// that was stopped continues where it was. `asperity.study` uses it. With it, any engine that sends Python objects to workers can solve a
/// study:
///
///     ledger = asp.Ledger(study, "study.csv")
///     for batch in ledger.batches(workers=8):                                           # on a worker:
///         ledger.add(batch.realisations, study.solve(batch.realisations))
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
            check_named(path, &["csv"]).and_then(|()| check_target(path)).map_err(py_error)?;
            let table = study::Table::new(path);
            check_apart(table.files().into_iter().chain(table.views()), study.plan.files()).map_err(py_error)?;
        }
        let plan = study.plan.clone();
        let table = out.as_ref().map(study::Table::new);
        let ledger = py.try_detached(|| study::Ledger::new(plan.clone(), table))?;
        Ok(Self { plan, out, ledger: Mutex::new(ledger) })
    }

    /// Number of rows.
    #[getter]
    fn rows(&self) -> usize {
        self.plan.rows()
    }

    /// Number of rows that are solved.
    #[getter]
    fn completed(&self) -> usize {
        self.ledger().known()
    }

    /// The missing realisations, in batches for a number of workers, the longest first.
    fn batches(&self, py: Python<'_>, workers: usize) -> PyResult<Vec<Batch>> {
        let batches = py.try_detached(|| self.ledger().batches(workers))?;
        Ok(batches.into_iter().map(Batch).collect())
    }

    /// Adds the rows of some realisations, which Study.solve has returned.
    fn add(&self, py: Python<'_>, realisations: Vec<usize>, rows: Vec<String>) -> PyResult<()> {
        if realisations.len() != rows.len() {
            return bail(format!("{} realisations come with {} texts of rows", realisations.len(), rows.len()));
        }
        py.try_detached(|| {
            let points = rows.iter().map(|lines| Point::from_lines(lines.as_bytes()));
            self.ledger().enter(realisations.into_iter().zip(points).collect())
        })
    }

    /// The table of all rows. With `out` it is written there, and beside it as NAME.parquet, NAME.svg and NAME.png. An AsperityWarning says
    /// how many rows did not converge, are not resolved, or are on a grid that is too coarse.
    fn finish(&self, py: Python<'_>) -> PyResult<Table> {
        let (table, warnings) = py.detached(|| {
            let points = self.ledger().finish().map_err(py_error)?;
            if let Some(out) = &self.out {
                self.plan.write_views(out, &points, &FigureStyle::default()).map_err(py_error)?;
            }
            Ok::<_, PyErr>((Table::new(&self.plan, &points)?, self.plan.warnings(&points)))
        })??;
        warn(py, &warnings)?;
        Ok(table)
    }
}

/// Realisations that one worker solves one after the other.
#[pyclass(frozen, module = "asperity")]
pub struct Batch(study::Batch);

#[pymethods]
impl Batch {
    /// Numbers of the realisations, from 0.
    #[getter]
    fn realisations(&self) -> Vec<usize> {
        self.0.realisations.clone()
    }

    /// Estimated seconds for all of them on one core.
    #[getter]
    fn seconds(&self) -> f64 {
        self.0.expense.seconds
    }

    /// Estimated bytes of memory for the largest of them.
    #[getter]
    fn bytes(&self) -> f64 {
        self.0.expense.bytes
    }
}
