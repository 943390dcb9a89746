//! The places of a history with adhesion, and the energies between them.

use crate::adhesion::{AdhesiveControl, AdhesiveOutcome, AdhesiveState, Attraction};
use crate::contact::{ResultClaim, Work};
use crate::error::AdhesionError;
use std::sync::Arc;

/// Steps are compared with an earlier one if their lengths differ by at most this factor.
const COMPARABLE: f64 = 10.0;

/// A place on the path.
#[derive(Clone)]
pub(super) enum AdhesivePlace {
    State(Arc<AdhesiveState>),
    /// The surfaces have parted.
    Apart,
}

/// The energies of a history with adhesion from its beginning to a place, per area of the cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct AdhesionLedger {
    /// Energy lost in jumps.
    lost: f64,
    /// Work of the load: on a branch the change of the energy.
    work: f64,
    /// The sum of the differences between the integral of the pressure over the datum and the change of the energy, of all steps on branches.
    missed: f64,
    /// The sum of the energies that jumps may have lost more or less, since their places are known to a step only.
    spread: f64,
    /// Whether the surfaces have been apart under a load: it works without a limit there, so that no energies are known from then on.
    is_open: bool,
    /// The lowest mean pressure of all places on the way, also of those that are not shown; infinite before the first one.
    lowest: f64,
}

impl Default for AdhesionLedger {
    fn default() -> Self {
        Self { lost: 0.0, work: 0.0, missed: 0.0, spread: 0.0, is_open: false, lowest: f64::INFINITY }
    }
}

/// Where a step leads.
pub(super) struct AdhesiveStep {
    pub place: AdhesivePlace,
    /// The frames of the motion, with the method `gfmd`.
    pub frames: Vec<AdhesiveState>,
    pub work: Work,
}

/// A place on the path, with the energies up to it: what a state of the history is made of.
pub(super) struct AdhesiveVisit {
    pub place: AdhesivePlace,
    pub control: AdhesiveControl,
    pub ledger: AdhesionLedger,
    /// The energy lost in the jump that ends here.
    pub jump: Option<f64>,
    pub work: Work,
    pub branch: Branch,
}

/// The last steps on the branch of states that leads to a place.
#[derive(Clone, Default)]
pub(super) struct Branch {
    /// The state before, on the same branch.
    pub past: Option<Arc<AdhesiveState>>,
    /// Half the second derivative of the conjugate quantity in the last step.
    pub bend: Option<f64>,
    /// The length of a step that is short enough here; none if it is not known.
    pub length: Option<f64>,
}

/// The energies of a step from one state to another, per area.
pub(super) struct EnergyBalance {
    /// Energy that is lost; infinite where the surfaces part.
    pub lost: f64,
    /// The energy of the attraction in the state that has more of it.
    pub held: f64,
    /// Half the second derivative of the conjugate quantity.
    pub bend: Option<f64>,
    /// By how much the correction of the integral differs from that with the bend of the step before.
    pub swerve: f64,
    /// By how much the energy rises, without that of a uniform displacement.
    pub rise: f64,
    /// By how much the energy of the uniform displacement rises.
    uniform_rise: f64,
    /// Whether both states are the solutions of convex problems.
    pub is_convex: bool,
    /// Half the rectangle of the changes of datum and pressure: what a jump somewhere in the step may lose more or less.
    spread: f64,
}

impl EnergyBalance {
    /// The balance of a step whose work is not known.
    fn unknown(lost: f64) -> Self {
        Self { lost, held: 0.0, bend: None, swerve: 0.0, rise: 0.0, uniform_rise: 0.0, is_convex: false, spread: 0.0 }
    }
}

impl AdhesionLedger {
    /// Adds a step on a branch, which loses nothing: what the integral misses is its error.
    pub(crate) fn add_smooth(&mut self, step: &EnergyBalance) {
        self.work += step.rise + step.uniform_rise;
        self.missed += if step.is_convex { 0.0 } else { step.lost };
    }

    /// Adds a step that jumps.
    pub(crate) fn add_jump(&mut self, step: &EnergyBalance) {
        if step.lost.is_finite() {
            self.lost += step.lost;
            self.work += step.rise + step.uniform_rise + step.lost;
            self.spread += step.spread;
        }
    }

