//! A solid that yields below its surface, under loads up and down.

use super::plastic_doubts::warnings_of_yielding;
use crate::contact::{Feels, Load, Problem, Quantity};
use crate::elastic::DepthLayers;
use crate::error::{ConflictRule, HistoryError, PlasticError, SetupError};
use crate::grid::Grid;
use crate::history::{Plastic, PlasticLoading, PlasticSolid};
use crate::setup::drive::{Drive, StateChart};
use crate::setup::ingredient::Ingredient;
use crate::setup::key::{Dimension, FlagValue, Key, key};
use crate::setup::{Setup, Solid, YieldLaw};

/// The iterations of a load step that are expected.
const ITERATIONS: usize = 30;
/// The memory of a history with those that estimate its errors, over its own: one of the same places, and others of at most a half, a half and a quarter.
const HISTORIES: f64 = 3.25;
/// Transforms of the surface that take as long as a load step in one layer, without flow and with it. Measured on a line of 512 nodes, a ball of 48 x 48 and a
/// rough surface of 64 x 64: 220 to 450 with flow.
const TRANSFORMS_OF_LAYER: [f64; 2] = [20.0, 300.0];
/// The time of a history with those that estimate its errors, over its own: twice the steps, a half, a quarter and a quarter of the places.
const TIMES_OF_ERRORS: f64 = 4.0;
/// Load steps by which the pressure of a given mean gap is found.
const TRIALS_OF_GAP: f64 = 6.0;

#[rustfmt::skip]
const KEYS: &[Key] = &[
    key("solid.yield-stress", "yield-stress", FlagValue::One, Dimension::Pressure, "Y", "Yield stress in tension of a body that yields below its surface (J2 plasticity) and keeps an imprint; needs --young, --poisson and --hardening-modulus; loads, up and down, follow each other").over_modulus(),
    key("solid.hardening-modulus", "hardening-modulus", FlagValue::One, Dimension::Pressure, "H", "Modulus of isotropic hardening: after a plastic strain alpha the body yields at Y + H alpha; a millionth of Young's modulus hardly differs from none").over_modulus(),
    key("solid.kinematic-hardening", "kinematic-hardening", FlagValue::One, Dimension::Pressure, "C", "Modulus of linear kinematic hardening besides, which moves the yield limits [default: 0]").over_modulus(),
    key("solid.yield-depth", "yield-depth", FlagValue::One, Dimension::Length, "D", "Depth at which the layers end in which the body may yield [default: half the longest side of the cell, and deeper where the body yields down to there]"),
    key("solid.yield-layers", "yield-layers", FlagValue::One, Dimension::One, "N", "Number of layers, all of equal thickness [default: the first is half as thick as the spacing of the grid, each further one thicker by a tenth]"),
    key("solid.yield-errors", "yield-errors", FlagValue::Switch, Dimension::Switch, "", "Estimate the errors of imprint and area by the load steps, by the layers and by the grid, from the same loads solved in finer steps, in coarser layers and on a coarser grid; takes about four times as long"),
];

/// A solid that yields below its surface, under loads that go up and down along a path.
pub(crate) const PLASTIC: Drive = Drive {
    name: "plastic",
    keys: KEYS,
    given: Ingredient { path: "solid.yield-stress", name: "a yield stress", is_given: Setup::yields },
    takes: &["path", "solver.method"],
    needs: &[],
    states: Setup::states_of_yielding,
    check: Setup::check_plastic,
    bytes: Setup::plastic_bytes,
    transforms: Setup::transforms_of_yielding,
    make: |it, problem| Ok(Box::new(it.plastic(problem)?)),
    doubts: |it, states| warnings_of_yielding(states, it),
    totals: |_| Vec::new(),
    needs_pressure: false,
    is_list: false,
    missed: Drive::WITHOUT_CERTIFICATE,
    axis: None,
    is_logarithmic: false,
    charts: [
        StateChart::against(Quantity::MeanPressure, Quantity::RelativeArea),
        StateChart::against(Quantity::MeanPressure, Quantity::ImprintDepth),
    ],
    columns: &[
        Quantity::MeanPressure,
        Quantity::RelativeArea,
        Quantity::MeanGap,
        Quantity::ContactPressureOverYield,
        Quantity::MaxPlasticStrain,
        Quantity::DeepestYield,
        Quantity::ImprintDepth,
        Quantity::PlasticWork,
        Quantity::StepCertificate,
    ],
    caption: &[Quantity::MeanPressure, Quantity::DeepestYield],
    has_claims: false,
    feels: Feels::EIGENSTRAIN,
};

impl Setup {
    /// How the solid yields below its surface, if anything of it is given.
    pub(in crate::setup) fn yield_law(&self) -> Option<&YieldLaw> {
        self.solid.as_ref().and_then(Solid::yield_law)
    }

    /// Whether the solid yields below its surface.
    pub fn yields(&self) -> bool {
        self.yield_stress().is_some()
    }

    /// The yield stress of a solid that yields below its surface, a pressure.
    pub fn yield_stress(&self) -> Option<f64> {
        self.yield_law()?.yield_stress
    }

    /// Whether the solid yields in layers that were given, to which none are added.
    pub fn has_fixed_layers(&self) -> bool {
        self.yields() && self.yield_law().is_some_and(|law| !law.grows())
    }

