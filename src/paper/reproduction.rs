//! The content of a table or figure that was made again.

use super::verdict::Verdict;
use crate::plot::{Colour, Figure};
use crate::study::Realisation;

/// A table or figure that was made again.
pub struct Reproduction {
    /// The figure, if it is one.
    pub figure: Option<Figure>,
    /// The paper's numbers beside those found here.
    pub verdicts: Vec<Verdict>,
    /// Curves and contacts for a recording over loads.
    pub ramp: Option<Ramp>,
}

/// Curves over loads, and contacts that grow with them.
pub struct Ramp {
    /// The loads in words, lightest first.
    pub captions: Vec<String>,
    /// Where each load stands in the panels of the figure.
    pub cursor: Vec<f64>,
    /// Curves over the loads.
    pub curves: Vec<RampCurve>,
    /// Surfaces under these loads.
    pub contacts: Vec<Realisation>,
    /// Unit of lengths.
    pub length_unit: &'static str,
}

/// A curve over loads.
pub struct RampCurve {
    /// Title of the view that it shares with others.
    pub view: &'static str,
    /// Name in the legend.
    pub name: String,
    /// Colour on paper.
    pub colour: Colour,
    /// One value per load; missing ones are left out.
    pub values: Vec<f64>,
}

/// Loads in words, such as `p* = 1.00e-3`.
pub fn captions(name: &str, values: &[f64]) -> Vec<String> {
    values.iter().map(|value| format!("{name} = {value:.2e}")).collect()
}
