//! A scene with one realisation of its surface.

use super::scene::AccuracyScene;
use crate::contact::Problem;
use crate::error::SetupError;
use crate::setup::Setup;
use crate::surface::RoughnessScale;

/// A scene whose surface is the same on all grids.
///
/// A rough surface has a given rms gradient by finite differences, which depend on the grid, so that scaling it on each
/// grid would change the surface from one to the next. Here it is scaled once, on the finest grid. Its rms height gives
/// the scale on the others: all of them carry the same waves, and by Parseval's theorem the same mean square of them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Realised {
    pub scene: AccuracyScene,
    seed: u64,
    /// Rms height of roughness on the finest grid.
    rms_height: Option<f64>,
}

impl Realised {
    /// The scene, scaled on the grid of `finest` points along each side.
    ///
    /// # Errors
    /// For a grid that cannot carry the scene.
    pub(crate) fn new(scene: AccuracyScene, seed: u64, finest: usize) -> Result<Self, SetupError> {
        let rms_height = if scene.is_rough() { Some(rms_height(&scene.setup(finest, seed))?) } else { None };
        Ok(Self { scene, seed, rms_height })
    }

    /// The setup on the grid of `points` along each side, under the load of the curves.
    ///
    /// # Errors
    /// For a grid that cannot carry the scene.
    pub(crate) fn setup(&self, points: usize) -> Result<Setup, SetupError> {
        let mut setup = self.scene.setup(points, self.seed);
        if let (Some(finest), Some(roughness)) = (self.rms_height, &mut setup.surface.spectrum) {
            roughness.scale = RoughnessScale::RmsHeight(finest);
        }
        Ok(setup)
    }

    /// The problem on that grid.
    ///
    /// # Errors
    /// The errors of [`Realised::setup`].
    pub(crate) fn problem(&self, points: usize) -> Result<Problem, SetupError> {
        self.setup(points)?.problem()
    }
}

fn rms_height(setup: &Setup) -> Result<f64, SetupError> {
    let heights = setup.surface()?;
    let heights = heights.heights();
    Ok((heights.iter().map(|h| h * h).sum::<f64>() / heights.len() as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rough_surface_is_the_same_on_all_grids() {
        for (scene, finest) in [(AccuracyScene::RoughLine, 4096), (AccuracyScene::RoughSurface, 128)] {
            let realised = Realised::new(scene, 3, finest).unwrap();
            let fine = realised.setup(finest).unwrap().surface().unwrap();
            let coarse = realised.setup(finest / 4).unwrap().surface().unwrap();
            let highest = fine.heights().iter().fold(0.0, |highest: f64, h| highest.max(*h));
            for ((y, x), h) in coarse.height().indexed_iter() {
                let there = fine.height()[[if scene.is_line() { 0 } else { 4 * y }, 4 * x]];
                assert!((h - there).abs() < 1e-12 * highest, "{} at {y}, {x}: {h} {there}", scene.name());
            }
        }
    }
}
