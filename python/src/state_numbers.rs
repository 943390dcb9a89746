//! The numbers of a state of a history.

use asperity::history::{HISTORY_QUANTITIES, HistoryState};

/// The numbers of a state of a history, one for each of [`HISTORY_QUANTITIES`]; none where the state has no such number.
#[derive(Clone)]
pub struct StateNumbers(pub Vec<Option<f64>>);

impl From<&HistoryState> for StateNumbers {
    fn from(state: &HistoryState) -> Self {
        Self(HISTORY_QUANTITIES.iter().map(|it| (it.value)(state)).collect())
    }
}

impl PartialEq for StateNumbers {
    /// Whether all numbers are the same to the last bit, so that a number that is not a number is the same as another one.
    fn eq(&self, other: &Self) -> bool {
        let bits = |it: &Self| -> Vec<_> { it.0.iter().map(|number| number.map(f64::to_bits)).collect() };
        bits(self) == bits(other)
    }
}

impl StateNumbers {
    /// The number of a name, if the state has it.
    pub fn find(&self, name: &str) -> Option<f64> {
        let place = HISTORY_QUANTITIES.iter().position(|it| it.name == name)?;
        self.0.get(place).copied().flatten()
    }
}
