//! Where the solve of a step in time begins.

use super::CreepState;
use crate::surface::Field;

/// The stiffness of a node that comes into contact, in that of the shortest wave: it took the fewest transforms.
const GAP_STIFFNESS: f64 = 0.5;

/// The pressure `m p` to start from: the signed pressure, as it went from the state before to this one, goes on for the step.
/// On rough surfaces with small steps it needs fewer transforms than the last pressure does, and never many more.
pub(super) fn warm_start(state: &CreepState, hist: &Field, dt: f64) -> Option<Field> {
    state.contact.pressure.iter().any(|&p| p > 0.0).then(|| match &state.carried.before {
        Some((before, step)) if dt > 0.0 => {
            let growth = dt / step;
            let further = |now: &f64, before: &f64| now + growth * (now - before);
            let mut start = signed_pressure(state);
            start.zip_mut_with(before, |now, before| *now = further(now, before));
            start - hist
        }
        _ => &state.carried.effective - hist,
    })
}

/// A start without the traces of an earlier contact: values below [`LEAST_START`] of the largest one are zero.
pub(super) fn without_traces(mut start: Field) -> Field {
    let least = LEAST_START * start.iter().fold(0.0, |most: f64, p| most.max(*p));
    start.mapv_inplace(|p| if p > 0.0 && p < least { 0.0 } else { p });
    start
}

/// The least pressure of a node in a start, over the largest one. Where a contact recedes, what nodes remember decays, and the difference of what they
/// remember at two times is positive. Once it is too small for the certificate, a solver that begins with it ends with it: all nodes of the largest earlier contact
/// would be told to touch, with pressures up to 1e-6 of the largest one. Nodes at the edges of contacts carry more than 1e-3 of it.
const LEAST_START: f64 = 1e-4;

/// The effective pressure and, where a surface has a gap, that less the gap times a stiffness: the field goes on
/// through zero where a contact grows, so that it tells which nodes will touch and about how much they will carry. On lines
/// it is the effective pressure alone, since few nodes at a time come into contact.
pub(super) fn signed_pressure(state: &CreepState) -> Field {
    let (mut field, problem) = (state.carried.effective.clone(), &state.contact.problem);
    if !problem.surface().grid().is_line() {
        let [_, stiffest] = problem.compliance().stiffness_range();
        let pairs = state.contact.pressure.iter().zip(&state.contact.gap);
        field.iter_mut().zip(pairs).filter(|(_, (p, _))| **p == 0.0).for_each(|(field, (_, gap))| {
            *field -= GAP_STIFFNESS * stiffest * gap.max(0.0);
        });
    }
    field
}
