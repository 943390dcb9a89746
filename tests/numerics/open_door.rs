//! A solver that is written outside the crate does all that the solvers of the crate do.

use crate::common::{relative_l2, solve, solvers};
use asperity::contact::{
    Certificate, Contact, ContactModulus, Each, Energy, Failure, Load, Multilevel, Observer, Run, Solver, Status, Step,
    Wish,
};
use asperity::error::SolveError;
use asperity::surface::{Field, Spectrum};
use asperity::{Grid, Indenter, Problem, Stop, Surface};
use std::ops::ControlFlow::{Break, Continue};

/// Projected gradients: `p <- max(p - tau g, 0)` with the step that is safe for every mode, then the load.
struct ProjectedGradient;

impl Solver for ProjectedGradient {
    fn name(&self) -> &str {
        "projected-gradient"
    }

    fn settings(&self) -> String {
        "the step that is safe for every mode".into()
    }

    fn solve_from(
        &self,
        start: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        let mean_pressure =
            problem.mean_pressure().ok_or_else(|| SolveError::NeedsPressure { solver: self.name().into() })?;
        let mut run = Run::begin(self, problem, stop, observer).with_patience(200);
        let mut half_space = problem.response();
        let tau = half_space.softest_stiffness();
        let (mut p, mut u) = (problem.first_pressure(start), vec![0.0; problem.nodes()]);
        let status = loop {
            half_space.displacement(&p, &mut u);
            let certificate = Certificate::from_displacement(problem, &p, &u);
            run.offer(&certificate, &p);
            let step = Step::new(problem, run.work(half_space.transforms()), &p, &u).with_certificate(certificate);
            if let Some(status) = run.show(&step) {
                break status;
            }
            let advanced: Vec<f64> = p.iter().zip(step.gap()).map(|(p, gap)| (p - tau * gap).max(0.0)).collect();
            drop(step);
            let scale = mean_pressure * advanced.len() as f64 / advanced.iter().sum::<f64>();
            p = advanced.into_iter().map(|p| scale * p).collect();
            run.advance();
        };
        Ok(run.finish(status, half_space))
    }
}

fn pressed(surface: Surface) -> Problem {
    Problem::new(surface, ContactModulus(2.0), Load::ReducedPressure(0.1)).unwrap()
}

fn sine() -> Problem {
    pressed(Indenter::Sine { amplitude: 0.02 }.surface(Grid::line(64, 1.0).unwrap()).unwrap())
}

fn problems() -> [Problem; 3] {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.1, rms_gradient: 0.01 };
    let wide = Grid::surface([24, 35], [1.0, 1.5]).unwrap();
    [
        sine(),
        pressed(Surface::rough(Grid::line(127, 1.0).unwrap(), &spectrum, 3).unwrap()),
        pressed(Indenter::Sphere { radius: 2.0 }.surface(wide).unwrap()),
    ]
}

/// The solvers of the crate and the one of this file.
fn all_solvers() -> Vec<Box<dyn Solver>> {
    let mut all = solvers();
    all.push(Box::new(ProjectedGradient));
    all
}

/// Counts what it sees.
#[derive(Debug, Default, Clone, PartialEq)]
struct Tally {
    begun: Vec<String>,
    steps: usize,
    ended: Vec<Status>,
}

impl Observer for Tally {
    fn begin(&mut self, solver: &dyn Solver, problem: &Problem, stop: &Stop) -> Result<(), Failure> {
        self.begun.push(format!("{}, {} nodes, {}", solver.name(), problem.nodes(), stop.tolerance()));
        Ok(())
    }

    fn step(&mut self, _: &Step<'_>) -> Wish {
        self.steps += 1;
        Ok(Continue(()))
    }

    fn end(&mut self, contact: &Contact) -> Result<(), Failure> {
        self.ended.push(contact.status);
        Ok(())
    }
}

#[test]
fn it_finds_the_contact_and_is_certified() {
    for problem in problems() {
        let contact = solve(&ProjectedGradient, &problem, 1e-10);
        let expected = solve(&Multilevel, &problem, 1e-12);
        let difference = relative_l2(&contact.pressure, &expected.pressure);
        assert!(difference < 1e-4, "{:?}: {difference}", problem.surface().grid());
        assert_eq!(contact.solver, "projected-gradient");
        assert!(contact.certificate.eta <= 1e-10 && contact.certificate.load_error < 1e-12);
        assert_eq!(Certificate::new(&problem, contact.pressure.as_slice().unwrap()), contact.certificate);
        // a pair at every step, the first included, and one for the contact
        assert_eq!(contact.work.transforms as usize, 2 * (contact.work.iterations + 2));
        assert!((contact.counted().relative_area - expected.counted().relative_area).abs() < 0.02);
    }
}

