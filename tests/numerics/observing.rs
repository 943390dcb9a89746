//! Watching costs nothing that is not asked for, changes nothing, and can end a run.

use crate::common::solvers;
use asperity::contact::{
    ContactModulus, Each, Energy, Gfmd, Load, Multilevel, PolonskyKeer, Problem, Solver, Status, Step, Stop,
};
use asperity::error::SolveError;
use asperity::surface::Spectrum;
use asperity::{Grid, Surface};
use std::ops::ControlFlow;

fn rough() -> Problem {
    let spectrum = Spectrum { hurst: 0.5, rolloff_wavelength: 0.2, short_cutoff: 0.02, rms_gradient: 0.01 };
    let surface = Surface::rough(Grid::line(1024, 1.0).unwrap(), &spectrum, 3).unwrap();
    Problem::new(surface, ContactModulus(2.0), Load::ReducedPressure(0.05)).unwrap()
}

fn rough_surface() -> Problem {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.1, rms_gradient: 0.01 };
    let surface = Surface::rough(Grid::surface([128, 96], [1.0, 1.0]).unwrap(), &spectrum, 3).unwrap();
    Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.1)).unwrap()
}

#[test]
fn every_step_is_shown_once_and_in_order() {
    let problem = rough();
    for solver in solvers() {
        let mut indices = Vec::new();
        let mut transforms = 0;
        let mut watch = Each(|step: &Step<'_>| {
            indices.push(step.index());
            assert!(step.transforms() >= transforms);
            transforms = step.transforms();
            ControlFlow::Continue(())
        });
        let contact = solver.solve(&problem, &Stop::default(), &mut watch).unwrap().converged().unwrap();
        assert_eq!(indices, (0..=contact.work.iterations).collect::<Vec<_>>(), "{}", solver.settings());
        assert!(contact.work.transforms >= transforms);
    }
}

#[test]
fn a_watched_run_is_the_unwatched_run() {
    let problem = rough();
    for solver in solvers() {
        let plain = solver.solve(&problem, &Stop::default(), &mut ()).unwrap().converged().unwrap();
        let mut curious = Each(|step: &Step<'_>| {
            let asked = step.gap().len() + step.patches().count() + step.counted().contact_nodes;
            assert!(asked > 0 && step.energy().value().is_finite() && step.mean_gap().is_finite());
            ControlFlow::Continue(())
        });
        let watched = solver.solve(&problem, &Stop::default(), &mut curious).unwrap().converged().unwrap();
        assert_eq!(plain.pressure, watched.pressure, "{}", solver.settings());
        assert_eq!(plain.work.transforms, watched.work.transforms, "{}", solver.settings());
    }
}

#[test]
fn the_last_step_tells_what_the_result_tells() {
    let problem = rough();
    for solver in solvers() {
        let mut last = None;
        let mut watch = Each(|step: &Step<'_>| {
            last = Some((step.counted().kappa_r, step.mean_gap(), step.patches().clone(), step.energy().value()));
            ControlFlow::Continue(())
        });
        let contact =
            solver.solve(&problem, &Stop::new(1e-12, 100_000).unwrap(), &mut watch).unwrap().converged().unwrap();
        let (kappa_r, mean_gap, patches, energy) = last.unwrap();
        assert_eq!(kappa_r, contact.counted().kappa_r, "{}", solver.settings());
        assert!((mean_gap / contact.mean_gap() - 1.0).abs() < 1e-6, "{}", solver.settings());
        assert_eq!(patches, contact.patches());
        let heights = contact.displacement.iter().zip(problem.height());
        let complementary: f64 = contact.pressure.iter().zip(heights).map(|(p, (u, h))| p * (0.5 * u - h)).sum();
        let scale = problem.expected_mean_pressure() * problem.rms_height() * contact.pressure.len() as f64;
        assert!((energy.abs() / (complementary / scale).abs() - 1.0).abs() < 1e-6, "{}: {energy}", solver.settings());
    }
}

