//! Histories: the states of a contact that creeps, slips, slides, rolls or sticks.

use crate::arrays::vector;
use crate::contact::Contact;
use crate::contact_files::ending;
use crate::conversion::to_python;
use crate::detached::Detached;
use crate::error::{BoxedError, bail, py_error, unknown_name};
use crate::output::check_output;
use crate::problem::Problem;
use crate::setup::Setup;
use crate::shared_state::SharedState;
use crate::states::States;
use asperity::contact::{Quantity, State, archive_of_states};
use asperity::files::write_beside;
use asperity::job::HistoryOutcome;
use asperity::setup::StateChart;
use asperity::surface::Field;
use numpy::ndarray::{ArrayD, Axis, stack};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The states of a contact that creeps in time, slips under tangential loads, slides at some speeds, rolls, has adhesion or yields below its surface, in
/// their order: a sequence of Contact.
///
/// history[0] is the contact of the first state. history.numbers["friction"] holds the friction of all states, and
/// history.fields["traction"] the tractions of all states. A contact of a history has the numbers of its state in its measures.
#[pyclass(frozen, sequence, extends = States, module = "asperity")]
pub struct History {
    pub outcome: Arc<HistoryOutcome>,
    pub rank: usize,
}

impl History {
    /// The history that was followed from a setup.
    pub fn new(py: Python<'_>, outcome: HistoryOutcome, problem: &Problem, setup: Setup) -> PyResult<Py<Self>> {
        let Problem { surface, rank, preparation, .. } = problem;
        let rank = *rank;
        let contact = |state: &Arc<State>| {
            let contact = Contact::new(SharedState(state.clone()), surface.clone(), setup.setup.clone(), rank);
            Contact { is_of_history: true, preparation: preparation.clone(), ..contact }
        };
        let states = States::new(py, outcome.states.iter().map(contact), setup.clone())?;
        Self::from_states(py, outcome, states, rank)
    }

    /// The history with an outcome and the contacts of its states.
    pub fn from_states(py: Python<'_>, outcome: HistoryOutcome, states: States, rank: usize) -> PyResult<Py<Self>> {
        let history = Self { outcome: Arc::new(outcome), rank };
        Py::new(py, PyClassInitializer::from(states).add_subclass(history))
    }

    /// Writes the fields and numbers of all states.
    fn write_archive(&self, path: &Path, setup: &Setup) -> Result<(), BoxedError> {
        let bytes = archive_of_states(&self.outcome.states, self.rank, &setup.to_saved_table().to_toml());
        Ok(write_beside(path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?)
    }
}

#[pymethods]
impl History {
    /// What the contact does: "creep", "slip", "sliding", "rolling", "adhesion" or "plastic".
    #[getter]
    fn process(&self) -> &'static str {
        self.outcome.drive.name
    }

