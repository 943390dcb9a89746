//! The error of the grid.

use super::curve::solve;
use super::quantity::{QUANTITIES, Values, errors, of_contact, of_exact, root_mean_square};
use super::scene::Scene;
use crate::contact::{Load, Stop, Work};
use crate::error::SetupError;
use crate::lab::table::points;
use crate::lab::{Rival, Watch};

/// Loads over which errors are averaged, from the least to just below twice that: where the edge of the contact falls
/// between two nodes makes the error of a single load jump by a factor of ten.
pub const LOADS: usize = 8;
/// How much finer the grid is that stands in for an exact solution.
pub const REFINEMENT: usize = 4;

/// A grid with its errors.
pub struct Rung {
    /// Points along y and x.
    pub shape: [usize; 2],
    /// Errors, root mean square over the loads.
    pub errors: Values,
    /// Work of the solver at the least load.
    pub work: Work,
}

/// The grids of a scene and what they are held against.
pub struct Ladder {
    /// The source of the truth, in words.
    pub against: String,
    /// The true values at the least load.
    pub truth: Values,
    /// The grids, coarsest first.
    pub rungs: Vec<Rung>,
}

impl Ladder {
    /// Solves `scene` on all grids under all loads.
    pub(super) fn of(
        scene: Scene,
        sides: &[usize],
        seed: u64,
        stop: &Stop,
        watch: &mut Watch<'_>,
    ) -> Result<Self, SetupError> {
        let mut solved = |side| solved(scene, side, seed, stop, watch);
        let (against, truth) = truth(scene, sides, &mut solved)?;
        let rungs = sides.iter().map(|&side| Ok(Rung::of(scene, side, &solved(side)?, &truth)));
        let rungs = rungs.collect::<Result<_, SetupError>>()?;
        Ok(Self { against, truth: truth[0], rungs })
    }

    /// The largest error of `quantity` on the grid of this many points along a side and on all finer ones: a coarse grid may
    /// be right by chance.
    pub fn error_from(&self, side: usize, quantity: usize) -> Option<f64> {
        let finer = self.rungs.iter().filter(|rung| rung.side() >= side);
        finer.map(|rung| rung.errors[quantity]).try_fold(0.0, |worst: f64, error| Some(worst.max(error?)))
    }

    /// The orders in the spacing from the coarsest grid to the finest.
    pub fn orders(&self) -> Values {
        let (Some(first), Some(last)) = (self.rungs.first(), self.rungs.last()) else {
            return [None; QUANTITIES.len()];
        };
        let octaves = (last.side() as f64 / first.side() as f64).log2();
        std::array::from_fn(|i| Some((first.errors[i]? / last.errors[i]?).log2() / octaves).filter(|o| o.is_finite()))
    }
}

impl Rung {
    fn of(scene: Scene, side: usize, solved: &[Solved], truth: &[Values]) -> Self {
        let all: Vec<Values> = solved.iter().zip(truth).map(|((found, _), truth)| errors(found, truth)).collect();
        Self { shape: scene.shape(side), errors: root_mean_square(&all), work: solved[0].1 }
    }

    /// Points along the longer side.
    pub fn side(&self) -> usize {
        self.shape[1]
    }
}

/// The values that a solve under one load has found, and its work.
type Solved = (Values, Work);

/// The true values under all loads, and where they come from.
fn truth(
    scene: Scene,
    sides: &[usize],
    solved: &mut impl FnMut(usize) -> Result<Vec<Solved>, SetupError>,
) -> Result<(String, Vec<Values>), SetupError> {
    let finest = sides.iter().copied().max().unwrap_or_default();
    if let Some(exact) = scene.exact(finest, scene.mean_pressure())? {
        let all =
            loads(scene).map(|load| Ok(scene.exact(finest, load)?.map_or_else(Values::default, |e| of_exact(&e))));
        return Ok((format!("the exact solution ({})", exact.name), all.collect::<Result<_, SetupError>>()?));
    }
    let finer = REFINEMENT * finest;
    let values = solved(finer)?.into_iter().map(|(values, _)| values).collect();
    Ok((format!("{} points", points(scene.shape(finer))), values))
}

/// The contact on one grid under all loads.
fn solved(scene: Scene, side: usize, seed: u64, stop: &Stop, watch: &mut Watch<'_>) -> Result<Vec<Solved>, SetupError> {
    let problem = scene.setup(side, seed).problem()?;
    let solve_under = |(i, load): (usize, f64)| {
        let problem = problem.clone().with_load(Load::MeanPressure(load))?;
        let title = format!("{} {side}, load {} of {LOADS},", scene.name(), i + 1);
        let contact = solve(&Rival::MULTILEVEL, &problem, stop, &mut (), &title, watch)?;
        Ok((of_contact(&contact), contact.work))
    };
    loads(scene).enumerate().map(solve_under).collect()
}

fn loads(scene: Scene) -> impl Iterator<Item = f64> {
    (0..LOADS).map(move |i| scene.mean_pressure() * 2f64.powf(i as f64 / LOADS as f64))
}