/// The gap of every step has the datum where `<p g> = 0`, whichever solver shows it, on every level.
#[test]
fn all_solvers_show_the_gap_with_one_datum() {
    for problem in [rough(), rough_surface()] {
        for solver in solvers() {
            let mut watch = Each(|step: &Step<'_>| {
                let (load, pg) = step
                    .pressure()
                    .iter()
                    .zip(step.gap())
                    .fold((0.0, 0.0), |(load, pg), (p, gap)| (load + p, pg + p * gap));
                let unit = load * step.problem().rms_height();
                assert!(load > 0.0 && f64::abs(pg) < 1e-12 * unit, "{} at {}: {pg}", solver.name(), step.index());
                ControlFlow::Continue(())
            });
            solver.solve(&problem, &Stop::default(), &mut watch).unwrap().converged().unwrap();
        }
    }
}

/// Strong duality: at the solution the energies of methods that move the pressure and of methods that move the surface have
/// one magnitude and opposite signs.
#[test]
fn complementary_and_potential_energy_meet() {
    for problem in [rough(), rough_surface()] {
        let (mut complementary, mut potential) = (Vec::new(), Vec::new());
        for solver in solvers() {
            let mut last = None;
            let mut watch = Each(|step: &Step<'_>| {
                last = Some(step.energy());
                ControlFlow::Continue(())
            });
            let stop = Stop::new(1e-12, 100_000).unwrap();
            solver.solve(&problem, &stop, &mut watch).unwrap().converged().unwrap();
            match last.unwrap() {
                Energy::Complementary(energy) => complementary.push(energy),
                Energy::Potential(energy) => potential.push(energy),
            }
        }
        assert_eq!((complementary.len(), potential.len()), (2, 4));
        for least in complementary {
            assert!(least < -0.1, "{least}");
            for energy in &potential {
                assert!((energy / least + 1.0).abs() < 1e-6, "{energy} against {least}");
            }
        }
    }
}

#[test]
fn an_observer_ends_a_run_with_what_it_has() {
    let problem = rough();
    for solver in solvers() {
        let mut enough = Each(|step: &Step<'_>| match step.index() {
            5 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        });
        let contact = solver.solve(&problem, &Stop::default(), &mut enough).unwrap();
        assert_eq!((contact.status, contact.work.iterations), (Status::StoppedByObserver, 5));
        assert!(contact.certificate.load_error < 1e-12 && contact.certificate.min_pressure >= 0.0);
    }
}

#[test]
fn the_cap_ends_a_run_with_the_best_state_which_is_not_converged() {
    let problem = rough();
    for solver in solvers() {
        let best = solver.solve(&problem, &Stop::new(1e-8, 2).unwrap(), &mut ()).unwrap();
        assert_eq!((best.status, best.work.iterations), (Status::IterationCap, 2));
        assert!(best.certificate.eta > 1e-8 && best.certificate.eta.is_finite(), "{:?}", best.certificate);
        let (name, eta) = (best.solver.clone(), best.certificate.eta);
        let missed = best.converged().expect_err("2 steps are too few");
        assert!(matches!(missed, SolveError::NotConverged { solver, iterations: 2, certificate, .. }
            if solver == name && certificate == eta));
    }
}

#[test]
fn a_tolerance_below_rounding_is_said_to_be_out_of_reach() {
    let problem = rough();
    for solver in [&PolonskyKeer as &dyn Solver, &Gfmd::default(), &Multilevel] {
        let stop = Stop::new(1e-30, 1_000_000).unwrap();
        let best = solver.solve(&problem, &stop, &mut ()).unwrap();
        assert_eq!(best.status, Status::Stalled);
        assert!(best.certificate.eta < 1e-12, "{:?}", best.certificate);
        assert!(best.converged().is_err());
    }
}

/// One transform pair per iteration of conjugate gradients, one more when the contact set has changed, and one in the end.
#[test]
fn polonsky_keer_pays_a_pair_per_iteration_and_one_per_change_of_the_set() {
    let problem = rough();
    let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut ()).unwrap().converged().unwrap();
    let pairs = contact.work.transforms as usize / 2;
    assert!(pairs > contact.work.iterations && pairs <= 2 * contact.work.iterations + 2, "{:?}", contact.work);
}

/// One pair per step, and the thinning checks of the certificate.
#[test]
fn gfmd_pays_a_pair_per_step() {
    let contact = Gfmd::default().solve(&rough(), &Stop::default(), &mut ()).unwrap().converged().unwrap();
    let pairs = contact.work.transforms as usize / 2;
    assert!(pairs as f64 <= 1.5 * contact.work.iterations as f64 + 50.0, "{:?}", contact.work);
}
