//! Steady rolling with friction.

use crate::contact::{Feels, Problem, Quantity};
use crate::error::{ConflictRule, SetupError, SlipError};
use crate::grid::Grid;
use crate::history::{RollingConditions, RollingDrive, RollingProcess};
use crate::setup::cost::bytes;
use crate::setup::drive::{Drive, StateChart};
use crate::setup::ingredient::Ingredient;
use crate::setup::key::{Dimension, FlagValue, Key, key};
use crate::setup::{RollingMotion, Setup};

/// Fields that rolling takes besides its solves, lines and surfaces. Measured as the peak of resident memory.
const FIELDS: [f64; 2] = [33.0, 33.0];

#[rustfmt::skip]
const KEYS: &[Key] = &[
    key("rolling.creepage", "creepage", FlagValue::List, Dimension::One, "XI[,XI]", "Steady rolling along x of a line with friction, at this creepage; a negative creepage pulls the solid towards +x; needs --friction"),
    key("rolling.tangential", "rolling", FlagValue::List, Dimension::Load, "Q[,Q]", "Steady rolling under this tangential load, of the same kind as the normal one; 0 for free rolling; needs --friction").named("tangential load of rolling"),
    key("rolling.step", "rolling-step", FlagValue::One, Dimension::Length, "L", "Length of a step of rolling [default: the spacing of the grid]").named("step of rolling"),
];

/// Steady rolling of a line with friction, one state for each creepage or tangential load.
pub(crate) const ROLLING: Drive = Drive {
    name: "rolling",
    keys: KEYS,
    given: Ingredient { path: "rolling", name: "rolling", is_given: |it| it.rolling.is_some() },
    takes: &[],
    needs: &["friction.coefficient"],
    states: |it| it.rolling.as_ref().map_or(0, |it| it.creepage.len() + it.tangential.len()),
    check: Setup::check_rolling,
    bytes: |_, grid| Ok(bytes(grid, FIELDS[usize::from(!grid.is_line())])),
    transforms: |_, _| Ok(Drive::TRANSFORMS_OF_WARM_STATE),
    make: |it, problem| Ok(Box::new(it.rolls(problem)?)),
    doubts: |_, _| Vec::new(),
    totals: |_| Vec::new(),
    needs_pressure: true,
    is_list: false,
    missed: Drive::WITHOUT_CERTIFICATE,
    axis: None,
    is_logarithmic: false,
    charts: [
        StateChart::against(Quantity::Creepage, Quantity::Friction),
        StateChart::against(Quantity::Creepage, Quantity::StickShare),
    ],
    columns: &[
        Quantity::Creepage,
        Quantity::Friction,
        Quantity::StickShare,
        Quantity::RelativeArea,
        Quantity::MaxPressure,
        Quantity::Certificate,
        Quantity::TractionCertificate,
    ],
    caption: &[Quantity::Creepage, Quantity::Friction],
    has_claims: false,
    feels: Feels::PRESSURE,
};

impl Setup {
    /// Refuses surfaces, and steps that are longer than the line.
    fn check_rolling(&self, grid: &Grid) -> Result<(), SetupError> {
        if !grid.is_line() {
            return Err(ConflictRule::RollingOnSurface.into());
        }
        let (length, spacing) = (grid.size()[1], grid.spacing()[1]);
        match self.rolling.as_ref().and_then(|rolling| rolling.step).filter(|step| *step > length) {
            Some(step) => {
                let given = [("step", step), ("length", length), ("spacing", spacing)];
                let given = given.map(|(name, value)| (name, value.into()));
                Err(ConflictRule::RollingStepOfLine.with(given).into())
            }
            None => Ok(()),
        }
    }

    /// What makes the states of rolling, one for each creepage or tangential load.
    fn rolls(&self, problem: Problem) -> Result<RollingProcess, SetupError> {
        let rolling = self.rolling.clone().unwrap_or_default();
        let conditions = self.rolling_conditions(&rolling, problem.surface().grid())?;
        Ok(RollingProcess::new(problem, conditions, self.stop))
    }

    /// The conditions of rolling, one for each creepage or tangential load.
    fn rolling_conditions(&self, rolling: &RollingMotion, grid: &Grid) -> Result<Vec<RollingConditions>, SetupError> {
        let friction = self.friction.map_or(0.0, |friction| friction.coefficient);
        let beta = self.dundurs_beta();
        let step = rolling.step.unwrap_or(grid.spacing()[1]);
        let limit = friction * self.load.value();
        let of = |drive| RollingConditions { friction, step, beta, drive };
        let creepages = rolling.creepage.iter().map(|&creepage| of(RollingDrive::Creepage(creepage)));
        let loads = rolling.tangential.iter().map(|&tangential| of(RollingDrive::Ratio(tangential / limit)));
        if let Some(&tangential) = rolling.tangential.iter().find(|it| it.abs() >= limit) {
            return Err(SlipError::Sliding { tangential, limit }.into());
        }
        Ok(creepages.chain(loads).collect())
    }
}
