//! What a recording shows of the layers below a contact that yields.

use crate::contact::{DepthCut, State};
use crate::record::{PLASTIC_STRAIN, VON_MISES, YieldZone};
use crate::setup::Setup;

/// The plastic strain that a scale reaches where nothing has yielded, over the elastic strain at yield.
const LEAST_STRAIN: f64 = 0.1;

/// The layers below some states, with the ranges of their fields over these, times some room.
pub(super) fn zone(setup: &Setup, states: &[&State], room: f64) -> Option<YieldZone> {
    let yield_stress = setup.yield_stress()?;
    let cuts: Vec<&DepthCut> = states.iter().filter_map(|state| state.cut.as_ref()).collect();
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let strain = most(&mut cuts.iter().flat_map(|cut| cut.plastic_strain.iter().copied()));
    let stress = most(&mut cuts.iter().flat_map(|cut| cut.von_mises.iter().copied()));
    let least = LEAST_STRAIN * yield_stress / setup.contact_modulus().ok()?;
    Some(YieldZone {
        interfaces: cuts.first()?.interfaces.clone(),
        yield_stress,
        strain: room * strain.max(least),
        stress: stress.max(yield_stress),
    })
}

/// The fields of a cut, by the names that a recording has for them.
pub(super) fn fields_of_cut(cut: &DepthCut) -> [(&'static str, &[f64]); 2] {
    [(PLASTIC_STRAIN, &cut.plastic_strain), (VON_MISES, &cut.von_mises)]
        .map(|(name, field)| (name, field.as_slice().unwrap_or_default()))
}
