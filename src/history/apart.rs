//! A contact in which nothing touches.

use crate::contact::{Certificate, Contact, Problem, Status, Work};
use crate::surface::Field;

/// The certificate of no pressure where there is no contact: nothing is off.
const EXACT: Certificate = Certificate {
    eta: 0.0,
    eta_gap: 0.0,
    pressure_error_bound: 0.0,
    mean_gap_error_bound: 0.0,
    load_error: 0.0,
    min_pressure: 0.0,
    above_hardness: 0.0,
    penetration: 0.0,
    rounding: 0.0,
};

/// The contact without pressure above a displaced solid: at a datum, or where the highest point of it just touches.
pub(super) fn apart(problem: Problem, displacement: Field, work: Work, datum: Option<f64>) -> Contact {
    let height = problem.surface().height();
    let touch = || height.iter().zip(&displacement).fold(f64::NEG_INFINITY, |most, (h, u)| most.max(h - u));
    let datum = datum.unwrap_or_else(touch);
    let gap = &displacement - height + datum;
    let pressure = Field::zeros(height.dim());
    let parts = (EXACT, work, Status::Converged);
    Contact::from_parts(problem, [pressure, displacement, gap], parts, "none", None).expect("fields fit the grid")
}
