//! The states of a run with several: loads, creep, slip, sliding, rolling or adhesion.

use crate::adhesion::AdhesionScales;
use crate::contact::{
    Law, Observables, Problem, Quantity, ResultClaim, State, StateRow, warning_of_friction, warning_of_trail,
    warnings_of, warnings_of_states,
};
use crate::error::{ConflictRule, FileError, HistoryError, SetupError};
use crate::history::{AdhesionTotals, CycleLoss, cycle_losses, open_cycles};
use crate::setup::{Drive, Posed, Setup, warning_of_leakage};
use crate::warning::Warning;
use serde::Serialize;
use std::collections::BTreeSet;
use std::sync::Arc;

/// The states of a history, and what they add up to.
#[derive(Debug)]
pub struct HistoryOutcome {
    /// The drive that has led from one state to the next.
    pub drive: &'static Drive,
    /// The attraction and what came of it, with adhesion.
    pub adhesion: Option<AdhesionOutcome>,
    /// What tables and summaries say of all states, in their order.
    pub rows: Vec<StateRow>,
    /// The states, in their order; the last one alone where the job keeps no others.
    pub states: Vec<Arc<State>>,
    /// What the states add up to.
    pub totals: Vec<(Quantity, f64)>,
    /// Why the history ended before its path did, if it did: an observer that stopped it, such as Ctrl-C, or a failure.
    pub ended: Option<HistoryError>,
    /// Why a recording, table or archive of the states could not be written, if it could not.
    pub failure: Option<FileError>,
    /// Doubts about what the setup says.
    doubts: Vec<Warning>,
    /// The law of the surfaces, by which strains are judged.
    law: Law,
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
    fn new(setup: &Setup, problem: &Problem, rows: &[StateRow]) -> Result<Option<Self>, SetupError> {
        let (Some(adhesion), Some(totals)) = (&setup.adhesion, AdhesionTotals::from_rows(rows)) else {
            return Ok(None);
        };
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
        let drive = setup.drive()?.ok_or(ConflictRule::NoHistory)?;
        let rows = states.iter().map(|state| StateRow::new(state)).collect();
        Self::from_posed(&Posed { run: 0, setup, problem, drive }, rows, states)
    }

    /// The history of a run, with the rows of all states and with the states that are kept.
    pub(super) fn from_posed(
        posed: &Posed<'_>,
        rows: Vec<StateRow>,
        states: Vec<Arc<State>>,
    ) -> Result<Self, SetupError> {
        let Posed { setup, problem, drive, .. } = *posed;
        let adhesion = AdhesionOutcome::new(setup, problem, &rows)?;
        let totals = drive.totals_of(&rows);
        let mut doubts = (drive.doubts)(setup, &states);
        doubts.extend(warning_of_open_cycles(setup, &states));
        Ok(Self { drive, adhesion, rows, states, totals, ended: None, failure: None, doubts, law: problem.law() })
    }

    /// The quantities that the states have, in the order of their table.
    pub fn quantities(&self) -> Vec<Quantity> {
        let numbers = self.rows.iter().flat_map(|row| row.numbers.iter());
        let told: BTreeSet<Quantity> = numbers.map(|(quantity, _)| *quantity).collect();
        told.into_iter().collect()
    }

    /// The values of a quantity in all states; NaN where a state has none.
    pub fn values(&self, quantity: Quantity) -> Vec<f64> {
        self.rows.iter().map(|row| row.value(quantity)).collect()
    }

    /// What is claimed of all states, none if there are none: nothing where one of them is not converged, and the error by steps where a part of the
    /// path has one.
    pub fn claim(&self) -> Option<ResultClaim> {
        let weakest = [
            ResultClaim::NotConverged,
            ResultClaim::RoundsOfGivenSteps,
            ResultClaim::RoundsOfPathSteps,
            ResultClaim::GivenSteps,
            ResultClaim::PathSteps,
        ];
        let is_claimed = |claim: &ResultClaim| self.rows.iter().any(|row| row.claim == *claim);
        // those on the way claim nothing that holds for the others
        let first = self.rows.iter().map(|row| row.claim).find(|claim| *claim != ResultClaim::Moving);
        weakest.into_iter().find(is_claimed).or(first)
    }

    /// The energy that each closed cycle of the path lost, per area of the cell.
    pub fn cycles(&self, setup: &Setup) -> Vec<CycleLoss> {
        cycle_losses(&setup.path_points(), &self.states)
    }

    /// Reasons to doubt the states.
    pub fn warnings(&self) -> Vec<Warning> {
        let leakage = warning_of_leakage(self.rows.iter().map(|row| row.numbers.as_slice()));
        let of_states = if self.drive.is_list { self.warnings_of_loads() } else { self.warnings_of_history() };
        of_states.into_iter().chain(leakage).collect()
    }

    /// Reasons to doubt states that are no list of loads.
    fn warnings_of_history(&self) -> Vec<Warning> {
        let missed = self.states.iter().filter(|state| !state.contact.is_converged()).count();
        let missed = (missed > 0).then(|| {
            Warning::new(
                format!("{missed} of {} states {}", self.states.len(), self.drive.missed),
                "Use a larger tolerance, or more iterations",
            )
            .with_remedy("stop.tolerance", None)
        });
        let contacts = || self.states.iter().map(|state| &state.contact);
        let motion = [warning_of_trail(contacts()), warning_of_friction(contacts())];
        let doubts = self.doubts.iter().cloned().chain(missed);
        doubts.chain(motion.into_iter().flatten()).chain(warnings_of_states(&self.states)).collect()
    }

    /// Reasons to doubt contacts under a list of loads.
    fn warnings_of_loads(&self) -> Vec<Warning> {
        let observables: Vec<Observables> = self.rows.iter().map(StateRow::observables).collect();
        let mut warnings = warnings_of(&observables.iter().collect::<Vec<_>>(), self.law);
        // what holds for one contact holds for the others too, with nearly the same numbers: it is said once
        let of_one = self.rows.iter().find(|row| !row.doubts.is_empty());
        warnings.extend(of_one.into_iter().flat_map(|row| row.doubts.iter().cloned()));
        warnings
    }
}

/// The warning of cycles of the path after which the contact has not returned to its state.
fn warning_of_open_cycles(setup: &Setup, states: &[Arc<State>]) -> Option<Warning> {
    let count = open_cycles(&setup.path_points(), states);
    (count > 0).then(|| {
        Warning::new(
            format!(
                "In {count} of the cycles of the path the load returns, but the contact does not return to its state, and \
                 no energy lost per cycle is given"
            ),
            "Let the path go so far that the surfaces let go, or follow the cycle again",
        )
        .with_remedy("path.load", None)
    })
}
