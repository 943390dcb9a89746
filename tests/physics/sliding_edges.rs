//! The edges of contacts that slide over viscoelastic solids, against elastic contacts at both ends and finer grids between.

use crate::common::solve;
use asperity::contact::{
    Contact, ContactModulus, Load, MonotoneSets, Multilevel, Observables, Problem, warning_of_trail,
};
use asperity::surface::Spectrum;
use asperity::{Grid, Indenter, Surface};

const CREEP: f64 = 9.0;

fn line(points: usize, seed: u64) -> Surface {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.125, short_cutoff: 1.0 / 64.0, rms_gradient: 0.02 };
    Surface::rough(Grid::line(points, 1.0).unwrap(), &spectrum, seed).unwrap()
}

fn square(points: usize, seed: u64) -> Surface {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.125, rms_gradient: 0.02 };
    Surface::rough(Grid::surface([points; 2], [1.0; 2]).unwrap(), &spectrum, seed).unwrap()
}

fn cylinder(points: usize) -> Surface {
    Indenter::Cylinder { radius: 4.0 }.surface(Grid::line(points, 1.0).unwrap()).unwrap()
}

fn at_rest(surface: Surface, modulus: f64, pressure: f64) -> Contact {
    let problem = Problem::new(surface, ContactModulus(modulus), Load::MeanPressure(pressure)).unwrap();
    solve(&Multilevel, &problem, 1e-10)
}

fn sliding(surface: Surface, pressure: f64, speed: f64) -> Contact {
    let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(pressure)).unwrap();
    solve(&MonotoneSets, &problem.sliding(speed, &[(CREEP, 1.0)]).unwrap(), 1e-10)
}

fn area(contact: &Contact) -> f64 {
    contact.resolved().relative_area
}

/// The numbers that depend on a modulus.
fn numbers(contact: &Contact) -> [f64; 9] {
    let it = Observables::new(contact);
    [
        it.relative_area,
        it.relative_area_corrected,
        it.reduced_pressure,
        it.reduced_pressure_contact,
        it.kappa,
        it.kappa_counted,
        it.kappa_r,
        it.kappa_r_corrected,
        it.effective_modulus,
    ]
}

fn assert_alike(found: &Contact, expected: &Contact, tolerance: f64) {
    let [found, expected] = [found, expected].map(numbers);
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < tolerance, "{found} for {expected}");
    }
}

#[test]
fn slow_slides_have_the_numbers_of_the_relaxed_solid_at_rest() {
    let surfaces = [line(512, 1), line(4096, 2), square(96, 3), cylinder(256)];
    for (surface, pressure) in surfaces.into_iter().zip([2e-4, 2e-4, 2e-4, 5e-4]) {
        let relaxed = at_rest(surface.clone(), 1.0 / (1.0 + CREEP), pressure);
        assert_alike(&sliding(surface, pressure, 1e-10), &relaxed, 1e-5);
    }
}

#[test]
fn fast_slides_of_lines_have_the_numbers_of_the_glassy_solid_at_rest() {
    for (surface, pressure) in [line(512, 1), line(4096, 2), cylinder(256)].into_iter().zip([2e-3, 2e-4, 5e-4]) {
        let glassy = at_rest(surface.clone(), 1.0, pressure);
        assert_alike(&sliding(surface, pressure, 1e10), &glassy, 1e-5);
    }
}

/// The error on a coarse grid, whether waves of the grid are slow or fast. Counting nodes is off by 6 to 20 % here.
#[test]
fn areas_of_coarse_lines_are_those_of_fine_ones_at_all_speeds() {
    for lag in [0.1, 0.3, 1.0, 3.0, 10.0] {
        let mut missed = 0.0;
        for seed in [1, 2, 3] {
            let [coarse, fine] = [1024, 8192].map(|points| area(&sliding(line(points, seed), 2e-4, lag / 1024.0)));
            missed += (coarse / fine - 1.0).abs() / 3.0;
        }
        println!("line {lag}: {missed:.2e}");
        assert!(missed < 0.006, "{missed} where the surface slides {lag} spacings in the retardation time");
    }
}

/// The edges of a single contact on one of 32 times as many points, with the effective modulus between both ends.
#[test]
fn a_cylinder_has_the_same_edges_on_any_grid() {
    let mut before = 0.1;
    for lag in [0.03, 0.3, 1.0, 3.0, 10.0, 30.0] {
        let [coarse, fine] = [256, 8192].map(|points| sliding(cylinder(points), 5e-4, lag / 256.0));
        assert!((area(&coarse) / area(&fine) - 1.0).abs() < 2e-4, "{} {}", area(&coarse), area(&fine));
        assert_eq!((coarse.resolved().edges_of_shape, fine.resolved().edges_of_shape), (0, 0));
        let [one, other] = [&coarse, &fine].map(|it| it.resolved().kappa_r);
        assert!((one / other - 1.0).abs() < 4e-3 && (1.2..1.5).contains(&one), "{one} {other}");
        let modulus = fine.effective_modulus();
        assert!(modulus > before && modulus < 1.0, "{modulus} after {before}");
        before = modulus;
    }
}

/// Edges along the motion are at rest, and oblique ones move at a part of the speed.
#[test]
fn areas_of_coarse_surfaces_are_those_of_fine_ones_at_all_speeds() {
    for (lag, pressure) in [(0.1, 3e-4), (1.0, 4e-4), (3.0, 6e-4), (30.0, 2e-3), (1e9, 2e-3)] {
        let [coarse, fine] = [64, 192].map(|points| sliding(square(points, 1), pressure, lag / 64.0));
        let missed = area(&coarse) / area(&fine) - 1.0;
        let counted = coarse.counted().relative_area / area(&fine) - 1.0;
        let [one, other] = [&coarse, &fine].map(|it| it.resolved().kappa_r);
        println!(
            "surface {lag}: area {:.4} off by {missed:.1e}, counted {counted:.1e}, kappa_r {one:.4} {other:.4}",
            area(&fine)
        );
        assert!(missed.abs() < 0.01, "{missed} where the surface slides {lag} spacings in the retardation time");
        assert!((one / other - 1.0).abs() < 0.02 && (1.2..1.8).contains(&other), "{one} {other}");
    }
}

#[test]
fn a_trail_that_is_longer_than_the_cell_gets_a_warning() {
    let slides = [0.5, 2.0, 4.0].map(|speed| sliding(cylinder(256), 5e-4, speed));
    assert!(
        warning_of_trail(&slides[..1]).is_none() && warning_of_trail([&at_rest(cylinder(64), 1.0, 5e-4)]).is_none()
    );
    let one = warning_of_trail([&slides[1]]).unwrap().to_string();
    assert!(one.starts_with("The trail") && one.contains("2.000e0 long") && one.contains("cell 1.000e0"), "{one}");
    let several = warning_of_trail(&slides).unwrap().to_string();
    assert!(several.starts_with("At 2 of 3 speeds the trail") && several.contains("up to 4.000e0"), "{several}");
}
