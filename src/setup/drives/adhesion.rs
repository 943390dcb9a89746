//! Adhesion under loads up and down.

use crate::adhesion::{AdhesionScales, AdhesiveMethod, AdhesiveMotion, AdhesiveProblem, AttractionForm};
use crate::contact::{Feels, Load, Problem, Quantity, ResultClaim, State, StateRow};
use crate::error::{AdhesionError, SetupError};
use crate::grid::Grid;
use crate::history::{AdhesionTotals, AdhesiveProcess, PathPoint};
use crate::setup::Setup;
use crate::setup::cost::bytes;
use crate::setup::drive::{Drive, StateChart};
use crate::setup::ingredient::Ingredient;
use crate::setup::key::{Dimension, FlagValue, Key, choices, key};
use crate::warning::Warning;
use std::sync::Arc;

/// Steps between two points of a path, if no number is given.
const STEPS: usize = 20;

/// Fields that a history takes besides its solves, lines and surfaces. Measured as the peak of resident memory.
const FIELDS: [f64; 2] = [24.0, 24.0];

/// Transforms that take as long as a state, measured on rough lines of 2^14 nodes and surfaces of 2^16.
const TRANSFORMS: f64 = 400.0;

/// A process zone of fewer spacings gets a warning.
const FEW_SPACINGS: f64 = 4.0;

/// An error of the grid above this part gets a warning.
const LARGE_GRID_ERROR: f64 = 0.02;

#[rustfmt::skip]
const KEYS: &[Key] = &[
    key("adhesion.work", "adhesion", FlagValue::One, Dimension::EnergyPerArea, "W", "Work of adhesion, an energy per area such as 50mJ/m^2; needs --adhesion-range").named("work of adhesion").over_modulus(),
    key("adhesion.range", "adhesion-range", FlagValue::One, Dimension::Length, "RHO", "Range of the attraction: the work of adhesion over its largest traction, a length"),
    key("adhesion.form", "adhesion-form", FlagValue::Choice(choices::<AttractionForm>), Dimension::Word, "FORM", "How the attraction falls with the gap [default: exponential]"),
    key("adhesion.table", "adhesion-table", FlagValue::One, Dimension::File, "FILE.csv", "Table of the attraction with the columns gap and traction, instead of the three flags above"),
    key("adhesion.method", "adhesion-method", FlagValue::Choice(choices::<AdhesiveMethod>), Dimension::Word, "METHOD", "Method that finds states with adhesion; gfmd is a motion, in which jumps can be watched [default: fast]"),
];

/// Adhesion, under loads that go up and down along a path.
pub(crate) const ADHESION: Drive = Drive {
    name: "adhesion",
    keys: KEYS,
    given: Ingredient { path: "adhesion", name: "adhesion", is_given: |it| it.adhesion.is_some() },
    takes: &["path"],
    needs: &[],
    states: |it| it.states_of_path(STEPS).max(1).saturating_add(it.expected_frames()),
    check: Setup::check_adhesion,
    bytes: |_, grid| Ok(bytes(grid, FIELDS[usize::from(!grid.is_line())])),
    transforms: |_, _| Ok(TRANSFORMS),
    make: |it, problem| Ok(Box::new(it.adhesive(problem)?)),
    doubts: |it, states| warnings_of_zone(it, states).into_iter().chain(warnings_of_stability(states)).collect(),
    totals,
    needs_pressure: false,
    is_list: false,
    missed: "are not converged: equilibrium is missed by more than the tolerance",
    axis: None,
    is_logarithmic: false,
    charts: [
        StateChart::against(Quantity::MeanGap, Quantity::MeanPressure),
        StateChart::against(Quantity::MeanGap, Quantity::RelativeArea),
    ],
    columns: &[
        Quantity::MeanPressure,
        Quantity::MeanGap,
        Quantity::Approach,
        Quantity::RelativeArea,
        Quantity::MeanAttraction,
        Quantity::Jump,
        Quantity::Dissipated,
        Quantity::LeastCurvature,
        Quantity::Residual,
    ],
    caption: &[Quantity::MeanPressure, Quantity::MeanGap],
    has_claims: true,
    feels: Feels::ATTRACTION,
};

impl Setup {
    /// What makes the history of a problem with adhesion along the path of this setup.
    ///
    /// # Errors
    /// The errors of [`Adhesion::attraction`](crate::setup::Adhesion::attraction) and of [`AdhesiveProblem::new`].
    pub fn adhesive(&self, problem: Problem) -> Result<AdhesiveProcess, SetupError> {
        let adhesion = self.adhesion.clone().unwrap_or_default();
        let problem = AdhesiveProblem::new(problem, adhesion.attraction()?)?;
        let steps = self.path.as_ref().and_then(|path| path.steps).unwrap_or(STEPS);
        Ok(AdhesiveProcess::new(problem, self.path_points(), steps, adhesion.method, self.stop))
    }

