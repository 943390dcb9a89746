//! What to choose: when to stop, and the cheapest way to an accuracy.

use super::curve::{Curve, Point};
use super::ladder::Ladder;
use crate::lab::Rival;

/// The accuracies that advice is given for.
pub const ACCURACIES: [f64; 2] = [0.01, 0.001];

/// The largest certificate from which on `quantity` stays within `accuracy` of its final value.
pub fn settled(curve: &Curve, quantity: usize, accuracy: f64) -> Option<f64> {
    let is_settled = |&i: &usize| curve.error_from(i, quantity).is_some_and(|error| error <= accuracy);
    (0..curve.points.len()).find(is_settled).map(|i| curve.points[i].eta)
}

/// A solver on a grid, stopped at a certificate.
pub struct Advice {
    pub rival: Rival,
    pub shape: [usize; 2],
    pub eta: f64,
    pub seconds: f64,
    pub discretisation: f64,
    pub algebraic: f64,
}

impl Advice {
    /// The fastest way to a total error of at most `accuracy` in `quantity`.
    pub fn for_accuracy(curves: &[Curve], ladder: &Ladder, quantity: usize, accuracy: f64) -> Option<Self> {
        let all = curves.iter().flat_map(|curve| Self::of_curve(curve, ladder, quantity));
        all.filter(|advice| advice.total() <= accuracy).min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }

    /// The least total error in `quantity` that was measured.
    pub fn best_error(curves: &[Curve], ladder: &Ladder, quantity: usize) -> Option<f64> {
        let all = curves.iter().flat_map(|curve| Self::of_curve(curve, ladder, quantity));
        all.map(|advice| advice.total()).min_by(f64::total_cmp)
    }

    fn of_curve<'a>(curve: &'a Curve, ladder: &'a Ladder, quantity: usize) -> impl Iterator<Item = Self> + 'a {
        curve.points.iter().enumerate().filter_map(move |(i, point)| Self::of(curve, i, point, ladder, quantity))
    }

    fn of(curve: &Curve, i: usize, point: &Point, ladder: &Ladder, quantity: usize) -> Option<Self> {
        Some(Self {
            rival: curve.rival,
            shape: curve.shape,
            eta: point.eta,
            seconds: point.median(),
            discretisation: ladder.error_from(curve.side(), quantity)?,
            algebraic: curve.error_from(i, quantity)?,
        })
    }

    fn total(&self) -> f64 {
        self.discretisation + self.algebraic
    }
}
