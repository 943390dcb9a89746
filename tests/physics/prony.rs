//! Prony series: creep and relaxation of one solid.

use asperity::elastic::{Prony, PronyTerm};
use asperity::error::SolidError;
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};

fn term(ratio: f64, time: f64) -> PronyTerm {
    PronyTerm { ratio, time }
}

/// `1 + sum f / (1 + s tau)`.
fn compliance(terms: &[PronyTerm], s: f64) -> f64 {
    1.0 + terms.iter().map(|it| it.ratio / (1.0 + s * it.time)).sum::<f64>()
}

/// `1 - sum g / (1 + s tau)`, without cancellation for small `s`: `left` is `1 - sum g`.
fn stiffness(terms: &[PronyTerm], left: f64, s: f64) -> f64 {
    left + terms.iter().map(|it| it.ratio * (s * it.time / (1.0 + s * it.time))).sum::<f64>()
}

/// The product of both for slow and fast loads.
fn check(creep: &[PronyTerm], relaxation: &[PronyTerm], left: f64, tolerance: f64) {
    for decade in -60..=60 {
        let s = 10f64.powf(0.37 * f64::from(decade));
        let product = compliance(creep, s) * stiffness(relaxation, left, s);
        assert!((product - 1.0).abs() < tolerance, "{product} at {s} of {relaxation:?}");
    }
}

/// Creep is slower than relaxation, term by term, and faster than the next slower relaxation.
fn check_interlaced(creep: &[PronyTerm], relaxation: &[PronyTerm]) {
    assert_eq!(creep.len(), relaxation.len());
    let mut times: Vec<f64> = relaxation.iter().map(|it| it.time).collect();
    times.sort_by(f64::total_cmp);
    for (i, it) in creep.iter().enumerate() {
        assert!(it.time >= times[i] && times.get(i + 1).is_none_or(|&next| it.time <= next), "{creep:?} {times:?}");
    }
}

#[test]
fn a_standard_linear_solid_creeps_slower_than_it_relaxes_by_the_ratio_of_its_moduli() {
    for f in [1e-9, 0.3, 9.0, 1e6] {
        let prony = Prony::from_relaxation(&[term(f / (1.0 + f), 2.0)]).unwrap();
        let [it] = prony.terms() else { panic!("one term") };
        assert!((it.ratio / f - 1.0).abs() < 1e-15 * (8.0 + f.max(1.0 / f)), "{} for {f}", it.ratio);
        assert!((it.time / (2.0 * (1.0 + f)) - 1.0).abs() < 1e-15 * (8.0 + f), "{} for {f}", it.time);
        let [back] = prony.to_relaxation()[..] else { panic!("one term") };
        assert!((back.time - 2.0).abs() < 1e-15 * (8.0 + f));
        for t in [0.0, 0.5, 3.0, 1e3] {
            let creep = 1.0 + f * (1.0 - (-t / (2.0 * (1.0 + f))).exp());
            let relaxation = 1.0 - f / (1.0 + f) * (1.0 - (-t / 2.0f64).exp());
            assert!((prony.creep(t) / creep - 1.0).abs() < 1e-14 * (1.0 + f));
            assert!((prony.relaxation(t) - relaxation).abs() < 1e-14);
        }
    }
}

#[test]
fn creep_times_relaxation_is_one_for_random_series() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for count in (1..=20).chain(1..=20) {
        let spread = rng.random_range(0.1..15.0);
        let sum = rng.random_range(0.01..0.98);
        let mut terms: Vec<PronyTerm> = (0..count)
            .map(|_| term(rng.random_range(0.001..1.0), 10f64.powf(spread * (rng.random_range(0.0..1.0) - 0.5))))
            .collect();
        let all: f64 = terms.iter().map(|it| it.ratio).sum();
        terms.iter_mut().for_each(|it| it.ratio *= sum / all);
        let left = 1.0 - terms.iter().map(|it| it.ratio).sum::<f64>();
        let prony = Prony::from_relaxation(&terms).unwrap();
        check(prony.terms(), &terms, left, 1e-12);
        check_interlaced(prony.terms(), &terms);
        assert!((prony.relaxed_ratio() * left - 1.0).abs() < 1e-12);
        // and back
        let back = prony.to_relaxation();
        terms.sort_by(|a, b| a.time.total_cmp(&b.time));
        for (it, was) in back.iter().zip(&terms) {
            assert!(
                (it.time / was.time - 1.0).abs() < 1e-9 && (it.ratio / was.ratio - 1.0).abs() < 1e-7,
                "{it:?} {was:?}"
            );
        }
    }
}

