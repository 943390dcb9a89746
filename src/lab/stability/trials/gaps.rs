//! Mean gaps from just touching to nearly closed.

use super::shapes::{Grids, pressed, rough};
use crate::contact::{Load, Problem};
use crate::error::SetupError;
use crate::grid::Grid;
use crate::lab::stability::trial::Trial;

/// Mean gaps over the highest peak: from just below it.
const TO_THE_PEAK: [f64; 3] = [1.0 - 1e-9, 0.999, 0.5];
/// Mean gaps over the rms height: to near zero.
const TO_ZERO: [f64; 3] = [1e-2, 1e-4, 1e-8];

pub fn trials(grids: Grids) -> Vec<Trial> {
    let of_kind = |(kind, grid): (&str, Grid)| {
        let far = TO_THE_PEAK.map(|share| {
            Trial::new(format!("gap-{kind}-peak-{share}"), move || apart(grid, |peak, _| share * peak)).at_mean_gap()
        });
        let near = TO_ZERO.map(|share| {
            Trial::new(format!("gap-{kind}-rms-{share:e}"), move || apart(grid, |_, rms| share * rms)).at_mean_gap()
        });
        far.into_iter().chain(near)
    };
    grids.named().into_iter().flat_map(of_kind).collect()
}

/// A rough surface at a mean gap that follows from its highest peak and rms height.
fn apart(grid: Grid, mean_gap: impl Fn(f64, f64) -> f64) -> Result<Problem, SetupError> {
    let problem = pressed(rough(grid).surface(grid)?, Load::ReducedPressure(0.1))?;
    let peak = problem.height().iter().fold(0.0, |highest: f64, &h| highest.max(h));
    let mean_gap = mean_gap(peak, problem.rms_height());
    Ok(problem.with_load(Load::MeanGap(mean_gap))?)
}
