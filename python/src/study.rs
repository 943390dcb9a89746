//! Studies: setups with lists in them.

use crate::cancel::CancelToken;
use crate::conversion::{sections_from_keywords, table_from_sections};
use crate::detached::Detached;
use crate::error::{bail, error_of_keywords, index_of, py_error};
use crate::setup::Setup;
use asperity::error::StudyError;
use asperity::setup::SetupTable;
use asperity::study::{Plan, Point};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use rayon::ThreadPoolBuilder;
use std::path::{PathBuf, absolute};

/// Threads of a worker at most.
const MOST_THREADS: usize = 4096;

/// A setup with lists, which describes many contacts: one realisation for each combination of values from the lists, each solved under all
/// loads one after the other. Each load of a realisation is a row of the table.
///
/// Study(surface=..., grid=..., load=..., ...) takes the sections of a scene as dictionaries, with `_` for `-` in their keys. Any value may be
/// a list (a list of lists where a scene has a list), and a seed may be a range such as "1-100". `asperity.study` solves it.
///
/// With adhesion each row is a history along its path, and has its pull-off pressure, as minus `lowest_pressure`, instead of the area.
#[pyclass(frozen, module = "asperity")]
pub struct Study {
    pub plan: Plan,
    /// The study as TOML, with the full paths of height files, so that other processes can read it.
    text: String,
}

impl Study {
    fn from_table(table: SetupTable, exception: impl FnOnce(StudyError) -> PyErr) -> PyResult<Self> {
        let table = table.beside(&absolute("study.toml")?).map_err(py_error)?;
        let text = table.to_toml();
        let plan = Plan::from_table(table).map_err(exception)?;
        Ok(Self { plan, text })
    }
}

#[pymethods]
impl Study {
    #[new]
    #[pyo3(signature = (**keys), text_signature = "(*, surface, grid, load, solid=None, law=None, adhesion=None, viscoelastic=None, path=None, sliding=None, flow=None, solver=None, stop=None, record=None)")]
    fn new(py: Python<'_>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let table = table_from_sections(&sections_from_keywords(keys)?)?;
        Self::from_table(table, |error| error_of_keywords(py, "Study", &[""], error))
    }

    /// The study that a TOML text describes. Height files are found in the working directory.
    #[staticmethod]
    fn from_toml(text: &str) -> PyResult<Self> {
        Plan::from_toml(text).map_err(py_error)?; // which names the line of what is wrong
        Self::from_table(SetupTable::from_toml(text).map_err(py_error)?, py_error)
    }

    /// The study in a file. Height files are found beside it.
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        Plan::read(&path).map_err(py_error)?;
        Self::from_table(SetupTable::read(&absolute(path)?).map_err(py_error)?, py_error)
    }

    /// The study as TOML, with the full paths of height files.
    fn to_toml(&self) -> &str {
        &self.text
    }

    /// Number of rows.
    #[getter]
    fn rows(&self) -> usize {
        self.plan.rows()
    }

    /// Number of realisations.
    #[getter]
    fn realisations(&self) -> usize {
        self.plan.realisations()
    }

    /// The setup of a row under its load. Rows count from 0: study.setup(5) is the setup of table["scene"][5], whose number in the column "row",
    /// in files and on the command line is 6.
    fn setup(&self, row: isize) -> PyResult<Setup> {
        let row = index_of("row", row, self.plan.rows())?;
        // rows of the library count from 1
        self.plan.row(row + 1).and_then(|it| self.plan.setup(it)).map(Setup::new).map_err(py_error)
    }

    /// The estimated cost of each combination of values, except for the seeds: the values, the number of realisations, and for each of them
    /// the seconds on one core and the bytes.
    fn expenses<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let expenses = py.try_detached(|| self.plan.expenses())?;
        let rows = expenses.into_iter().map(|(first, expense)| {
            let row = PyDict::new(py);
            row.set_item("values", self.plan.words_but_seed(first))?;
            row.set_item("realisations", self.plan.seeds())?;
            row.set_item("seconds", expense.seconds)?;
            row.set_item("bytes", expense.bytes)?;
            Ok(row)
        });
        rows.collect()
    }

    /// Solves some realisations, given by their numbers from 0, on a number of threads, and returns the rows of each as text for Ledger.add.
    /// This is what a worker does; a Study can be pickled. cancel.cancel() of a CancelToken ends it.
    #[pyo3(signature = (realisations, *, threads=1, cancel=None))]
    fn solve(
        &self,
        py: Python<'_>,
        realisations: Vec<isize>,
        threads: usize,
        cancel: Option<&CancelToken>,
    ) -> PyResult<Vec<String>> {
        if threads == 0 {
            return bail("a realisation is solved on 0 threads: give at least one (threads)");
        }
        if threads > MOST_THREADS {
            return bail(format!("a realisation is solved on {threads} threads: give at most {MOST_THREADS}"));
        }
        let index = |it: isize| index_of("realisation", it, self.plan.realisations());
        let realisations = realisations.into_iter().map(index).collect::<PyResult<Vec<_>>>()?;
        let cancel = cancel.cloned().unwrap_or_default();
        let solve = |&it: &usize| self.plan.solve(self.plan.number(it)?, |_| &cancel);
        let solved = py.detached(|| {
            // threads of its own, since those that all share are not in a process that was forked
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().map_err(py_error)?;
            let lines = |it| solve(it).map(|points| Point::to_lines(&points)).map_err(py_error);
            pool.install(|| realisations.iter().map(lines).collect::<PyResult<Vec<_>>>())
        })??;
        if cancel.is_cancelled() { bail("the study was cancelled before it was solved") } else { Ok(solved) }
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.text == other.text
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let text = PyTuple::new(slf.py(), [&slf.get().text])?;
        Ok((slf.get_type().getattr("from_toml")?, text))
    }

    fn __repr__(&self) -> String {
        format!("Study.from_toml('''\n{}''')", self.text)
    }
}
