//! Green's function molecular dynamics: damped dynamics of the surface modes against a hard wall.
//!
//! Letters of this file: `w = u + d` the surface of the solid in the frame of the indenter, `h` the indenter, `k = E* q / 2`
//! the stiffness of a mode, `m` its mass, `s = dt^2 / m` of the stiffest mode, `f` the net force, `a` the advance that the
//! forces make in a step, `dw` the last advance of `w`, `p` the constraint forces of the wall.

mod moving;
mod pace;
mod probe;
mod relaxation;
mod settings;

use crate::contact::{Contact, Observer, Problem, Run, Solver, Stop};
use crate::error::SolveError;
use crate::surface::Field;
use moving::Moving;
use probe::Probe;

pub(crate) use pace::Pace;
pub use relaxation::Relaxation;
pub use settings::{Dynamics, Gfmd, Masses};

impl Solver for Gfmd {
    fn name(&self) -> &str {
        "gfmd"
    }

    fn settings(&self) -> String {
        let masses = match self.masses {
            Masses::Uniform => "uniform masses",
            Masses::Stiffness => "masses proportional to mode stiffness",
        };
        let dynamics = match self.dynamics {
            Dynamics::Damped => format!("damping {} of critical", self.damping),
            Dynamics::Fire => "FIRE".into(),
        };
        format!("{masses}, {dynamics}, time step {} of the stability limit", self.time_step)
    }

    fn relaxation(&self, problem: &Problem) -> Option<Relaxation> {
        Relaxation::new(self, problem)
    }

    fn solve_from(
        &self,
        start: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        if problem.is_moving() {
            return Err(SolveError::NeedsRest { solver: self.name().into() });
        }
        if problem.datum().is_some() {
            return Err(SolveError::NeedsPressure { solver: self.name().into() });
        }
        if !problem.compliance().is_diagonal() {
            return Err(SolveError::NeedsWaves { solver: self.name().into() });
        }
        if problem.ceiling().is_finite() {
            return Err(SolveError::NeedsHardWall { solver: self.name().into() });
        }
        let mut run = Run::begin(self, problem, stop, observer);
        let mut surface = Moving::new(start, problem, self.masses);
        let mut probe = Probe::new(problem);
        let mut pace = Pace::new(self, &surface.response.stiffnesses().collect::<Vec<_>>());
        let status = loop {
            surface.pull();
            let certificate = probe.certify(problem, &surface.p, &mut run);
            let work = run.work(surface.response.transforms() + probe.response.transforms());
            if let Some(status) = run.show(&surface.step(work, certificate).with_decision(pace.decision())) {
                break status;
            }
            surface.advance(&mut pace);
            run.advance();
        };
        let transforms = surface.response.transforms() + probe.response.transforms();
        drop(surface);
        Ok(run.finish_after(status, transforms, probe.into_response()))
    }
}
