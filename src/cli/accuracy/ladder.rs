//! The error of the grid.

use super::curve::solve;
use super::quantity::{NAMES, Values, errors, of_contact, of_exact, root_mean_square};
use super::scene::Scene;
use crate::cli::contender::Contender;
use anyhow::Result;
use asperity::Problem;
use asperity::contact::{Load, Stop, Work};

/// Loads over which errors are averaged, from the least to just below twice that: where the edge of the contact falls
/// between two nodes makes the error of a single load jump by a factor of ten.
pub const LOADS: usize = 8;
/// How much finer the grid is that stands in for an exact solution.
pub const REFINEMENT: usize = 4;

/// One grid.
pub struct Rung {
    pub shape: [usize; 2],
    /// Root mean square over the loads.
    pub errors: Values,
    /// Work of the solver at the least load.
    pub work: Work,
}

/// The grids of a scene and what they are held against.
pub struct Ladder {
    /// What the truth comes from.
    pub against: String,
    /// The true values at the least load.
    pub truth: Values,
    pub rungs: Vec<Rung>,
}

impl Ladder {
    /// Solves `scene` on all grids under all loads.
    pub fn of(scene: Scene, sides: &[usize], seed: u64, stop: &Stop) -> Result<Self> {
        let (against, truth) = truth(scene, sides, seed, stop)?;
        let rungs = sides.iter().map(|&side| Rung::of(scene, side, seed, stop, &truth)).collect::<Result<_>>()?;
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
        let (Some(first), Some(last)) = (self.rungs.first(), self.rungs.last()) else { return [None; NAMES.len()] };
        let octaves = (last.side() as f64 / first.side() as f64).log2();
        std::array::from_fn(|i| Some((first.errors[i]? / last.errors[i]?).log2() / octaves).filter(|o| o.is_finite()))
    }
}

impl Rung {
    fn of(scene: Scene, side: usize, seed: u64, stop: &Stop, truth: &[Values]) -> Result<Self> {
        let solved = solved(scene, side, seed, stop)?;
        let all: Vec<Values> = solved.iter().zip(truth).map(|((found, _), truth)| errors(found, truth)).collect();
        Ok(Self { shape: scene.grid(side)?.shape(), errors: root_mean_square(&all), work: solved[0].1 })
    }

    /// Points along the longer side.
    pub fn side(&self) -> usize {
        self.shape[1]
    }
}

/// The true values under all loads, and where they come from.
fn truth(scene: Scene, sides: &[usize], seed: u64, stop: &Stop) -> Result<(String, Vec<Values>)> {
    let finest = sides.iter().copied().max().unwrap_or_default();
    if let Some(exact) = scene.exact(finest, scene.mean_pressure())? {
        let all = loads(scene).map(|load| Ok(scene.exact(finest, load)?.map_or([None; NAMES.len()], |e| of_exact(&e))));
        return Ok((format!("the exact solution ({})", exact.name), all.collect::<Result<_>>()?));
    }
    let finer = REFINEMENT * finest;
    let values = solved(scene, finer, seed, stop)?.into_iter().map(|(values, _)| values).collect();
    Ok((format!("{} points", if scene.is_line() { finer.to_string() } else { format!("{finer}x{finer}") }), values))
}

/// The contact on one grid under all loads.
fn solved(scene: Scene, side: usize, seed: u64, stop: &Stop) -> Result<Vec<(Values, Work)>> {
    let problem = scene.problem(side, seed)?;
    let solve_under = |(i, load): (usize, f64)| {
        let problem: Problem = problem.clone().with_load(Load::MeanPressure(load))?;
        let title = format!("{} {side}, load {} of {LOADS},", scene.name(), i + 1);
        let contact = solve(Contender::Multilevel, &problem, stop, &mut (), &title)?;
        Ok((of_contact(&contact, &problem), contact.work))
    };
    loads(scene).enumerate().map(solve_under).collect()
}

fn loads(scene: Scene) -> impl Iterator<Item = f64> {
    (0..LOADS).map(move |i| scene.mean_pressure() * 2f64.powf(i as f64 / LOADS as f64))
}
