//! The transients by which a viscoelastic solid answers a change of the rate of the load.

use super::creep_path::RateChange;
use crate::elastic::PronyTerm;

/// The first step after a point where the load stops or turns, as a part of the shortest time whose transient counts: a jump of the rate excites
/// an element by less than a jump of the load does, and the doubled history sees the transient from there.
const AFTER_TURN: f64 = 0.5;
/// Where the rate of the load changes by less, the first step is longer in proportion, up to that of this change: with steps longer than the time, as
/// with 0.25, errors of the loss along sampled sines were up to 2.2 times the stated ones.
const LEAST_TURN: f64 = 0.5;
/// A transient counts where the energy that it may change is more than this part of the tolerance, over the energy lost on the way to the next
/// point. Transients of shorter elements are not followed, and are part of the error of the lost energy.
const LEAST_ENERGY: f64 = 0.1;
/// The energy that a transient may change, over that lost on the way of a duration `T` to the next point, is at most this many times
/// `tau/T` times the change of the rate. With the rates `a` and `b` before and after, the element loses in proportion to
/// `int (b + (a - b) exp(-t/tau))^2 dt = b^2 T + 2 b (a - b) tau + (a - b)^2 tau/2`.
const OF_TRANSIENT: f64 = 2.0;

/// The transients of the Kelvin elements after a point of a path.
///
/// Steps that are much longer than a transient miss it, those of twice the length miss it as well, and the difference of both histories does not tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Transients {
    /// The longest first step that sees all transients that count; infinite where none does.
    pub first_step: f64,
    /// The largest part of the lost energy that one of the others may change.
    pub left_out: f64,
}

impl Transients {
    /// The transients of the elements of a solid at a point where the rate of the load changes, for a relative tolerance of the lost energy; none
    /// without a change.
    pub(crate) fn new(turn: Option<RateChange>, terms: &[PronyTerm], tolerance: f64) -> Self {
        let mut transients = Self { first_step: f64::INFINITY, left_out: 0.0 };
        let Some(turn) = turn else { return transients };
        for term in terms {
            let part = OF_TRANSIENT * turn.change * term.time / turn.time;
            if part > LEAST_ENERGY * tolerance {
                let step = AFTER_TURN * term.time / turn.change.clamp(LEAST_TURN, 1.0);
                transients.first_step = transients.first_step.min(step);
            } else {
                transients.left_out = transients.left_out.max(part);
            }
        }
        transients
    }

    /// The largest part of the energy lost in a step that transients may change which begin within it, as where surfaces touch or part. Those of
    /// elements that are slower than the step are in the difference of both histories.
    pub(crate) fn left_out_within(step: f64, terms: &[PronyTerm]) -> f64 {
        let faster = terms.iter().map(|term| term.time).filter(|time| *time < step);
        (OF_TRANSIENT * faster.fold(0.0, f64::max) / step).min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the loss of an element differs from that of a constant rate after a change of the rate, by many small steps: with the rate `b` after
    /// the change and `a` before it, of the larger one of the losses before and after.
    fn changed([a, b]: [f64; 2], tau: f64, duration: f64) -> f64 {
        let (count, mut rate, mut lost) = (200_000, a, 0.0);
        let step = duration / f64::from(count);
        for _ in 0..count {
            let next = b + (rate - b) * (-step / tau).exp();
            lost += step * (rate * rate + rate * next + next * next) / 3.0;
            rate = next;
        }
        (lost - b * b * duration).abs() / (a * a * duration).max(b * b * duration)
    }

    #[test]
    fn what_is_left_out_is_not_more_than_what_is_told() {
        let (tau, time) = (1e-3, 7.0);
        for [a, b] in [[1.0, -1.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.5], [0.5, 1.0], [-0.3, 1.0], [1.0, 0.99]] {
            let change = f64::abs(a - b) / f64::max(f64::abs(a), f64::abs(b));
            let terms = [PronyTerm { ratio: 2.0, time: tau }];
            let transients = Transients::new(Some(RateChange { change, time }), &terms, 1e-1);
            let true_part = changed([a, b], tau, time);
            assert!(transients.first_step.is_infinite() && true_part > 0.0);
            assert!(true_part <= transients.left_out && transients.left_out <= 8.0 * true_part, "{a} {b}: {true_part}");
        }
    }

    #[test]
    fn steps_begin_with_the_shortest_time_that_counts() {
        let terms = [1e-6, 0.3, 5.0].map(|time| PronyTerm { ratio: 1.0, time });
        let at = |change: f64| Transients::new(Some(RateChange { change, time: 10.0 }), &terms, 1e-2);
        assert!((at(2.0).first_step - 0.15).abs() < 1e-12 && (at(0.5).first_step - 0.3).abs() < 1e-12);
        assert!((at(2.0).left_out - 4e-7).abs() < 1e-12);
        assert_eq!(Transients::new(None, &terms, 1e-2), Transients { first_step: f64::INFINITY, left_out: 0.0 });
    }
}
