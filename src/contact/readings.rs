//! What quantities are computed from.

use crate::contact::{Certificate, Counted, Resolution, Resolved};

/// What is read of a contact or a step to compute its quantities. A number that is not known is NaN.
pub trait Readings {
    /// The mean pressure between the surfaces.
    fn mean_pressure(&self) -> f64;
    /// The reduced pressure.
    fn reduced_pressure(&self) -> f64;
    /// The largest pressure.
    fn max_pressure(&self) -> f64;
    /// The mean gap.
    fn mean_gap(&self) -> f64;
    /// The approach.
    fn approach(&self) -> f64;
    /// The elastic energy, per area.
    fn elastic_energy(&self) -> f64;
    /// The share of nodes at the hardness.
    fn plastic_area(&self) -> f64;
    /// The share of the load on nodes at the hardness.
    fn plastic_load_share(&self) -> f64;
    /// The mean overlap of what yields.
    fn plastic_overlap(&self) -> f64;
    /// The contact stiffness.
    fn stiffness(&self) -> f64;
    /// The relative error of the mean pressure at a given mean gap.
    fn mean_pressure_error(&self) -> f64;
    /// The hysteretic friction.
    fn friction(&self) -> f64;
    /// `kappa_r` with resolved edges.
    fn kappa_r(&self) -> f64;
    /// The modulus by which pressures are reduced.
    fn effective_modulus(&self) -> f64;
    /// The contact modulus.
    fn contact_modulus(&self) -> f64;
    /// The rms height of the surface.
    fn rms_height(&self) -> f64;
    /// The rms gradient of the surface.
    fn rms_gradient(&self) -> f64;
    /// The number of patches.
    fn patches(&self) -> usize;
    /// Iterations of the solver.
    fn iterations(&self) -> usize;
    /// Fourier transforms of the solver.
    fn transforms(&self) -> u64;
    /// What counting nodes gives.
    fn counted(&self) -> &Counted;
    /// What resolved edges give.
    fn resolved(&self) -> &Resolved;
    /// The certificate.
    fn certificate(&self) -> &Certificate;
    /// How well the grid resolves the contact.
    fn resolution(&self) -> Resolution;
}

/// A reduced pressure with the gradient of a contact; NaN where there is no gradient, as in a contact of one node or below a punch.
pub(super) fn known(reduced_pressure: f64) -> f64 {
    if reduced_pressure.is_finite() { reduced_pressure } else { f64::NAN }
}

/// A number of the nodes in contact; NaN where nothing touches.
pub(super) fn in_contact(it: &dyn Readings, value: f64) -> f64 {
    if it.counted().contact_nodes > 0 { value } else { f64::NAN }
}

/// A ratio of an area to a load; NaN where it is zero or no number: without contact, and where single nodes have neither an area nor a gradient.
pub(super) fn positive(ratio: f64) -> f64 {
    if ratio > 0.0 { ratio } else { f64::NAN }
}
