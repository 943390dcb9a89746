//! One load after the other.

use super::sliding::SLIDING;
use crate::contact::{Feels, Quantity};
use crate::history::Loading;
use crate::setup::drive::{Drive, StateChart};
use crate::setup::ingredient::Ingredient;

/// A list of loads: contacts one after the other, each solved from the one before.
pub const LOADS: Drive = Drive {
    name: "loads",
    keys: &[],
    given: Ingredient { path: "load", name: "several loads outside a path", is_given: |it| !it.loads.is_empty() },
    takes: &["law.hardness", "solver.method", "sliding", "viscoelastic"],
    needs: &[],
    states: |it| it.loads.len(),
    check: |it, grid| if it.sliding.is_some() { (SLIDING.check)(it, grid) } else { Ok(()) },
    bytes: |_, _| Ok(0.0),
    transforms: |_, _| Ok(Drive::TRANSFORMS_OF_WARM_STATE),
    make: |it, problem| Ok(Box::new(Loading::new(problem, it.solver(), it.stop).along(it.loads.clone()))),
    doubts: |_, _| Vec::new(),
    totals: |_| Vec::new(),
    needs_pressure: false,
    is_list: true,
    missed: Drive::WITHOUT_CERTIFICATE,
    axis: Some(Quantity::ReducedPressure),
    is_logarithmic: true,
    charts: [
        StateChart::against(Quantity::ReducedPressure, Quantity::RelativeArea),
        StateChart::against(Quantity::ReducedPressure, Quantity::KappaR),
    ],
    columns: &[
        Quantity::ReducedPressure,
        Quantity::MeanPressure,
        Quantity::MeanGap,
        Quantity::RelativeArea,
        Quantity::RelativeAreaCounted,
        Quantity::Kappa,
        Quantity::KappaR,
        Quantity::Patches,
        Quantity::Certificate,
    ],
    caption: &[Quantity::ReducedPressure],
    has_claims: false,
    feels: Feels::PRESSURE,
};
