//! The work of the load in a step.

use crate::contact::Contact;
use crate::surface::Field;

/// A contact at a given plastic strain, as far as the work of the load depends on it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pressing {
    /// The mean pressure `P`.
    pressure: f64,
    /// The elastic energy of the pressure, `<p A p>/2`, pressure times length.
    energy: f64,
    /// The approach `D` of the rigid surface, a length, from any fixed place on. Without a pressure it does no work, and is 0.
    approach: f64,
}

impl Pressing {
    /// The contact on the heights less a residual displacement.
    pub(crate) fn new(contact: &Contact, residual: &Field) -> Self {
        let pressed = &contact.displacement;
        Self::from_parts(contact, mean(&(&contact.pressure * pressed)), mean(pressed) + mean(residual))
    }

    /// The contact of a state, whose displacement has the residual one in it.
    pub(crate) fn from_whole(contact: &Contact, residual: &Field) -> Self {
        let pressed = &contact.displacement - residual;
        Self::from_parts(contact, mean(&(&contact.pressure * &pressed)), mean(&contact.displacement))
    }

    fn from_parts(contact: &Contact, product: f64, displacement: f64) -> Self {
        match contact.mean_pressure() {
            0.0 => Self::default(),
            pressure => Self { pressure, energy: 0.5 * product, approach: displacement - mean(&contact.gap) },
        }
    }

    /// The work of the load up to another state of the same plastic strain. A contact is conservative, so that it is the change of the elastic energy,
    /// whatever the length of the step.
    pub(crate) fn elastic_work(&self, after: &Self) -> f64 {
        after.energy - self.energy
    }

    /// The work of the load in a step `int P dD` with flow, from this contact to the one `after` it.
    ///
    /// The load and the plastic strain change together, in an order that one implicit step does not know. If all of the load comes first, `loaded` is the
    /// contact under it before anything flows, and what flows then moves the surface under the whole load. If all of the flow comes first, `flowed` is
    /// the contact under the load before with the plastic strain after the step. The work is the mean of both. What is elastic in it is exact.
    pub(crate) fn work(&self, loaded: &Self, flowed: &Self, after: &Self) -> f64 {
        let load_first = self.elastic_work(loaded) + after.pressure * (after.approach - loaded.approach);
        let flow_first = self.pressure * (flowed.approach - self.approach) + flowed.elastic_work(after);
        0.5 * (load_first + flow_first)
    }
}

fn mean(field: &Field) -> f64 {
    field.mean().unwrap_or(0.0)
}
