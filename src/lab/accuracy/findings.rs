//! The findings of an experiment.

use super::curve::Curve;
use super::ladder::Ladder;
use super::model::Model;
use super::scene::Scene;
use crate::contact::Stop;
use crate::lab::Rival;

/// All that was measured on a scene; displays as tables, 120 columns wide.
pub struct Findings {
    /// The scene.
    pub scene: Scene,
    /// Errors of the grids.
    pub ladder: Ladder,
    /// Errors of the theories.
    pub models: Vec<Model>,
    /// Errors and work of all solvers on all grids, the finest last.
    pub curves: Vec<Curve>,
}

impl Findings {
    /// The curves on the finest grid.
    pub fn finest(&self) -> impl Iterator<Item = &Curve> {
        self.curves.iter().skip(self.curves.len().saturating_sub(Rival::ALL.len()))
    }

    /// Whether all curves end at the tolerance of a stop.
    pub fn is_converged(&self, stop: &Stop) -> bool {
        let ends = self.curves.iter().map(|curve| curve.points.last());
        ends.into_iter().all(|end| end.is_some_and(|end| end.eta <= stop.tolerance()))
    }
}
