//! Estimated errors of a state by a coarser history.

use super::PlasticState;

/// By how much a state differs from that of a coarser history under the same load. What is coarser says which error it estimates:
///
/// | coarser are   | the error                             |
/// |---------------|---------------------------------------|
/// | the steps, of twice the length | of the steps, of first order: about the difference |
/// | the layers, of twice the thickness, see [`DepthLayers::halved`](crate::elastic::DepthLayers::halved) | in depth, of second order: about a third of it |
/// | the grid      | of the grid: contact edges count in nodes, so that it may be larger than the difference |
///
/// None of them is in the certificate, which is that of one step on its grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlasticErrors {
    /// Of the approach, a length.
    pub approach: f64,
    /// Of the depth of the imprint, a length.
    pub imprint_depth: f64,
    /// Of the accumulated plastic strain over all layers, per area of the cell: a length.
    pub total_accumulated: f64,
    /// Of the mean pressure over the nodes in contact, a pressure.
    pub mean_contact_pressure: f64,
    /// Of the part of the nodes that are in contact.
    pub relative_area: f64,
}

impl PlasticErrors {
    /// The differences of a state and that of a coarser history; NaN where one of them is not converged, since they estimate nothing then.
    pub fn between(state: &PlasticState, coarser: &PlasticState) -> Self {
        let is_known = state.is_converged && coarser.is_converged;
        let difference =
            |of: fn(&PlasticState) -> f64| if is_known { (of(state) - of(coarser)).abs() } else { f64::NAN };
        Self {
            approach: difference(PlasticState::approach),
            imprint_depth: difference(PlasticState::imprint_depth),
            total_accumulated: difference(PlasticState::total_accumulated),
            mean_contact_pressure: difference(PlasticState::mean_contact_pressure),
            relative_area: difference(PlasticState::relative_area),
        }
    }
}