#[test]
fn hard_series_are_converted_to_rounding() {
    let nearly_equal: Vec<PronyTerm> = (0..6).map(|i| term(0.1, 1.0 + f64::from(i) * f64::EPSILON)).collect();
    let wide: Vec<PronyTerm> = (0..16).map(|i| term(0.06, 10f64.powi(i - 8))).collect();
    let tiny: Vec<PronyTerm> = (0..5).map(|i| term(10f64.powi(-4 * i - 1), 2f64.powi(i))).collect();
    for terms in [nearly_equal, wide, tiny] {
        let left = 1.0 - terms.iter().map(|it| it.ratio).sum::<f64>();
        let prony = Prony::from_relaxation(&terms).unwrap();
        check(prony.terms(), &terms, left, 1e-12);
        check_interlaced(prony.terms(), &terms);
    }
    // a stiffness that is all but lost: its digits are those of what is left
    let soft = [term(0.5, 1.0), term(0.5 - 2f64.powi(-40), 1e5)];
    let prony = Prony::from_relaxation(&soft).unwrap();
    check(prony.terms(), &soft, 2f64.powi(-40), 1e-12);
    assert!((prony.relaxed_ratio() / 2f64.powi(40) - 1.0).abs() < 1e-12);
    // terms of one time are one term
    let twice = Prony::from_relaxation(&[term(0.3, 1.0), term(0.2, 1.0)]).unwrap();
    assert_eq!(twice, Prony::from_relaxation(&[term(0.5, 1.0)]).unwrap());
}

#[test]
fn creep_of_many_terms_is_converted_too() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    for count in 1..=20 {
        let terms: Vec<PronyTerm> = (0..count)
            .map(|_| term(10f64.powf(rng.random_range(-6.0..4.0)), 10f64.powf(rng.random_range(-8.0..7.0))))
            .collect();
        let prony = Prony::new(terms.clone()).unwrap();
        let back = prony.to_relaxation();
        check(&terms, &back, 1.0 / prony.relaxed_ratio(), 1e-11);
        check_interlaced(
            &{
                let mut t = terms;
                t.sort_by(|a, b| a.time.total_cmp(&b.time));
                t
            },
            &back,
        );
        assert!((prony.relaxation(1e300) * prony.relaxed_ratio() - 1.0).abs() < 1e-9 * prony.relaxed_ratio().max(1.0));
    }
}

#[test]
fn the_complex_compliance_is_that_of_a_harmonic_load() {
    let prony = Prony::new(vec![term(9.0, 2.0), term(0.5, 1e-3)]).unwrap();
    assert_eq!(prony.compliance(0.0), [10.5, 0.0]);
    let [re, im] = prony.compliance(0.5);
    assert!((re - (1.0 + 4.5 + 0.5 / (1.0 + 2.5e-7))).abs() < 1e-12);
    assert!((im + 4.5 + 0.5 * 5e-4 / (1.0 + 2.5e-7)).abs() < 1e-12);
    let [re, im] = prony.compliance(1e308);
    assert!(re == 1.0 && im.abs() < 1e-300);
}

#[test]
fn impossible_series_are_refused_with_numbers() {
    for (ratio, time) in [(0.0, 1.0), (-1.0, 1.0), (f64::NAN, 1.0), (0.5, 0.0), (0.5, f64::INFINITY)] {
        let error = Prony::new(vec![term(ratio, time)]).unwrap_err();
        assert!(matches!(error, SolidError::PronyTerm { .. }) && Prony::from_relaxation(&[term(ratio, time)]).is_err());
    }
    let error = Prony::from_relaxation(&[term(0.6, 1.0), term(0.4, 2.0)]).unwrap_err();
    assert_eq!(error.to_string(), "the ratios of the relaxation add up to 1.0: give ratios whose sum is below 1");
    assert_eq!(Prony::new(Vec::new()).unwrap().creep(3.0), 1.0);
}
