//! A contact with adhesion that is moved by hand.

use super::adhesive::{AdhesiveProcess, Ledger, Place, Visit};
use super::process::HistoryState;
use crate::adhesion::AdhesiveControl;
use crate::contact::Load;
use crate::error::AdhesionError;

/// A contact with adhesion that is moved from load to load, whatever these will be. Each move starts from the last state.
pub struct AdhesiveHand {
    process: AdhesiveProcess,
    last: Visit,
}

impl AdhesiveHand {
    /// The contact at the end of the path of a process.
    ///
    /// # Errors
    /// The errors of [`AdhesiveProblem::solve`](crate::adhesion::AdhesiveProblem::solve), and [`AdhesionError::Pathless`].
    pub fn new(process: AdhesiveProcess) -> Result<Self, AdhesionError> {
        let loads: Vec<Load> = process.loads().collect();
        let (first, rest) = loads.split_first().ok_or(AdhesionError::Pathless)?;
        let control = process.control(*first);
        let (place, work) = process.solve(control, None, &mut ())?;
        let last = Visit { place, control, ledger: Ledger::default(), jump: None, work };
        let mut hand = Self { process, last };
        rest.iter().try_for_each(|load| hand.move_to(*load))?;
        Ok(hand)
    }

    /// Moves the contact to another load, in steps that are short where it jumps.
    ///
    /// # Errors
    /// The errors of [`AdhesiveProblem::solve`](crate::adhesion::AdhesiveProblem::solve).
    pub fn move_to(&mut self, load: Load) -> Result<(), AdhesionError> {
        let target = self.process.control(load);
        let begin = match (&self.last.place, target) {
            (Place::Apart, _) => target,
            (Place::State(state), AdhesiveControl::MeanPressure(_)) => target.with_value(state.mean_pressure),
            (Place::State(state), AdhesiveControl::MeanGap(_)) => target.with_value(state.mean_gap()),
            (Place::State(state), AdhesiveControl::Approach(_)) => {
                target.with_value(self.process.highest() - state.datum)
            }
        };
        let from = Visit { control: begin, ..self.last.kept() };
        let reached = self.process.visits(&from, target, &mut ())?.pop();
        self.last = reached.expect("a step has an end");
        Ok(())
    }

    /// The state.
    pub fn state(&self) -> HistoryState {
        self.process.told(self.last.kept(), None)
    }
}
