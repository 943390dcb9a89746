//! A trial: what is pressed, where the solver starts, how far it must come.

use super::verdict::Demand;
use crate::contact::{Contact, Each, Problem, Step, Stop};
use crate::error::SetupError;
use crate::lab::{Rival, Watch};
use crate::surface::Field;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// One contact to be solved, or refused.
pub struct Trial {
    /// Name in tables.
    pub name: String,
    /// The solvers to use if none is named.
    pub rivals: &'static [Rival],
    pub(super) tolerance: f64,
    pub(super) demand: Demand,
    pub(super) is_at_mean_gap: bool,
    pub(super) pose: Pose,
    /// The contact in other units, whose dimensionless results must be the same.
    pub(super) twin: Option<Pose>,
    /// Garbage in two of three values of the pressure to start from; the others are 0.
    pub(super) start: Option<f64>,
}

/// A function that poses a problem.
pub type Pose = Box<dyn Fn() -> Result<Problem, SetupError>>;

impl Trial {
    /// The contact that `pose` poses, to be solved from the flat start.
    pub(super) fn new(name: impl Into<String>, pose: impl Fn() -> Result<Problem, SetupError> + 'static) -> Self {
        Self {
            name: name.into(),
            rivals: Rival::USUAL,
            tolerance: 1e-8,
            demand: Demand::Solution,
            is_at_mean_gap: false,
            pose: Box::new(pose),
            twin: None,
            start: None,
        }
    }

    pub(super) fn demanding(self, demand: Demand) -> Self {
        Self { demand, ..self }
    }

    /// The trial to another certificate.
    pub(super) fn to(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// The demand on a solver: one that cannot take a mean gap must refuse it.
    pub fn demand_of(&self, rival: &Rival) -> Demand {
        if self.is_at_mean_gap && !rival.method.takes_mean_gap() { Demand::Refusal } else { self.demand }
    }

    /// Solves the contact, and the one that it must be like, if there is one, each until the step in which the budget runs out.
    pub(super) fn solve(
        &self,
        rival: &Rival,
        budget: Duration,
        watch: &mut Watch<'_>,
    ) -> Result<(Contact, Option<Contact>), SetupError> {
        let mut solve = |pose: &Pose| -> Result<Contact, SetupError> {
            let problem = pose()?;
            let stop = Stop::new(self.tolerance, 1_000_000)?;
            let start = self.start.map(|garbage| start(&problem, garbage));
            let clock = Instant::now();
            let is_over = || clock.elapsed() >= budget;
            let end = Each(|_: &Step<'_>| if is_over() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) });
            Ok(rival.method.solver().solve_from(start.as_ref(), &problem, &stop, &mut (watch(&self.name), end))?)
        };
        Ok((solve(&self.pose)?, self.twin.as_ref().map(solve).transpose()?))
    }
}

/// Garbage in two of three diagonals, nothing in the third.
fn start(problem: &Problem, garbage: f64) -> Field {
    Field::from_shape_fn(problem.surface().grid().shape(), |(y, x)| if (x + y) % 3 == 0 { 0.0 } else { garbage })
}
