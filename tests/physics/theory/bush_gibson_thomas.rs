//! The asperity model of Bush, Gibson and Thomas: its limit, and sums over random summits.

use asperity::theory::BushGibsonThomas;
use asperity::theory::persson::KAPPA_BGT;
use std::f64::consts::PI;

#[test]
fn at_vanishing_load_the_slope_is_the_root_of_two_pi() {
    for nayak in [1.6, 2.0, 5.0, 20.0, 200.0] {
        let model = BushGibsonThomas { nayak };
        let off =
            |separation: f64| 1.0 - model.relative_area(separation) / (model.reduced_pressure(separation) * KAPPA_BGT);
        let [near, far] = [15.0, 30.0].map(off);
        // the higher the summits in contact are, the nearer is the limit
        assert!(far > 0.0 && far < 0.5 * near && far < 0.004 * nayak, "{nayak}: {near} {far}");
    }
}

#[test]
fn the_slope_falls_with_the_load_and_with_the_breadth_of_the_spectrum() {
    let kappa = |nayak| [1e-6, 1e-4, 1e-2].map(|pressure| BushGibsonThomas { nayak }.kappa(pressure));
    let all = [2.0, 10.0, 50.0, 200.0].map(kappa);
    assert!(all.iter().all(|it| it[0] < KAPPA_BGT && it.is_sorted_by(|a, b| a > b)), "{all:?}");
    assert!(all.windows(2).all(|pair| (0..3).all(|i| pair[0][i] > pair[1][i])), "{all:?}");
}

#[test]
fn the_load_that_is_searched_is_the_one_that_is_found() {
    let model = BushGibsonThomas { nayak: 7.0 };
    let (area, pressure) = (model.relative_area(1.5), model.reduced_pressure(1.5));
    assert!((model.kappa(pressure) * pressure / area - 1.0).abs() < 1e-9);
}

/// Complete elliptic integrals `K(m)` and `E(m)` by the rule of midpoints, which is exact for periodic functions.
fn elliptic(m: f64) -> [f64; 2] {
    let steps = 64;
    let sum = |power: f64| {
        let term = |i: i32| (1.0 - m * (PI * (f64::from(i) + 0.5) / f64::from(2 * steps)).sin().powi(2)).powf(power);
        (0..steps).map(term).sum::<f64>() * PI / f64::from(2 * steps)
    };
    [sum(-0.5), sum(0.5)]
}

/// Area and load of a paraboloid of the curvatures `k1 > k2` under a compression of 1 on a modulus of 1 (Johnson, Eqs. 4.26 to 4.28).
fn hertz([k1, k2]: [f64; 2]) -> [f64; 2] {
    let [mut low, mut high] = [1e-6, 1.0 - 1e-6];
    for _ in 0..40 {
        let m = 0.5 * (low + high);
        let [k, e] = elliptic(m);
        *(if (k - e) / (e / (1.0 - m) - k) > k2 / k1 { &mut low } else { &mut high }) = m;
    }
    let m = 0.5 * (low + high);
    let [k, e] = elliptic(m);
    let a = (2.0 * (k - e) / (m * k2 * k)).sqrt();
    [PI * a * a * (1.0 - m).sqrt(), 2.0 * PI / 3.0 * a / k]
}

/// Area and pressure by summits of random height and second derivatives, with `m0 = m2 = 1`.
fn sampled(nayak: f64, separation: f64) -> [f64; 2] {
    let mut sums = [0.0; 2];
    let samples = 60_000;
    for i in 1..=samples {
        let uniform = |prime: f64| (f64::from(i) * prime.sqrt()).fract();
        let pair = |primes: [f64; 2]| {
            let (radius, angle) = ((-2.0 * uniform(primes[0]).ln()).sqrt(), 2.0 * PI * uniform(primes[1]));
            [radius * angle.cos(), radius * angle.sin()]
        };
        let ([g1, g2], [g3, g4]) = (pair([2.0, 3.0]), pair([5.0, 7.0]));
        // <z_xx^2> = m4, <z_xx z_yy> = <z_xy^2> = m4/3, <z z_xx> = -m2
        let (xx, yy) = (nayak.sqrt() * g1, nayak.sqrt() * (g1 + 8f64.sqrt() * g2) / 3.0);
        let xy = (nayak / 3.0).sqrt() * g3;
        let height = -0.75 * (xx + yy) / nayak + (1.0 - 1.5 / nayak).sqrt() * g4;
        let (mean, half) = (-0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        let [k1, k2] = [mean + half, mean - half];
        if k2 > 1e-5 * k1 && height > separation {
            let (weight, w) = (k1 * k2 / (2.0 * PI), height - separation);
            let [area, load] = hertz([k1, k2]);
            sums[0] += weight * area * w;
            sums[1] += weight * load * w.powf(1.5);
        }
    }
    [sums[0], sums[1] / 2f64.sqrt()].map(|sum| sum / f64::from(samples))
}

#[test]
fn sums_over_random_summits_give_the_same_area_and_pressure() {
    for (nayak, separation) in [(2.0, 0.5), (2.0, 1.5), (8.0, 1.0), (60.0, 0.5)] {
        let model = BushGibsonThomas { nayak };
        let [area, pressure] = sampled(nayak, separation);
        let found = [model.relative_area(separation) / area, model.reduced_pressure(separation) / pressure];
        assert!(found.iter().all(|ratio| (ratio - 1.0).abs() < 0.03), "{nayak} {separation}: {found:?}");
    }
}
