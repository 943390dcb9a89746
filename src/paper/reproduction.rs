//! The content of a table or figure that was made again.

use super::verdict::Verdict;
use crate::plot::{AxisScale, Colour, Figure, Panel};
use crate::study::Realisation;

/// A table or figure that was made again.
pub(crate) struct Reproduction {
    /// The figure, and curves and contacts for a recording of it, if there is one.
    pub figure: Option<(Figure, Ramp)>,
    /// The paper's numbers beside those found here.
    pub verdicts: Vec<Verdict>,
}

impl Reproduction {
    /// A figure that was made again.
    pub(crate) fn new(title: impl Into<String>, panels: Vec<Panel>, ramp: Ramp, verdicts: Vec<Verdict>) -> Self {
        Self { figure: Some((Figure { title: title.into(), panels }, ramp)), verdicts }
    }
}

/// Curves over loads, and contacts that grow with them.
pub(crate) struct Ramp {
    /// The loads in words, lightest first.
    pub captions: Vec<String>,
    /// The quantity along the x axes of figure and curves, and the spacing of its values.
    pub quantity: (&'static str, AxisScale),
    /// Where each load stands along them.
    pub cursor: Vec<f64>,
    /// Curves over the loads.
    pub curves: Vec<RampCurve>,
    /// Surfaces under these loads.
    pub contacts: Vec<Realisation>,
    /// Unit of lengths.
    pub length_unit: &'static str,
}

/// A curve over loads.
pub(crate) struct RampCurve {
    /// Title of the view that it shares with others.
    pub view: &'static str,
    /// Name in the legend.
    pub name: String,
    /// Colour on paper.
    pub colour: Colour,
    /// One value per load; missing ones are left out.
    pub values: Vec<f64>,
}

impl RampCurve {
    /// A curve through `values`.
    pub(crate) fn new(
        view: &'static str,
        name: impl Into<String>,
        colour: Colour,
        values: impl Iterator<Item = f64>,
    ) -> Self {
        Self { view, name: name.into(), colour, values: values.collect() }
    }
}

/// Loads in words, such as `p* = 1.00e-3`.
pub(crate) fn captions(name: &str, values: &[f64]) -> Vec<String> {
    values.iter().map(|value| format!("{name} = {value:.2e}")).collect()
}
