//! Constrained conjugate gradients where nodes enter and leave in turns.

use asperity::contact::{ContactModulus, Each, Load, PolonskyKeer, Solver, Step};
use asperity::surface::{Field, Spectrum};
use asperity::{Grid, Problem, Stop, Surface};
use std::ops::ControlFlow;

/// A block of nodes over flat ground.
fn block(shape: [usize; 2], width: usize) -> Surface {
    let height = Field::from_shape_fn(shape, |(y, x)| if y < width && x < width { 1.0 } else { 0.0 });
    Surface::new(Grid::surface(shape, [1.0, 1.0]).unwrap(), height).unwrap()
}

fn pressed(surface: Surface, reduced_pressure: f64) -> Problem {
    Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(reduced_pressure)).unwrap()
}

#[test]
fn blocks_over_flat_ground_do_not_trap_it() {
    for (shape, width) in [([51, 28], 1), ([51, 28], 2), ([64, 64], 1), ([64, 64], 2), ([7, 90], 1)] {
        for reduced_pressure in [8e-3, 9e-3, 1e-2, 1.2e-2, 1.5e-2, 2e-2, 5e-2] {
            let problem = pressed(block(shape, width), reduced_pressure);
            let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut ()).unwrap().converged();
            assert!(contact.is_ok(), "{shape:?} {width} {reduced_pressure}: {}", contact.unwrap_err());
        }
    }
}

#[test]
fn the_energy_does_not_rise_when_the_contact_changes() {
    let problem = pressed(block([51, 28], 1), 2e-2);
    let (mut before, mut energy, mut changes) = (Vec::new(), 0.0, 0);
    let mut watch = Each(|step: &Step<'_>| {
        let now = step.energy().value();
        let contact: Vec<bool> = step.pressure().iter().map(|&p| p > 0.0).collect();
        if step.index() > 0 && contact != before {
            assert!(now <= energy + 1e-12, "{energy} to {now} at {}", step.index());
            changes += 1;
        }
        (before, energy) = (contact, now);
        ControlFlow::Continue(())
    });
    PolonskyKeer.solve(&problem, &Stop::default(), &mut watch).unwrap();
    assert!(changes > 3);
}

/// Under light loads and a tolerance that nobody meets the run stalls; what comes back is the best state that it has shown.
#[test]
fn a_stalled_run_returns_its_best_state() {
    for (seed, reduced_pressure) in [(1, 1e-10), (2, 1e-7), (3, 1e-4), (4, 1e-2)] {
        let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.02, rms_gradient: 0.1 };
        let surface = Surface::rough(Grid::line(256, 1.0).unwrap(), &spectrum, seed).unwrap();
        let mut best = f64::INFINITY;
        let mut watch = Each(|step: &Step<'_>| {
            best = step.certificate().map_or(best, |certificate| best.min(certificate.eta));
            ControlFlow::Continue(())
        });
        let stop = Stop::new(1e-30, 20_000).unwrap();
        let contact = PolonskyKeer.solve(&pressed(surface, reduced_pressure), &stop, &mut watch).unwrap();
        let (found, rounding) = (contact.certificate.eta, contact.certificate.rounding);
        assert!(
            !contact.is_converged() && found <= 2.0 * best + rounding,
            "{found:e} after {best:e} at {reduced_pressure}"
        );
    }
}
