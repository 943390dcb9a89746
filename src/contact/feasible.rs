//! Pressures between zero and a ceiling, with a given load.
//!
//! A pressure that lies at the ceiling to the last bit yields; one that lies there but is free to fall is [`f64::next_down`] of it.

use crate::chunks;

/// Rounds of scaling, each of which brings more nodes to the ceiling, and of the search for a shift.
const ROUNDS: usize = 100;

/// Fraction of a load that may be lost by rounding.
const LOST: f64 = 1e-14;

/// Makes pressures carry `load`, which is their sum, between zero and `ceiling`, if the nodes can carry it. Values at the
/// ceiling stay, all others are scaled by one factor and cut: those that were above it at the ceiling, the rest just below. If
/// this is not enough, all values decrease by the same factor, or rise by the same fraction of the room up to the ceiling.
/// Returns the factor if all values have been scaled by the same one.
pub(super) fn carry(values: &mut [f64], load: f64, ceiling: f64) -> Option<f64> {
    let below = ceiling.next_down();
    let stays = |p: f64| p == below || p == ceiling;
    let mut scale = 0.0;
    for round in 0..ROUNDS {
        // the sum of the scaled values is concave, so that the factor rises from round to round
        let is_cut = |p: f64| stays(p) || scale * p > below;
        let free = sum(values, |p| if is_cut(p) { 0.0 } else { p });
        let fixed = sum(values, |p| if is_cut(p) { ceiling } else { 0.0 });
        let next = (load - fixed) / free;
        if !(next.is_finite() && next > 0.0) {
            break;
        }
        if round > 0 && next <= scale {
            let scaled = |p: f64| (scale * p).min(if p > ceiling { ceiling } else { below });
            chunks::update(values, |_, values| {
                values.iter_mut().filter(|p| !stays(**p)).for_each(|p| *p = scaled(*p));
            });
            return (fixed == 0.0).then_some(scale);
        }
        scale = next;
    }
    chunks::update(values, |_, values| values.iter_mut().for_each(|p| *p = p.min(ceiling)));
    let (carried, most) = (sum(values, |p| p), values.len() as f64 * ceiling);
    if (load - carried).abs() <= LOST * load {
        return None;
    }
    let share = ((load - carried) / (most - carried)).min(1.0);
    let make = |p: f64| if load < carried { p * (load / carried) } else { (p + share * (ceiling - p)).min(ceiling) };
    chunks::update(values, |_, values| values.iter_mut().for_each(|p| *p = make(*p)));
    None
}

/// The nearest values between zero and `ceiling` whose sum is `load`: `min(max(value - theta, 0), ceiling)`. The sum falls with
/// `theta`, in straight pieces, so Newton's steps within a bracket find the piece and end.
pub(super) fn nearest(mut values: Vec<f64>, load: f64, ceiling: f64) -> Vec<f64> {
    let extremes = |low: f64, high: f64, value: f64| (low.min(value), high.max(value));
    let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &v| extremes(low, high, v));
    let (mut low, mut high) = (low - ceiling, high);
    let mut theta = low.max(high - ceiling);
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
    chunks::update(&mut values, |_, values| values.iter_mut().for_each(|v| *v = (*v - theta).clamp(0.0, ceiling)));
    carry(&mut values, load, ceiling);
    values
}

/// The sum of the shifted values, and how many lie between the bounds.
fn shifted(values: &[f64], theta: f64, ceiling: f64) -> (f64, usize) {
    let parts = chunks::visit(values.len(), |range| {
        values[range].iter().fold((0.0, 0), |(sum, count), v| {
            let p = (v - theta).clamp(0.0, ceiling);
            (sum + p, count + usize::from(p > 0.0 && p < ceiling))
        })
    });
    parts.into_iter().fold((0.0, 0), |(sum, count), (s, c)| (sum + s, count + c))
}

fn sum(values: &[f64], of: impl Fn(f64) -> f64 + Sync) -> f64 {
    chunks::sum(values.len(), |i| of(values[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pressures_are_scaled_below_the_ceiling_and_those_at_it_stay() {
        let mut values = [2.0, 1.0, 0.5, 0.0];
        carry(&mut values, 4.0, 2.0);
        assert!((values[1] - 4.0 / 3.0).abs() < 1e-15 && values[0] == 2.0 && values[3] == 0.0);
        // one of them would rise above the ceiling: it stops just below
        carry(&mut values, 5.9, 2.0);
        assert_eq!((values[0], values[1]), (2.0, 2f64.next_down()));
        assert!((values.iter().sum::<f64>() - 5.9).abs() < 1e-14);
    }

    #[test]
    fn what_scaling_cannot_carry_is_spread() {
        for (mut values, load) in
            [([2.0, 2.0, 2.0, 0.0], 3.0), ([2.0, 0.0, 0.0, 0.0], 3.0), ([2.0, 2.0, 1.0, 0.0], 8.0)]
        {
            carry(&mut values, load, 2.0);
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
        for (load, ceiling) in [(30.0, 0.2), (30.0, 1.0), (199.0, 1.0), (1e-3, 1.0), (200.0, 1.0), (30.0, 1e6)] {
            let near = nearest(values.clone(), load, ceiling);
            assert!(
                (near.iter().sum::<f64>() / load - 1.0).abs() < 1e-13
                    && near.iter().all(|p| (0.0..=ceiling).contains(p))
            );
            for shift in 1..50 {
                let other = nearest((0..200).map(|i| noise(i * shift + 7)).collect(), load, ceiling);
                let angle: f64 = (0..200).map(|i| (values[i] - near[i]) * (other[i] - near[i])).sum();
                assert!(angle <= 1e-9 * load, "{angle}");
            }
        }
    }
}
