//! Steady sliding over viscoelastic solids against closed forms, the reference output of the program CONTACT, and elastic limits.

use crate::common::{relative_l2, solve};
use asperity::contact::{
    Contact, ContactModulus, Gfmd, Load, MonotoneSets, Multilevel, PolonskyKeer, Problem, Solver, Stop,
};
use asperity::error::{InputError, MotionError, ProblemError, SolveError};
use asperity::history::Sliding;
use asperity::surface::Spectrum;
use asperity::{Grid, Indenter, Surface};
use std::f64::consts::{PI, TAU};

fn slide(problem: &Problem, tolerance: f64) -> Sliding {
    Sliding::solve(problem, &Stop::new(tolerance, 20_000).unwrap(), &mut ()).unwrap()
}

/// The example `visc_cylindr` of CONTACT: two equal rollers of `G = 1143`, `nu = 0.4`, `f = 1`, `R = 50` combined, 600 N/mm, 1000 mm/s.
/// Positions are mirrored: here the material enters at `+x`.
#[test]
fn viscoelastic_rollers_carry_the_pressures_of_contact() {
    let (points, length) = (8192, 400.0);
    let surface = Indenter::Cylinder { radius: 50.0 }.surface(Grid::line(points, length).unwrap()).unwrap();
    let cases = [
        (0.0, 60.32, [-6.30, 6.30], 0.0),
        (0.009, 78.74, [-3.91, 5.81], 0.0244),
        (0.045, 84.72, [-3.96, 5.03], 0.0117),
        (2.0, 85.31, [-4.44, 4.49], 0.0004),
    ];
    for (time, highest, edges, friction) in cases {
        let problem =
            Problem::new(surface.clone(), ContactModulus(1905.0), Load::MeanPressure(600.0 / length)).unwrap();
        let sliding = slide(&problem.sliding(1000.0, &[(1.0, time)]).unwrap(), 1e-10);
        let contact = &sliding.contact;
        assert!((contact.max_pressure() / highest - 1.0).abs() < 1e-3, "{time}: {}", contact.max_pressure());
        let touching: Vec<f64> = (0..points)
            .filter(|&i| contact.pressure[[0, i]] > 0.0)
            .map(|i| (i as f64 - (points / 2) as f64) * length / points as f64)
            .collect();
        for (found, edge) in [touching[0], touching[touching.len() - 1]].into_iter().zip(edges) {
            assert!((found - edge).abs() < 0.06, "{time}: {found} against {edge}");
        }
        assert!((sliding.friction - friction).abs() < 1e-4 && sliding.lateral == 0.0, "{time}: {}", sliding.friction);
        assert!(time == 0.0 || sliding.friction > 0.0);
        // the other way round, everything is mirrored
        let back = slide(
            &Problem::new(surface.clone(), ContactModulus(1905.0), Load::MeanPressure(600.0 / length))
                .unwrap()
                .sliding(-1000.0, &[(1.0, time)])
                .unwrap(),
            1e-10,
        );
        assert!((back.friction + sliding.friction).abs() < 1e-7);
    }
}

/// `h = D cos(q x)`, `u = h`, `p_q = K D`, `K = (E* q/2) / (1 + f/(1 - i W))`.
#[test]
fn a_sine_in_full_contact_rubs_as_its_loss_modulus_says() {
    let (amplitude, creep, pressure_over): (f64, f64, f64) = (1e-3, 9.0, 1.5);
    let sine = Indenter::Sine { amplitude }.surface(Grid::line(512, 1.0).unwrap()).unwrap();
    for w in [0.1f64, 1.0, 10.0] {
        // 1 + f/(1 - i W) = a + i b
        let (a, b) = (1.0 + creep / (1.0 + w * w), creep * w / (1.0 + w * w));
        let stiffness = 0.5 * TAU / a.hypot(b);
        let pressure = pressure_over * stiffness * amplitude;
        let loss = 0.5 * TAU * amplitude * amplitude * (0.5 * TAU) * b / (a * a + b * b);
        let problem = Problem::new(sine.clone(), ContactModulus(1.0), Load::MeanPressure(pressure)).unwrap();
        let sliding = slide(&problem.sliding(w / TAU, &[(creep, 1.0)]).unwrap(), 1e-12);
        let exact = loss / pressure;
        assert_eq!(sliding.contact.counted().relative_area, 1.0);
        for found in [sliding.friction, sliding.full_contact] {
            assert!((found / exact - 1.0).abs() < 1e-12, "{w}: {found} against {exact}");
        }
        assert!(w != 1.0 || (exact / 1.326250e-3 - 1.0).abs() < 1e-6, "{exact}");
    }
}

