//! Errors by finite steps in time.

use crate::chunks;
use crate::surface::Field;

/// Estimated errors of a state by finite steps in time.
///
/// The same history is solved in steps of twice the length. An error of first order is the difference of both, one of second order is
/// a third of it. So the difference is stated. Where it crosses zero, the state states a part of the error before, and means state a
/// part of the root mean square over the nodes. The lost energy states what the two histories have moved apart by in all steps, in whichever direction, so that
/// what it grows by is also an error of the loss between two states; and at least the relative error of the pressure for each part of it, and a part of what
/// is missing in the balance of the energies. Transients after a change of the rate of the load that are much shorter than the steps are in neither history: what they may
/// change of the energies is stated. Nodes that have just come into
/// contact state a part of what has flowed in them. The area states the nodes whose pressure or gap is below its error. Quantities that the load
/// prescribes have no error.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TimeErrors {
    /// Of the contact pressure, root mean square over the nodes, a pressure.
    pub pressure: f64,
    /// Of the mean pressure, a pressure.
    pub mean_pressure: f64,
    /// Of the mean gap, a length.
    pub mean_gap: f64,
    /// Of the relative area.
    pub relative_area: f64,
    /// Of the energy that is lost, per area.
    pub lost: f64,
    /// Of the work of the load and of the stored energy, per area: also the difference between the work and the energies that it
    /// became.
    pub work: f64,
}

/// The root mean square of a field.
pub(super) fn rms(field: &Field) -> f64 {
    let values = field.as_slice().expect("standard layout");
    (chunks::sum(values.len(), |i| values[i] * values[i]) / values.len() as f64).sqrt()
}
