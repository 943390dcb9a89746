//! How far a claim is from solving its problem.

use super::claim::{Claim, ClaimedState};
use super::tension::Tension;
use crate::contact::{Certificate, Problem};
use crate::surface::Field;

/// How far a claim is from solving its problem.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fault {
    /// The certificate of its pressure, made feasible.
    pub certificate: Certificate,
    /// The largest of what is wrong, each of first order in the error of the pressure: the bound of the latter in the energy norm, the share of tension, and how far
    /// the load is missed.
    pub size: f64,
    /// Nodes that the load is spread over, `(sum p)^2 / sum p^2`.
    pub nodes: f64,
}

impl Fault {
    /// The fault of a claim; none where its problem cannot be posed.
    pub(crate) fn from_claim(claim: &Claim) -> Option<Self> {
        claim.state().ok().map(|state| Self::from_state(&state))
    }

    pub(crate) fn from_state(state: &ClaimedState) -> Self {
        let tension = Tension::new(&state.pressure);
        let feasible = feasible(&state.problem, &state.pressure, &tension);
        let certificate = match &feasible {
            None => state.certificate(),
            Some(pressure) => state.with_pressure(pressure).certificate(),
        };
        let pressure = feasible.as_ref().unwrap_or(&state.pressure);
        let (sum, squares) = pressure.iter().fold((0.0, 0.0), |(sum, squares), p| (sum + p, squares + p * p));
        let size = certificate.pressure_error_bound.max(tension.share).max(load_error(state));
        Self { certificate, size: if size.is_nan() { f64::INFINITY } else { size }, nodes: sum * sum / squares }
    }
}

/// How far the load that is prescribed is missed by the pressure as it is: relative to it, or 0 at a mean gap, whose
/// error the certificate contains.
pub(super) fn load_error(state: &ClaimedState) -> f64 {
    let mean = state.pressure.iter().sum::<f64>() / state.pressure.len() as f64;
    state.problem.mean_pressure().map_or(0.0, |prescribed| (mean / prescribed - 1.0).abs())
}

/// The feasible pressure that stands in for one that is not: clipped, and scaled to the load that is prescribed.
pub(super) fn feasible(problem: &Problem, pressure: &[f64], tension: &Tension) -> Option<Vec<f64>> {
    let is_feasible = tension.nodes == 0 && pressure.iter().any(|&p| p > 0.0);
    let as_field = || Field::from_shape_vec(problem.surface().grid().shape(), pressure.to_vec());
    (!is_feasible).then(|| problem.first_pressure(as_field().ok().as_ref()))
}