/// Table of mu/(q D) by `W = q V tau` at `f = 9`, under a part of the pressure of full contact of the relaxed solid.
#[test]
fn a_sliding_sine_rubs_as_in_the_table() {
    let amplitude = 1e-3;
    let sine = Indenter::Sine { amplitude }.surface(Grid::line(512, 1.0).unwrap()).unwrap();
    let speeds = [0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0];
    let tables = [
        (0.2, [0.0081, 0.0768, 0.2037, 0.3840, 0.2402, 0.0787, 0.0079]),
        (0.5, [0.0067, 0.0662, 0.1881, 0.4587, 0.4286, 0.1545, 0.0157]),
    ];
    for (share, expected) in tables {
        for (w, expected) in speeds.into_iter().zip(expected) {
            let pressure = share * PI * amplitude / 10.0;
            let problem = Problem::new(sine.clone(), ContactModulus(1.0), Load::MeanPressure(pressure)).unwrap();
            let found = slide(&problem.sliding(w / TAU, &[(9.0, 1.0)]).unwrap(), 1e-10).friction / (TAU * amplitude);
            assert!((found / expected - 1.0).abs() < 0.02, "{share} {w}: {found} against {expected}");
        }
    }
}

fn rough(is_line: bool) -> Surface {
    let grid = if is_line { Grid::line(4096, 1.0) } else { Grid::surface([128, 128], [1.0, 1.0]) }.unwrap();
    let short_cutoff = if is_line { 0.005 } else { 0.05 };
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff, rms_gradient: 0.01 };
    Surface::rough(grid, &spectrum, 7).unwrap()
}

#[test]
fn slow_and_fast_slides_are_elastic() {
    for is_line in [true, false] {
        let rest = |modulus: f64| {
            let load = Load::MeanPressure(5e-5);
            Problem::new(rough(is_line), ContactModulus(modulus), load).unwrap()
        };
        for (speed, modulus) in [(0.0, 0.25), (1e-9, 0.25), (1e9, 1.0)] {
            let sliding = slide(&rest(1.0).sliding(speed, &[(1.0, 1.0), (2.0, 0.1)]).unwrap(), 1e-11);
            if is_line || speed == 0.0 || modulus < 1.0 {
                let elastic = solve(&Multilevel, &rest(modulus), 1e-11);
                let error = relative_l2(&sliding.contact.pressure, &elastic.pressure);
                assert!(error < 1e-4, "{is_line} {speed}: {error}");
            }
            assert!(sliding.friction.abs() < 1e-5, "{}", sliding.friction);
        }
    }
}

#[test]
fn rough_surfaces_rub_most_at_some_speed_and_persson_tells_about_where() {
    for is_line in [true, false] {
        let problem = |speed: f64| {
            let rest = Problem::new(rough(is_line), ContactModulus(1.0), Load::ReducedPressure(0.05)).unwrap();
            rest.sliding(speed, &[(9.0, 1.0)]).unwrap()
        };
        let slides = [1e-4, 0.03, 100.0].map(|speed| slide(&problem(speed), 1e-8));
        assert!(slides[1].friction > 3.0 * slides[0].friction.max(slides[2].friction) && slides[0].friction > 0.0);
        for sliding in slides {
            let ratio = sliding.persson / sliding.friction;
            assert!((0.2..5.0).contains(&ratio), "{ratio}");
            assert!(sliding.contact.certificate.mean_gap_error_bound.is_infinite());
            assert!(sliding.contact.certificate.pressure_error_bound < 1e-2);
            assert!(sliding.contact.stiffness().is_nan());
        }
    }
}

/// A ridge at an angle to the motion pushes the solid aside.
#[test]
fn ridges_at_an_angle_push_the_solid_aside() {
    let grid = Grid::surface([32, 32], [1.0, 1.0]).unwrap();
    let height = asperity::surface::Field::from_shape_fn((32, 32), |(y, x)| 1e-3 * (TAU * (x + y) as f64 / 32.0).cos());
    let problem =
        Problem::new(Surface::new(grid, height).unwrap(), ContactModulus(1.0), Load::MeanPressure(1e-3)).unwrap();
    let sliding = slide(&problem.sliding(0.3, &[(4.0, 1.0)]).unwrap(), 1e-10);
    assert!(sliding.friction > 0.0 && (sliding.lateral / sliding.friction - 1.0).abs() < 1e-6);
}

