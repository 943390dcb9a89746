//! A state of a contact with adhesion.

use super::control::AdhesiveControl;
use crate::contact::{Contact, ResultClaim, Work};
use crate::surface::Field;

/// A state of a contact with adhesion.
///
/// | field                  | shape      | unit     | meaning                                                   |
/// |------------------------|------------|----------|-----------------------------------------------------------|
/// | `contact.pressure`     | `(ny, nx)` | pressure | `p_c >= 0`, where the surfaces touch                      |
/// | `traction`             | `(ny, nx)` | pressure | `sigma(g) >= 0`, by which the surfaces attract each other |
/// | `contact.displacement` | `(ny, nx)` | length   | `A (p_c - sigma)`, into the solid                         |
/// | `contact.gap`          | `(ny, nx)` | length   | `g >= 0`                                                  |
///
/// The certificate of `contact` is that of a contact without adhesion and says nothing here; [`AdhesiveState::residual`] and
/// [`AdhesiveState::claim`] do. Its status says whether the residual met its goal; frames of a motion count as converged. Its area counts the
/// nodes that touch: edges are not resolved.
#[derive(Debug, Clone)]
pub struct AdhesiveState {
    /// What was prescribed.
    pub control: AdhesiveControl,
    /// The fields of the contact, on the surface of the problem.
    pub contact: Contact,
    /// The attraction.
    pub traction: Field,
    /// The mean pressure `P = <p_c> - <sigma>`, negative where the surfaces are pulled apart.
    pub mean_pressure: f64,
    /// The datum `d` of the gap `u - h + d`.
    pub datum: f64,
    /// The elastic energy and that of the attraction, per area; without the load, and without what the uniform displacement stores where the
    /// displacement does not contain it, see [`AdhesiveState::stored`].
    pub energy: f64,
    /// The largest violation of equilibrium at a node: a pressure over the strength of the attraction. With the safe method, and where the
    /// rounding of elastic stress is larger than the tolerance of that, it is the largest displacement that the violation causes, over the range.
    pub residual: f64,
    /// The least curvature of the energy over that of the softest wave of the solid: where it is positive, the state is stable. It is
    /// none on free boundaries, where it is not computed, and where all nodes touch.
    pub least_curvature: Option<f64>,
    /// The error of the least curvature: the curvature has an eigenvalue that is at most so far away.
    pub curvature_error: Option<f64>,
    /// What is claimed of the state.
    pub claim: ResultClaim,
    /// The method that found it.
    pub method: &'static str,
    /// Iterations: steps of the method, and those of the contacts without adhesion that it solves.
    pub steps: usize,
    /// Work done.
    pub work: Work,
}

impl AdhesiveState {
    /// The share of nodes that touch.
    pub fn relative_area(&self) -> f64 {
        self.contact.counted().relative_area
    }

    /// The mean gap, a length.
    pub fn mean_gap(&self) -> f64 {
        self.contact.mean_gap()
    }

    /// The stored energy per area, pressure times length: that of the solid and of the attraction. On a layer that of the uniform displacement by the
    /// mean pressure, `c P^2 / 2` with the compliance `c` of a uniform pressure, is a part of it under any control. It changes without a loss, as that
    /// of a spring in series.
    pub fn stored(&self) -> f64 {
        self.energy + self.contact.uniform_energy()
    }

    /// The state moved on from an earlier one, by a share of the way between both: an estimate, with the gap and the datum of a smooth branch.
    pub(crate) fn carried_on(&self, past: &Self, share: f64) -> Self {
        let mut carried = self.clone();
        let gap = carried.contact.gap.iter_mut().zip(&past.contact.gap);
        gap.for_each(|(gap, past)| *gap = (*gap + share * (*gap - past)).max(0.0));
        carried.datum += share * (self.datum - past.datum);
        carried
    }

    /// The energy with that of the load, per area, which a step under this control lowers: `P d` is added under a mean pressure.
    pub fn potential(&self) -> f64 {
        match self.control {
            AdhesiveControl::MeanPressure(pressure) => self.energy + pressure * self.datum,
            _ => self.energy,
        }
    }
}

/// A damped motion of the surface, from a state to the next one.
#[derive(Debug, Clone)]
pub struct AdhesiveMotion {
    /// States on the way, with the claim [`ResultClaim::Moving`]. Some node has moved by a tenth of the range of the attraction from one frame
    /// to the next, or the area has changed by 1 % of the nodes; by a multiple of both in a long motion.
    pub frames: Vec<AdhesiveState>,
    /// What the motion ends with.
    pub outcome: AdhesiveOutcome,
}

impl AdhesiveMotion {
    /// A motion has fewer frames.
    pub const MOST_FRAMES: usize = 120;
}

/// What a solve with adhesion ends with.
#[derive(Debug, Clone)]
#[expect(clippy::large_enum_variant, reason = "nearly all outcomes are states")]
pub enum AdhesiveOutcome {
    /// A state.
    State(AdhesiveState),
    /// The attraction does not hold the load: the surfaces part for good.
    Separated {
        /// The work until this was known.
        work: Work,
    },
}
