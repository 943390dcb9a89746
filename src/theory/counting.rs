//! The excess of the contact area by counting nodes.

use std::f64::consts::PI;

/// Wavenumbers beyond this one, in units of one over the spacing, are taken by their mean.
const LARGEST: f64 = 2000.0;
/// Points of the rule of midpoints below it: the integrand has steps and logarithmic peaks.
const POINTS: usize = 1_000_000;

/// The mean excess of counted nodes over the true contact beside a straight edge, in spacings of a square grid: the width of the
/// strip by which counting makes the contact larger, when the edge may lie anywhere. `angle` is that between the normal of
/// the edge and an axis of the grid, in radians.
///
/// ```text
/// e = (1/pi) int_0^inf ln(q / |q n|) dq / q^2,     |q n| the length of the wave vector q (cos, sin) folded to [-pi, pi]^2
/// ```
///
/// A straight edge along a lattice direction is a problem in one dimension, on the lines of nodes parallel to it, whose symbol
/// is the folded wavenumber; the edge of its Wiener-Hopf solutions lies by `e` before the middle of the spacing, on average.
/// In that form nothing is left of the lattice direction, and the formula holds at any angle. Along the grid it is
/// `1/4 + sum_{m >= 1} (1/2 - Si(m pi)/pi) = 0.1900095`, and the mean over all angles is 0.129078.
///
/// Computed by the midpoint rule, to six digits, in about 20 ms.
///
/// # Source
/// This crate's own.
///
/// ```
/// use asperity::theory::counting_excess;
/// let along = counting_excess(0.0);
/// assert!((along - 0.1900095).abs() < 1e-5);
/// // the diagonal is a grid of its own, with a spacing smaller by the square root of 2
/// let diagonal = counting_excess(std::f64::consts::FRAC_PI_4);
/// assert!((diagonal - along / 2f64.sqrt()).abs() < 1e-5);
/// ```
pub fn counting_excess(angle: f64) -> f64 {
    let (cosine, sine) = (angle.cos(), angle.sin());
    let folded = |q: f64| folded(q * cosine).hypot(folded(q * sine)).ln();
    // below it nothing folds
    let first = PI / cosine.abs().max(sine.abs());
    let step = (LARGEST - first) / POINTS as f64;
    let (mut sum, mut mean) = (0.0, 0.0);
    for i in 0..POINTS {
        let q = first + (i as f64 + 0.5) * step;
        let length = folded(q);
        sum += (q.ln() - length) / (q * q);
        mean += length / POINTS as f64;
    }
    (sum * step + (LARGEST.ln() + 1.0 - mean) / LARGEST) / PI
}

/// `x` on `[-pi, pi]`, less whole turns.
fn folded(x: f64) -> f64 {
    x - 2.0 * PI * (x / (2.0 * PI)).round()
}
