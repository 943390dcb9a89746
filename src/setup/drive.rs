//! What a drive declares: how it is asked for, what makes its states, and what is shown of them.

use super::{Ingredient, Key, Setup};
use crate::contact::{Feels, Problem, Quantity, ResultClaim, State, StateRow};
use crate::error::SetupError;
use crate::grid::Grid;
use crate::history::Process;
use crate::warning::Warning;
use std::fmt;
use std::sync::Arc;

/// What leads a contact from one state to the next, such as creep or sliding, as its one declaration.
///
/// Each drive is a constant in a file of its own, and [`DRIVES`](super::DRIVES) lists them. Checks, costs, tables, recordings, the page and Python read the
/// declaration and name no drive.
pub struct Drive {
    /// Its name in files and reports.
    pub name: &'static str,
    /// Its own keys of a scene, which no other drive has.
    pub keys: &'static [Key],
    /// What of a setup asks for it.
    pub given: Ingredient,
    /// The other [ingredients](Ingredient) that it can have beside it. Any other one that is given is refused.
    pub(super) takes: &'static [&'static str],
    /// The ingredients that it cannot be without.
    pub(super) needs: &'static [&'static str],
    /// The number of its states along the path or the list of a setup, an estimate where steps are chosen by the error in time.
    pub(super) states: fn(&Setup) -> usize,
    /// Refuses what it cannot have on a grid.
    pub(super) check: fn(&Setup, &Grid) -> Result<(), SetupError>,
    /// The bytes that it takes besides the solves.
    pub(super) bytes: fn(&Setup, &Grid) -> Result<f64, SetupError>,
    /// The transforms of the surface that take as long as one of its states, for forecasts of run times.
    pub(crate) transforms: fn(&Setup, &Grid) -> Result<f64, SetupError>,
    /// What makes its states.
    pub(super) make: MakeProcess,
    /// Reasons to doubt its states, besides those that hold for the states of all drives.
    pub doubts: fn(&Setup, &[Arc<State>]) -> Vec<Warning>,
    /// What its states add up to, besides what those of all drives do.
    pub(super) totals: fn(&[StateRow]) -> Vec<(Quantity, f64)>,
    /// Whether its load must be a pressure, since friction follows that.
    pub(super) needs_pressure: bool,
    /// Whether its states are contacts under a list of loads, written and judged like contacts under one load, and not the states of a history.
    pub is_list: bool,
    /// What states that are not converged have missed.
    pub missed: &'static str,
    /// The quantity along which states are drawn; none for the number of the state.
    pub axis: Option<Quantity>,
    /// Whether this axis is logarithmic.
    pub is_logarithmic: bool,
    /// The charts of its pictures.
    pub charts: [StateChart; 2],
    /// The columns of the table for reading.
    pub columns: &'static [Quantity],
    /// What names a state in a recording.
    pub caption: &'static [Quantity],
    /// Whether the states differ in what they claim, so that each states its own claim.
    pub has_claims: bool,
    /// What the solid feels besides the pressure between the surfaces.
    pub feels: Feels,
}

/// What makes the states of a problem, which is that of a setup.
pub(super) type MakeProcess = for<'a> fn(&'a Setup, Problem) -> Result<Box<dyn Process + 'a>, SetupError>;

/// A chart of the states of a drive: one quantity against another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StateChart {
    /// The quantity on the horizontal axis; none for the number of the state.
    pub x: Option<Quantity>,
    /// The quantity on the vertical axis.
    pub y: Quantity,
}

impl StateChart {
    /// The chart of `y` against `x`.
    pub(super) const fn against(x: Quantity, y: Quantity) -> Self {
        Self { x: Some(x), y }
    }
}

impl Drive {
    /// The quantities that it shows of its states, the most important ones first: those of its charts, then the columns of its table.
    pub fn shown(&self) -> impl Iterator<Item = Quantity> {
        let ordinates = self.charts.iter().map(|chart| chart.y);
        ordinates.chain(self.charts.iter().filter_map(|chart| chart.x)).chain(self.columns.iter().copied())
    }

    /// What states add up to: their number, the largest area, the transforms of all, and what the drive knows besides. Frames of a motion are no states.
    pub fn totals_of(&self, states: &[StateRow]) -> Vec<(Quantity, f64)> {
        let held: Vec<&StateRow> = states.iter().filter(|state| state.claim != ResultClaim::Moving).collect();
        let area = held.iter().filter_map(|state| state.get(Quantity::RelativeArea)).reduce(f64::max);
        let transforms: f64 = states.iter().filter_map(|state| state.get(Quantity::Transforms)).sum();
        let mut totals = Vec::new();
        totals.extend(area.map(|area| (Quantity::LargestArea, area)));
        totals.push((Quantity::States, held.len() as f64));
        totals.push((Quantity::HistoryTransforms, transforms));
        totals.extend((self.totals)(states));
        totals
    }

    /// Transforms of a state that begins with the last one, measured on a rough line that creeps.
    pub(super) const TRANSFORMS_OF_WARM_STATE: f64 = 60.0;

    /// What is said of states whose certificate is above the tolerance.
    pub(super) const WITHOUT_CERTIFICATE: &'static str = "did not reach their certificate";
}

impl fmt::Debug for Drive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Drive").field("name", &self.name).finish_non_exhaustive()
    }
}

/// Two drives are the same if their names are, which differ in the list.
impl PartialEq for Drive {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Drive {}
