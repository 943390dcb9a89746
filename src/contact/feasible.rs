//! Pressures between zero and a ceiling, with a given load.
//!
//! A pressure that lies at the ceiling to the last bit yields; one that lies there but is free to fall is [`f64::next_down`] of it.

use crate::chunks;
use crate::contact::Ceiling;

/// Rounds of scaling, each of which brings more nodes to the ceiling, and of the search for a shift.
const ROUNDS: usize = 100;

/// Fraction of a load that may be lost by rounding.
const LOST: f64 = 1e-14;

/// Makes pressures carry `load`, which is their sum, between zero and `ceiling`, whose nodes are the values, if they can carry it. Values at the
/// ceiling stay, all others are scaled by one factor and cut: those that were above it at the ceiling, the rest just below. If
/// this is not enough, all values decrease by the same factor, or rise by the same fraction of the room up to the ceiling.
/// Returns the factor if all values have been scaled by the same one.
pub(super) fn carry(values: &mut [f64], load: f64, ceiling: &Ceiling) -> Option<f64> {
    let stays = |i: usize, p: f64| p == ceiling.below(i) || p == ceiling.at(i);
    let mut scale = 0.0;
    for round in 0..ROUNDS {
        // the sum of the scaled values is concave, so that the factor rises from round to round
        let is_cut = |i: usize, p: f64| stays(i, p) || scale * p > ceiling.below(i);
        let free = sum(values, |i, p| if is_cut(i, p) { 0.0 } else { p });
        let fixed = sum(values, |i, p| if is_cut(i, p) { ceiling.at(i) } else { 0.0 });
        let next = (load - fixed) / free;
        if !(next.is_finite() && next > 0.0) {
            break;
        }
        if round > 0 && next <= scale {
            let most = |i: usize, p: f64| if p > ceiling.at(i) { ceiling.at(i) } else { ceiling.below(i) };
            let scaled = |i: usize, p: f64| if stays(i, p) { p } else { (scale * p).min(most(i, p)) };
            each(values, scaled);
            return (fixed == 0.0).then_some(scale);
        }
        scale = next;
    }
    each(values, |i, p| p.min(ceiling.at(i)));
    let (carried, most) = (sum(values, |_, p| p), ceiling.total(values.len()));
    if (load - carried).abs() <= LOST * load {
        return None;
    }
    let share = ((load - carried) / (most - carried)).min(1.0);
    let raised = |i: usize, p: f64| (p + share * (ceiling.at(i) - p)).min(ceiling.at(i));
    each(values, |i, p| if load < carried { p * (load / carried) } else { raised(i, p) });
    None
}

/// The nearest values between zero and `ceiling` whose sum is `load`: `min(max(value - theta, 0), ceiling)`. The sum falls with
/// `theta`, in straight pieces, so Newton's steps within a bracket find the piece and end.
pub(super) fn nearest(mut values: Vec<f64>, load: f64, ceiling: &Ceiling) -> Vec<f64> {
    // all nodes are at their ceilings for the lowest `theta`, and carry nothing for the highest
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut theta = f64::NEG_INFINITY;
    for (i, &value) in values.iter().enumerate() {
        (low, high) = (low.min(value - ceiling.at(i)), high.max(value));
        theta = theta.max(value - ceiling.at(i));
    }
    for _ in 0..ROUNDS {
        let (carried, count) = shifted(&values, theta, ceiling);
        if (carried - load).abs() <= f64::EPSILON * load {
            break;
        }
        if carried > load {
            low = theta
        } else {
            high = theta
        }
        let next = theta + (carried - load) / count as f64;
        theta = if next > low && next < high { next } else { 0.5 * (low + high) };
    }
    each(&mut values, |i, v| (v - theta).clamp(0.0, ceiling.at(i)));
    carry(&mut values, load, ceiling);
    values
}

/// The sum of the shifted values, and how many lie between the bounds.
fn shifted(values: &[f64], theta: f64, ceiling: &Ceiling) -> (f64, usize) {
    let parts = chunks::visit(values.len(), |range| {
        range.fold((0.0, 0), |(sum, count), i| {
            let p = (values[i] - theta).clamp(0.0, ceiling.at(i));
            (sum + p, count + usize::from(p > 0.0 && p < ceiling.at(i)))
        })
    });
    parts.into_iter().fold((0.0, 0), |(sum, count), (s, c)| (sum + s, count + c))
}

fn sum(values: &[f64], of: impl Fn(usize, f64) -> f64 + Sync) -> f64 {
    chunks::sum(values.len(), |i| of(i, values[i]))
}

/// Replaces each value by that of `of`.
fn each(values: &mut [f64], of: impl Fn(usize, f64) -> f64 + Sync) {
    chunks::update(values, |range, values| range.zip(values).for_each(|(i, value)| *value = of(i, *value)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pressures_are_scaled_below_the_ceiling_and_those_at_it_stay() {
        let mut values = [2.0, 1.0, 0.5, 0.0];
        carry(&mut values, 4.0, &Ceiling::Uniform(2.0));
        assert!((values[1] - 4.0 / 3.0).abs() < 1e-15 && values[0] == 2.0 && values[3] == 0.0);
        // one of them would rise above the ceiling: it stops just below
        carry(&mut values, 5.9, &Ceiling::Uniform(2.0));
        assert_eq!((values[0], values[1]), (2.0, 2f64.next_down()));
        assert!((values.iter().sum::<f64>() - 5.9).abs() < 1e-14);
    }

    #[test]
    fn what_scaling_cannot_carry_is_spread() {
        for (mut values, load) in
            [([2.0, 2.0, 2.0, 0.0], 3.0), ([2.0, 0.0, 0.0, 0.0], 3.0), ([2.0, 2.0, 1.0, 0.0], 8.0)]
        {
            carry(&mut values, load, &Ceiling::Uniform(2.0));
            assert!((values.iter().sum::<f64>() - load).abs() < 1e-14, "{values:?}");
            assert!(values.iter().all(|p| (0.0..=2.0).contains(p)));
        }
    }

    /// The angle at the nearest point of a convex set, between the outside point and any other point of the set, is
    /// obtuse.
    #[test]
    fn the_nearest_pressure_is_no_farther_than_any_other() {
        let noise = |i: usize| (i as f64 * 78.233).sin() * 43758.5453 % 1.0;
        let values: Vec<f64> = (0..200).map(|i| 3.0 * noise(i)).collect();
        let uneven: Vec<f64> = (0..200).map(|i| if i % 3 == 0 { 0.0 } else { 2.0 + noise(i) }).collect();
        let uniform = [(30.0, 0.2), (30.0, 1.0), (199.0, 1.0), (1e-3, 1.0), (200.0, 1.0), (30.0, 1e6)];
        let uniform = uniform.map(|(load, ceiling)| (load, Ceiling::Uniform(ceiling)));
        let uneven = [1e-3, 30.0, 200.0].map(|load| (load, Ceiling::Field(uneven.clone().into())));
        for (load, ceiling) in uniform.iter().chain(&uneven) {
            let near = nearest(values.clone(), *load, ceiling);
            assert!(
                (near.iter().sum::<f64>() / load - 1.0).abs() < 1e-13
                    && near.iter().enumerate().all(|(i, p)| (0.0..=ceiling.at(i)).contains(p))
            );
            for shift in 1..50 {
                let other = nearest((0..200).map(|i| noise(i * shift + 7)).collect(), *load, ceiling);
                let angle: f64 = (0..200).map(|i| (values[i] - near[i]) * (other[i] - near[i])).sum();
                assert!(angle <= 1e-9 * load, "{angle}");
            }
        }
    }
}
