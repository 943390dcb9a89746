//! Reasons to doubt the states of a solid that yields below its surface.

use crate::contact::{Quantity, State, StateKind};
use crate::setup::Setup;
use crate::warning::Warning;
use std::sync::Arc;

/// Mean pressures in contact above this part of the yield stress are those of a contact that is fully plastic.
const FULLY_PLASTIC: f64 = 2.4;

/// Accumulated plastic strains above this one are not small.
const LARGEST_STRAIN: f64 = 0.1;

/// The warnings of some states of a setup; none of those of other solids.
pub(super) fn warnings_of_yielding(states: &[Arc<State>], setup: &Setup) -> Vec<Warning> {
    if states.first().is_none_or(|first| first.contact.values().kind != StateKind::Plastic) {
        return Vec::new();
    }
    let most = |of: Quantity| states.iter().filter_map(|state| state.get(of)).fold(0.0, f64::max);
    let reaches_the_bottom = |state: &Arc<State>| {
        let bottom = state.cut.as_ref().and_then(|cut| cut.interfaces.last().copied());
        bottom.is_some_and(|bottom| state.get(Quantity::DeepestYield).is_some_and(|depth| depth >= bottom))
    };
    // layers that were not given grow
    let bottom = (setup.has_fixed_layers() && states.iter().any(reaches_the_bottom)).then(|| {
        Warning::new(
            "The solid yields down to the end of the last layer, so that the results depend on where the layers end",
            "Let the layers end deeper, or use less load",
        )
        .with_remedy("solid.yield-depth", None)
    });
    let strain = most(Quantity::MaxPlasticStrain);
    let large = (strain > LARGEST_STRAIN).then(|| {
        Warning::new(
            format!("The largest plastic strain is {strain:.2}, but the theory of flow used here is for small strains"),
            "Use less load or gentler slopes, or take the strains where they are large as an estimate",
        )
    });
    let ratio = most(Quantity::ContactPressureOverYield);
    let rippled = (ratio > FULLY_PLASTIC).then(|| {
        Warning::new(
            format!(
                "The mean pressure in contact reaches {ratio:.2} yield stresses: where a contact is fully plastic, the pressure differs by \
                 some percent from node to node, and so do the largest pressure and the largest strain"
            ),
            "Report sums, such as area, mean gap, imprint and work",
        )
    });
    bottom.into_iter().chain(large).chain(rippled).chain(warnings_of_errors(states, setup)).collect()
}

/// The warnings of estimated errors of some states that say little.
fn warnings_of_errors(states: &[Arc<State>], setup: &Setup) -> Vec<Warning> {
    if !setup.estimates_errors() {
        return Vec::new();
    }
    let single = (setup.yield_steps() == 1).then(|| {
        Warning::new(
            "The errors by the load steps are estimated from a single step between two loads, and may be far too small",
            "Take two steps or more",
        )
        .with_remedy("path.steps", Some("2"))
    });
    let is_thick = |state: &Arc<State>| {
        let first = state.cut.as_ref().and_then(|cut| cut.interfaces.get(1).copied());
        first.is_some_and(|first| first > state.contact.problem.surface().grid().spacing()[1])
    };
    let thick = (setup.has_fixed_layers() && states.iter().any(is_thick)).then(|| {
        Warning::new(
            "The layers are thicker than the spacing of the grid, so that the errors by the layers may be far larger than they are estimated",
            "Give more layers, or leave their number out",
        )
        .with_remedy("solid.yield-layers", None)
    });
    single.into_iter().chain(thick).collect()
}
