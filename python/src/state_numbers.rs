//! The numbers of a state of a history.

use asperity::contact::{StateKind, StateValues};
use asperity::history::{HISTORY_QUANTITIES, State};
use asperity::setup::ProcessKind;

/// The numbers of a state of a history, one for each of [`HISTORY_QUANTITIES`]; none where the state has no such number.
#[derive(Clone)]
pub struct StateNumbers(pub Vec<Option<f64>>);

impl From<&State> for StateNumbers {
    fn from(state: &State) -> Self {
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
    /// What the state of a process knows better than its contact.
    pub fn values(&self, process: ProcessKind) -> StateValues {
        let [relative_area, kappa_r] = ["relative_area", "kappa_r"].map(|name| self.find(name));
        match process {
            ProcessKind::Adhesion => {
                let mean_pressure = self.find("mean_pressure");
                StateValues { kind: StateKind::Adhesion, mean_pressure, relative_area, kappa_r: None }
            }
            ProcessKind::Creep => StateValues { kind: StateKind::Creep, mean_pressure: None, relative_area, kappa_r },
            ProcessKind::Slip | ProcessKind::Sliding | ProcessKind::Rolling => StateValues::default(),
        }
    }

    /// The number of a name, if the state has it.
    pub fn find(&self, name: &str) -> Option<f64> {
        let place = HISTORY_QUANTITIES.iter().position(|it| it.name == name)?;
        self.0.get(place).copied().flatten()
    }
}
