//! A contact with adhesion under the hand, which depends on the contacts before.

use super::refusal::Refusal;
use super::report::Numbers;
use crate::contact::{Load, Quantity, State};
use crate::error::HistoryError;
use crate::history::{AdhesiveProcess, PathPoint, Process};
use crate::sentence::Worded;
use crate::setup::Setup;

/// The last state of a setup with adhesion under the hand.
pub(crate) struct StickingHand {
    setup: Setup,
    process: AdhesiveProcess,
    state: State,
}

impl StickingHand {
    /// The state of a setup at a load, or at the end of its path, from the last state if the rest of the setup is the same, else from
    /// the state at the end of the path.
    ///
    /// # Errors
    /// A sentence for an attraction that cannot be solved here, and for a state that was not found.
    pub(crate) fn moved(setup: &Setup, before: Option<Self>, load: Option<Load>) -> Result<Self, Refusal> {
        let setup = Setup { record: Default::default(), ..setup.clone() };
        let refused = |error: HistoryError| Refusal::from(error.sentence());
        let mut process = match before.filter(|it| it.setup == setup) {
            Some(it) => it.process,
            None => setup.adhesive(setup.problem()?)?,
        };
        let state = match load {
            Some(load) => process.move_to(PathPoint::under(load), &mut ()),
            None => process.at_end(&mut ()),
        };
        let state = state.map_err(refused)?;
        Ok(Self { setup, process, state })
    }

    /// The state.
    pub(crate) fn state(&self) -> &State {
        &self.state
    }

    /// The mean pressure, negative where the hand pulls.
    pub(crate) fn mean_pressure(&self) -> f64 {
        self.state.get(Quantity::MeanPressure).unwrap_or(0.0)
    }

    /// The numbers of the state.
    pub(crate) fn numbers(&self) -> Numbers {
        Numbers::from_contact(&self.state.contact)
    }
}
