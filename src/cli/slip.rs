//! The stick and slip areas under a tangential load, as text and as JSON.

use super::output::{TextRow, row};
use super::units::Units;
use asperity::contact::PartialSlip;
use serde::Serialize;

/// The numbers of a contact in partial slip.
#[derive(Serialize)]
pub(crate) struct SlipFinding {
    pub friction: f64,
    /// The tangential load, in the form of the normal one.
    pub tangential: f64,
    /// The same over the load at which all slides.
    pub tangential_over_sliding: f64,
    /// The mean traction, a pressure.
    pub mean_traction: f64,
    pub max_traction: f64,
    /// The area that sticks over that of the cell, with edges interpolated between the nodes.
    pub stick_area: f64,
    pub slip_area: f64,
    /// The certificate of the contact under the smaller load.
    pub stick_certificate: f64,
}

impl From<&PartialSlip> for SlipFinding {
    fn from(slip: &PartialSlip) -> Self {
        let traction = slip.traction();
        Self {
            friction: slip.friction.coefficient,
            tangential: slip.friction.tangential,
            tangential_over_sliding: slip.ratio,
            mean_traction: traction.mean().unwrap_or(f64::NAN),
            max_traction: traction.fold(0.0, |most: f64, &tau| most.max(tau)),
            stick_area: slip.stick().relative_area,
            slip_area: slip.slip_area(),
            stick_certificate: slip.stuck.certificate.eta,
        }
    }
}

impl SlipFinding {
    /// Names and values for reading.
    pub(crate) fn rows(&self, units: Units) -> Vec<TextRow> {
        let load = format!("{:.6e} of the load at which everything slides", self.tangential_over_sliding);
        let stick = format!("{:.6} (certificate {:.2e})", self.stick_area, self.stick_certificate);
        vec![
            row("tangential load", load),
            row("mean traction", units.pressure(self.mean_traction)),
            row("largest traction", units.pressure(self.max_traction)),
            row("stick area", stick),
            row("slip area", format!("{:.6}", self.slip_area)),
        ]
    }
}
