//! Contact patches as arrays.

use crate::arrays::vector;
use crate::detached::Detached;
use asperity::contact::{Patch, PatchHistory, TrackedPatch};
use asperity::setup::Setup;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A number of a patch.
type PatchColumn<T> = fn(&T) -> f64;

/// A count of a patch.
type PatchCount<T> = fn(&T) -> usize;

/// A table of arrays by name.
fn table<'py, T>(
    py: Python<'py>,
    rows: &[T],
    counts: &[(&str, PatchCount<T>)],
    columns: &[(&str, PatchColumn<T>)],
) -> PyResult<Bound<'py, PyDict>> {
    let table = PyDict::new(py);
    for (name, of) in counts {
        table.set_item(name, PyArray1::from_iter(py, rows.iter().map(|row| of(row) as i64)))?;
    }
    columns.iter().try_for_each(|(name, of)| table.set_item(name, vector(py, rows.iter().map(of).collect())))?;
    Ok(table)
}

/// The patches of one contact.
pub fn of_contact<'py>(py: Python<'py>, contact: &asperity::Contact, setup: &Setup) -> PyResult<Bound<'py, PyDict>> {
    let patches = py.detached(|| {
        let (problem, pressure) = (&contact.problem, contact.pressure.as_slice().unwrap_or_default());
        let own = setup.surface.own_shape(problem.surface().grid().shape());
        Patch::within(problem, pressure, own).into_iter().map(|(patch, _)| patch).collect::<Vec<_>>()
    })?;
    table(
        py,
        &patches,
        &[("nodes", |it| it.nodes), ("peak", |it| it.peak)],
        &[
            ("area", |it| it.area),
            ("load", |it| it.load),
            ("kappa_r", |it| it.kappa_r),
            ("curvature", |it| it.curvature),
            ("x", |it| it.centre[1]),
            ("y", |it| it.centre[0]),
        ],
    )
}

/// The patches of all states, with the numbers that they keep.
pub fn of_states<'py>(py: Python<'py>, history: &PatchHistory) -> PyResult<Bound<'py, PyDict>> {
    let rows: Vec<TrackedPatch> = history.rows();
    table(
        py,
        &rows,
        &[("state", |it| it.state - 1), ("patch", |it| it.patch), ("nodes", |it| it.nodes)],
        &[
            ("area", |it| it.area),
            ("load", |it| it.load),
            ("load_share", |it| it.load_share),
            ("kappa_r", |it| it.kappa_r),
            ("x", |it| it.x),
            ("y", |it| it.y),
        ],
    )
}

/// An event: the index of the state, what happened, the patch and the other one.
pub type PatchEventRow = (usize, &'static str, usize, Option<usize>);

/// What happened to the patches from state to state.
pub fn events(history: PatchHistory) -> Vec<PatchEventRow> {
    history.events.into_iter().map(|it| (it.state - 1, <&'static str>::from(it.event), it.patch, it.other)).collect()
}
