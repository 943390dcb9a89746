//! The numbers of a contact by their names.

use crate::arrays::vector;
use crate::contact::Contact;
use crate::detached::Detached;
use crate::error::bail;
use asperity::contact::{Quantity, QuantityKind, Reading};
use asperity::error::FlowError;
use asperity::setup::{Drive, FlowFound};
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
    /// The drive of the history of which the contact is a state, if it is one.
    pub fn drive(&self) -> Option<&'static Drive> {
        self.setup.drive().ok().flatten().filter(|_| self.is_of_history)
    }

    /// All numbers by their names: the observables, what yields where there is a hardness, and what flows where the setup asks for it. Numbers
    /// of a state of a history stand in place of the observables of their names.
    ///
    /// # Errors
    /// For a flow that cannot be found.
    pub fn numbers(&self) -> Result<Vec<(&'static str, Measure)>, FlowError> {
        let reading = Reading::from(&*self.contact);
        let measure = |quantity: Quantity, value: f64| match quantity.row().kind {
            QuantityKind::Flag => (quantity.name(), Measure::Truth(value == 1.0)),
            QuantityKind::Number | QuantityKind::Bound | QuantityKind::Whole => {
                (quantity.name(), Measure::Number(value))
            }
        };
        let told = Quantity::all().filter(|it| it.tells_of(&self.contact));
        let mut numbers: Vec<_> = told.map(|it| measure(it, reading.value(it))).collect();
        let of_state = |it: &Quantity| self.contact.values().get(*it).is_some();
        if !self.setup.flow.is_none() {
            let found = self.flow()?.numbers;
            numbers.extend(found.into_iter().filter(|(it, _)| !of_state(it)).map(|(it, value)| measure(it, value)));
        }
        Ok(numbers)
    }

    /// What flows through the contact, as far as its setup asks for it, found on first use.
    pub fn flow(&self) -> Result<FlowFound, FlowError> {
        if let Some(found) = self.flow.get() {
            return Ok(found.clone());
        }
        let found = self.setup.flow.measure(&self.contact)?;
        // the fields are found again where they are asked for
        Ok(self.flow.get_or_init(|| FlowFound { leakages: Vec::new(), ..found }).clone())
    }
}

/// The numbers of several contacts, by their names an array with a number for each contact; NaN where a contact has no such number.
pub fn columns<'py>(py: Python<'py>, contacts: &[Py<Contact>]) -> PyResult<Bound<'py, PyDict>> {
    let rows = py.try_detached(|| contacts.iter().map(|it| it.get().numbers()).collect::<Result<Vec<_>, _>>())?;
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
        let numbers = py.try_detached(|| self.numbers())?;
        let measures = PyDict::new(py);
        numbers.into_iter().try_for_each(|(name, number)| measures.set_item(name, number))?;
        Ok(measures)
    }

    /// Mean pressure. In a history with adhesion it is that of the contact less that of the attraction, as in History.numbers.
    #[getter]
    fn mean_pressure(&self) -> f64 {
        self.contact.0.value(Quantity::MeanPressure)
    }

    /// Mean gap, a length. NaN where adhesion has let go under a load: surfaces that have parted have no distance.
    #[getter]
    fn mean_gap(&self) -> f64 {
        self.contact.0.value(Quantity::MeanGap)
    }

    /// The approach, a length: how far the surface has moved since first touch. None on a periodic half-space, where it has no limit.
    #[getter]
    fn approach(&self) -> Option<f64> {
        self.contact.0.get(Quantity::Approach)
    }

    /// Elastic energy per area, pressure times length. In a history of creep or adhesion it is NaN: `stored` in History.numbers is the stored
    /// energy there.
    #[getter]
    fn elastic_energy(&self) -> f64 {
        match self.contact.values().feels.is_pressure_alone() {
            true => self.contact.elastic_energy(),
            false => f64::NAN,
        }
    }

    /// Contact stiffness, computed on first use with about a tenth of the work of a solve; then also in `measures`. A pressure per length.
    fn stiffness(&self, py: Python<'_>) -> PyResult<f64> {
        if self.contact.values().feels.attraction {
            return bail("the stiffness is that of a contact without adhesion: leave the adhesion out");
        }
        py.detached(|| self.contact.stiffness())
    }
}
