//! The contact patches of runs and results.

use super::saved::{SavedFound, SavedResult};
use crate::contact::{PatchHistory, State};
use crate::error::FileError;
use crate::setup::{Posed, StateSink};

impl StateSink for PatchHistory {
    fn state(&mut self, posed: &Posed<'_>, _: usize, state: &State) -> Result<(), FileError> {
        if posed.run == 0 {
            self.add(&state.contact);
        }
        Ok(())
    }
}

impl SavedResult {
    /// The contact patches of all states.
    pub fn patches(&self) -> PatchHistory {
        let mut patches = PatchHistory::new(self.setup.surface.own_shape(self.surface.grid().shape()));
        match &self.found {
            SavedFound::Contact(state, _) => patches.add(&state.contact),
            SavedFound::States(outcome) => outcome.states.iter().for_each(|state| patches.add(&state.contact)),
        }
        patches
    }
}
