//! The error of the grid.

use super::quantity::{self, QUANTITIES, QuantityValues, errors, exact, found, root_mean_square};
use super::realised::Realised;
use super::scene::AccuracyScene;
use crate::contact::{Load, Multilevel, Solver, Stop, Work};
use crate::error::SetupError;
use crate::lab::ObserverMaker;
use crate::lab::table::points;

/// Loads over which errors are averaged, from the least to just below twice that: where the edge of the contact falls
/// between two nodes makes the error of a single load jump by a factor of ten.
pub(crate) const LOADS: usize = 8;
/// Refinement factor of the grid that replaces an exact solution.
pub(crate) const REFINEMENT: usize = 4;

/// A grid with its errors.
pub(crate) struct Rung {
    pub shape: [usize; 2],
    /// Errors, root mean square over the loads.
    pub errors: QuantityValues,
    /// Work of the solver at the least load.
    pub work: Work,
}

/// The grids of a scene and their reference.
pub(crate) struct Ladder {
    /// The source of the truth, in words.
    pub against: String,
    /// The true values at the least load.
    pub truth: QuantityValues,
    pub rungs: Vec<Rung>,
}

impl Ladder {
    /// Solves a scene on all grids under all loads.
    pub(crate) fn solve(
        realised: &Realised,
        sides: &[usize],
        stop: &Stop,
        watch: ObserverMaker,
    ) -> Result<Self, SetupError> {
        let scene = realised.scene;
        let finest = sides.iter().copied().max().unwrap_or_default();
        let all = loads(scene).map(|load| scene.exact(finest, load).transpose());
        let (against, truth): (_, Vec<QuantityValues>) = match all.collect::<Option<Result<Vec<_>, _>>>().transpose()? {
            Some(all) => (format!("the exact solution ({})", all[0].name), all.iter().map(exact).collect()),
            None => {
                let finer = solved(realised, REFINEMENT * finest, stop, watch)?;
                let name = points(scene.shape(REFINEMENT * finest));
                (
                    format!("{name} points"),
                    finer.into_iter().map(|([best @ .., _, _], _)| quantity::truth(best)).collect(),
                )
            }
        };
        let rung = |&side: &usize| -> Result<Rung, SetupError> {
            let solved = solved(realised, side, stop, watch)?;
            let all: Vec<QuantityValues> =
                solved.iter().zip(&truth).map(|((found, _), truth)| errors(found, truth)).collect();
            Ok(Rung { shape: scene.shape(side), errors: root_mean_square(&all), work: solved[0].1 })
        };
        let rungs = sides.iter().map(rung).collect::<Result<_, _>>()?;
        Ok(Self { against, truth: truth[0], rungs })
    }

    /// The largest error of `quantity` on the grid of this many points per side and on all finer ones: a coarse grid
    /// may be right by chance.
    pub(crate) fn error_from(&self, side: usize, quantity: usize) -> Option<f64> {
        let finer = self.rungs.iter().filter(|rung| rung.shape[1] >= side);
        finer.map(|rung| rung.errors[quantity]).try_fold(0.0, |worst: f64, error| Some(worst.max(error?)))
    }

    /// The orders in the spacing from the coarsest grid to the finest.
    pub(crate) fn orders(&self) -> QuantityValues {
        let (Some(first), Some(last)) = (self.rungs.first(), self.rungs.last()) else {
            return [None; QUANTITIES.len()];
        };
        let octaves = (last.shape[1] as f64 / first.shape[1] as f64).log2();
        std::array::from_fn(|i| Some((first.errors[i]? / last.errors[i]?).log2() / octaves).filter(|o| o.is_finite()))
    }
}

/// The values found on one grid under each load, and the work of the solver.
fn solved(
    realised: &Realised,
    side: usize,
    stop: &Stop,
    watch: ObserverMaker,
) -> Result<Vec<(QuantityValues, Work)>, SetupError> {
    let (scene, problem) = (realised.scene, realised.problem(side)?);
    let solve_under = |(i, load): (usize, f64)| {
        let problem = problem.clone().with_load(Load::MeanPressure(load))?;
        let title = format!("{} {side}, load {} of {LOADS}, multilevel", scene.name(), i + 1);
        let contact = Multilevel.solve(&problem, stop, &mut watch(&title))?;
        Ok((found(&contact), contact.work))
    };
    loads(scene).enumerate().map(solve_under).collect()
}

fn loads(scene: AccuracyScene) -> impl Iterator<Item = f64> {
    (0..LOADS).map(move |i| scene.mean_pressure() * 2f64.powf(i as f64 / LOADS as f64))
}
