//! Runs made to be slow, each in its own way: the diagnosis names the cause.

use asperity::contact::{
    Certificate, Contact, ContactModulus, Dynamics, Each, Gfmd, Load, Masses, Multilevel, Observer, PolonskyKeer, Run,
    Solver, Status, Step,
};
use asperity::diagnosis::{Cause, Diagnosis, Findings, Reference, Ritz};
use asperity::error::SolveError;
use asperity::surface::{Field, Spectrum};
use asperity::{Grid, Indenter, Problem, Stop, Surface};
use std::ops::ControlFlow;
use std::sync::Arc;

fn rough_line(points: usize) -> Problem {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.125, short_cutoff: 0.01, rms_gradient: 1e-3 };
    let surface = Surface::rough(Grid::line(points, 1.0).unwrap(), &spectrum, 1).unwrap();
    Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.05)).unwrap()
}

/// The diagnosis of a run that knows its end, and the contact.
fn diagnosed(solver: &dyn Solver, problem: &Problem, stop: &Stop) -> (Findings, Contact) {
    let end = solver.solve(problem, stop, &mut ()).unwrap();
    let mut diagnosis = Diagnosis::new(problem, Some(Arc::new(Reference::from_contact(&end))));
    let contact = solver.solve(problem, stop, &mut diagnosis).unwrap();
    assert_eq!(contact.pressure, end.pressure, "the second pass is not the first");
    (diagnosis.findings(), contact)
}

#[test]
fn uniform_masses_are_named_with_the_longest_waves() {
    let problem = rough_line(2048);
    let (diagnosis, contact) = diagnosed(&Gfmd::default(), &problem, &Stop::default());
    assert!(contact.is_converged());
    let causes = &diagnosis.causes;
    let Cause::Masses { condition, .. } = causes[0] else { panic!("{diagnosis}") };
    assert!((condition / 1024.0 - 1.0).abs() < 1e-9, "{condition}");
    let other = Gfmd { masses: Masses::Stiffness, dynamics: Dynamics::Fire, ..Gfmd::default() };
    let (diagnosis, fast) = diagnosed(&other, &problem, &Stop::default());
    assert!(fast.work.iterations < contact.work.iterations / 2);
    assert!(!diagnosis.causes.iter().any(|cause| matches!(cause, Cause::Masses { .. } | Cause::Damping { .. })));
}

#[test]
fn a_damping_far_from_critical_is_named_and_the_rate_is_that_of_theory() {
    let problem = rough_line(512);
    let usual = diagnosed(&Gfmd::default(), &problem, &Stop::default()).1.work.iterations;
    for factor in [0.03, 30.0] {
        let stop = Stop::new(1e-6, 100_000).unwrap();
        let (diagnosis, contact) = diagnosed(&Gfmd { damping: factor, ..Gfmd::default() }, &problem, &stop);
        assert!(contact.work.iterations > usual);
        let causes = &diagnosis.causes;
        let Cause::Damping { damping, rate, best } = causes[0] else { panic!("{factor}: {diagnosis}") };
        assert!((damping / factor - 1.0).abs() < 0.02 && rate < best / 5.0, "{diagnosis}");
        if factor < 1.0 {
            // waves that swing shrink alike, whether the contact holds them or not
            let measured = causes.iter().find_map(|cause| match cause {
                Cause::SlowBand { rate, .. } => Some(*rate),
                _ => None,
            });
            let measured = measured.unwrap_or_else(|| panic!("{diagnosis}"));
            assert!((measured / rate - 1.0).abs() < 0.3, "{measured} for {rate}");
        }
    }
}

/// Projected gradients with a step that is too long for short waves.
struct TooLong;

impl Solver for TooLong {
    fn name(&self) -> &str {
        "too-long"
    }

    fn settings(&self) -> String {
        "projected gradients with steps of twice the stable length".into()
    }

