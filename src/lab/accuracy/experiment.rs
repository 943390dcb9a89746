//! The experiment on a scene.

use super::curve::ConvergenceCurve;
use super::ladder::{Ladder, REFINEMENT};
use super::model::{Model, models};
use super::realised::Realised;
use super::scene::AccuracyScene;
use crate::contact::{Multilevel, Solver, Stop};
use crate::error::{ConflictRule, SettingError, SetupError};
use crate::lab::{ObserverMaker, Rival};
use std::num::NonZeroUsize;

/// The experiment on a scene: its grids, where runs end, and how often they are timed.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// The scene.
    pub scene: AccuracyScene,
    /// Points along each side of the grids, coarsest first.
    pub sides: Vec<usize>,
    /// Seed of rough surfaces.
    pub seed: u64,
    /// Where the curves end.
    pub stop: Stop,
    /// The goals of the reference solutions, if rounding allows them.
    pub reference: Stop,
    /// Runs that are timed after one to warm up.
    pub repeats: NonZeroUsize,
}

impl Experiment {
    /// Checks all that can be checked before anything runs.
    ///
    /// # Errors
    /// For no grids, grids that do not become finer, and grids that cannot carry the scene.
    pub fn check(&self) -> Result<(), SetupError> {
        if let Some(pair) = self.sides.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(SettingError::NotFiner { from: pair[0], to: pair[1] }.into());
        }
        self.scene.setup(*self.sides.first().ok_or(ConflictRule::NoPoints)?, self.seed).check()?;
        self.scene.cell(self.finest().saturating_mul(REFINEMENT)).grid()?;
        Ok(())
    }

    /// Measures the errors of grids, theories and solvers.
    ///
    /// # Errors
    /// The errors of [`Experiment::check`].
    pub fn run(&self, watch: ObserverMaker) -> Result<Measurements, SetupError> {
        self.check()?;
        let realised = self.realised()?;
        let ladder = Ladder::solve(&realised, &self.sides, &self.stop, watch)?;
        let rms_gradient = realised.problem(self.finest())?.rms_gradient();
        let models = models(self.scene, &ladder.truth, self.scene.mean_pressure() / rms_gradient);
        let curves =
            self.sides.iter().map(|&side| self.curves(&realised, side, watch)).collect::<Result<Vec<_>, _>>()?;
        Ok(Measurements { scene: self.scene, ladder, models, curves: curves.into_iter().flatten().collect() })
    }

    /// The scene, scaled on the finest grid that is solved on.
    pub(super) fn realised(&self) -> Result<Realised, SetupError> {
        Realised::new(self.scene, self.seed, self.finest().saturating_mul(REFINEMENT))
    }

    /// The curves of all solvers on one grid.
    fn curves(
        &self,
        realised: &Realised,
        side: usize,
        watch: ObserverMaker,
    ) -> Result<Vec<ConvergenceCurve>, SetupError> {
        let title = format!("{} {side},", self.scene.name());
        let problem = realised.problem(side)?;
        let observer = &mut watch(&format!("{title} multilevel"));
        let reference = Multilevel.solve(&problem, &self.reference, observer)?;
        let curve = |rival| Ok(ConvergenceCurve::measure(rival, &reference, &self.stop, self.repeats, &title, watch)?);
        Rival::ALL.into_iter().map(curve).collect()
    }

    /// Points along each side of the finest grid.
    pub(super) fn finest(&self) -> usize {
        self.sides.last().copied().unwrap_or_default()
    }
}

/// All that was measured on a scene; displays as tables, 120 columns wide.
pub struct Measurements {
    /// The scene.
    pub scene: AccuracyScene,
    /// Errors of the theories.
    pub models: Vec<Model>,
    pub(super) ladder: Ladder,
    /// Errors and work of all solvers on all grids, the finest last.
    pub(super) curves: Vec<ConvergenceCurve>,
}

impl Measurements {
    /// The curves on the finest grid.
    pub(super) fn finest(&self) -> impl Iterator<Item = &ConvergenceCurve> {
        self.curves.iter().skip(self.curves.len().saturating_sub(Rival::ALL.len()))
    }

    /// Whether all curves end at the tolerance of a stop.
    pub fn is_converged(&self, stop: &Stop) -> bool {
        let is_end = |curve: &ConvergenceCurve| curve.points.last().is_some_and(|end| end.eta <= stop.tolerance());
        self.curves.iter().all(is_end)
    }
}
