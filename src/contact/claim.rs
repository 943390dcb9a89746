//! The claim of a result: what its certificate proves.

use crate::contact::Contact;
use serde::Serialize;
use strum::{EnumMessage, EnumString, IntoStaticStr};

/// The claim of a result: what its certificate proves about energy, pressure and mean gap.
///
/// ```
/// use asperity::contact::{ContactModulus, Load, MonotoneSets, ResultClaim, Solver};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(64, 1.0)?)?;
/// let rest = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.01))?;
/// let moving = rest.clone().sliding(1.0, &[(1.0, 1.0)])?;
/// let claims = [rest, moving].map(|problem| MonotoneSets.solve(&problem, &Stop::default(), &mut ()).map(|it| it.claim()));
/// assert_eq!([claims[0].clone()?, claims[1].clone()?], [ResultClaim::Solution, ResultClaim::Bounded]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, EnumMessage, EnumString, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum ResultClaim {
    /// The solution of a convex problem: energy, pressure and mean gap are bounded.
    #[strum(message = "the solution: energy, pressure and mean gap are bounded")]
    Solution,
    /// The solution of a load step of a solid that yields: contact and flow are those of one least energy, after the steps before.
    #[strum(
        message = "the solution of each load step: its distance from the least energy is bounded, on this grid and these layers"
    )]
    LoadStep,
    /// Slip along a path whose steps are not exact: each of them is the solution of a convex problem, and the error by their length is estimated.
    #[strum(
        message = "the solution of each step of the path: pressure and mean gap are bounded; shift and lost energy have estimated errors by the steps"
    )]
    PathSteps,
    /// Slip along a path in given steps that are not exact, whose error is not known.
    #[strum(
        message = "the solution of each given step of the path: pressure and mean gap are bounded; the error of shift and lost energy by these steps is not known"
    )]
    GivenSteps,
    /// The solution of a monotone problem without an energy, of a contact that moves: only the pressure is bounded.
    #[strum(message = "bounded: the error of the pressure is bounded, and no energy belongs to the contact")]
    Bounded,
    /// Rounds between pressure and traction that have converged: the pressure is certified for this traction, and the traction for
    /// this pressure, but not both together.
    #[strum(
        message = "rounds converged: the pressure is certified for this traction, and the traction for this pressure, but not both together"
    )]
    RoundsConverged,
    /// Converged rounds in each step of a path whose steps are not exact: the error by their length is estimated.
    #[strum(
        message = "rounds converged in each step of the path: the pressure is certified for this traction, and the traction for this pressure, but not both together; shift and lost energy have estimated errors by the steps"
    )]
    RoundsOfPathSteps,
    /// Converged rounds in each given step of a path, of which the error by the steps is not known.
    #[strum(
        message = "rounds converged in each given step of the path: the pressure is certified for this traction, and the traction for this pressure, but not both together; the error of shift and lost energy by these steps is not known"
    )]
    RoundsOfGivenSteps,
    /// A state with adhesion that is in equilibrium and stable; there may be others.
    #[strum(
        message = "stable: in equilibrium, and small changes do not grow; other states may exist under the same load"
    )]
    Stable,
    /// A state with adhesion that is in equilibrium and close to a jump.
    #[strum(message = "marginal: in equilibrium, but close to a jump, so that its stability is not certain")]
    Marginal,
    /// A state with adhesion that is in equilibrium and not stable.
    #[strum(message = "saddle: in equilibrium, but a small change grows")]
    Saddle,
    /// A state with adhesion that is in equilibrium; its stability is not known.
    #[strum(message = "stationary: in equilibrium; its stability is not known")]
    Stationary,
    /// A frame on the way to the next state, which is not in equilibrium: of a motion with adhesion, or an iteration of a solid that yields.
    #[strum(message = "moving: not in equilibrium; the surfaces are on their way to the next state")]
    Moving,
    /// A contact or a state that was not found: the best one, which misses the tolerance.
    #[strum(message = "not converged: the tolerance is missed, so that nothing is claimed")]
    NotConverged,
    /// The attraction does not hold the load, and the surfaces have parted.
    #[strum(message = "separated: the attraction does not hold this load, and the surfaces have parted")]
    Separated,
    /// Nothing is claimed of a state that was read from a file, which does not confirm it or does not have what a check needs.
    #[strum(message = "unchecked: the state was read from a file that does not confirm it")]
    Unchecked,
}

impl ResultClaim {
    /// The claim of a contact that may have missed its tolerance: nothing, where it has, of what is solved for.
    pub(super) fn if_converged(self, contact: &Contact) -> Self {
        let is_solved_for = matches!(
            self,
            Self::Solution
                | Self::LoadStep
                | Self::PathSteps
                | Self::GivenSteps
                | Self::Bounded
                | Self::RoundsConverged
                | Self::RoundsOfPathSteps
                | Self::RoundsOfGivenSteps
        );
        if is_solved_for && !contact.is_converged() { Self::NotConverged } else { self }
    }

    /// The claim in words.
    pub fn words(self) -> &'static str {
        self.get_message().unwrap_or_default()
    }
}

impl Contact {
    /// The claim of this contact: the solution, or, for a contact that moves, a bounded error of the pressure. A contact that is not converged
    /// claims nothing.
    pub fn claim(&self) -> ResultClaim {
        if self.problem.is_moving() { ResultClaim::Bounded } else { ResultClaim::Solution }.if_converged(self)
    }
}