    /// The frames of motions, if there is one long jump from each point of the path to the next.
    fn expected_frames(&self) -> usize {
        let moves = self.adhesion.as_ref().is_some_and(|it| it.method == AdhesiveMethod::Gfmd);
        let ways = self.path_points().len().saturating_sub(1);
        if moves { ways * AdhesiveMotion::MOST_FRAMES } else { 0 }
    }

    /// Refuses mean gaps that are not positive, a grid that does not resolve the attraction, and a damped motion on a free boundary.
    fn check_adhesion(&self, grid: &Grid) -> Result<(), SetupError> {
        if let Some(adhesion) = &self.adhesion {
            if !grid.is_periodic() && adhesion.method == AdhesiveMethod::Gfmd {
                return Err(AdhesionError::FreeMotion.into());
            }
            AdhesiveProblem::check_grid(grid, self.contact_modulus()?, &adhesion.attraction()?)?;
        }
        let is_closed = |point: &PathPoint| matches!(point.load, Load::MeanGap(gap) if gap <= 0.0);
        match self.path_points().iter().find(|point| is_closed(point)) {
            Some(point) => Err(AdhesionError::MeanGap { value: point.load.value() }.into()),
            None => Ok(()),
        }
    }
}

/// Pull-off, jumps and the energy lost in them, and whether all states are known to be stable.
fn totals(states: &[StateRow]) -> Vec<(Quantity, f64)> {
    let Some(it) = AdhesionTotals::from_rows(states) else { return Vec::new() };
    let flag = |is_true: bool| Some(f64::from(u8::from(is_true)));
    // a solution that no other one can replace is stable, and surfaces that have parted are
    let is_certain = |claim: ResultClaim| {
        matches!(claim, ResultClaim::Stable | ResultClaim::Solution | ResultClaim::Separated | ResultClaim::Moving)
    };
    let totals = [
        (Quantity::LowestPressure, it.lowest_pressure),
        (Quantity::Separated, flag(it.separated)),
        (Quantity::Jumps, Some(it.jumps.len() as f64)),
        (Quantity::LostInJumps, Some(it.lost_in_jumps)),
        (Quantity::LostError, it.lost_error),
        (Quantity::Stable, flag(states.iter().all(|state| is_certain(state.claim)))),
    ];
    totals.into_iter().filter_map(|(quantity, value)| Some((quantity, value?))).collect()
}

/// The warning of a grid that is coarse beside the process zone of the attraction: at most one of two.
fn warnings_of_zone(setup: &Setup, states: &[Arc<State>]) -> Option<Warning> {
    let attraction = setup.adhesion.as_ref()?.attraction().ok()?;
    let scales = AdhesionScales::new(&states.first()?.contact.problem, &attraction);
    let spacings = scales.spacings;
    if spacings < FEW_SPACINGS {
        return Some(
            Warning::new(
                format!(
                    "The process zone of the attraction is {spacings:.1} spacings long, and so the nodes hold the edges of the contact"
                ),
                "Use more points, or a longer range: the zone should be at least 4 spacings long",
            )
            .with_remedy("grid.points", None),
        );
    }
    let error = scales.grid_error.filter(|error| *error > LARGE_GRID_ERROR)?;
    Some(
        Warning::new(
            format!(
                "Forces at which contacts let go may be off by {:.0} %, as the traction jumps at the end of its range and the nodes hold the edges of the contact",
                1e2 * error
            ),
            "Use more points: the error is proportional to their spacing",
        )
        .with_remedy("grid.points", None),
    )
}

/// Warnings about states that are in equilibrium, but not stable, or not known to be.
fn warnings_of_stability(states: &[Arc<State>]) -> impl Iterator<Item = Warning> {
    let count = states.len();
    let saddles = numbers_of(states, ResultClaim::Saddle);
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
    let unknown = numbers_of(states, ResultClaim::Stationary);
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
fn numbers_of(states: &[Arc<State>], claim: ResultClaim) -> Vec<usize> {
    let all = states.iter().enumerate().filter(|(_, state)| state.claim == claim);
    all.map(|(i, _)| i + 1).collect()
}

/// Some numbers in words: one, or the first and the last one.
fn in_words(numbers: &[usize]) -> String {
    match numbers {
        [] => String::new(),
        [one] => format!("state {one}"),
        [first, .., last] => format!("states {first} to {last}"),
    }
}