#[test]
fn it_goes_on_from_any_start() {
    let [problem, ..] = problems();
    let solution = solve(&ProjectedGradient, &problem, 1e-10).pressure;
    let stop = Stop::new(1e-9, 10).unwrap();
    let again = ProjectedGradient.solve_from(Some(&solution), &problem, &stop, &mut ()).unwrap();
    assert_eq!((again.status, again.work.iterations), (Status::Converged, 0));
}

#[test]
fn its_steps_tell_what_those_of_others_tell() {
    let problem = sine();
    let mut indices = Vec::new();
    let mut watch = Each(|step: &Step<'_>| {
        indices.push(step.index());
        assert_eq!((step.phase().level, step.phase().outer, step.phase().inner), (0, step.index(), 0));
        assert!(matches!(step.energy(), Energy::Complementary(energy) if energy <= 0.0));
        assert!(step.certificate().is_some() && step.patches().count() >= 1);
        assert!((step.gap().iter().sum::<f64>() / 64.0 - step.mean_gap()).abs() < 1e-12);
        Continue(())
    });
    let contact = ProjectedGradient.solve(&problem, &Stop::default(), &mut watch).unwrap().converged().unwrap();
    assert_eq!(indices, (0..=contact.work.iterations).collect::<Vec<_>>());
}

#[test]
fn every_composed_observer_sees_all_of_every_run() {
    let problem = sine();
    for solver in all_solvers() {
        let (mut lent, mut last) = (Tally::default(), Tally::default());
        let mut several = vec![Some(Tally::default()), None, Some(Tally::default())];
        let mut watch = (&mut lent, (&mut several, Box::new(Tally::default())), &mut last);
        let contact = solver.solve(&problem, &Stop::default(), &mut watch).unwrap();
        let expected = Tally {
            begun: vec![format!("{}, 64 nodes, {}", solver.name(), 1e-8)],
            steps: contact.work.iterations + 1,
            ended: vec![Status::Converged],
        };
        let boxed = *watch.1.1;
        let all = several.into_iter().flatten().chain([boxed, lent, last]);
        assert_eq!(all.collect::<Vec<_>>(), vec![expected; 5], "{}", solver.settings());
    }
}

#[test]
fn it_stops_at_the_cap_where_it_stalls_and_when_it_is_told_to() {
    let [_, problem, _] = problems();
    let ended = |stop: Stop, watch: &mut dyn Observer| {
        let contact = ProjectedGradient.solve(&problem, &stop, watch).unwrap();
        assert!(contact.certificate.eta.is_finite() && contact.certificate.load_error < 1e-12);
        let (status, iterations) = (contact.status, contact.work.iterations);
        assert!(matches!(contact.converged(), Err(SolveError::NotConverged { solver, reason, .. })
            if solver == "projected-gradient" && reason == status.to_string()));
        (status, iterations)
    };
    assert_eq!(ended(Stop::new(1e-8, 7).unwrap(), &mut ()), (Status::IterationCap, 7));
    assert_eq!(ended(Stop::new(1e-30, 1_000_000).unwrap(), &mut ()).0, Status::Stalled);
    let mut enough = Each(|step: &Step<'_>| if step.index() == 3 { Break(()) } else { Continue(()) });
    let mut tally = Tally::default();
    assert_eq!(ended(Stop::default(), &mut (&mut enough, &mut tally)), (Status::StoppedByObserver, 3));
    assert_eq!((tally.steps, tally.ended), (4, vec![Status::StoppedByObserver]));
}

#[test]
fn it_says_what_it_cannot_take_on() {
    let apart = sine().with_load(Load::MeanGap(0.01)).unwrap();
    let refused = ProjectedGradient.solve(&apart, &Stop::default(), &mut ()).unwrap_err();
    assert!(refused.to_string().starts_with("projected-gradient needs a given mean pressure"), "{refused}");
}

/// The moments at which an observer can fail.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Moment {
    Begin,
    Step(usize),
    End,
}

/// An observer whose disk is full at some moment.
struct Faulty(Moment);

impl Faulty {
    fn at(&self, now: Moment) -> Result<(), Failure> {
        if self.0 == now { Err("the disk is full: make room on it".into()) } else { Ok(()) }
    }
}

