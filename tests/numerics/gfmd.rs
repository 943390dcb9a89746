//! Green's function molecular dynamics: its energy, and the steps that its masses cost.

use crate::common::solve;
use asperity::contact::{ContactModulus, Dynamics, Each, Energy, Gfmd, Load, Masses, Problem, Solver, Step, Stop};
use asperity::surface::Spectrum;
use asperity::{Grid, Indenter, Surface};
use std::ops::ControlFlow;

fn rough_line(points: usize) -> Problem {
    let spectrum =
        Spectrum { hurst: 0.2, rolloff_wavelength: 0.125, short_cutoff: 32.0 / points as f64, rms_gradient: 1e-3 };
    let surface = Surface::rough(Grid::line(points, 1.0).unwrap(), &spectrum, 1).unwrap();
    Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.1)).unwrap()
}

fn steps(masses: Masses, dynamics: Dynamics, points: usize) -> usize {
    solve(&Gfmd { masses, dynamics, ..Gfmd::default() }, &rough_line(points), 1e-8).work.iterations
}

#[test]
fn uniform_masses_crawl_on_long_lines_and_masses_proportional_to_stiffness_do_not() {
    for dynamics in [Dynamics::Damped, Dynamics::Fire] {
        let steps = |masses| [1 << 10, 1 << 14].map(|points| steps(masses, dynamics, points));
        let [short, long] = steps(Masses::Stiffness);
        assert!(long < 2 * short && long < 600, "{dynamics:?}: {short} to {long} steps");
        if dynamics == Dynamics::Damped {
            let [short, long] = steps(Masses::Uniform);
            assert!(long > 3 * short, "{short} to {long} steps");
        }
    }
}

/// Before it moves the surface is flat and touches the highest peak: its potential energy is `<p> max(h)`.
#[test]
fn potential_energy_starts_at_the_peak_and_falls() {
    let surface = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(128, 1.0).unwrap()).unwrap();
    let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(0.01)).unwrap();
    let mut energies = Vec::new();
    let mut watch = Each(|step: &Step<'_>| {
        let Energy::Potential(energy) = step.energy() else { panic!("gfmd moves the surface") };
        energies.push(energy);
        ControlFlow::Continue(())
    });
    let contact = Gfmd::default().solve(&problem, &Stop::default(), &mut watch).unwrap().converged().unwrap();
    assert!((energies[0] - 0.01 / problem.rms_height()).abs() < 1e-12, "{}", energies[0]);
    let last = energies[contact.work.iterations];
    assert!(energies.iter().all(|&energy| energy >= last - 1e-7) && last < energies[0]);
    assert!(energies.windows(2).take(50).all(|pair| pair[1] < pair[0]));
}

#[test]
fn friction_does_not_lower_the_stable_time_step() {
    let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(64, 4.0).unwrap()).unwrap();
    let problem = Problem::new(cylinder, ContactModulus(1.0), Load::MeanPressure(1e-2)).unwrap();
    for masses in [Masses::Uniform, Masses::Stiffness] {
        for damping in [0.3, 1.0, 10.0] {
            let solver = Gfmd { masses, dynamics: Dynamics::Damped, time_step: 0.99, damping };
            let contact = solver.solve(&problem, &Stop::default(), &mut ()).unwrap();
            assert!(contact.is_converged(), "{masses:?}, damping {damping}: {}", contact.status);
        }
    }
}
