//! Studies: setups with lists in them.

use crate::halt::Halt;
use crate::refusal::{refuse, refused};
use crate::setup::Setup;
use crate::value::{sections, table};
use asperity::setup::Table;
use asperity::study::{Plan, Point};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use rayon::ThreadPoolBuilder;
use std::path::{PathBuf, absolute};

/// A setup with lists in it, which stands for many: one realisation for each choice of a value from every list, each solved under all
/// loads one after the other. Each load of a realisation is a row.
///
/// Study(surface=..., grid=..., load=..., ...) takes the sections of a scene as dictionaries, with `_` for `-` in their keys. Any value may be
/// a list, a list of lists where a scene has a list, and a seed a range such as "1-100". `asperity.study` solves it.
#[pyclass(frozen, module = "asperity")]
pub struct Study {
    pub plan: Plan,
    /// The study as TOML, with the full paths of height files, so that it can be sent to other processes.
    text: String,
}

impl Study {
    fn made(table: Table) -> PyResult<Self> {
        let table = table.beside(&absolute("study.toml")?);
        let text = table.to_toml();
        Ok(Self { plan: Plan::from_table(table).map_err(refused)?, text })
    }
}

#[pymethods]
impl Study {
    #[new]
    #[pyo3(signature = (**keys), text_signature = "(*, surface, grid, load, solid=None, law=None, solver=None, stop=None)")]
    fn new(keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Self::made(table(&keys.map(sections).transpose()?.unwrap_or_default())?)
    }

    /// The study that a TOML text describes. Height files are found in the working directory.
    #[staticmethod]
    fn from_toml(text: &str) -> PyResult<Self> {
        Plan::from_toml(text).map_err(refused)?; // which names the line of what is wrong
        Self::made(Table::from_toml(text).map_err(refused)?)
    }

    /// The study in a file. Height files are found beside it.
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        Plan::read(&path).map_err(refused)?;
        Self::made(Table::read(&absolute(path)?).map_err(refused)?)
    }

    /// The study as TOML, with the full paths of height files.
    fn to_toml(&self) -> &str {
        &self.text
    }

    /// How many rows there are.
    #[getter]
    fn rows(&self) -> usize {
        self.plan.rows()
    }

    /// How many realisations there are.
    #[getter]
    fn realisations(&self) -> usize {
        self.plan.realisations()
    }

    /// The setup of a row, by its number from 1, under its load.
    fn setup(&self, row: usize) -> PyResult<Setup> {
        self.plan.row(row).and_then(|row| self.plan.setup(row)).map(Setup).map_err(refused)
    }

    /// What each choice from the lists but that of the seeds takes, as a model says: the values, how many realisations, and of each of them
    /// the seconds on one core and the bytes.
    fn expenses<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let expenses = py.detach(|| self.plan.expenses()).map_err(refused)?;
        let told = expenses.into_iter().map(|(first, expense)| {
            let told = PyDict::new(py);
            told.set_item("values", self.plan.words_but_seed(first))?;
            told.set_item("realisations", self.plan.seeds())?;
            told.set_item("seconds", expense.seconds)?;
            told.set_item("bytes", expense.bytes)?;
            Ok(told)
        });
        told.collect()
    }

    /// Solves some realisations, by their numbers from 0, on so many threads, and returns the rows of each as text that a Ledger enters. This
    /// is what a worker does; a Study can be pickled. A Halt ends it.
    #[pyo3(signature = (realisations, *, threads=1, halt=None))]
    fn solve(
        &self,
        py: Python<'_>,
        realisations: Vec<usize>,
        threads: usize,
        halt: Option<&Halt>,
    ) -> PyResult<Vec<String>> {
        if threads == 0 {
            return refuse("a realisation is solved on 0 threads: give at least one (threads)");
        }
        let halt = halt.cloned().unwrap_or_default();
        let solve = |&it: &usize| self.plan.solve(self.plan.number(it)?, |_| &halt);
        let solved = py.detach(|| {
            // threads of its own, since those that all share are not in a process that was forked
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().map_err(refused)?;
            let lines = |it| solve(it).map(|points| Point::to_lines(&points)).map_err(refused);
            pool.install(|| realisations.iter().map(lines).collect::<PyResult<Vec<_>>>())
        })?;
        if halt.is_pulled() { refuse("the study was ended before it was solved") } else { Ok(solved) }
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
