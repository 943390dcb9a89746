//! The states of a run with several: loads, creep, slip, sliding, rolling or adhesion.

use super::posed::Posed;
use super::yielding::warnings_of_yielding;
use crate::adhesion::AdhesionScales;
use crate::contact::{
    FieldKind, Observables, Problem, Quantity, ResultClaim, State, warning_of_friction, warning_of_trail, warnings_of,
    warnings_of_contact, warnings_of_states,
};
use crate::error::{ConflictRule, FileError, HistoryError, SetupError};
use crate::history::{AdhesionTotals, CycleLoss, LEAST_LOSS, LEAST_SHIFT, cycle_losses, open_cycles};
use crate::setup::{ProcessKind, Setup, warning_of_leakage};
use crate::warning::Warning;
use serde::Serialize;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Errors in time of the pressure of states with less than this part of the largest mean pressure are not compared with the tolerance, and those of the
/// gap are divided by at least this part of the rms height.
const SMALL: f64 = 1e-2;

/// A process zone of fewer spacings gets a warning.
const FEW_SPACINGS: f64 = 4.0;

/// An error of the grid above this part gets a warning.
const LARGE_GRID_ERROR: f64 = 0.02;

/// The states of a history, and what they add up to.
#[derive(Debug)]
pub struct HistoryOutcome {
    /// The process.
    pub kind: ProcessKind,
    /// The attraction and what came of it, with adhesion.
    pub adhesion: Option<AdhesionOutcome>,
    /// The states, in their order.
    pub states: Vec<Arc<State>>,
    /// Why the history ended before its path did, if it did: an observer that stopped it, such as Ctrl-C, or a failure.
    pub ended: Option<HistoryError>,
    /// Why a recording, table or archive of the states could not be written, if it could not.
    pub failure: Option<FileError>,
    /// Doubts about what the setup says.
    doubts: Vec<Warning>,
}

/// The attraction of a history with adhesion, and what came of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AdhesionOutcome {
    /// Work of adhesion, an energy per area.
    pub work: f64,
    /// Range of the attraction, a length.
    pub range: f64,
    /// How the attraction compares with surface and solid.
    #[serde(flatten)]
    pub scales: AdhesionScales,
    /// Pull-off, jumps and energies.
    #[serde(flatten)]
    pub totals: AdhesionTotals,
}

impl AdhesionOutcome {
    fn new(setup: &Setup, problem: &Problem, states: &[Arc<State>]) -> Result<Option<Self>, SetupError> {
        let (Some(adhesion), Some(totals)) = (&setup.adhesion, AdhesionTotals::new(states)) else { return Ok(None) };
        let attraction = adhesion.attraction()?;
        let scales = AdhesionScales::new(problem, &attraction);
        Ok(Some(Self { work: attraction.work(), range: attraction.range(), scales, totals }))
    }
}

impl HistoryOutcome {
    /// The history of states that were found before, such as those of a file.
    ///
    /// # Errors
    /// For a setup without a history, and for an attraction that cannot be.
    pub fn from_states(setup: &Setup, problem: &Problem, states: Vec<Arc<State>>) -> Result<Self, SetupError> {
        let kind = setup.process()?.ok_or(ConflictRule::NoHistory)?;
        Self::from_posed(&Posed { run: 0, setup, problem, kind, loads: &[] }, states)
    }

    pub(super) fn from_posed(posed: &Posed<'_>, states: Vec<Arc<State>>) -> Result<Self, SetupError> {
        let Posed { setup, problem, kind, .. } = *posed;
        let adhesion = AdhesionOutcome::new(setup, problem, &states)?;
        let doubts = setup.warnings_of_creep();
        let outcome = Self { kind, adhesion, states, ended: None, failure: None, doubts };
        let outcome = outcome.with_time_errors(setup).with_path_errors(setup);
        Ok(outcome.with_open_cycles(setup).with_doubts_of_yielding(setup))
    }

    /// The history, with a reason to doubt it where errors in time are above the tolerance: those of all quantities that it limits.
    fn with_time_errors(mut self, setup: &Setup) -> Self {
        let (tolerance, count) = (setup.time_tolerance(), self.states.len());
        let mut above = Vec::new();
        for (name, errors) in [
            ("contact pressure", self.pressure_time_errors()),
            ("mean gap", self.gap_time_errors()),
            ("lost energy", self.loss_time_errors()),
        ] {
            let missed = errors.iter().filter(|error| **error > tolerance).count();
            let largest = errors.iter().copied().fold(0.0, f64::max);
            if missed > 0 {
                above.push(format!("of the {name} in {missed} of {count} states (largest {largest:.1e})"));
            }
        }
        if !above.is_empty() {
            self.doubts.push(
                Warning::new(
                    format!(
                        "The estimated error in time is above the tolerance of {tolerance:e}: {}",
                        above.join(", ")
                    ),
                    "Read the stated errors in time, or use a smaller tolerance of the error in time",
                )
                .with_remedy("path.time-tolerance", None),
            );
        }
        self
    }

