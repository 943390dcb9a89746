//! What to choose: when to stop, and the cheapest way to an accuracy.

use super::curve::Curve;
use super::findings::Findings;
use crate::lab::Rival;

/// The accuracies that advice is given for.
pub const ACCURACIES: [f64; 2] = [0.01, 0.001];

/// The largest certificate from which on `quantity` stays within `accuracy` of its final value.
pub fn settled(curve: &Curve, quantity: usize, accuracy: f64) -> Option<f64> {
    let is_settled = |&i: &usize| curve.error_from(i, quantity).is_some_and(|error| error <= accuracy);
    (0..curve.points.len()).find(is_settled).map(|i| curve.points[i].eta)
}

/// A solver on a grid, stopped at a certificate, with its errors in a quantity.
pub struct Advice {
    pub rival: Rival,
    pub shape: [usize; 2],
    pub eta: f64,
    pub seconds: f64,
    pub discretisation: f64,
    pub algebraic: f64,
}

impl Advice {
    /// All points that were measured.
    pub fn all<'a>(findings: &'a Findings, quantity: usize) -> impl Iterator<Item = Self> + 'a {
        let of_curve = move |curve: &'a Curve| {
            let discretisation = findings.ladder.error_from(curve.side(), quantity);
            curve.points.iter().enumerate().filter_map(move |(i, point)| {
                let (rival, shape, eta, seconds) = (curve.rival, curve.shape, point.eta, point.median());
                let algebraic = curve.error_from(i, quantity)?;
                Some(Self { rival, shape, eta, seconds, discretisation: discretisation?, algebraic })
            })
        };
        findings.curves.iter().flat_map(of_curve)
    }

    /// The total error.
    pub fn total(&self) -> f64 {
        self.discretisation + self.algebraic
    }
}
