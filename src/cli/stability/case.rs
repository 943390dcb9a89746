//! A case: what is pressed, where the solver starts, how far it must come.

use super::budget::Budget;
use super::verdict::Demand;
use crate::cli::contender::Contender;
use crate::cli::progress::Progress;
use anyhow::Result;
use asperity::contact::Contact;
use asperity::error::SolveError;
use asperity::surface::Field;
use asperity::{Problem, Stop};
use std::time::Duration;

/// The certificate to reach where nothing else is said.
const TOLERANCE: f64 = 1e-8;
/// Iterations at the most, besides the budget in seconds.
const MAX_ITERATIONS: usize = 1_000_000;

/// One contact to be solved, or refused.
pub struct Case {
    pub name: String,
    /// The solvers to use if none is named.
    pub methods: &'static [Contender],
    demand: Demand,
    is_at_mean_gap: bool,
    pub tolerance: f64,
    pose: Pose,
    twin: Option<Pose>,
    start: Option<f64>,
}

type Pose = Box<dyn Fn() -> Result<Problem>>;

/// A problem with what a solver returned.
pub struct Solved {
    pub problem: Problem,
    pub contact: Contact,
}

impl Case {
    /// The contact that `pose` poses, to be solved from the flat start.
    pub fn new(name: impl Into<String>, pose: impl Fn() -> Result<Problem> + 'static) -> Self {
        Self {
            name: name.into(),
            methods: Contender::USUAL,
            demand: Demand::Solution,
            is_at_mean_gap: false,
            tolerance: TOLERANCE,
            pose: Box::new(pose),
            twin: None,
            start: None,
        }
    }

    /// The same, with another end demanded.
    pub fn demanding(self, demand: Demand) -> Self {
        Self { demand, ..self }
    }

    /// The same, to another certificate.
    pub fn to(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// The same, of a problem at a mean gap.
    pub fn at_mean_gap(self) -> Self {
        Self { is_at_mean_gap: true, ..self }
    }

    /// The same by other solvers.
    pub fn by(self, methods: &'static [Contender]) -> Self {
        Self { methods, ..self }
    }

    /// The same, from a pressure of which every other value is `garbage`, and the others are 0 or as much.
    pub fn from(self, garbage: f64) -> Self {
        Self { start: Some(garbage), ..self }
    }

    /// The same, whose dimensionless results must be those of the contact that `pose` poses.
    pub fn like(self, pose: impl Fn() -> Result<Problem> + 'static) -> Self {
        Self { twin: Some(Box::new(pose)), ..self }
    }

    /// What is demanded of a method: molecular dynamics must refuse a mean gap.
    pub fn demand_of(&self, method: Contender) -> Demand {
        if self.is_at_mean_gap && method.needs_pressure() { Demand::Refusal } else { self.demand }
    }

    /// Poses the problem and solves it.
    pub fn solve(&self, method: Contender, budget: Duration) -> Result<Solved> {
        self.solve_posed((self.pose)()?, method, budget)
    }

    /// The same of the contact that it must be like, if there is one.
    pub fn solve_twin(&self, method: Contender, budget: Duration) -> Result<Option<Solved>> {
        self.twin.as_ref().map(|pose| self.solve_posed(pose()?, method, budget)).transpose()
    }

    fn solve_posed(&self, problem: Problem, method: Contender, budget: Duration) -> Result<Solved> {
        let stop = Stop::new(self.tolerance, MAX_ITERATIONS)?;
        let start = self.start.map(|garbage| start(&problem, garbage));
        let mut progress = Progress::new(self.tolerance, &self.name);
        let mut watch = (&mut progress, &mut Budget::new(budget));
        let solver = method.solver()?;
        let contact = solver.solve_from(start.as_ref(), &problem, &stop, &mut watch);
        Ok(Solved { contact: contact.or_else(SolveError::into_contact)?, problem })
    }
}

/// Garbage in two of three rows or nodes, nothing in the others.
fn start(problem: &Problem, garbage: f64) -> Field {
    Field::from_shape_fn(problem.surface().grid().shape(), |(y, x)| if (x + y) % 3 == 0 { 0.0 } else { garbage })
}
