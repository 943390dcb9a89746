//! The numbers of a contact by their names.

use crate::arrays::vector;
use crate::contact::Contact;
use crate::error::{bail, py_error};
use asperity::contact::{OBSERVABLES, State, StateKind};
use asperity::error::FlowError;
use asperity::history::HISTORY_QUANTITIES;
use asperity::setup::ProcessKind;
use asperity::study::{FLOW_COLUMNS, FlowColumn, FlowRow};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A number of a contact, or whether something holds.
#[derive(Clone, Copy, IntoPyObject)]
pub enum Measure {
    Number(f64),
    Truth(bool),
}

impl Contact {
    /// The process of the history of which the contact is a state, if it is one.
    pub fn process(&self) -> Option<ProcessKind> {
        self.state.as_ref().and_then(|_| self.setup.process().ok().flatten())
    }

    /// All numbers by their names: the observables, what yields where there is a hardness, and what flows where the setup asks for it. Numbers
    /// of a state of a history stand in place of the observables of their names.
    ///
    /// # Errors
    /// For a flow that cannot be found.
    pub fn numbers(&self) -> Result<Vec<(&'static str, Measure)>, FlowError> {
        let state = State::from(&self.contact);
        let of_state = |name: &str| self.state.as_ref().and_then(|it| it.find(name));
        let known = OBSERVABLES.iter().filter(|it| it.tells_of(&self.contact) || of_state(it.name).is_some());
        let number = |name, value| (name, Measure::Number(value));
        let mut numbers: Vec<_> =
            known.map(|it| number(it.name, of_state(it.name).unwrap_or_else(|| (it.value)(&state)))).collect();
        let is_observable = |name: &str| OBSERVABLES.iter().any(|it| it.name == name);
        let others = HISTORY_QUANTITIES.iter().filter(|it| !is_observable(it.name));
        numbers.extend(others.filter_map(|it| Some(number(it.name, of_state(it.name)?))));
        if !self.setup.law.is_hard_wall() {
            numbers.push(number("plastic_load_share", self.contact.plasticity().load_share));
        }
        if !self.setup.flow.is_none() {
            let row = self.flow()?;
            numbers.extend(FLOW_COLUMNS.iter().filter_map(|column| match column {
                FlowColumn::Number(name, of) => Some((*name, Measure::Number(of(&row)?))),
                FlowColumn::Text(name, of) => Some((*name, Measure::Truth(of(&row)?))),
            }));
        }
        Ok(numbers)
    }

    /// What flows through the contact, as far as its setup asks for it, found on first use.
    pub fn flow(&self) -> Result<FlowRow, FlowError> {
        if let Some(row) = self.flow.get() {
            return Ok(*row);
        }
        let (row, _) = FlowRow::measure(&self.contact, &self.setup.flow)?;
        Ok(*self.flow.get_or_init(|| row))
    }
}

/// The numbers of several contacts, by their names an array with a number for each contact; NaN where a contact has no such number.
pub fn columns<'py>(py: Python<'py>, contacts: &[Py<Contact>]) -> PyResult<Bound<'py, PyDict>> {
    let rows = py.detach(|| contacts.iter().map(|it| it.get().numbers()).collect::<Result<Vec<_>, _>>());
    let rows = rows.map_err(py_error)?;
    let columns = PyDict::new(py);
    for (name, first) in rows.first().into_iter().flatten() {
        let of = |row: &Vec<(&str, Measure)>| {
            row.iter().find(|(other, _)| other == name).map_or(Measure::Number(f64::NAN), |(_, value)| *value)
        };
        match first {
            Measure::Number(_) => {
                let number = |it| if let Measure::Number(value) = it { value } else { f64::NAN };
                columns.set_item(name, vector(py, rows.iter().map(|row| number(of(row))).collect()))?;
            }
            Measure::Truth(_) => {
                let holds = |it| matches!(it, Measure::Truth(true));
                columns.set_item(name, PyArray1::from_iter(py, rows.iter().map(|row| holds(of(row)))))?;
            }
        }
    }
    Ok(columns)
}

#[pymethods]
impl Contact {
    /// All numbers of the contact by their names: areas, gradients, kappa_r, mean gap, errors and so on. asperity.observables() explains them.
    ///
    /// Where there is a hardness, they include plastic_overlap (the mean overlap of what yields, a length) and plastic_load_share. Where the
    /// setup has a section `flow`, they include percolation, leakage and conductance, under the names of the tables of the command line.
    ///
    /// A state of a history has the numbers of History.numbers instead of those of the same name. With creep and adhesion, numbers that hold for
    /// an elastic contact only are absent.
    #[getter]
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let numbers = py.detach(|| self.numbers()).map_err(py_error)?;
        let measures = PyDict::new(py);
        numbers.into_iter().try_for_each(|(name, number)| measures.set_item(name, number))?;
        Ok(measures)
    }

    /// Mean pressure. In a history with adhesion it is that of the contact less that of the attraction, as in History.numbers.
    #[getter]
    fn mean_pressure(&self) -> f64 {
        let of_state = self.state.as_ref().and_then(|it| it.find("mean_pressure"));
        of_state.unwrap_or_else(|| self.contact.mean_pressure())
    }

    /// Mean gap, a length.
    #[getter]
    fn mean_gap(&self) -> f64 {
        self.contact.mean_gap()
    }

    /// The approach, a length: how far the surface has moved since first touch. None on a periodic half-space, where it has no limit.
    #[getter]
    fn approach(&self) -> Option<f64> {
        self.contact.approach()
    }

    /// Elastic energy per area, pressure times length. In a history of creep or adhesion it is NaN: `stored` in History.numbers is the stored
    /// energy there.
    #[getter]
    fn elastic_energy(&self) -> f64 {
        match self.contact.values().kind {
            StateKind::Creep | StateKind::Adhesion => f64::NAN,
            StateKind::Elastic => self.contact.elastic_energy(),
        }
    }

    /// Contact stiffness, computed on first use with about a tenth of the work of a solve; then also in `measures`. A pressure per length.
    fn stiffness(&self, py: Python<'_>) -> PyResult<f64> {
        if self.process() == Some(ProcessKind::Adhesion) {
            return bail("the stiffness is that of a contact without adhesion: leave the adhesion out");
        }
        Ok(py.detach(|| self.contact.stiffness()))
    }
}