#[test]
fn mean_gaps_can_be_given() {
    let rest = Problem::new(rough(true), ContactModulus(1.0), Load::ReducedPressure(0.05)).unwrap();
    let moving = rest.sliding(0.03, &[(3.0, 1.0)]).unwrap();
    let contact = solve(&MonotoneSets, &moving, 1e-10);
    let apart = moving.with_load(Load::MeanGap(contact.mean_gap())).unwrap();
    assert!(apart.is_moving());
    let same: Contact = solve(&MonotoneSets, &apart, 1e-10);
    assert!((same.mean_pressure() / contact.mean_pressure() - 1.0).abs() < 1e-4);
}

#[test]
fn other_solvers_refuse_contacts_that_move() {
    let rest = Problem::new(rough(true), ContactModulus(1.0), Load::ReducedPressure(0.05)).unwrap();
    assert!(matches!(Sliding::solve(&rest, &Stop::default(), &mut ()), Err(MotionError::NeedsSliding)));
    let moving = rest.clone().sliding(1.0, &[(1.0, 1.0)]).unwrap();
    let solvers: [&dyn Solver; 3] = [&Multilevel, &PolonskyKeer, &Gfmd::default()];
    for solver in solvers {
        let error = solver.solve(&moving, &Stop::default(), &mut ()).unwrap_err();
        assert!(matches!(error, SolveError::NeedsRest { .. }) && error.is_input(), "{error}");
        assert!(error.to_string().contains("monotone"));
    }
    for (speed, terms) in [(f64::NAN, (1.0, 1.0)), (1.0, (-1.0, 1.0)), (1.0, (1.0, f64::INFINITY))] {
        assert!(rest.clone().sliding(speed, &[terms]).is_err());
    }
    let free = rough(true).grid().with_periodic([false; 2]);
    let free = Surface::new(free, rough(true).height().clone()).unwrap();
    let free = Problem::new(free, ContactModulus(1.0), Load::MeanPressure(1e-4)).unwrap();
    assert!(matches!(free.sliding(1.0, &[(1.0, 1.0)]), Err(ProblemError::NeedsPeriodic)));
}

/// The told error of the grid against a grid of eight times as many points, on contacts that were not used to choose it; and none at rest.
#[test]
fn friction_has_the_error_of_its_grid() {
    let mut ratios = Vec::new();
    for seed in 0..12_u32 {
        let speed = 10_f64.powf(-1.5 + 0.2 * f64::from(seed));
        let load = Load::MeanPressure(2e-4 * 1.5_f64.powf(f64::from(seed % 6)));
        // waves of one surface on both grids: five of them, with phases by the seed
        let on = |points: usize| {
            let grid = Grid::line(points, 1.0).unwrap();
            let wave = |x: f64, k: f64| 3e-3 / k.powf(1.3) * (TAU * k * x + f64::from(seed) * k * k).cos();
            let height = |(_, i): (usize, usize)| {
                let x = i as f64 / points as f64;
                [1.0, 2.0, 3.0, 5.0, 9.0].map(|k| wave(x, k)).iter().sum()
            };
            let heights = asperity::surface::Field::from_shape_fn(grid.shape(), height);
            let problem = Problem::new(Surface::new(grid, heights).unwrap(), ContactModulus(1.0), load).unwrap();
            slide(&problem.sliding(speed, &[(4.0, 1.0)]).unwrap(), 1e-9)
        };
        let (found, fine) = (on(128), on(1024));
        ratios.push((found.friction / fine.friction - 1.0).abs() / found.grid_error.unwrap());
        assert!(fine.grid_error.unwrap() < found.grid_error.unwrap(), "{seed}");
    }
    ratios.sort_by(f64::total_cmp);
    assert!(ratios[11] < 1.5 && ratios[6] > 1e-3, "{ratios:?}");
}

/// Waves of one length come in the order of rounding, which the unit of length changes.
#[test]
fn persson_s_friction_has_no_unit_of_length() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.1, rms_gradient: 0.05 };
    let shape = [48, 48];
    let heights = Surface::rough(Grid::surface(shape, [1.0; 2]).unwrap(), &spectrum, 5).unwrap().height().clone();
    let of = |unit: f64| {
        let surface = Surface::new(Grid::surface(shape, [unit; 2]).unwrap(), &heights * unit).unwrap();
        let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(3e-3)).unwrap();
        slide(&problem.sliding(0.1 * unit, &[(4.0, 1.0)]).unwrap(), 1e-8).persson
    };
    let one = of(1.0);
    for unit in [0.3, 1e-6, 7.7e3] {
        assert!((of(unit) / one - 1.0).abs() < 1e-10, "{unit}: {} for {one}", of(unit));
    }
}
