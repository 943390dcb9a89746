//! The displacement by a uniform pressure on one element of a half-space, without images.

use std::f64::consts::PI;

/// Distance, in widths, from which the influence of a strip is computed by a series: there the closed form loses digits
/// by cancellation.
const FAR: f64 = 16.0;

/// Step and end of the trapezium rule for waves. It errs by `exp(-pi^2 / STEP)`, and the integrand has fallen by `exp(-END)`.
const STEP: f64 = 0.25;
const END: f64 = 40.0;

/// Displacement at the distance `x` from the middle of a strip of some `width` that runs across a line, per unit of pressure:
/// `-(2 / (pi E*)) int ln(|s| / D) ds` over the strip, with the datum `D`.
///
/// # Source
/// Flamant; Johnson, *Contact Mechanics* (1985), sections 2.2 and 2.5.
pub(super) fn strip(x: f64, width: f64, datum: f64, contact_modulus: f64) -> f64 {
    let (x, half) = (x.abs(), 0.5 * width);
    let integral = if x > FAR * width {
        let square = (half / x).powi(2);
        width
            * ((x / datum).ln() - square * (1.0 / 6.0 + square * (1.0 / 20.0 + square * (1.0 / 42.0 + square / 72.0))))
    } else {
        let of = |s: f64| if s == 0.0 { 0.0 } else { s * ((s.abs() / datum).ln() - 1.0) };
        of(x + half) - of(x - half)
    };
    -2.0 / (PI * contact_modulus) * integral
}

/// Displacement at the distance `[y, x]` from the middle of a rectangle of sides `[dy, dx]`, per unit of pressure:
/// `(1 / (pi E*)) int 1/r` over the rectangle.
///
/// # Source
/// Love, Phil. Trans. R. Soc. A 228, 377 (1929); Johnson, *Contact Mechanics* (1985), Eq. 3.25.
pub(crate) fn rectangle([y, x]: [f64; 2], [dy, dx]: [f64; 2], contact_modulus: f64) -> f64 {
    let [[below, above], [left, right]] = [[y, dy], [x, dx]].map(|[at, side]| [at - 0.5 * side, at + 0.5 * side]);
    // x asinh(y/|x|) + y asinh(x/|y|) has the mixed derivative 1/r
    let edge = |s: f64, from: f64, to: f64| s * ((to / s.abs()).asinh() - (from / s.abs()).asinh());
    let integral =
        edge(right, below, above) - edge(left, below, above) + edge(above, left, right) - edge(below, left, right);
    integral / (PI * contact_modulus)
}

/// Displacement at the distance `x` from the middle of a strip of some `width` under a pressure that is a wave of wavenumber `q` along
/// the strip, over the height of the wave: `(2 / (pi E*)) int K0(q |s|) ds` across the strip, with the Bessel function
/// `K0(z) = int_0^inf exp(-z cosh t) dt`.
pub(super) fn wave(x: f64, width: f64, q: f64, contact_modulus: f64) -> f64 {
    let (x, half) = (x.abs(), 0.5 * width);
    let term = |cosh: f64| {
        let fraction = if x < half {
            -2.0 * (-q * half * cosh).exp_m1()
        } else {
            -(-q * (x - half) * cosh).exp() * (-q * width * cosh).exp_m1()
        };
        fraction / (q * cosh)
    };
    let steps = (END / STEP) as usize;
    let sum: f64 = (1..=steps).map(|i| term((STEP * i as f64).cosh())).take_while(|&term| term > 0.0).sum();
    2.0 / (PI * contact_modulus) * STEP * (0.5 * term(1.0) + sum)
}
