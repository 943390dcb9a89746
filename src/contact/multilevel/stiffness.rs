//! The stiffness of a contact.

use super::correction::{Correction, dot};
use super::operator::Spectral;
use super::support::SparsePressure;
use super::workspace::Workspace;
use crate::contact::Problem;

/// Reduction of the residual. The stiffness errs by the square of it.
const REDUCTION: f64 = 1e-2;

/// The contact stiffness `k = -d<p>/dD` of a pressure whose displacement is given, both row by row: a pressure per
/// length.
///
/// As the gap closes by `dD`, the nodes of the contact set `S` move down alike, `A_SS dp = dD`, and those at its edge, where
/// pressure and gap are zero, enter or leave at second order only. So `k = 1' A_SS^-1 1 / n`. It is found from
///
/// ```text
/// <p>^2 / k = min <x A x>    over x on S with <x> = <p>
/// ```
///
/// which starts from the pressure itself. Conjugate gradients approach the minimum from above, and `k` from below, with the square
/// of the error of `x`. Where all nodes touch and the cell is periodic, a uniform pressure displaces nothing, and the stiffness is infinite.
///
/// Below a hardness `S` are the free nodes only: those that yield carry what they carry. Their share of the
/// displacement is then subtracted with one more transform pair. Where no node is free, the stiffness is zero.
pub(in crate::contact) fn stiffness(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> f64 {
    let mut response = problem.response();
    let ceiling = problem.ceiling();
    let yields = |(i, p): (usize, &f64)| ceiling.yields(i, *p);
    let is_elastic = !ceiling.is_finite() || !pressure.iter().enumerate().any(yields);
    if is_elastic {
        return stiffness_on(problem, SparsePressure::from_field(pressure, response.rows()), displacement);
    }
    let free: Vec<f64> = pressure.iter().enumerate().map(|(i, &p)| if yields((i, &p)) { 0.0 } else { p }).collect();
    let mut displacement = vec![0.0; free.len()];
    response.displacement(&free, &mut displacement);
    let free = SparsePressure::from_field(&free, response.rows());
    if free.values.is_empty() { 0.0 } else { stiffness_on(problem, free, &displacement) }
}

/// The stiffness of the whole contact set, with the nodes that yield, as if all of them were elastic: `1' A_SS^-1 1 / n`.
pub(in crate::contact) fn stiffness_of_all(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> f64 {
    stiffness_on(problem, SparsePressure::from_field(pressure, problem.response().rows()), displacement)
}

/// The stiffness of the nodes under a pressure, from its displacement.
fn stiffness_on(problem: &Problem, SparsePressure { support, values }: SparsePressure, displacement: &[f64]) -> f64 {
    if values.len() == problem.nodes() && problem.surface().grid().is_periodic() {
        return f64::INFINITY;
    }
    let u = support.of_field(displacement);
    let mut operator = Spectral::<f64>::new(problem);
    let residual = u.iter().map(|u| -u).collect();
    let mut workspace = Workspace::new(u.len());
    let mut correction = Correction::new([&support; 2], residual, true, &mut operator, &mut workspace);
    correction.solve(REDUCTION, &mut operator, &mut |_, _| None);
    let load: f64 = values.iter().sum();
    // the residual is orthogonal to the correction
    load * load / (dot(&values, &u) + dot(&correction.delta, &u)) / problem.nodes() as f64
}
