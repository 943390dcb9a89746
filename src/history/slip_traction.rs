//! The traction of one step with friction, and its certificate.

use super::discs::Pair;
use super::slip_state::SlipCertificate;
use crate::chunks;
use crate::contact::{Status, Work};

/// Relative distance from `mu p` up to which a traction counts as slipping, because of rounding.
const ROUNDING: f64 = 1e-14;

/// A traction, and what was found with it. The second component of fields is empty where the traction is along `x` alone.
pub(super) struct Traction {
    pub values: [Vec<f64>; 2],
    pub displacement: [Vec<f64>; 2],
    pub shift: Pair,
    pub status: Status,
    pub work: Work,
}

impl Traction {
    /// No traction on each axis; each number is the count of nodes of one axis.
    pub(crate) fn none(nodes: [usize; 2]) -> Self {
        let zeros = || nodes.map(|nodes| vec![0.0; nodes]);
        Self {
            values: zeros(),
            displacement: zeros(),
            shift: [0.0; 2],
            status: Status::Converged,
            work: Work::default(),
        }
    }

    /// Whether a node in contact slips: where `tau/(mu p) - s/reach` lies outside of the unit circle. At the solution this is whether
    /// the traction is at its limit, and elsewhere it weighs what is left to the limit against the slip.
    pub(crate) fn slips(&self, i: usize, limit: f64, [a, b]: Pair, reach: f64) -> bool {
        let [x, y] = at(&self.values, i);
        if limit == 0.0 || reach == 0.0 {
            return x.hypot(y) >= limit * (1.0 - ROUNDING);
        }
        (x / limit - a / reach).hypot(y / limit - b / reach) >= 1.0 - ROUNDING
    }
}

/// The vector at a node, whose second component is zero in a field without one.
pub(super) fn at(fields: &[Vec<f64>; 2], i: usize) -> Pair {
    [fields[0][i], fields[1].get(i).copied().unwrap_or(0.0)]
}

pub(super) fn length_at(fields: &[Vec<f64>; 2], i: usize) -> f64 {
    let [x, y] = at(fields, i);
    if y == 0.0 { x.abs() } else { x.hypot(y) }
}

/// The rms of the displacement by `mu p`, about its mean.
pub(super) fn sliding_length(mu: f64, pressed: &[f64]) -> f64 {
    let mean = |of: &(dyn Fn(usize) -> f64 + Sync)| chunks::sum(pressed.len(), of) / pressed.len() as f64;
    let middle = mean(&|i| pressed[i]);
    mu * mean(&|i| (pressed[i] - middle).powi(2)).sqrt()
}

/// The shift along `x` with the lower `<tau s> + <mu p |s|>`: the first one, or that at which the slips of both senses carry the load.
/// The first one is that of the nodes that stick, of which there may be hardly any. The other one is a quantile of the displacements `w`
/// with the weights `mu p`, since the derivative of the sum is `<mu p sgn(l - w)> - <tau>`.
pub(super) fn better_shift(mu: f64, pressure: &[f64], [tau, w]: [&[f64]; 2], first: f64) -> f64 {
    let missed =
        |shift: f64| chunks::sum(tau.len(), |i| (w[i] - shift) * tau[i] + mu * pressure[i] * (w[i] - shift).abs());
    let mut places: Vec<usize> = chunks::positive(pressure, 0..pressure.len()).collect();
    places.sort_unstable_by(|&a, &b| w[a].total_cmp(&w[b]));
    let mut rest: f64 = 0.5 * places.iter().map(|&i| mu * pressure[i] + tau[i]).sum::<f64>();
    let carried = places.iter().find(|&&i| {
        rest -= mu * pressure[i];
        rest <= 0.0
    });
    match carried.map(|&i| w[i]) {
        Some(other) if missed(other) < missed(first) => other,
        _ => first,
    }
}

/// The bounds of a traction with its slip, under a pressure that displaces the surface by `pressed`.
pub(super) fn certify(
    mu: f64,
    pressure: &[f64],
    found: &Traction,
    slip: &[Vec<f64>; 2],
    pressed: &[f64],
) -> SlipCertificate {
    let n = pressure.len();
    let mean = |of: &(dyn Fn(usize) -> f64 + Sync)| chunks::sum(n, of) / n as f64;
    let missed = |i: usize| {
        let ([x, y], [a, b]) = (at(&found.values, i), at(slip, i));
        if pressure[i] > 0.0 { x * a + y * b + mu * pressure[i] * length_at(slip, i) } else { 0.0 }
    };
    let gap = mean(&missed);
    let square = mu * mu * mean(&|i| pressure[i] * pressed[i]);
    let over = |gap: f64, scale: f64| if mu > 0.0 { gap.max(0.0) / scale } else { 0.0 };
    SlipCertificate {
        eta: over(gap, mu * mean(&|i| pressure[i]) * sliding_length(mu, pressed)),
        traction_error_bound: over(gap, square).sqrt(),
    }
}