    /// The ledger at a place.
    pub(crate) fn at(self, place: &AdhesivePlace) -> Self {
        // a place without a state ends what holds, and its load is not carried
        let lowest = place.state().map_or(self.lowest, |state| self.lowest.min(state.mean_pressure));
        Self { is_open: self.is_open || matches!(place, AdhesivePlace::Apart), lowest, ..self }
    }

    /// The lowest mean pressure so far; none if there was no state yet.
    pub(crate) fn lowest(&self) -> Option<f64> {
        Some(self.lowest).filter(|lowest| lowest.is_finite())
    }

    /// The energy lost so far, of jumps that are shown and of smaller ones, as far as it is known.
    pub(crate) fn counted(&self) -> f64 {
        self.lost
    }

    /// The energy lost; none where the surfaces have been apart under a load.
    pub(crate) fn lost(&self) -> Option<f64> {
        self.known(self.lost)
    }

    /// The work of the load; none where the surfaces have been apart under it.
    pub(crate) fn work(&self) -> Option<f64> {
        self.known(self.work)
    }

    /// The estimated error of the energy lost.
    pub(crate) fn error(&self) -> Option<f64> {
        self.known(self.spread + self.missed.abs())
    }

    fn known(&self, energy: f64) -> Option<f64> {
        (!self.is_open).then_some(energy)
    }
}

impl AdhesiveStep {
    /// The step after which the surfaces are still apart.
    pub(crate) fn apart() -> Self {
        Self { place: AdhesivePlace::Apart, frames: Vec::new(), work: Work::default() }
    }
}

impl From<AdhesiveOutcome> for AdhesiveStep {
    fn from(outcome: AdhesiveOutcome) -> Self {
        let (place, work) = match outcome {
            AdhesiveOutcome::State(state) => {
                let work = state.work;
                (AdhesivePlace::State(Arc::new(state)), work)
            }
            AdhesiveOutcome::Separated { work } => (AdhesivePlace::Apart, work),
        };
        Self { place, frames: Vec::new(), work }
    }
}

impl AdhesiveVisit {
    /// A place at which no jump ends, without a step before it.
    pub(crate) fn first(place: AdhesivePlace, control: AdhesiveControl, work: Work) -> Self {
        let ledger = AdhesionLedger::default().at(&place);
        Self { place, control, ledger, jump: None, work, branch: Branch::default() }
    }

    /// This visit under another control. A control of another kind (a gap instead of a pressure) forgets the way to the place, since lengths along a branch
    /// are those of its control.
    pub(crate) fn under(self, control: AdhesiveControl) -> Self {
        let is_same = std::mem::discriminant(&self.control) == std::mem::discriminant(&control);
        let branch = if is_same { self.branch } else { Branch::default() };
        Self { control, branch, ..self }
    }

    /// The visit without its work, as the beginning of the next step.
    pub(crate) fn kept(&self) -> Self {
        Self { place: self.place.clone(), work: Work::default(), branch: self.branch.clone(), ..*self }
    }
}

impl AdhesivePlace {
    /// The error of a state that misses equilibrium by more than the tolerance.
    pub(crate) fn fault(&self) -> Option<AdhesionError> {
        let state = self.state().filter(|state| state.claim == ResultClaim::NotConverged)?;
        Some(AdhesionError::NotFound { steps: state.steps, residual: state.residual })
    }

    /// The state; none where the surfaces have parted.
    pub(crate) fn state(&self) -> Option<&Arc<AdhesiveState>> {
        match self {
            Self::State(state) => Some(state),
            Self::Apart => None,
        }
    }
}

