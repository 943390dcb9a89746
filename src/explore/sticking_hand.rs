//! A contact with adhesion under the hand, which depends on the contacts before.

use super::refusal::Refusal;
use super::report::Numbers;
use crate::contact::{Contact, Load};
use crate::error::AdhesionError;
use crate::history::{AdhesiveHand, HistoryState};
use crate::setup::Setup;

/// The last state of a setup with adhesion under the hand.
pub struct StickingHand {
    setup: Setup,
    hand: AdhesiveHand,
    state: HistoryState,
}

impl StickingHand {
    /// The state of a setup at a load, or at the end of its path, from the last state if the rest of the setup is the same, else from
    /// the state at the end of the path.
    ///
    /// # Errors
    /// A sentence for an attraction that cannot be solved here, and for a state that was not found.
    pub fn moved(setup: &Setup, before: Option<Self>, load: Option<Load>) -> Result<Self, Refusal> {
        let setup = Setup { record: Default::default(), ..setup.clone() };
        let refused = |error: AdhesionError| Refusal::from(error.to_string());
        let mut hand = match before.filter(|it| it.setup == setup) {
            Some(it) => it.hand,
            None => AdhesiveHand::new(setup.adhesive(setup.problem()?)?).map_err(refused)?,
        };
        if let Some(load) = load {
            hand.move_to(load).map_err(refused)?;
        }
        let state = hand.state();
        Ok(Self { setup, hand, state })
    }

    /// The contact.
    pub fn contact(&self) -> &Contact {
        &self.state.contact
    }

    /// The mean pressure, negative where the hand pulls.
    pub fn mean_pressure(&self) -> f64 {
        self.state.numbers.net_pressure.unwrap_or(0.0)
    }

    /// The numbers of the state.
    pub fn numbers(&self) -> Numbers {
        Numbers::from_contact(&self.state.contact)
    }
}
