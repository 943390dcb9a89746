//! Reasons to doubt the states of a solid that yields below its surface.

use crate::contact::{Contact, Quantity, State};
use crate::sentence::sentence;
use crate::setup::Setup;
use crate::warning::Warning;
use ndarray::Axis;
use std::sync::Arc;

/// Mean pressures in contact above this part of the yield stress are those of a contact that is fully plastic.
const FULLY_PLASTIC: f64 = 2.4;

/// The largest thickness of given layers, over the mean width of the contacts.
const THICKEST_LAYER: f64 = 0.15;

/// Rounding of thicknesses, relative.
const THICKNESS_ROUNDING: f64 = 1e-9;

/// Accumulated plastic strains above this one are not small.
const LARGEST_STRAIN: f64 = 0.1;

/// The warnings of some states of a setup.
pub(super) fn warnings_of_yielding(states: &[Arc<State>], setup: &Setup) -> Vec<Warning> {
    let most = |of: Quantity| states.iter().filter_map(|state| state.get(of)).fold(0.0, f64::max);
    let reaches_the_bottom = |state: &Arc<State>| {
        let bottom = state.layers.as_ref().and_then(|layers| layers.interfaces.last().copied());
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
            sentence!(
                "The largest plastic strain is {strain:.2}, but the theory of flow used here is for small strains",
                strain
            ),
            "Use less load or gentler slopes, or take the strains where they are large as an estimate",
        )
    });
    let thick = warning_of_thick_layers(states, setup);
    let ratio = most(Quantity::ContactPressureOverYield);
    // in thick layers the mean stress is so low that nothing flows, whatever the pressure is
    let rippled = (ratio > FULLY_PLASTIC && thick.is_none()).then(|| {
        Warning::new(
            sentence!("The mean pressure in contact reaches {ratio:.2} yield stresses: where a contact is fully plastic, the pressure differs by \
                 some percent from node to node, and so do the largest pressure and the largest strain", ratio),
            "Report sums, such as area, mean gap, imprint and work",
        )
    });
    bottom.into_iter().chain(large).chain(thick).chain(rippled).chain(warning_of_errors(setup)).collect()
}

/// The warning of given layers that are too thick for the contact under the largest load.
fn warning_of_thick_layers(states: &[Arc<State>], setup: &Setup) -> Option<Warning> {
    if !setup.has_fixed_layers() {
        return None;
    }
    let pressure = |state: &Arc<State>| state.contact.mean_pressure();
    let heaviest = states.iter().max_by(|a, b| pressure(a).total_cmp(&pressure(b)))?;
    let first = heaviest.layers.as_ref()?.interfaces.get(1).copied()?;
    let width = mean_width(&heaviest.contact)?;
    // the first layer is never asked to be thinner than it is by default
    let limit = (THICKEST_LAYER * width).max(0.5 * heaviest.contact.problem.surface().grid().shortest_spacing());
    (first > limit * (1.0 + THICKNESS_ROUNDING)).then(|| {
        Warning::new(
            format!(
                "The layers are {:.2} times as thick as the contacts are wide: the stress is uniform in a layer, so that a contact that is \
                 narrow flows too late or not at all, and area, imprint and their estimated errors may be far off",
                first / width
            ),
            "Give more layers, or leave their number out",
        )
        .with_remedy("solid.yield-layers", None)
    })
}

/// The mean length of unbroken rows of nodes in contact, along the axis on which it is shorter; none where nothing touches.
fn mean_width(contact: &Contact) -> Option<f64> {
    let grid = contact.problem.surface().grid();
    let axes = if grid.is_line() { &[1][..] } else { &[0, 1] };
    let along = |&axis: &usize| {
        let (mut touching, mut begins) = (0_usize, 0_usize);
        for lane in contact.pressure.lanes(Axis(axis)) {
            // the cell is periodic
            let mut before = lane[lane.len() - 1] > 0.0;
            for touches in lane.iter().map(|p| *p > 0.0) {
                touching += usize::from(touches);
                begins += usize::from(touches && !before);
                before = touches;
            }
        }
        let length = grid.spacing()[axis] * touching as f64;
        // a lane that touches all along has no begin
        if begins == 0 { length.min(grid.size()[axis]) } else { length / begins as f64 }
    };
    let width = axes.iter().map(along).fold(f64::INFINITY, f64::min);
    (width > 0.0).then_some(width)
}

/// The warning of estimated errors that say little.
fn warning_of_errors(setup: &Setup) -> Option<Warning> {
    (setup.estimates_errors() && setup.yield_steps() == 1).then(|| {
        Warning::new(
            "The errors by the load steps are estimated from a single step between two loads, and may be far too small",
            "Take two steps or more",
        )
        .with_remedy("path.steps", Some("2"))
    })
}
