//! The least curvature of the energy of a state: whether it is stable.

use super::gap_energy::{GapEnergy, GapState};
use super::newton::{OpenNodes, dot, norm};

/// Most products with the curvature.
const PRODUCTS: usize = 60;

/// The residual of an eigenvalue, over the larger of its magnitude and a part of the softest stiffness, at which it is found.
const RESIDUAL: f64 = 0.05;
const SMALL: f64 = 0.01;

/// An estimate of the least eigenvalue of `K + V''` on the nodes that do not touch, and a vector that belongs to it. At a given mean gap
/// only changes with the sum zero count.
pub(super) struct LeastCurvature {
    /// The eigenvalue, a pressure per length. It is never below the true one, so a negative one proves a saddle.
    pub value: f64,
    pub vector: Vec<f64>,
}

/// Finds the least curvature by the locally optimal conjugate gradients of Knyazev, SIAM J. Sci. Comput. 23, 517 (2001), with one vector:
/// the least Rayleigh quotient of the vector, its preconditioned residual and the last step.
pub(super) fn least_curvature(energy: &mut GapEnergy<'_>, state: &GapState) -> Option<LeastCurvature> {
    let n = state.gap.len();
    let open = OpenNodes::new(energy, state);
    if open.count() <= usize::from(energy.keeps_mean()) {
        return None;
    }
    // the attraction bends the energy down where it is steep; so begin there
    let mut x: Vec<f64> = (0..n)
        .map(|i| 1e-3 + (1e-3 * (i % 7) as f64) - energy.attraction.slope(state.gap[i]) / energy.softest())
        .collect();
    open.project(&mut x);
    let mut better = vec![0.0; n];
    energy.precondition(&x.clone(), &mut better);
    open.project(&mut better);
    let size = norm(&better);
    if !(size > 0.0 && size.is_finite()) {
        return None;
    }
    x = better.iter().map(|x| x / size).collect();
    let mut image = vec![0.0; n];
    open.curved(energy, state, &x, &mut image);
    let mut basis: Vec<[Vec<f64>; 2]> = vec![[x, image]];
    let mut value = dot(&basis[0][0], &basis[0][1]);
    for _ in 0..PRODUCTS {
        let [x, image] = &basis[0];
        let residual: Vec<f64> = image.iter().zip(x).map(|(a, x)| a - value * x).collect();
        if norm(&residual) <= RESIDUAL * value.abs().max(SMALL * energy.softest()) {
            break;
        }
        let mut better = vec![0.0; n];
        energy.precondition(&residual, &mut better);
        open.project(&mut better);
        orthogonalise(&mut better, &basis);
        let size = norm(&better);
        if !(size > 0.0 && size.is_finite()) {
            break;
        }
        better.iter_mut().for_each(|z| *z /= size);
        let mut image = vec![0.0; n];
        open.curved(energy, state, &better, &mut image);
        basis.push([better, image]);
        let weights = least_of(&basis);
        value = weights.0;
        let combined = |from: usize| -> [Vec<f64>; 2] {
            [0, 1].map(|part| {
                (0..n).map(|i| (from..basis.len()).map(|b| weights.1[b] * basis[b][part][i]).sum()).collect()
            })
        };
        let mut next = combined(0);
        let size = norm(&next[0]);
        next.iter_mut().for_each(|part| part.iter_mut().for_each(|x| *x /= size));
        // what was added to the last vector is the direction of the next round, less its part along the vector
        let mut step = combined(1);
        let along = dot(&step[0], &next[0]);
        for (step, next) in step.iter_mut().zip(&next) {
            step.iter_mut().zip(next).for_each(|(s, x)| *s -= along * x);
        }
        let size = norm(&step[0]);
        basis = vec![next];
        if size > 1e-8 {
            step.iter_mut().for_each(|part| part.iter_mut().for_each(|x| *x /= size));
            basis.push(step);
        }
    }
    let [vector, _] = basis.swap_remove(0);
    Some(LeastCurvature { value, vector })
}

/// Takes off the parts along vectors of the length one that are perpendicular to each other, twice because of rounding.
fn orthogonalise(x: &mut [f64], basis: &[[Vec<f64>; 2]]) {
    for _ in 0..2 {
        for [vector, _] in basis {
            let along = dot(x, vector);
            x.iter_mut().zip(vector).for_each(|(x, v)| *x -= along * v);
        }
    }
}

/// The least eigenvalue of the curvature in a basis of at most three vectors, and its weights.
fn least_of(basis: &[[Vec<f64>; 2]]) -> (f64, [f64; 3]) {
    let mut a = [[0.0; 3]; 3];
    for i in 0..basis.len() {
        for j in 0..=i {
            a[i][j] = dot(&basis[i][0], &basis[j][1]);
            a[j][i] = a[i][j];
        }
    }
    let (values, vectors) = eigen(a, basis.len());
    let least = (0..basis.len()).min_by(|&i, &j| values[i].total_cmp(&values[j])).unwrap_or(0);
    (values[least], [0, 1, 2].map(|i| vectors[i][least]))
}

/// Eigenvalues and eigenvectors (as columns) of the leading part of a symmetric matrix, by Jacobi's rotations.
fn eigen(mut a: [[f64; 3]; 3], size: usize) -> ([f64; 3], [[f64; 3]; 3]) {
    let mut vectors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..20 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)].into_iter().filter(|(_, q)| *q < size) {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            for row in &mut a {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
            let (at_p, at_q) = (a[p], a[q]);
            for k in 0..3 {
                (a[p][k], a[q][k]) = (c * at_p[k] - s * at_q[k], s * at_p[k] + c * at_q[k]);
            }
            for row in &mut vectors {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
        }
    }
    ([a[0][0], a[1][1], a[2][2]], vectors)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvectors_of_small_matrices_are_found() {
        let a = [[2.0, -1.0, 0.5], [-1.0, 3.0, 0.25], [0.5, 0.25, -1.0]];
        for size in 1..=3 {
            let (values, vectors) = eigen(a, size);
            for k in 0..size {
                for i in 0..size {
                    let image: f64 = (0..size).map(|j| a[i][j] * vectors[j][k]).sum();
                    assert!((image - values[k] * vectors[i][k]).abs() < 1e-12);
                }
            }
        }
    }
}
