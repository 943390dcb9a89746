//! Photoelastic fringes: what a polariscope with crossed polarisers shows of the stress in a birefringent model.

use std::f64::consts::PI;

/// Orders of the fringes up to the largest shear stress that is expected.
const ORDERS: f64 = 10.0;

/// The difference of the principal stresses from one fringe to the next, for about ten orders up to the shear stress `highest`: a
/// number of one digit times a power of ten of `unit`.
pub(crate) fn per_order(highest: f64, unit: f64) -> f64 {
    let wanted = 2.0 * highest / ORDERS / unit;
    let power = 10f64.powf(wanted.log10().floor());
    (wanted / power).round() * power * unit
}

/// The light of isochromatics in a dark field, `sin^2(pi N)` with the order `N = 2 tau_max / f`, of an image with rows of `width`.
/// It is the mean over a pixel: where there is a fringe for each pixel, the light is grey.
pub(crate) fn light(tau: &[f64], width: usize, per_order: f64) -> Vec<f64> {
    let order = |i: usize| 2.0 * tau[i] / per_order;
    let height = tau.len() / width;
    let steepness = |i: usize| {
        let (x, y) = (i % width, i / width);
        let across = order(y * width + (x + 1).min(width - 1)) - order(y * width + x.saturating_sub(1));
        let down = order((y + 1).min(height - 1) * width + x) - order(y.saturating_sub(1) * width + x);
        0.5 * across.hypot(down)
    };
    let mean = |i: usize| 0.5 - 0.5 * (2.0 * PI * order(i)).cos() * contrast(steepness(i));
    (0..tau.len()).map(mean).collect()
}

/// The contrast of the mean over a pixel that a number of fringes crosses.
fn contrast(fringes: f64) -> f64 {
    match fringes {
        0.0 => 1.0,
        0.0..1.0 => (PI * fringes).sin() / (PI * fringes),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_orders_are_dark_and_halves_are_bright() {
        let flat = |order: f64| light(&[0.5 * order; 9], 3, 1.0)[4];
        for (order, expected) in [(0.0, 0.0), (1.0, 0.0), (0.5, 1.0), (2.25, 0.5)] {
            assert!((flat(order) - expected).abs() < 1e-14, "{order}");
        }
    }

    #[test]
    fn fringes_that_are_finer_than_pixels_are_grey() {
        let steep: Vec<f64> = (0..64).map(|i| f64::from(i % 8)).collect();
        assert!(light(&steep, 8, 0.7).iter().all(|light| (light - 0.5).abs() < 1e-14));
    }

    #[test]
    fn fringes_have_round_values() {
        assert!((per_order(0.3, 2.0) / 0.06 - 1.0).abs() < 1e-12);
        assert!((per_order(2.3e-3, 1.0) / 5e-4 - 1.0).abs() < 1e-12);
        assert!((per_order(4.9e-3, 1.0) / 1e-3 - 1.0).abs() < 1e-12);
    }
}