impl Observer for Faulty {
    fn begin(&mut self, _: &dyn Solver, _: &Problem, _: &Stop) -> Result<(), Failure> {
        self.at(Moment::Begin)
    }

    fn step(&mut self, step: &Step<'_>) -> Wish {
        self.at(Moment::Step(step.index())).map(Continue)
    }

    fn end(&mut self, _: &Contact) -> Result<(), Failure> {
        self.at(Moment::End)
    }
}

#[test]
fn an_observer_that_fails_ends_the_run_with_its_sentence_and_the_contact_comes_back() {
    let problem = sine();
    for solver in all_solvers() {
        for (moment, status) in [
            (Moment::Begin, Status::ObserverFailed),
            (Moment::Step(0), Status::ObserverFailed),
            (Moment::Step(3), Status::ObserverFailed),
            (Moment::End, Status::Converged),
        ] {
            let mut tally = Tally::default();
            let contact = solver.solve(&problem, &Stop::default(), &mut (Faulty(moment), &mut tally)).unwrap();
            let what = format!("{} at {moment:?}", solver.settings());
            assert_eq!((contact.status, tally.ended.as_slice()), (status, [status].as_slice()), "{what}");
            if let Moment::Step(last) = moment {
                assert_eq!((contact.work.iterations, tally.steps), (last, last + 1), "{what}");
            }
            assert!(contact.certificate.eta.is_finite() && contact.certificate.load_error < 1e-12, "{what}");
            let failure = contact.failure.clone().unwrap();
            assert_eq!(failure.to_string(), "the disk is full: make room on it", "{what}");
            let error = contact.converged().unwrap_err();
            assert!(matches!(error, SolveError::Observer(_)), "{what}");
            assert_eq!(error.to_string(), failure.to_string(), "{what}");
        }
    }
}

#[test]
fn a_failure_counts_before_a_wish_and_before_convergence() {
    let problem = sine();
    let solution = solve(&ProjectedGradient, &problem, 1e-10).pressure;
    for start in [None, Some(&solution)] {
        let mut wish = Each(|_: &Step<'_>| Break(()));
        let mut both = (&mut wish, Faulty(Moment::Step(0)));
        let contact = ProjectedGradient.solve_from(start, &problem, &Stop::default(), &mut both).unwrap();
        assert_eq!(contact.status, Status::ObserverFailed);
        assert!(contact.failure.is_some());
    }
}

/// Shows the uniform pressure with a certificate that it has not.
struct Boaster;

impl Solver for Boaster {
    fn name(&self) -> &str {
        "boaster"
    }

    fn settings(&self) -> String {
        "none".into()
    }

    fn solve_from(
        &self,
        start: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        let mut run = Run::begin(self, problem, stop, observer);
        let p = problem.first_pressure(start);
        let boast = Certificate { eta: 0.0, eta_gap: 0.0, pressure_error_bound: 0.0, ..Certificate::new(problem, &p) };
        run.offer(&boast, &p);
        let status = run.show(&Step::new(problem, run.work(0), &p, &vec![0.0; p.len()]).with_certificate(boast));
        let half_space = problem.response();
        Ok(run.finish(status.unwrap_or(Status::Converged), half_space))
    }
}

#[test]
fn what_a_solver_says_of_its_convergence_is_checked() {
    let contact = Boaster.solve(&sine(), &Stop::default(), &mut ()).unwrap();
    assert!(contact.certificate.eta > 0.1, "{}", contact.certificate.eta);
    assert_eq!(contact.status, Status::Stalled);
    assert!(contact.converged().is_err());
}

/// The bound of the pressure as much as `eta`.
#[test]
fn what_a_solver_says_of_any_goal_is_checked() {
    let [coarse, fine] = [1e-6, 1e-12].map(|tolerance| {
        let stop = Stop::new(tolerance, 100_000).unwrap();
        Multilevel.solve(&sine(), &stop, &mut ()).unwrap().converged().unwrap()
    });
    let stop = Stop::new(1e-6, 10).unwrap().with_pressure_tolerance(1e-5).unwrap();
    let boasted = |start| Boaster.solve_from(Some(start), &sine(), &stop, &mut ()).unwrap();
    let missed = boasted(&coarse.pressure);
    assert!(missed.certificate.eta <= 1e-6 && missed.certificate.pressure_error_bound > 1e-5);
    assert_eq!(missed.status, Status::Stalled);
    assert!(missed.converged().unwrap_err().to_string().contains("and a relative error of the pressure of at most"));
    assert_eq!(boasted(&fine.pressure).status, Status::Converged);
}
