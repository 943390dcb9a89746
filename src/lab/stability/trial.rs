//! A trial: what is pressed, where the solver starts, how far it must come.

use super::verdict::Demand;
use crate::contact::{Contact, Each, Load, Problem, Step, Stop};
use crate::error::SetupError;
use crate::lab::{ObserverMaker, Rival};
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
    pub(super) is_below_hardness: bool,
    pub(super) is_free: bool,
    /// The solver that may run out of its budget.
    pub(super) slow: Option<Rival>,
    pub(super) pose: Pose,
    /// The bound of the relative error of the pressure to reach as well.
    pub(super) pressure_tolerance: Option<f64>,
    pub(super) twin: Option<EquivalentContact>,
    /// Garbage in two of three values of the pressure to start from; the others are 0.
    pub(super) start: Option<f64>,
}

/// Another contact that must come to the same end.
pub(crate) enum EquivalentContact {
    /// The contact in other units, whose dimensionless results must be the same.
    InOtherUnits(Pose),
    /// The contact of a mean gap under the mean pressure that was found, which must open to the same mean gap.
    UnderItsLoad,
}

/// A function that poses a problem.
pub(crate) type Pose = Box<dyn Fn() -> Result<Problem, SetupError>>;

impl Trial {
    /// The contact that `pose` poses, to be solved from the flat start.
    pub(super) fn new(name: impl Into<String>, pose: impl Fn() -> Result<Problem, SetupError> + 'static) -> Self {
        Self {
            name: name.into(),
            rivals: Rival::USUAL,
            tolerance: 1e-8,
            pressure_tolerance: None,
            demand: Demand::Solution,
            is_at_mean_gap: false,
            is_below_hardness: false,
            is_free: false,
            slow: None,
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

    /// The demand on a solver: one that cannot take a mean gap, a free boundary or a hardness must refuse it.
    pub fn demand_of(&self, rival: &Rival) -> Demand {
        match self.demand {
            _ if self.is_at_mean_gap && !rival.method.takes_mean_gap() => Demand::Refusal,
            _ if self.is_free && !rival.method.takes_free_boundary() => Demand::Refusal,
            _ if self.is_below_hardness && !rival.method.takes_hardness() => Demand::Refusal,
            Demand::Solution if self.slow.as_ref() == Some(rival) => Demand::Budget,
            demand => demand,
        }
    }

    /// Solves the contact, and the one that it must be like, if there is one, each until the step in which the budget runs out.
    pub(super) fn solve(
        &self,
        rival: &Rival,
        budget: Duration,
        watch: ObserverMaker,
    ) -> Result<(Contact, Option<Contact>), SetupError> {
        let stop = Stop::new(self.tolerance, 1_000_000)?;
        let stop = self.pressure_tolerance.map_or(Ok(stop), |tolerance| stop.with_pressure_tolerance(tolerance))?;
        let solve = |problem: Problem, stop: Stop| -> Result<Contact, SetupError> {
            let start = self.start.map(|garbage| start(&problem, garbage));
            let clock = Instant::now();
            let is_over = || clock.elapsed() >= budget;
            let end = Each(|_: &Step<'_>| if is_over() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) });
            Ok(rival.method.solver().solve_from(start.as_ref(), &problem, &stop, &mut (watch(&self.name), end))?)
        };
        let contact = solve((self.pose)()?, stop)?;
        let twin = match &self.twin {
            None => None,
            Some(EquivalentContact::InOtherUnits(pose)) => Some(solve(pose()?, stop)?),
            Some(EquivalentContact::UnderItsLoad) => {
                let (problem, stop) = under_its_load(&contact, &stop)?;
                Some(solve(problem, stop)?)
            }
        };
        Ok((contact, twin))
    }
}

/// The problem of a contact under the mean pressure that was found, and a stop by which its mean gap is known to a tenth of what it
/// may differ by from the one that was given.
fn under_its_load(contact: &Contact, stop: &Stop) -> Result<(Problem, Stop), SetupError> {
    let problem = &contact.problem;
    let left = problem.mean_gap().map_or(problem.rms_height(), |gap| gap.min(problem.highest() - gap));
    let tolerance = (0.1 * stop.gap_tolerance() * left / problem.rms_height()).min(stop.tolerance());
    let problem = problem.clone().with_load(Load::MeanPressure(contact.mean_pressure()))?;
    Ok((problem, Stop::new(tolerance, stop.max_iterations())?))
}

/// Garbage in two of three diagonals, nothing in the third.
fn start(problem: &Problem, garbage: f64) -> Field {
    Field::from_shape_fn(problem.surface().grid().shape(), |(y, x)| if (x + y) % 3 == 0 { 0.0 } else { garbage })
}
