//! The half-space.

use super::ElasticSolid;
use std::sync::Arc;

/// A half-space of a contact modulus `E* = E / (1 - nu^2)`: `u_q = 2 p_q / (E* q)`.
///
/// # Source
/// Johnson, *Contact Mechanics* (1985), section 13.2; Stanley & Kato, J. Tribol. 119, 481 (1997).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    /// Contact modulus `E*`, a pressure.
    pub contact_modulus: f64,
    /// The distance from a line load at which the displacement is zero, see [`ElasticSolid::datum`]; the length of the
    /// cell if it is left out.
    pub datum: Option<f64>,
}

impl HalfSpace {
    /// The half-space of a contact modulus, a pressure.
    pub fn new(contact_modulus: f64) -> Self {
        Self { contact_modulus, datum: None }
    }

    /// The half-space with a datum of line loads, a length.
    pub fn with_datum(self, datum: f64) -> Self {
        Self { datum: Some(datum), ..self }
    }
}

impl ElasticSolid for HalfSpace {
    fn contact_modulus(&self) -> f64 {
        self.contact_modulus
    }

    fn factor(&self, _q: f64) -> f64 {
        1.0
    }

    fn is_half_space(&self) -> bool {
        true
    }

    fn datum(&self) -> Option<f64> {
        self.datum
    }

    fn description(&self) -> String {
        "half-space".into()
    }
}

impl From<HalfSpace> for Arc<dyn ElasticSolid> {
    fn from(solid: HalfSpace) -> Self {
        Arc::new(solid)
    }
}
