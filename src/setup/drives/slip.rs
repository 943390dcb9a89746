//! Partial slip under normal and tangential loads.

use crate::contact::{Feels, FieldKind, Problem, Quantity, State};
use crate::error::{ConflictRule, SetupError, SlipError};
use crate::history::{LEAST_LOSS, LEAST_SHIFT, SlipHistory, SlipPace, SlipProcess};
use crate::setup::cost::bytes;
use crate::setup::drive::{Drive, StateChart};
use crate::setup::ingredient::Ingredient;
use crate::setup::{Setup, Solid};
use crate::warning::Warning;
use std::sync::Arc;

/// The estimated relative error by the steps of a path with friction, if none is given.
const PATH_TOLERANCE: f64 = 1e-2;

/// Fields that a path of slip takes besides its solves, lines and surfaces, and for each of its states: there is a history in doubled steps, and states are
/// kept with traction and slip in both directions. Measured as the peak of resident memory.
const FIELDS: [f64; 2] = [28.0, 27.0];
const STATE_FIELDS: [f64; 2] = [3.0, 5.0];

/// Partial slip along a path of normal and tangential loads.
pub(crate) const SLIP: Drive = Drive {
    name: "slip",
    keys: &[],
    given: Ingredient {
        path: "path.tangential",
        name: "tangential loads of a path",
        is_given: |it| it.path.as_ref().is_some_and(|path| !path.tangential.is_empty()),
    },
    takes: &["path", "solver.method"],
    needs: &["friction.coefficient"],
    states: |it| it.states_of_path(1),
    check: |it, _| it.check_slip(),
    bytes: |it, grid| {
        let (of_dimension, states) = (usize::from(!grid.is_line()), it.expected_states()? as f64);
        Ok(bytes(grid, FIELDS[of_dimension] + STATE_FIELDS[of_dimension] * states))
    },
    transforms: |_, _| Ok(Drive::TRANSFORMS_OF_WARM_STATE),
    make: |it, problem| Ok(Box::new(it.slip(problem)?)),
    doubts: |it, states| warning_of_path_errors(it, states).into_iter().collect(),
    totals: |_| Vec::new(),
    needs_pressure: true,
    is_list: false,
    missed: Drive::WITHOUT_CERTIFICATE,
    axis: None,
    is_logarithmic: false,
    charts: [
        StateChart::against(Quantity::Shift, Quantity::MeanTraction),
        StateChart { x: None, y: Quantity::StickShare },
    ],
    columns: &[
        Quantity::MeanPressure,
        Quantity::MeanTraction,
        Quantity::Friction,
        Quantity::Shift,
        Quantity::ShiftPathError,
        Quantity::StickShare,
        Quantity::Dissipated,
        Quantity::DissipatedPathError,
        Quantity::RelativeArea,
        Quantity::TractionCertificate,
    ],
    caption: &[Quantity::Friction],
    has_claims: false,
    feels: Feels::PRESSURE,
};

impl Setup {
    /// What makes the history of slip along the path.
    fn slip(&self, problem: Problem) -> Result<SlipProcess<'_>, SetupError> {
        let mu = self.friction.map_or(0.0, |friction| friction.coefficient);
        let history = SlipHistory::sheared(problem, mu, self.shear_ratio(), self.solver.solver(), self.stop)?;
        let history = history.with_coupling(self.dundurs_beta())?;
        Ok(SlipProcess::new(history, self.path_points(), self.slip_pace()))
    }

    /// Refuses normal loads of 0, and a first step of a path at which everything would slide. Where everything slides later, the history ends there.
    fn check_slip(&self) -> Result<(), SetupError> {
        let points = self.path_points();
        if points.iter().any(|point| point.load.value() == 0.0) {
            return Err(ConflictRule::SlipUnloaded.into());
        }
        let Some(first) = points.first() else { return Ok(()) };
        let limit = self.friction.map_or(0.0, |friction| friction.coefficient) * first.load.value();
        let steps = match self.slip_pace() {
            SlipPace::Count(count) => count as f64,
            SlipPace::Tolerance(_) => 1.0,
        };
        let tangential = first.tangential.unwrap_or(0.0) / steps;
        if tangential.abs() >= limit { Err(SlipError::Sliding { tangential, limit }.into()) } else { Ok(()) }
    }

    /// The steps from one point of a path of slip to the next.
    fn slip_pace(&self) -> SlipPace {
        match self.path.as_ref().and_then(|path| path.steps) {
            Some(count) => SlipPace::Count(count),
            None => SlipPace::Tolerance(self.path_tolerance()),
        }
    }

    /// The tolerance of relative errors by the steps of a path with friction.
    pub fn path_tolerance(&self) -> f64 {
        self.path.as_ref().and_then(|path| path.tolerance).unwrap_or(PATH_TOLERANCE)
    }

    /// The ratio `m = sum (nu/G) / sum ((1 - nu)/G)` over the bodies, see [`Compliance::tangential`](crate::elastic::Compliance::tangential);
    /// 0 for a solid of which only the contact modulus is known.
    fn shear_ratio(&self) -> f64 {
        self.solid.as_ref().and_then(Solid::shear_ratio).unwrap_or(0.0)
    }
}

/// The warning that errors of shift or lost energy by the steps of the path are above the tolerance.
fn warning_of_path_errors(setup: &Setup, states: &[Arc<State>]) -> Option<Warning> {
    let tolerance = setup.path_tolerance();
    let largest = |of: &dyn Fn(&State) -> f64| states.iter().map(|state| of(state)).fold(0.0, f64::max);
    let shift = largest(&|state| state.value(Quantity::Shift).abs());
    let shift = shift.max(LEAST_SHIFT * largest(&|state| displacement_by_traction(state)));
    let stored = LEAST_LOSS * largest(&|state| state.value(Quantity::Stored));
    let relative = |state: &State| -> f64 {
        let over =
            |error: Quantity, size: f64| state.get(error).filter(|error| *error > 0.0).map_or(0.0, |it| it / size);
        let lost = state.value(Quantity::Dissipated).max(stored);
        over(Quantity::ShiftPathError, shift).max(over(Quantity::DissipatedPathError, lost))
    };
    let above: Vec<f64> = states.iter().map(|state| relative(state)).filter(|it| *it > tolerance).collect();
    let most = above.iter().copied().reduce(f64::max)?;
    Some(
        Warning::new(
            format!(
                "The estimated error of shift or lost energy by the steps of the path is above the tolerance of {tolerance:e} in {} of {} \
                 states, by up to {most:.1e}",
                above.len(),
                states.len()
            ),
            "Read the stated errors, or put more points on the path where the loads turn",
        )
        .with_remedy("path.tolerance", None),
    )
}

/// The mean displacement by the traction along `x` of a state with friction, weighted with it, a length; 0 without traction.
fn displacement_by_traction(state: &State) -> f64 {
    let traction = state
        .field(FieldKind::Traction)
        .map_or(0.0, |it| it.iter().map(|tau| tau.abs()).sum::<f64>() / it.len() as f64);
    if traction > 0.0 { 2.0 * state.value(Quantity::Stored) / traction } else { 0.0 }
}