    fn solve_from(
        &self,
        _: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        let mut run = Run::begin(self, problem, stop, observer);
        let mut half_space = problem.response();
        let mean = problem.mean_pressure().unwrap();
        let mut p = vec![mean; problem.nodes()];
        let mut u = vec![0.0; problem.nodes()];
        let status = loop {
            half_space.displacement(&p, &mut u);
            let certificate = Certificate::from_displacement(problem, &p, &u);
            run.offer(&certificate, &p);
            let step = Step::new(problem, run.work(half_space.transforms()), &p, &u).with_certificate(certificate);
            if let Some(status) = run.show(&step) {
                break status;
            }
            let gap = step.gap().to_vec();
            drop(step);
            let length = 4.0 * half_space.softest_stiffness();
            p.iter_mut().zip(&gap).for_each(|(p, g)| *p = (*p - length * g).max(0.0));
            let sum: f64 = p.iter().sum();
            p.iter_mut().for_each(|p| *p *= mean * u.len() as f64 / sum);
            run.advance();
        };
        Ok(run.finish(status, half_space))
    }
}

#[test]
fn a_set_that_goes_in_circles_is_named() {
    let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(128, 1.0).unwrap()).unwrap();
    let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.01)).unwrap();
    let (diagnosis, contact) = diagnosed(&TooLong, &problem, &Stop::new(1e-8, 500).unwrap());
    assert_ne!(contact.status, Status::Converged);
    let Cause::Cycle { period, rounds, nodes, .. } = diagnosis.causes[0] else { panic!("{diagnosis}") };
    assert!(period == 2 && rounds > 100 && nodes > 0, "{diagnosis}");
}

#[test]
fn a_tolerance_below_rounding_is_named_for_each_solver() {
    let problem = rough_line(1024);
    let stop = Stop::new(1e-20, 20_000).unwrap();
    for solver in [&Multilevel as &dyn Solver, &PolonskyKeer] {
        let (diagnosis, contact) = diagnosed(solver, &problem, &stop);
        assert!(!contact.is_converged(), "{}", solver.name());
        let causes = &diagnosis.causes;
        let Cause::Rounding { eta, rounding, .. } = causes[0] else { panic!("{}: {diagnosis}", solver.name()) };
        assert!(eta <= rounding && rounding < 1e-10, "{eta} {rounding}");
    }
}

#[test]
fn a_run_without_trouble_is_not_blamed() {
    let (diagnosis, contact) = diagnosed(&Multilevel, &rough_line(4096), &Stop::default());
    assert!(contact.is_converged());
    let is_blame = |cause: &Cause| !matches!(cause, Cause::SlowBand { .. });
    assert!(!diagnosis.causes.iter().any(is_blame), "{diagnosis}");
    let standing = diagnosis.standing.unwrap();
    assert!(standing.kappa_r <= standing.steps && standing.relative_area <= standing.steps);
}

/// In full contact the set stays, and conjugate gradients see the compliance of all waves of the sine: one.
#[test]
fn ritz_values_of_a_solver_are_those_of_its_operator() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 1.0 / 17.0, rms_gradient: 1e-3 };
    let surface = Surface::rough(Grid::line(64, 1.0).unwrap(), &spectrum, 1).unwrap();
    let problem = Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(20.0)).unwrap();
    let (mut ritz, mut ends): (_, Option<[f64; 2]>) = (Ritz::default(), None);
    let mut watch = Each(|step: &Step<'_>| {
        if let Some([low, high]) = ritz.add(step.decision()) {
            let [lowest, highest] = ends.unwrap_or([f64::INFINITY, 0.0]);
            ends = Some([low.min(lowest), high.max(highest)]);
        }
        ControlFlow::Continue(())
    });
    PolonskyKeer.solve(&problem, &Stop::new(1e-14, 1000).unwrap(), &mut watch).unwrap();
    let [low, high] = ends.unwrap();
    // the compliance 2 / q of the longest and of the shortest wave in the heights, waves 1 and 16
    let expected = [2.0 / (std::f64::consts::TAU * 16.0), 2.0 / std::f64::consts::TAU];
    assert!(
        (low / expected[0] - 1.0).abs() < 0.02 && (high / expected[1] - 1.0).abs() < 0.02,
        "{low} {high} for {expected:?}"
    );
}