    /// What the states claim to be, in words: the solution, steps of a path with friction, a pressure whose error is bounded, rounds that have
    /// converged, a state with adhesion, or load steps of a solid that yields. With adhesion, states differ in their claims, and this is the first one.
    #[getter]
    fn claim(&self) -> &'static str {
        self.outcome.claim().map_or("", |claim| claim.words())
    }

    /// What each state claims to be, in a word: with adhesion "solution", "stable", "marginal", "saddle", "stationary", "not-converged", "moving" (a frame of
    /// a jump) or "separated"; otherwise "solution", "path-steps" and "given-steps" (of friction), "load-step" (of a solid that yields), "bounded", or
    /// "rounds-converged", "rounds-of-path-steps" and "rounds-of-given-steps" (of bodies of different materials).
    #[getter]
    fn claims(&self) -> Vec<&'static str> {
        self.outcome.states.iter().map(|state| state.claim.into()).collect()
    }

    /// With adhesion a dictionary; otherwise None. It has the work and range of the attraction, process_zone (a length) and spacings (the same in
    /// spacings of the grid), grid_error (the estimated relative error of pull-off forces by the grid, for an attraction that jumps, such as
    /// Dugdale's; otherwise None), the numbers tabor, maugis and pastewka_robbins, lowest_pressure (of all states: the pull-off pressure if separated
    /// is True), jumps (a list of dictionaries with state, energy, and mean_gap, mean_pressure and relative_area before and after), and
    /// lost_in_jumps and lost_error (its estimated error; None on a free boundary), energies per area of the cell.
    #[getter]
    fn adhesion<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.outcome.adhesion)
    }

    /// The numbers of the process by their names, each an array with a number for every state; NaN where a state has none. `explain` says
    /// what they are.
    #[getter]
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let outcome = Arc::clone(&self.outcome);
        let columns = py.detached(move || {
            outcome.quantities().into_iter().map(|it| (it.name(), outcome.values(it))).collect::<Vec<_>>()
        })?;
        let numbers = PyDict::new(py);
        columns.into_iter().try_for_each(|(name, values)| numbers.set_item(name, vector(py, values)))?;
        Ok(numbers)
    }

    /// Further fields of the states by their names, such as traction, slip, stored_strain, attraction or imprint, each an array with a first axis of states.
    #[getter]
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let fields = PyDict::new(py);
        let Some(first) = self.outcome.states.first() else { return Ok(fields) };
        for field in first.fields.iter().filter(|field| field.is_on_surface()) {
            let of_rank = |values: &Field| -> ArrayD<f64> {
                let values = values.clone();
                if self.rank == 1 { values.index_axis_move(Axis(0), 0).into_dyn() } else { values.into_dyn() }
            };
            let values: Vec<ArrayD<f64>> =
                self.outcome.states.iter().filter_map(|state| state.field(field.kind)).map(of_rank).collect();
            let views: Vec<_> = values.iter().map(|it| it.view()).collect();
            let stacked = stack(Axis(0), &views).map_err(|error| py_error(error.to_string()))?;
            fields.set_item(field.name(), PyArrayDyn::from_owned_array(py, stacked))?;
        }
        Ok(fields)
    }

    /// The energy that each closed cycle of the path lost, per area of the cell.
    #[getter]
    fn energy_per_cycle<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<f64>> {
        let setup = &slf.as_super().get().setup;
        let cycles = slf.get().outcome.cycles(&setup.setup);
        vector(slf.py(), cycles.iter().map(|cycle| cycle.energy).collect())
    }

    /// The estimated errors of `energy_per_cycle` by the steps in time or of the path; NaN where none is estimated.
    #[getter]
    fn energy_per_cycle_error<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<f64>> {
        let setup = &slf.as_super().get().setup;
        let cycles = slf.get().outcome.cycles(&setup.setup);
        vector(slf.py(), cycles.iter().map(|cycle| cycle.error.unwrap_or(f64::NAN)).collect())
    }

    /// Explains a number of `numbers` in one sentence.
    #[staticmethod]
    fn explain(py: Python<'_>, name: &str) -> PyResult<&'static str> {
        let names = || Quantity::all().map(Quantity::name).collect::<Vec<_>>();
        let found = Quantity::find(name).map(|it| it.row().sentence);
        found.ok_or_else(|| unknown_name(py, "number", name, &names()))
    }

    /// The unit of a number of `numbers` in a word, such as "length"; "1" for a pure number.
    #[staticmethod]
    fn _unit(name: &str) -> &'static str {
        Quantity::find(name).map_or("1", |it| it.row().unit.into())
    }

    /// The charts of a figure: names of the quantities on both axes, their titles, and whether the first axis is logarithmic.
    fn _charts(&self) -> [([&'static str; 2], [&'static str; 2], bool); 2] {
        let drive = self.outcome.drive;
        let ends = |it: StateChart| [it.x, Some(it.y)];
        let name = |it: Option<Quantity>| it.map_or("state", Quantity::name);
        let title = |it: Option<Quantity>| it.map_or("state", |it| it.row().title);
        drive.charts.map(|it| (ends(it).map(name), ends(it).map(title), drive.is_logarithmic))
    }

    /// Writes the history to a file whose ending says what: .npz for the fields and numbers of all states, with the setup, .csv for the table that the
    /// command line writes, .svg, .pdf or .png for the figure of `plot`. asperity.load reads a .npz again.
    fn save(slf: Bound<'_, Self>, path: PathBuf) -> PyResult<()> {
        let (it, setup) = (slf.get(), &slf.as_super().get().setup);
        check_output(&path, &["npz", "csv", "svg", "pdf", "png"], &setup.setup)?;
        if it.outcome.states.is_empty() {
            return bail("the history has no states: nothing is saved");
        }
        match ending(&path).as_str() {
            "npz" => slf.py().try_detached(|| it.write_archive(&path, setup)),
            "csv" => slf.py().try_detached(|| it.outcome.write_table(&path)),
            _ => slf.call_method0("plot")?.call_method1("savefig", (path,)).map(drop),
        }
    }

    /// The numbers as a data frame of pandas, with a row for every state.
    fn to_pandas<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("pandas")?.call_method1("DataFrame", (slf.get().numbers(slf.py())?,))
    }

    /// The fields and numbers as a Dataset of xarray, over the states and the positions of the nodes.
    fn to_xarray<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.export")?.call_method1("history_to_xarray", (slf,))
    }

    /// A figure by matplotlib, with the quantities that the command line draws: area and gap over time for creep; mean pressure and area over the mean
    /// gap for adhesion, with an arrow for each jump; traction over the shift and the share that sticks for slip; friction and area over the
    /// speed for sliding; friction and the share that sticks over the creepage for rolling.
    ///
    /// `length_unit` and `pressure_unit`, such as "um" and "MPa", are those of the axes, of a problem in metres and pascals.
    #[pyo3(signature = (*, length_unit=None, pressure_unit=None))]
    fn plot<'py>(
        slf: Bound<'py, Self>,
        length_unit: Option<&str>,
        pressure_unit: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let units = (slf.clone(), length_unit, pressure_unit);
        slf.py().import("asperity.plotting")?.call_method1("plot_history", units)
    }

    fn _repr_html_<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("history_as_html", (slf,))
    }

    fn __repr__(&self) -> String {
        format!("History({}, {} states)", self.process(), self.outcome.states.len())
    }
}
