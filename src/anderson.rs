//! Anderson's method for fixed points.

use crate::chunks;

/// Earlier points that one step combines.
const DEPTH: usize = 6;

/// Damping of the normal equations, relative to their largest diagonal entry.
const DAMPING: f64 = 1e-12;

/// Finds `x` with `f(x) = 0`, where `x + f(x)` is a convergent or nearly convergent iteration: Anderson, J. ACM 12, 547 (1965).
///
/// The next point combines the last ones such that their changes `f` cancel as far as they can, and adds the combined change.
#[derive(Default)]
pub(crate) struct Anderson {
    /// Points and their changes, from old to new.
    memory: Vec<[Vec<f64>; 2]>,
}

impl Anderson {
    /// Forgets all points, so that the next step is the plain one.
    pub(crate) fn clear(&mut self) {
        self.memory.clear();
    }

    /// Lengthens all points by values that have been zero so far and did not change.
    pub(crate) fn lengthen(&mut self, len: usize) {
        self.memory.iter_mut().flatten().for_each(|values| values.resize(len, 0.0));
    }

    /// Whether a step combined several points.
    pub(crate) fn is_combined(&self) -> bool {
        self.memory.len() > 1
    }

    /// The point after `point`, from which the iteration moves by `change`: with the part `pace` of the combined change.
    pub(crate) fn next(&mut self, point: Vec<f64>, change: Vec<f64>, pace: f64) -> Vec<f64> {
        if self.memory.len() == DEPTH {
            self.memory.remove(0);
        }
        let weights = least_squares(&change, &self.memory);
        let corrected = |i: usize| {
            let corrections = self
                .memory
                .iter()
                .zip(&weights)
                .map(|([x, f], weight)| weight * ((x[i] - point[i]) + pace * (f[i] - change[i])));
            point[i] + pace * change[i] + corrections.sum::<f64>()
        };
        let next = (0..point.len()).map(corrected).collect();
        self.memory.push([point, change]);
        next
    }
}

/// The weights `c` with the least `|f + sum c_j (f_j - f)|`, by the normal equations with a little damping.
fn least_squares(change: &[f64], earlier: &[[Vec<f64>; 2]]) -> Vec<f64> {
    let size = earlier.len();
    let difference = |j: usize, i: usize| earlier[j][1][i] - change[i];
    let product = |a: usize, b: usize| chunks::sum(change.len(), |i| difference(a, i) * difference(b, i));
    let mut rows: Vec<Vec<f64>> = (0..size)
        .map(|a| {
            let right = -chunks::sum(change.len(), |i| difference(a, i) * change[i]);
            (0..size).map(|b| product(a, b)).chain([right]).collect()
        })
        .collect();
    let largest = (0..size).map(|a| rows[a][a]).fold(0.0, f64::max);
    (0..size).for_each(|a| rows[a][a] += DAMPING * largest);
    // elimination without exchange of rows: the matrix is symmetric and positive
    for a in 0..size {
        let pivot = rows[a].clone();
        for row in rows.iter_mut().skip(a + 1) {
            let factor = row[a] / pivot[a];
            if factor.is_finite() {
                row.iter_mut().zip(&pivot).skip(a).for_each(|(value, pivot)| *value -= factor * pivot);
            }
        }
    }
    let mut weights = vec![0.0; size];
    for a in (0..size).rev() {
        let rest: f64 = (a + 1..size).map(|b| rows[a][b] * weights[b]).sum();
        let weight = (rows[a][size] - rest) / rows[a][a];
        weights[a] = if weight.is_finite() { weight } else { 0.0 };
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Turning the plane by a right angle and stretching it by 3 never converges by itself. Of a linear map of the plane, three points
    /// tell all.
    #[test]
    fn a_divergent_spiral_is_solved_in_three_steps() {
        let (mut anderson, mut point) = (Anderson::default(), vec![4.0, -7.0]);
        for _ in 0..3 {
            let change = vec![1.0 - 3.0 * point[1] - point[0], 2.0 + 3.0 * point[0] - point[1]];
            point = anderson.next(point, change, 0.1);
        }
        // x = 1 - 3 y and y = 2 + 3 x
        assert!((point[0] + 0.5).abs() < 1e-6 && (point[1] - 0.5).abs() < 1e-6, "{point:?}");
        assert!(anderson.is_combined());
    }
}
