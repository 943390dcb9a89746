//! Copies, comparisons and pickles of histories.

use crate::arrays::{ArrayLike, field, view};
use crate::contact::Contact;
use crate::error::{bail, py_error};
use crate::history::History;
use crate::problem::Problem;
use asperity::contact::{CutLayers, FieldKind, Quantity, ResultClaim, State, StateField};
use asperity::job::HistoryOutcome;
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::sync::Arc;

/// The row and the interfaces of the layers of a cut.
type LayerParts = (usize, Vec<f64>);

/// The values of a state besides its contact: the point of the path, the claim, further fields by their names, and the layers of the cut below it.
type StateParts<'py> = (Option<usize>, String, Vec<(String, Bound<'py, PyArrayDyn<f64>>)>, Option<LayerParts>);

/// The values of a state besides its contact, as a pickle gives them.
type GivenParts<'py> = (Option<usize>, String, Vec<(String, ArrayLike<'py>)>, Option<LayerParts>);

/// The values that make a history again: its problem, its contacts, and what else belongs to their states.
type HistoryParts<'py> = (Problem, Py<PyTuple>, Vec<StateParts<'py>>);

#[pymethods]
impl History {
    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, Self>) -> PyResult<bool> {
        let is_same = |(one, two): (&Arc<State>, &Arc<State>)| {
            one.claim == two.claim && one.point == two.point && one.fields == two.fields && one.layers == two.layers
        };
        let [one, two] = [slf, other].map(|it| &it.get().outcome.states);
        let [own, others] = [slf, other].map(|it| it.get());
        let has_same_contacts = own.contacts.bind(slf.py()).eq(others.contacts.bind(slf.py()))?;
        Ok(own.setup == others.setup && has_same_contacts && one.iter().zip(two).all(is_same))
    }

    fn __reduce__<'py>(slf: Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, HistoryParts<'py>)> {
        let (py, it) = (slf.py(), slf.get());
        let Self { contacts, setup, .. } = it;
        let Some(first) = contacts.bind(py).iter().next() else {
            return bail("the history has no states: there is nothing to pickle");
        };
        let contact = first.cast::<Contact>()?.get();
        let problem = Problem {
            problem: contact.contact.problem.clone(),
            surface: contact.surface.clone(),
            setup: setup.clone(),
            rank: it.rank,
            preparation: contact.preparation.clone(),
        };
        let fields = |state: &State| {
            let named = state.fields.iter().map(|it| {
                // a cut has layers along its first axis, below a line too
                let rank = if it.is_on_surface() { slf.get().rank } else { 2 };
                (it.name().to_owned(), view(&it.values, rank, slf.clone().into_any()))
            });
            named.collect()
        };
        let layers = |state: &State| state.layers.clone().map(|it| (it.row, it.interfaces));
        let state =
            |state: &Arc<State>| (state.point, <&str>::from(state.claim).to_owned(), fields(state), layers(state));
        let states = it.outcome.states.iter().map(state).collect();
        Ok((slf.get_type().getattr("_from_parts")?, (problem, contacts.clone_ref(py), states)))
    }

    /// The history that the values of a pickle describe.
    #[staticmethod]
    fn _from_parts(problem: &Problem, contacts: Bound<'_, PyTuple>, states: Vec<GivenParts<'_>>) -> PyResult<Py<Self>> {
        let state = |(contact, (point, claim, fields, layers)): (Bound<'_, PyAny>, GivenParts<'_>)| -> PyResult<_> {
            let contact = contact.cast::<Contact>()?.get();
            let claim: ResultClaim = claim.parse().map_err(|_| py_error(format!("there is no claim {claim:?}")))?;
            let fields = fields.iter().map(|(name, values)| named(name, field(values)?)).collect::<PyResult<_>>()?;
            let number = |quantity: Quantity| contact.contact.values().get(quantity);
            let contact = asperity::Contact::clone(&contact.contact);
            let layers = layers.map(|(row, interfaces)| CutLayers { row, interfaces });
            Ok(Arc::new(State::from_parts(contact, (point, claim), number, fields).with_layers(layers)))
        };
        let states = contacts.iter().zip(states).map(state).collect::<PyResult<Vec<_>>>()?;
        let Problem { problem, setup, rank, .. } = problem;
        let outcome = HistoryOutcome::from_states(&setup.setup, problem, states).map_err(py_error)?;
        let (outcome, setup, rank) = (Arc::new(outcome), setup.clone(), *rank);
        Py::new(contacts.py(), Self { contacts: contacts.clone().unbind(), setup, outcome, rank })
    }
}

/// The field of a name with its values.
pub fn named(name: &str, values: asperity::surface::Field) -> PyResult<StateField> {
    FieldKind::find(name)
        .map(|kind| StateField::new(kind, values))
        .ok_or_else(|| py_error(format!("there is no field {name:?} of histories")))
}