    /// The number of steps from load to load of a solid that yields.
    pub fn yield_steps(&self) -> usize {
        self.path.as_ref().and_then(|path| path.steps).unwrap_or(1)
    }

    /// Whether the errors of a solid that yields are estimated, by other histories beside its own.
    pub fn estimates_errors(&self) -> bool {
        self.yield_law().is_some_and(|law| law.errors)
    }

    /// The solid that yields below a grid, and the layers in which it may.
    fn plastic_solid(&self, grid: &Grid) -> Result<(PlasticSolid, DepthLayers), SetupError> {
        let body = self.solid.as_ref().and_then(Solid::yielding_body);
        let (Some(law), Some(body)) = (self.yield_law(), body) else { return Err(ConflictRule::NoHistory.into()) };
        let made = law.solid(body.young, body.poisson).and_then(|solid| Ok((solid, law.layers(grid)?)));
        Ok(made.map_err(HistoryError::from)?)
    }

    /// Refuses a body in which flow cannot be solved, and parts of a recording that it does not have.
    fn check_body(&self) -> Result<(), SetupError> {
        let body = self.solid.as_ref().map(Solid::as_elastic);
        Err(match body {
            _ if self.yield_law().is_some_and(|law| law.hardening_modulus.is_none()) => {
                ConflictRule::YieldWithoutHardening
            }
            Some(Solid::Layer { .. }) => ConflictRule::YieldOfLayer,
            Some(Solid::Bodies(_, Some(_))) => ConflictRule::YieldOfTwoBodies,
            None | Some(Solid::ContactModulus(_) | Solid::Stiffness { .. }) => ConflictRule::YieldWithoutConstants,
            _ if self.record.what.iter().any(|part| part.is_stress()) => ConflictRule::YieldAndStress,
            _ => return Ok(()),
        }
        .into())
    }

    /// Refuses a solid or layers that cannot be, what flow cannot be solved with, and mean pressures under which the solid yields at all depths.
    fn check_plastic(&self, grid: &Grid) -> Result<(), SetupError> {
        self.check_body()?;
        if !grid.is_periodic() {
            return Err(ConflictRule::YieldOfFree.into());
        }
        if matches!(self.load, Load::Approach(_)) {
            return Err(ConflictRule::YieldLoad.with([("load", self.load.to_string().into())]).into());
        }
        let limit = self.plastic_solid(grid)?.0.deep_limit();
        let pressures = self.path_points().into_iter().filter_map(|point| match point.load {
            Load::MeanPressure(pressure) => Some(pressure),
            Load::Force(force) => Some(force / grid.area()),
            _ => None,
        });
        match pressures.into_iter().find(|pressure| *pressure > limit) {
            Some(mean_pressure) => {
                Err(HistoryError::from(PlasticError::YieldsEverywhere { mean_pressure, limit }).into())
            }
            None => Ok(()),
        }
    }

    /// The states of a solid that yields, with the iterations if these are kept.
    fn states_of_yielding(&self) -> usize {
        let each = if self.record.iterations { ITERATIONS } else { 1 };
        self.path_points().len().saturating_mul(self.yield_steps()).saturating_mul(each)
    }

    /// The bytes that flow below a grid takes, with those of the states that are kept.
    fn plastic_bytes(&self, grid: &Grid) -> Result<f64, SetupError> {
        let (_, layers) = self.plastic_solid(grid)?;
        let histories = if self.estimates_errors() { HISTORIES } else { 1.0 };
        Ok(histories * Plastic::bytes(grid, &layers, self.expected_flow(grid)?)
            + self.states_of_path(1) as f64 * PlasticLoading::bytes_of_state(grid, &layers))
    }

    /// Transforms of the surface that take as long as one state of a solid that yields, with the histories that estimate its errors.
    fn transforms_of_yielding(&self, grid: &Grid) -> Result<f64, SetupError> {
        let (_, layers) = self.plastic_solid(grid)?;
        let of_layer = TRANSFORMS_OF_LAYER[usize::from(self.expected_flow(grid)? > 0.0)];
        let histories = if self.estimates_errors() { TIMES_OF_ERRORS } else { 1.0 };
        let trials = if matches!(self.load, Load::MeanGap(_)) { TRIALS_OF_GAP } else { 1.0 };
        Ok(of_layer * layers.count() as f64 * histories * trials)
    }

    /// What makes the states of a solid that yields, one for each step of the path.
    fn plastic(&self, problem: Problem) -> Result<PlasticLoading<'_>, SetupError> {
        let (solid, layers) = self.plastic_solid(problem.surface().grid())?;
        let loads = self.path_points().into_iter().map(|point| point.load).collect();
        let steps = self.yield_steps();
        let loading = Plastic::new(problem, solid, layers, self.solver.solver())
            .and_then(|plastic| plastic.with_tolerance(self.stop.tolerance()))
            .map(|plastic| plastic.with_max_iterations(self.stop.max_iterations()))
            .map(|plastic| if self.has_fixed_layers() { plastic } else { plastic.with_growing_depth() })
            .map(|plastic| if self.record.iterations { plastic.with_iterations() } else { plastic })
            .and_then(|plastic| PlasticLoading::new(plastic, loads, steps))
            .and_then(|loading| if self.estimates_errors() { loading.with_errors() } else { Ok(loading) });
        Ok(loading.map_err(HistoryError::from)?)
    }
}
