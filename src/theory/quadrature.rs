//! Gauss-Legendre quadrature of a fixed order.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Nodes per integral. Integrands are made smooth by substitution first; 64 nodes then reach rounding for scales down
/// to a twentieth of the interval.
const NODES: usize = 64;

/// Nodes on `[-1, 1]` with their weights, in rising order.
static RULE: LazyLock<[(f64, f64); NODES]> = LazyLock::new(|| std::array::from_fn(node));

/// `int_from^to f(x) dx` for a smooth `f`.
pub(crate) fn integral(from: f64, to: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    half * RULE.iter().map(|&(x, weight)| weight * f(middle + half * x)).sum::<f64>()
}

/// The `i`-th root `x` of the Legendre polynomial, by Newton's method from Tricomi's estimate, and its weight
/// `2 / ((1 - x^2) P'(x)^2)`.
fn node(i: usize) -> (f64, f64) {
    let mut x = -(PI * (i as f64 + 0.75) / (NODES as f64 + 0.5)).cos();
    for _ in 0..5 {
        let (value, slope) = legendre(x);
        x -= value / slope;
    }
    (x, 2.0 / ((1.0 - x * x) * legendre(x).1.powi(2)))
}

/// The Legendre polynomial of degree [`NODES`] and its derivative at `x`, by Bonnet's recurrence.
fn legendre(x: f64) -> (f64, f64) {
    let n = NODES as f64;
    let step = |(before, last), k| (last, ((2.0 * k - 1.0) * x * last - (k - 1.0) * before) / k);
    let (before, last) = (2..=NODES).map(|k| k as f64).fold((1.0, x), step);
    (last, n * (before - x * last) / (1.0 - x * x))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{E, FRAC_PI_2};

    #[test]
    fn polynomials_up_to_twice_the_nodes_are_exact() {
        for power in (0..2 * NODES as i32).step_by(2) {
            let found = integral(-1.0, 1.0, |x| x.powi(power));
            assert!((found * f64::from(power + 1) / 2.0 - 1.0).abs() < 1e-12, "{power}: {found}");
        }
        let next = 2 * NODES as i32;
        assert!(integral(-1.0, 1.0, |x| x.powi(next)) * f64::from(next + 1) / 2.0 < 1.0);
    }

    #[test]
    fn integrals_that_are_known_come_out_to_rounding() {
        let close = |found: f64, known: f64| assert!((found / known - 1.0).abs() < 1e-14, "{found} {known}");
        close(integral(0.0, 1.0, f64::exp), E - 1.0);
        close(integral(0.0, FRAC_PI_2, f64::sin), 1.0);
        close(integral(1.0, 3.0, f64::recip), 3f64.ln());
        close(integral(-1.0, 1.0, |x| (1.0 + x * x).recip()), FRAC_PI_2);
        close(integral(0.0, 1.0, |x| (50.0 * x).cos().powi(2)), 0.5 + 100f64.sin() / 200.0);
        close(integral(3.0, 1.0, f64::recip), -3f64.ln());
        assert!(integral(-2.0, 2.0, |x| x.powi(7)).abs() < 1e-13);
    }

    #[test]
    fn the_outermost_node_is_the_tabulated_one() {
        let (x, weight) = RULE[NODES - 1];
        assert!((x - 0.999_305_041_735_772_1).abs() < 1e-15, "{x}");
        assert!((weight - 0.001_783_280_721_696_432_9).abs() < 1e-15, "{weight}");
        assert!(RULE.is_sorted() && RULE.iter().zip(RULE.iter().rev()).all(|(a, b)| (a.0 + b.0).abs() < 1e-15));
    }
}
