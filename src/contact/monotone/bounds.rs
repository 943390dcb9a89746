//! Pressures between zero and a ceiling for each node, and their sum.

use crate::chunks;
use std::sync::Arc;

/// Rounds of the search for a factor or a shift.
const ROUNDS: usize = 200;

/// The part of a sum that may be lost by rounding.
const LOST: f64 = 1e-14;

/// The highest allowed pressure at each node.
#[derive(Debug, Clone)]
pub(crate) enum NodeCeilings {
    Uniform(f64),
    Field(Arc<[f64]>),
}

impl NodeCeilings {
    pub fn at(&self, node: usize) -> f64 {
        match self {
            Self::Uniform(ceiling) => *ceiling,
            Self::Field(ceilings) => ceilings[node],
        }
    }

    fn is_none(&self) -> bool {
        matches!(self, Self::Uniform(ceiling) if ceiling.is_infinite())
    }
}

/// Cuts values at zero and their ceilings.
pub(super) fn cut(values: &mut [f64], ceilings: &NodeCeilings) {
    chunks::update(values, |range, values| {
        range.zip(values).for_each(|(i, value)| *value = value.max(0.0).min(ceilings.at(i)));
    });
}

/// Makes values between the bounds have the sum `load`. Those at their ceilings stay, and the others are multiplied by one factor and
/// cut; if this is not enough, all rise by the same part of the room up to their ceilings, or fall by one factor.
pub(super) fn carry(values: &mut [f64], ceilings: &NodeCeilings, load: f64) {
    let sum_of =
        |values: &[f64], term: &(dyn Fn(usize, f64) -> f64 + Sync)| chunks::sum(values.len(), |i| term(i, values[i]));
    if ceilings.is_none() {
        let sum = sum_of(values, &|_, p| p);
        let (scale, uniform) = if sum > 0.0 { (load / sum, 0.0) } else { (0.0, load / values.len() as f64) };
        chunks::update(values, |_, values| values.iter_mut().for_each(|p| *p = scale * *p + uniform));
        return;
    }
    let mut scale = 0.0;
    for _ in 0..ROUNDS {
        // the sum of the values that are scaled and cut is concave in the factor, which rises from round to round
        let is_cut = |i: usize, p: f64| p >= ceilings.at(i) || scale * p >= ceilings.at(i);
        let free = sum_of(values, &|i, p| if is_cut(i, p) { 0.0 } else { p });
        let fixed = sum_of(values, &|i, p| if is_cut(i, p) { ceilings.at(i) } else { 0.0 });
        let next = (load - fixed) / free;
        if !(next.is_finite() && next > scale) {
            break;
        }
        scale = next;
    }
    if scale > 0.0 {
        chunks::update(values, |range, values| {
            for (i, p) in range.zip(values) {
                *p = if *p >= ceilings.at(i) { ceilings.at(i) } else { (scale * *p).min(ceilings.at(i)) };
            }
        });
    }
    let sum = sum_of(values, &|_, p| p);
    if (load - sum).abs() <= LOST * load {
        return;
    }
    let room = sum_of(values, &|i, p| ceilings.at(i) - p);
    let share = ((load - sum) / room).clamp(0.0, 1.0);
    let fall = (load / sum).min(1.0);
    chunks::update(values, |range, values| {
        for (i, p) in range.zip(values) {
            *p = if share > 0.0 { (*p + share * (ceilings.at(i) - *p)).min(ceilings.at(i)) } else { fall * *p };
        }
    });
}

/// The nearest values between the bounds, with the sum `load` if it is given: all are shifted alike and cut. The sum falls with the shift
/// in straight pieces, so that Newton's steps within a bracket find the piece.
pub(super) fn nearest(values: &mut [f64], ceilings: &NodeCeilings, load: Option<f64>) {
    let Some(load) = load else { return cut(values, ceilings) };
    let at = |values: &[f64], shift: f64| {
        let parts = chunks::visit(values.len(), |range| {
            range.fold((0.0, 0usize), |(sum, inside), i| {
                let p = (values[i] - shift).clamp(0.0, ceilings.at(i));
                (sum + p, inside + usize::from(p > 0.0 && p < ceilings.at(i)))
            })
        });
        parts.into_iter().fold((0.0, 0), |(sum, inside), (s, i)| (sum + s, inside + i))
    };
    let ends = chunks::visit(values.len(), |range| {
        range.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], i| {
            [low.min(values[i] - ceilings.at(i).min(load)), high.max(values[i])]
        })
    });
    let [mut low, mut high] =
        ends.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], [low, high]| [l.min(low), h.max(high)]);
    let mut shift = 0.0f64.clamp(low, high);
    for _ in 0..ROUNDS {
        let (sum, inside) = at(values, shift);
        if (sum - load).abs() <= f64::EPSILON * load {
            break;
        }
        if sum > load {
            low = shift
        } else {
            high = shift
        }
        let next = shift + (sum - load) / inside as f64;
        shift = if next > low && next < high { next } else { 0.5 * (low + high) };
    }
    chunks::update(values, |range, values| {
        range.zip(values).for_each(|(i, p)| *p = (*p - shift).clamp(0.0, ceilings.at(i)));
    });
    carry(values, ceilings, load);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(ceilings: &[f64]) -> NodeCeilings {
        NodeCeilings::Field(ceilings.into())
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
        nearest(&mut values, &NodeCeilings::Uniform(f64::INFINITY), Some(3.5));
        assert!(values.iter().zip([2.0, 0.0, 0.0, 1.5]).all(|(p, q)| (p - q).abs() < 1e-14), "{values:?}");
    }
}
