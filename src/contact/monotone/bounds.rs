//! Pressures between zero and the ceiling of each node, which may be infinite, and their sum.

use crate::chunks;
use crate::contact::{Ceiling, feasible};

/// Cuts values at zero and their ceilings.
pub(super) fn cut(values: &mut [f64], ceiling: &Ceiling) {
    chunks::update(values, |range, values| {
        range.zip(values).for_each(|(i, value)| *value = value.max(0.0).min(ceiling.at(i)));
    });
}

/// Makes values between the bounds have the sum `load`, see [`feasible::carry`]. Without a ceiling all are multiplied by one factor; if
/// all are zero, they become uniform.
pub(super) fn carry(values: &mut [f64], ceiling: &Ceiling, load: f64) {
    if ceiling.is_finite() {
        feasible::carry(values, load, ceiling);
        return;
    }
    let sum = chunks::sum(values.len(), |i| values[i]);
    let (scale, uniform) = if sum > 0.0 { (load / sum, 0.0) } else { (0.0, load / values.len() as f64) };
    chunks::update(values, |_, values| values.iter_mut().for_each(|p| *p = scale * *p + uniform));
}

/// The nearest values between the bounds, with the sum `load` if it is given.
pub(super) fn nearest(values: &mut Vec<f64>, ceiling: &Ceiling, load: Option<f64>) {
    let Some(load) = load else { return cut(values, ceiling) };
    // no node takes more than all together
    let most = if ceiling.is_finite() { ceiling.clone() } else { Ceiling::Uniform(load) };
    *values = feasible::nearest(std::mem::take(values), load, &most);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(ceilings: &[f64]) -> Ceiling {
        Ceiling::Field(ceilings.into())
    }

    #[test]
    fn values_carry_any_load_that_their_ceilings_bear() {
        let ceilings = field(&[2.0, 1.0, 0.0, 4.0]);
        for load in [1e-3, 1.0, 3.0, 6.9, 7.0] {
            for start in [[2.0, 0.5, 0.0, 1.0], [0.0, 1.0, 0.0, 0.0], [2.0, 1.0, 0.0, 4.0], [0.0; 4]] {
                for nearest_too in [false, true] {
                    let mut values = start.to_vec();
                    if nearest_too {
                        nearest(&mut values, &ceilings, Some(load));
                    } else {
                        carry(&mut values, &ceilings, load);
                    }
                    let sum: f64 = values.iter().sum();
                    assert!((sum / load - 1.0).abs() < 1e-12, "{start:?} {load}: {values:?}");
                    assert!(values.iter().enumerate().all(|(i, &p)| (0.0..=ceilings.at(i)).contains(&p)));
                }
            }
        }
    }

    #[test]
    fn the_nearest_values_are_shifted_alike() {
        let mut values = vec![3.0, 1.0, -1.0, 2.5];
        nearest(&mut values, &Ceiling::Uniform(f64::INFINITY), Some(3.5));
        assert!(values.iter().zip([2.0, 0.0, 0.0, 1.5]).all(|(p, q)| (p - q).abs() < 1e-14), "{values:?}");
    }
}
