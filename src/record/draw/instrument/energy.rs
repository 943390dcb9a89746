//! The elastic energy by step and wavelength.

use crate::record::draw::drawing::{Drawing, Subject};
use crate::record::draw::instrument::waterfall::{Waterfall, WaterfallQuantity, Waterfalls};

/// The drawing of the energy of a scene, over mean pressure and rms height.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    let problem = subject.scene.problem;
    let energy = WaterfallQuantity {
        entity: "energy",
        title: "Elastic energy by wavelength",
        name: "log10 energy / (p_mean h_rms)",
        unit: problem.expected_mean_pressure() * problem.rms_height(),
        values: |row| &row.energy,
    };
    Some(Box::new(Waterfalls(vec![Waterfall::new(subject, energy)])))
}