impl Branch {
    /// The balance of a step from one place of the branch to another.
    ///
    /// With the energy `E = 1/2 <p u> + <V>`, the mean pressure `P` and the datum `d` of the gap, a step from state 0 to state 1 loses
    ///
    /// `E_0 - E_1 + W`, `W = -int P dd`.
    ///
    /// Here `W` is that of the parabola through the last two states and the new one: `P` over `d`, or, under a mean pressure, `d` over `P`.
    /// Without an earlier state on the branch it is that of the trapezoid.
    pub(crate) fn balance(&self, from: &AdhesivePlace, to: &AdhesivePlace, attraction: &Attraction) -> EnergyBalance {
        let (before, after) = match (from, to) {
            (AdhesivePlace::State(before), AdhesivePlace::State(after)) => (before, after),
            (AdhesivePlace::State(_), AdhesivePlace::Apart) => {
                return EnergyBalance::unknown(f64::INFINITY);
            }
            // where surfaces that have parted come together, they come from afar
            (AdhesivePlace::Apart, _) => return EnergyBalance::unknown(0.0),
        };
        let trapezoid = -0.5 * (before.mean_pressure + after.mean_pressure) * (after.datum - before.datum);
        let [start, end] = [before, after].map(|state| conjugates(state));
        let bend = self.bend_to(start, end);
        let sign = if matches!(after.control, AdhesiveControl::MeanPressure(_)) { -1.0 } else { 1.0 };
        let length = end[0] - start[0];
        let correction = |bend: f64| sign * bend * length.powi(3) / 6.0;
        let rise = after.energy - before.energy;
        EnergyBalance {
            lost: trapezoid + correction(bend.unwrap_or(0.0)) - rise,
            held: [before, after].map(|state| held(state, attraction)).into_iter().fold(0.0, f64::max),
            bend,
            swerve: correction(bend.zip(self.bend).map_or(0.0, |(bend, last)| bend - last)),
            rise,
            uniform_rise: (after.stored() - before.stored()) - rise,
            is_convex: [before, after].iter().all(|state| state.claim == ResultClaim::Solution),
            spread: 0.5 * (length * (end[1] - start[1])).abs(),
        }
    }

    /// Half the second derivative of the conjugate quantity, by the last two states of the branch and a new one. On the way back the new
    /// one may be an old one again, and the last bend holds.
    fn bend_to(&self, start: [f64; 2], end: [f64; 2]) -> Option<f64> {
        let past = conjugates(self.past.as_ref()?);
        let (step, last, both) = (end[0] - start[0], start[0] - past[0], end[0] - past[0]);
        if !self.is_comparable(step / last) {
            return None;
        }
        if both.abs() < step.abs().min(last.abs()) / COMPARABLE {
            return self.bend;
        }
        Some(((end[1] - start[1]) / step - (start[1] - past[1]) / last) / both)
    }

    /// How far the conjugate quantity of a place beyond another one is from that of the other, or from the line through the last two states,
    /// whichever is more; none where this is not known.
    pub(crate) fn change_beyond(&self, from: &AdhesivePlace, to: &AdhesivePlace) -> Option<f64> {
        let [past, start, end] = [self.past.as_ref()?, from.state()?, to.state()?].map(|state| conjugates(state));
        let slope = (start[1] - past[1]) / (start[0] - past[0]);
        let change = end[1] - start[1];
        let bent = change - slope * (end[0] - start[0]);
        Some(change.abs().max(bent.abs())).filter(|change| change.is_finite())
    }

    fn is_comparable(&self, share: f64) -> bool {
        share.abs() >= 1.0 / COMPARABLE && share.abs() <= COMPARABLE
    }

    /// The state at another control on the line through the last two states, if there are two: where a smooth branch goes on.
    pub(crate) fn carried_on(&self, from: &AdhesiveState, control: AdhesiveControl) -> Option<AdhesiveState> {
        let past = self.past.as_ref()?;
        let share = (control.value() - from.control.value()) / (from.control.value() - past.control.value());
        self.is_comparable(share).then(|| from.carried_on(past, share))
    }
}

/// The independent quantity of a state and its conjugate: datum and mean pressure, or, under a mean pressure, both in turn.
fn conjugates(state: &AdhesiveState) -> [f64; 2] {
    match state.control {
        AdhesiveControl::MeanPressure(_) => [state.mean_pressure, state.datum],
        AdhesiveControl::MeanGap(_) | AdhesiveControl::Approach(_) => [state.datum, state.mean_pressure],
    }
}

/// The energy that the attraction holds a state with.
fn held(state: &AdhesiveState, attraction: &Attraction) -> f64 {
    let gap = &state.contact.gap;
    -gap.iter().map(|gap| attraction.energy(*gap)).sum::<f64>() / gap.len() as f64
}

/// The work of `all` without that of a part of it.
pub(super) fn less(all: Work, part: Work) -> Work {
    Work {
        iterations: all.iterations - part.iterations,
        transforms: all.transforms - part.transforms,
        seconds: all.seconds - part.seconds,
    }
}
