//! Copies, comparisons and pickles of contacts.

use crate::arrays::{ArrayLike, field, view};
use crate::certificate::{Certificate, Work};
use crate::contact::Contact;
use crate::error::{bail, py_error};
use crate::problem::Problem;
use asperity::contact::{Friction, PartialSlip, Quantity, Resolved, StateValues, Status};
use asperity::setup::Drive;
use numpy::PyArrayDyn;
use pyo3::prelude::*;

/// The values that make a contact again: fields, certificate and work, status, solver and the diagnosis, the state on the next coarser grid,
/// under friction its coefficient, the tangential load, the ratio of it to the load at which all slides, and the stick contact, and of a state of
/// a history its numbers and load.
type ContactParts<'py> = (
    Problem,
    [Bound<'py, PyArrayDyn<f64>>; 3],
    (Certificate, Work),
    ([String; 2], Option<String>),
    Option<([f64; 4], [usize; 2])>,
    Option<([f64; 3], Contact)>,
    Option<(Vec<(String, f64)>, String)>,
);

impl PartialEq for Contact {
    fn eq(&self, other: &Self) -> bool {
        let (one, two) = (&self.contact, &other.contact);
        let has_same_fields =
            one.pressure == two.pressure && one.gap == two.gap && one.displacement == two.displacement;
        has_same_fields && self.setup == other.setup && self.surface == other.surface && has_same_numbers(one, two)
    }
}

#[pymethods]
impl Contact {
    fn __eq__(&self, other: &Self) -> bool {
        self == other
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(slf: Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, ContactParts<'py>)> {
        let it = slf.get();
        let Self { contact, rank, .. } = it;
        if contact.problem.surface() != &it.surface {
            return bail(
                "this contact lies on a surface that has yielded under a higher load, which a pickle does not hold: save it in place of \
                 pickling it",
            );
        }
        let fields = [&contact.pressure, &contact.displacement, &contact.gap];
        let fields = fields.map(|field| view(field, *rank, slf.clone().into_any()));
        let coarser = contact.coarser.map(|it| {
            (
                [it.relative_area, it.rms_gradient_contact, it.kappa_r, it.reduced_pressure_contact],
                [it.edges, it.edges_of_shape],
            )
        });
        let slip = it.slip.as_ref().map(|slip| {
            let Friction { coefficient, tangential } = slip.friction;
            ([coefficient, tangential, slip.ratio], it.stick(slip))
        });
        let words = [contact.status.name().to_owned(), contact.solver.clone()];
        let numbers = (Certificate(contact.certificate), Work(contact.work));
        let load = contact.problem.load();
        let numbers_of_state = || {
            let named = contact.values().numbers().iter();
            named.map(|(quantity, value)| (quantity.name().to_owned(), *value)).collect::<Vec<_>>()
        };
        let state = it
            .is_of_history
            .then(|| Ok::<_, PyErr>((numbers_of_state(), serde_json::to_string(&load).map_err(py_error)?)));
        let words = (words, it.diagnosis.clone());
        let parts = (it.py_problem(), fields, numbers, words, coarser, slip, state.transpose()?);
        Ok((slf.get_type().getattr("_from_parts")?, parts))
    }

    /// The contact that the values of a pickle describe.
    #[staticmethod]
    fn _from_parts(
        problem: &Problem,
        fields: [ArrayLike<'_>; 3],
        numbers: (Certificate, Work),
        words: ([String; 2], Option<String>),
        coarser: Option<([f64; 4], [usize; 2])>,
        slip: Option<([f64; 3], Bound<'_, Self>)>,
        state: Option<(Vec<(String, f64)>, String)>,
    ) -> PyResult<Self> {
        let [pressure, displacement, gap] = &fields;
        let fields = [field(pressure)?, field(displacement)?, field(gap)?];
        let (Certificate(certificate), Work(work)) = numbers;
        let ([status, solver], diagnosis) = words;
        let status: Status = serde_json::from_value(status.into()).map_err(py_error)?;
        let coarser =
            coarser.map(|([relative_area, rms_gradient_contact, kappa_r, last], [edges, edges_of_shape])| Resolved {
                relative_area,
                rms_gradient_contact,
                kappa_r,
                reduced_pressure_contact: last,
                edges,
                edges_of_shape,
                edge_error: 0.0,
            });
        let Problem { problem, surface, setup, rank, preparation } = problem;
        let preparation = preparation.clone();
        // the load of a state is not that of its history; a state without a load keeps the one of the problem
        let of_state =
            state.as_ref().and_then(|(_, load)| problem.clone().with_load(serde_json::from_str(load).ok()?).ok());
        let contact = asperity::Contact::from_parts(
            of_state.unwrap_or_else(|| problem.clone()),
            fields,
            (certificate, work, status),
            solver,
            coarser,
        );
        let contact = contact.map_err(py_error)?;
        let is_of_history = state.is_some();
        let contact = match (state, setup.setup.drive().map_err(py_error)?) {
            (Some((numbers, _)), Some(drive)) => contact.with_values(values(drive, &numbers)),
            _ => contact,
        };
        let slip = slip.map(|([coefficient, tangential, ratio], stick)| PartialSlip {
            friction: Friction { coefficient, tangential },
            ratio,
            pressed: contact.clone(),
            stuck: asperity::Contact::clone(&stick.get().contact),
        });
        Ok(Self {
            diagnosis,
            slip,
            is_of_history,
            preparation,
            ..Self::new(contact, surface.clone(), setup.setup.clone(), *rank)
        })
    }
}

/// Whether the processes of two states have given the same numbers to the last bit, so that a number that is not a number is the same as another one.
fn has_same_numbers(one: &asperity::Contact, two: &asperity::Contact) -> bool {
    let bits = |it: &asperity::Contact| -> Vec<(Quantity, u64)> {
        let mut bits: Vec<_> = it.values().numbers().iter().map(|(it, value)| (*it, value.to_bits())).collect();
        bits.sort_unstable();
        bits
    };
    one.values().feels == two.values().feels && bits(one) == bits(two)
}

/// The numbers that a process has given for a state.
fn values(drive: &Drive, numbers: &[(String, f64)]) -> StateValues {
    let known = numbers.iter().filter_map(|(name, value)| Some((Quantity::find(name)?, *value)));
    known.fold(StateValues::new(drive.feels), |values, (quantity, value)| values.with(quantity, value))
}
