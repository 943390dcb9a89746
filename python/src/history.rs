//! Histories: the states of a contact under several loads, or of one that creeps, slips, slides, rolls, sticks or yields.

use crate::arrays::vector;
use crate::contact::Contact;
use crate::conversion::to_python;
use crate::detached::Detached;
use crate::error::{py_error, unknown_name};
use crate::measures::columns;
use crate::patches;
use crate::problem::Problem;
use crate::setup::Setup;
use crate::shared_state::SharedState;
use asperity::contact::{Load, PatchHistory, Quantity, State};
use asperity::job::HistoryOutcome;
use asperity::setup::StateChart;
use asperity::surface::Field;
use numpy::ndarray::{ArrayD, Axis, stack};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator, PyTuple};
use std::sync::Arc;

/// The states of a contact under a list of loads, or of one that creeps in time, slips under tangential loads, slides at some speeds, rolls, has adhesion
/// or yields below its surface, in their order: a sequence of Contact.
///
/// history[0] is the contact of the first state. history.measures["kappa_r"] holds kappa_r of all states, history.numbers["friction"] the
/// friction, and history.fields["traction"] the tractions. A contact of a history has the numbers of its state in its measures.
#[pyclass(frozen, sequence, module = "asperity")]
pub struct History {
    pub contacts: Py<PyTuple>,
    pub setup: Setup,
    pub outcome: Arc<HistoryOutcome>,
    pub rank: usize,
}

impl History {
    /// The history that was followed from a setup.
    pub fn new(py: Python<'_>, outcome: HistoryOutcome, problem: &Problem, setup: Setup) -> PyResult<Py<Self>> {
        let Problem { surface, rank, preparation, .. } = problem;
        let is_list = outcome.drive.is_list;
        let contact = |state: &Arc<State>| {
            // the contacts under a list of loads do not depend on each other, and each has a setup of its own
            let under = || setup.setup.under(state.contact.problem.load());
            let own = if is_list { under() } else { setup.setup.clone() };
            let contact = Contact::new(SharedState(state.clone()), surface.clone(), own, *rank);
            Py::new(py, Contact { is_of_history: !is_list, preparation: preparation.clone(), ..contact })
        };
        let contacts = outcome.states.iter().map(contact).collect::<PyResult<Vec<_>>>()?;
        let contacts = PyTuple::new(py, contacts)?.unbind();
        Py::new(py, Self { contacts, setup, outcome: Arc::new(outcome), rank: *rank })
    }

    /// The contacts themselves.
    pub fn each(&self, py: Python<'_>) -> PyResult<Vec<Py<Contact>>> {
        self.contacts.bind(py).iter().map(|it| Ok(it.cast::<Contact>()?.clone().unbind())).collect()
    }

    /// The contact patches from state to state.
    fn patch_history(&self, py: Python<'_>) -> PyResult<PatchHistory> {
        let contacts = self.each(py)?;
        py.detached(|| {
            let shape = contacts.first().map_or([0, 0], |it| it.get().contact.problem.surface().grid().shape());
            let mut history = PatchHistory::new(self.setup.setup.surface.own_shape(shape));
            contacts.iter().for_each(|it| history.add(&it.get().contact));
            history
        })
    }
}

#[pymethods]
impl History {
    /// Whether the solver converged in all states.
    #[getter]
    fn converged(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.each(py)?.iter().all(|it| it.get().contact.is_converged()))
    }

    /// The setup that repeats the states. Heights that were given as an array have the name array.npy in it.
    #[getter]
    fn setup(&self) -> Setup {
        self.setup.clone()
    }

    /// The values of a list of loads, in the form in which they were given; empty for what is no list.
    #[getter]
    fn loads<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.setup.setup.loads.iter().map(|load| load.value()).collect())
    }

    /// What the contact does: "loads" under a list of them, "creep", "slip", "sliding", "rolling", "adhesion" or "plastic".
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

    /// What the states add up to, by the names of quantities: states, largest_area and history_transforms, and with adhesion lowest_pressure, separated, jumps, lost_in_jumps, lost_error and stable. `explain` says what
    /// they are.
    #[getter]
    fn totals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let totals = PyDict::new(py);
        self.outcome.totals.iter().try_for_each(|(quantity, value)| totals.set_item(quantity.name(), value))?;
        Ok(totals)
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

    /// All numbers of Contact.measures by their names, each an array with a value for every state.
    #[getter]
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        columns(py, &self.each(py)?)
    }

    /// The numbers that stand in tables and figures: the measures of a list of loads, else the numbers of the process.
    pub fn _columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        if self.outcome.drive.is_list { self.measures(py) } else { self.numbers(py) }
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
    fn energy_per_cycle<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let cycles = self.outcome.cycles(&self.setup.setup);
        vector(py, cycles.iter().map(|cycle| cycle.energy).collect())
    }

    /// The estimated errors of `energy_per_cycle` by the steps in time or of the path; NaN where none is estimated.
    #[getter]
    fn energy_per_cycle_error<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let cycles = self.outcome.cycles(&self.setup.setup);
        vector(py, cycles.iter().map(|cycle| cycle.error.unwrap_or(f64::NAN)).collect())
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

    /// The charts of a figure: names of the quantities on both axes, their titles, and whether the first axis is logarithmic. Those of a list of loads
    /// have the load along the first axis as it was prescribed.
    fn _charts(&self) -> [([&'static str; 2], [&'static str; 2], bool); 2] {
        let drive = self.outcome.drive;
        let load = self.setup.setup.loads.first().map(|load| match load {
            Load::ReducedPressure(_) => Quantity::ReducedPressure,
            Load::MeanPressure(_) | Load::Force(_) => Quantity::MeanPressure,
            Load::MeanGap(_) => Quantity::MeanGap,
            Load::Approach(_) => Quantity::Approach,
        });
        let ends = |it: StateChart| [load.or(it.x), Some(it.y)];
        let name = |it: Option<Quantity>| it.map_or("state", Quantity::name);
        let title = |it: Option<Quantity>| it.map_or("state", |it| it.row().title);
        drive.charts.map(|it| (ends(it).map(name), ends(it).map(title), drive.is_logarithmic))
    }

    /// The contact patches of all states as arrays by name, a row for each patch in each state: the index of the state (state), the number of the patch,
    /// which it keeps from state to state (patch), nodes, area, load, load_share (of the load of all patches), kappa_r, x and y. See Contact.patches.
    fn patches<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        patches::of_states(slf.py(), &slf.get().patch_history(slf.py())?)
    }

    /// What happened to the contact patches, as a list of tuples: the index of the first state that shows it, "born", "died", "merged" or "split", the
    /// number of the patch, and the number of the patch that it merged into or was split from, or None.
    fn patch_events(&self, py: Python<'_>) -> PyResult<Vec<patches::PatchEventRow>> {
        Ok(patches::events(self.patch_history(py)?))
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.contacts.bind(py).len()
    }

    fn __getitem__<'py>(&self, py: Python<'py>, index: Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.contacts.bind(py).as_any().get_item(index)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.contacts.bind(py).try_iter()
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __repr__(&self) -> String {
        format!("History({}, {} states)", self.process(), self.outcome.states.len())
    }
}
