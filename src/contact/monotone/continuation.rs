//! A way to the contact of a solid that creeps much.
//!
//! Where the creep `f` is large and the retardation time is that in which a wave passes, the skew part of the compliance is about
//! `sqrt(f)/2` times as large as its symmetric part, and updates of whole sets wander about. So the compliance is made larger by that of
//! an elastic solid, `rho (1 + f) A`, and the heights by what it displaces under the last pressure. Solution after solution `rho` falls to
//! zero. These are proximal steps (Rockafellar, SIAM J. Control Optim. 14, 877 (1976)): without error in any of them, each comes nearer
//! to the solution, for every monotone operator.

use super::sets::SetIteration;
use crate::contact::{Certificate, Problem};
use crate::elastic::Response;
use crate::surface::Field;

/// The parts `rho`, from solution to solution.
const PARTS: [f64; 8] = [1.0, 0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4];

/// Each proximal step is solved until its certificate is below the tolerance and below this part of the certificate of the start, or for
/// this number of updates.
const TOLERANCE: f64 = 1e-4;
const REDUCTION: f64 = 0.03;
const UPDATES: usize = 60;

/// The pressure after all proximal steps from a pressure whose certificate is `eta`, and the transforms that they took. None for a problem
/// whose solid does not creep.
pub(super) fn approach(problem: &Problem, mut pressure: Vec<f64>, eta: f64) -> Option<(Vec<f64>, u64)> {
    let creep = problem.compliance().creep()?;
    let mut at_rest = Response::new(problem.surface().grid(), problem.solid().clone()).ok()?;
    let (mut transforms, goal) = (0, TOLERANCE.min(REDUCTION * eta));
    let mut displacement = vec![0.0; pressure.len()];
    for part in PARTS.into_iter().filter(|part| part * (1.0 + creep) > 0.01) {
        let extra = part * (1.0 + creep);
        at_rest.displacement(&pressure, &mut displacement);
        let shape = problem.surface().grid().shape();
        let heights = problem.height().iter().zip(&displacement).map(|(h, u)| h + extra * u).collect();
        let height = Field::from_shape_vec(shape, heights).ok()?;
        let softer = problem.clone().with_compliance(problem.compliance().softened(extra).ok()?).ok()?;
        let posed = softer.with_heights(height).ok()?;
        let mut state = SetIteration::from_problem(&posed, pressure);
        let mut best = (f64::INFINITY, Vec::new());
        for _ in 0..UPDATES {
            let eta = Certificate::from_displacement(&posed, &state.p, &state.u).eta;
            if eta < best.0 {
                best = (eta, state.p.clone());
            }
            if eta <= goal || state.is_stale() {
                break;
            }
            state.advance(eta, &mut |_| true);
        }
        transforms += state.transforms();
        pressure = if best.1.is_empty() { state.p } else { best.1 };
    }
    Some((pressure, transforms + at_rest.transforms()))
}