    /// The history, with a reason to doubt it where errors of shift or lost energy by the steps of the path are above the tolerance.
    fn with_path_errors(mut self, setup: &Setup) -> Self {
        let tolerance = setup.path_tolerance();
        let largest = |of: &dyn Fn(&State) -> f64| self.states.iter().map(|state| of(state)).fold(0.0, f64::max);
        let shift = largest(&|state| state.value(Quantity::Shift).abs());
        let shift = shift.max(LEAST_SHIFT * largest(&|state| displacement_by_traction(state)));
        let stored = LEAST_LOSS * largest(&|state| state.value(Quantity::Stored));
        let relative = |state: &State| -> f64 {
            let over =
                |error: Quantity, size: f64| state.get(error).filter(|error| *error > 0.0).map_or(0.0, |it| it / size);
            let lost = state.value(Quantity::Dissipated).max(stored);
            over(Quantity::ShiftPathError, shift).max(over(Quantity::DissipatedPathError, lost))
        };
        let above: Vec<f64> = self.states.iter().map(|state| relative(state)).filter(|it| *it > tolerance).collect();
        if self.kind == ProcessKind::Slip && !above.is_empty() {
            let most = above.iter().copied().fold(0.0, f64::max);
            self.doubts.push(
                Warning::new(
                    format!(
                        "The estimated error of shift or lost energy by the steps of the path is above the tolerance of {tolerance:e} in {} of {} \
                         states, by up to {most:.1e}",
                        above.len(),
                        self.states.len()
                    ),
                    "Read the stated errors, or put more points on the path where the loads turn",
                )
                .with_remedy("path.tolerance", None),
            );
        }
        self
    }

    /// The relative errors in time of the contact pressure, of states whose mean pressure is not small.
    fn pressure_time_errors(&self) -> Vec<f64> {
        let largest = self.states.iter().map(|it| it.contact.mean_pressure()).fold(0.0, f64::max);
        let pressed = self.states.iter().filter(|it| it.contact.mean_pressure() >= SMALL * largest);
        pressed.filter_map(|it| it.get(Quantity::TimeError)).collect()
    }

    /// The errors in time of the mean gap over that, or over a small part of the rms height.
    fn gap_time_errors(&self) -> Vec<f64> {
        let size = |it: &State| it.contact.mean_gap().max(SMALL * it.contact.problem.rms_height());
        let relative = |it: &Arc<State>| Some(it.get(Quantity::MeanGapTimeError)? / size(it));
        self.states.iter().filter_map(relative).collect()
    }

    /// The errors in time of the lost energy over that at the next point of the path: on the way there it may be as small as one likes.
    fn loss_time_errors(&self) -> Vec<f64> {
        let (mut errors, mut at_point) = (Vec::new(), None);
        for state in self.states.iter().rev() {
            let (Some(error), Some(lost)) = (state.get(Quantity::DissipatedTimeError), state.get(Quantity::Dissipated))
            else {
                continue;
            };
            if state.point.is_some() || at_point.is_none() {
                at_point = Some(lost);
            }
            if let Some(size) = at_point.filter(|size| *size > 0.0) {
                errors.push(error / size);
            }
        }
        errors
    }

    /// The outcome with the doubts about a solid that yields below its surface.
    fn with_doubts_of_yielding(mut self, setup: &Setup) -> Self {
        self.doubts.extend(warnings_of_yielding(&self.states, setup));
        self
    }

    /// The outcome with a warning of cycles of the path after which the contact has not returned to its state.
    fn with_open_cycles(mut self, setup: &Setup) -> Self {
        let count = open_cycles(&setup.path_points(), &self.states);
        if count > 0 {
            self.doubts.push(
                Warning::new(
                    format!(
                        "In {count} of the cycles of the path the load returns, but the contact does not return to its state, and \
                         no energy lost per cycle is given"
                    ),
                    "Let the path go so far that the surfaces let go, or follow the cycle again",
                )
                .with_remedy("path.load", None),
            );
        }
        self
    }

    /// The quantities that the states have, in the order of their table.
    pub fn quantities(&self) -> Vec<Quantity> {
        let numbers = self.states.iter().flat_map(|state| state.numbers().iter());
        let told: BTreeSet<Quantity> = numbers.map(|(quantity, _)| *quantity).collect();
        told.into_iter().collect()
    }

    /// The values of a quantity in all states; NaN where a state has none.
    pub fn values(&self, quantity: Quantity) -> Vec<f64> {
        self.states.iter().map(|state| state.value(quantity)).collect()
    }

    /// What is claimed of all states, none if there are none: nothing where one of them is not converged, and the error by steps where a part of the
    /// path has one.
    pub fn claim(&self) -> Option<ResultClaim> {
        let weakest = [ResultClaim::NotConverged, ResultClaim::GivenSteps, ResultClaim::PathSteps];
        let is_claimed = |claim: &ResultClaim| self.states.iter().any(|state| state.claim == *claim);
        // those on the way claim nothing that holds for the others
        let first = self.states.iter().map(|state| state.claim).find(|claim| *claim != ResultClaim::Moving);
        weakest.into_iter().find(is_claimed).or(first)
    }

