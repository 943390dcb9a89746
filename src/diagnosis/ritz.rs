//! Ritz values from the coefficients of conjugate gradients.

use crate::contact::Decision;

/// Halvings of an interval that holds an extreme value: to six digits.
const HALVINGS: usize = 24;

/// The extreme Ritz values of a run of conjugate gradients, which follow from its coefficients without further work.
///
/// With step lengths `alpha` and shares `beta`, the tridiagonal matrix of Lanczos has `1 / alpha_j + beta_j /
/// alpha_(j-1)` on its diagonal and `sqrt(beta_j) / alpha_(j-1)` beside it. Its extreme eigenvalues approach those of
/// the (preconditioned) operator on the contact set from inside, so their ratio is a lower bound of the condition
/// number of conjugate gradients.
///
/// A run ends where the directions begin anew, and where the contact set changes, since then the operator does. What stands before
/// the first step of a run is taken for nothing: where a set changed without a new beginning the first values are approximate.
///
/// # Source
/// Saad, *Iterative Methods for Sparse Linear Systems* (2003), section 6.7.3.
#[derive(Debug, Clone, Default)]
pub struct Ritz {
    diagonal: Vec<f64>,
    /// Beside the diagonal, one shorter than it.
    beside: Vec<f64>,
    last_length: f64,
    ends: Option<[f64; 2]>,
}

impl Ritz {
    /// Adds what a solver decided, and returns the smallest and the largest Ritz value of the run so far, if it is one of conjugate
    /// gradients.
    pub fn add(&mut self, decision: Option<Decision>) -> Option<[f64; 2]> {
        match decision {
            Some(Decision::Conjugate { length, share }) if length > 0.0 && share >= 0.0 => self.extend(length, share),
            _ => *self = Self::default(),
        }
        self.ends
    }

    fn extend(&mut self, length: f64, share: f64) {
        if share == 0.0 || self.diagonal.is_empty() {
            *self = Self { diagonal: vec![1.0 / length], last_length: length, ..Self::default() };
            self.ends = Some([1.0 / length; 2]);
            return;
        }
        self.diagonal.push(1.0 / length + share / self.last_length);
        self.beside.push(share.sqrt() / self.last_length);
        self.last_length = length;
        self.ends = self.ends.map(|[low, high]| {
            let most = (0..self.diagonal.len()).map(|row| self.diagonal[row] + self.reach(row)).fold(high, f64::max);
            let count = self.diagonal.len();
            // the number of values below the wanted end: none below the smallest, all but one below the largest
            [self.bisect(0.0, low, 1), self.bisect(high, most, count)]
        });
    }

    /// Sum of what stands beside the diagonal in a row.
    fn reach(&self, row: usize) -> f64 {
        let beside = |i: Option<usize>| i.and_then(|i| self.beside.get(i)).copied().unwrap_or(0.0);
        beside(row.checked_sub(1)) + beside(Some(row))
    }

    /// The value with `number - 1` smaller ones, between two bounds.
    fn bisect(&self, mut low: f64, mut high: f64, number: usize) -> f64 {
        for _ in 0..HALVINGS {
            let middle = if low > 0.0 { (low * high).sqrt() } else { low.midpoint(high) };
            if self.smaller(middle) >= number { high = middle } else { low = middle }
        }
        high
    }

    /// Number of eigenvalues below `value`, by the signs of Sturm's sequence.
    fn smaller(&self, value: f64) -> usize {
        let mut pivot = 1.0;
        let mut count = 0;
        for (row, diagonal) in self.diagonal.iter().enumerate() {
            let beside = row.checked_sub(1).map_or(0.0, |i| self.beside[i]);
            pivot = diagonal - value - beside * beside / pivot;
            if pivot == 0.0 {
                pivot = f64::MIN_POSITIVE;
            }
            count += usize::from(pivot < 0.0);
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Conjugate gradients on a diagonal matrix, whose eigenvalues are known: after as many steps as it has values, the Ritz values
    /// are the eigenvalues.
    #[test]
    fn ritz_values_become_eigenvalues() {
        let values = [0.03, 0.2, 0.9, 1.7, 5.0, 40.0];
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let (mut residual, mut direction) = (vec![1.0; 6], vec![0.0; 6]);
        let mut square = 0.0;
        let (mut ritz, mut found) = (Ritz::default(), Vec::new());
        for step in 0..6 {
            let next = dot(&residual, &residual);
            let share = if step == 0 { 0.0 } else { next / square };
            square = next;
            direction.iter_mut().zip(&residual).for_each(|(d, r)| *d = r + share * *d);
            let effect: Vec<f64> = direction.iter().zip(values).map(|(d, value)| d * value).collect();
            let length = square / dot(&direction, &effect);
            residual.iter_mut().zip(&effect).for_each(|(r, e)| *r -= length * e);
            found.extend(ritz.add(Some(Decision::Conjugate { length, share })));
        }
        assert!(
            found.windows(2).all(|pair| pair[1][0] <= pair[0][0] * 1.0001 && pair[1][1] >= pair[0][1] * 0.9999),
            "{found:?}"
        );
        let [low, high] = found[5];
        assert!((low / 0.03 - 1.0).abs() < 1e-4 && (high / 40.0 - 1.0).abs() < 1e-4, "{found:?}");
        assert_eq!(ritz.add(Some(Decision::Exchange)), None);
        assert_eq!(ritz.add(Some(Decision::Conjugate { length: 0.5, share: 0.3 })), Some([2.0, 2.0]));
    }
}
