//! Greenwood and Williamson's equations, from their definitions.

use asperity::theory::GreenwoodWilliamson;
use asperity::theory::SummitHeights::{self, Exponential, Gaussian};
use libm::{erfc, tgamma};
use std::f64::consts::{PI, TAU};

fn model(heights: SummitHeights) -> GreenwoodWilliamson {
    GreenwoodWilliamson { heights, scale: 0.02, radius: 1.5, density: 3.0, contact_modulus: 7.0 }
}

#[test]
fn exponential_heights_give_equations_16_17_20_21() {
    let model = model(Exponential);
    for d in [0.0, 1.0, 5.0, 100.0] {
        let area = PI * 1.5 * 0.02 * f64::exp(-d) * 3.0;
        let pressure = 0.02 * 7.0 * (PI * 1.5 * 0.02).sqrt() * f64::exp(-d) * 3.0;
        assert!((model.relative_area(d) / area - 1.0).abs() < 1e-14);
        assert!((model.pressure(d) / pressure - 1.0).abs() < 1e-14);
        assert!((model.rms_gradient_contact(d) - (0.02_f64 / 1.5).sqrt()).abs() < 1e-15);
        assert!((Exponential.kappa_r(d) - 1.7725).abs() < 5e-5);
    }
}

#[test]
fn kappa_r_is_its_definition() {
    for model in [model(Exponential), model(Gaussian)] {
        for d in [-3.0, 0.0, 2.0, 6.0] {
            let reduced = model.pressure(d) / (model.rms_gradient_contact(d) * 7.0);
            assert!((model.relative_area(d) / reduced / model.heights.kappa_r(d) - 1.0).abs() < 1e-13);
        }
    }
}

/// `F_m` of Gaussian heights of scale 1 for `m = 1, 3/2, 2`, from area, pressure and gradient.
fn moments(separation: f64) -> [f64; 3] {
    let unit = GreenwoodWilliamson { scale: 1.0, radius: 1.0, density: 1.0, contact_modulus: 1.0, ..model(Gaussian) };
    let first = unit.relative_area(separation) / PI;
    let second = 2.0 * unit.rms_gradient_contact(separation).powi(2) * first;
    [first, 0.75 * unit.pressure(separation), second]
}

#[test]
fn gaussian_moments_have_closed_forms_at_zero_and_for_whole_powers() {
    for (m, found) in [1.0, 1.5, 2.0].into_iter().zip(moments(0.0)) {
        let expected = 2f64.powf(0.5 * m - 1.0) * tgamma(0.5 * (m + 1.0)) / PI.sqrt();
        assert!((found / expected - 1.0).abs() < 1e-13);
    }
    for d in [-5.0_f64, -1.0, 0.5, 1.0, 3.0] {
        let density = (-0.5 * d * d).exp() / TAU.sqrt();
        let tail = 0.5 * erfc(d / 2f64.sqrt());
        let [first, _, second] = moments(d);
        assert!((first / (density - d * tail) - 1.0).abs() < 1e-11, "{d}");
        assert!((second / ((1.0 + d * d) * tail - d * density) - 1.0).abs() < 1e-10, "{d}");
    }
}

#[test]
fn gaussian_kappa_r_rises_to_the_exponential_one() {
    let kappa_r: Vec<f64> = (0..=40).map(|d| Gaussian.kappa_r(f64::from(d))).collect();
    assert!(kappa_r.is_sorted() && kappa_r.iter().all(|&k| k > 1.7 && k < PI.sqrt()));
    assert!((kappa_r[40] - PI.sqrt()).abs() < 5e-4);
    let far = Gaussian.kappa_r(1e8);
    assert!((far - PI.sqrt()).abs() < 1e-12, "{far}");
    assert!(Gaussian.kappa_r(-1e3).is_finite());
}