    /// The energy that each closed cycle of the path lost, per area of the cell.
    pub fn cycles(&self, setup: &Setup) -> Vec<CycleLoss> {
        cycle_losses(&setup.path_points(), &self.states)
    }

    /// Reasons to doubt the states.
    pub fn warnings(&self) -> Vec<Warning> {
        let numbers = self.states.iter().map(|state| state.contact.values().numbers());
        let leakage = warning_of_leakage(numbers);
        let of_process =
            if self.kind == ProcessKind::Loads { self.warnings_of_loads() } else { self.warnings_of_process() };
        of_process.into_iter().chain(leakage).collect()
    }

    /// Reasons to doubt states that are no list of loads.
    fn warnings_of_process(&self) -> Vec<Warning> {
        let missed = self.states.iter().filter(|state| !state.contact.is_converged()).count();
        let missed = (missed > 0).then(|| {
            Warning::new(
                format!("{missed} of {} states {}", self.states.len(), self.kind.row().missed),
                "Use a larger tolerance, or more iterations",
            )
            .with_remedy("stop.tolerance", None)
        });
        let spacings = self.adhesion.as_ref().map(|it| it.scales.spacings);
        let coarse = spacings.filter(|spacings| *spacings < FEW_SPACINGS).map(|spacings| {
            Warning::new(
                format!(
                    "The process zone of the attraction is {spacings:.1} spacings long, and so the nodes hold the edges of the contact"
                ),
                "Use more points, or a longer range: the zone should be at least 4 spacings long",
            )
            .with_remedy("grid.points", None)
        });
        let error = self.adhesion.as_ref().and_then(|it| it.scales.grid_error);
        let snapping = error.filter(|error| *error > LARGE_GRID_ERROR && coarse.is_none()).map(|error| {
            Warning::new(
                format!(
                    "Forces at which contacts let go may be off by {:.0} %, as the traction jumps at the end of its range and the nodes hold the edges of the contact",
                    1e2 * error
                ),
                "Use more points: the error is proportional to their spacing",
            )
            .with_remedy("grid.points", None)
        });
        let contacts = || self.states.iter().map(|state| &state.contact);
        let motion = [warning_of_trail(contacts()), warning_of_friction(contacts())];
        let missed = self.doubts.iter().cloned().chain(missed);
        missed
            .chain(coarse)
            .chain(snapping)
            .chain(motion.into_iter().flatten())
            .chain(self.unstable())
            .chain(warnings_of_states(&self.states))
            .collect()
    }

    /// Reasons to doubt contacts under a list of loads.
    fn warnings_of_loads(&self) -> Vec<Warning> {
        let Some(first) = self.states.first() else { return Vec::new() };
        let observables: Vec<Observables> = self.states.iter().map(|state| Observables::of_state(state)).collect();
        let warnings = warnings_of(&observables.iter().collect::<Vec<_>>(), first.contact.problem.law());
        let of_one =
            self.states.iter().map(|state| warnings_of_contact(&state.contact)).find(|found| !found.is_empty());
        warnings.into_iter().chain(of_one.into_iter().flatten()).collect()
    }

    /// Warnings about states with adhesion that are in equilibrium, but not stable, or not known to be.
    fn unstable(&self) -> impl Iterator<Item = Warning> {
        let count = self.states.len();
        let saddles = self.numbers_of(ResultClaim::Saddle);
        let saddles = (!saddles.is_empty()).then(|| {
            Warning::new(
                format!(
                    "{} of {count} states ({}): in equilibrium, but not stable, so that a small change grows",
                    saddles.len(),
                    in_words(&saddles)
                ),
                "Use smaller steps of the path, or another adhesion method",
            )
            .with_remedy("path.steps", None)
            .with_remedy("adhesion.method", None)
        });
        let unknown = self.numbers_of(ResultClaim::Stationary);
        let unknown = (!unknown.is_empty()).then(|| {
            Warning::new(
                format!(
                    "The stability of {} of {count} states ({}) is not known, since it is not computed on a free boundary",
                    unknown.len(),
                    in_words(&unknown)
                ),
                "Compare with a periodic cell that is wide beside the contact",
            )
            .with_remedy("grid.boundary", Some("periodic"))
        });
        saddles.into_iter().chain(unknown)
    }

    /// The numbers of the states with a claim, from 1.
    fn numbers_of(&self, claim: ResultClaim) -> Vec<usize> {
        let all = self.states.iter().enumerate().filter(|(_, state)| state.claim == claim);
        all.map(|(i, _)| i + 1).collect()
    }
}

/// The mean displacement by the traction along `x` of a state with friction, weighted with it, a length; 0 without traction.
fn displacement_by_traction(state: &State) -> f64 {
    let traction = state
        .field(FieldKind::Traction)
        .map_or(0.0, |it| it.iter().map(|tau| tau.abs()).sum::<f64>() / it.len() as f64);
    if traction > 0.0 { 2.0 * state.value(Quantity::Stored) / traction } else { 0.0 }
}

/// Some numbers in words: one, or the first and the last one.
fn in_words(numbers: &[usize]) -> String {
    match numbers {
        [] => String::new(),
        [one] => format!("state {one}"),
        [first, .., last] => format!("states {first} to {last}"),
    }
}
