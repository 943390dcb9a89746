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
    let trial = |name, grid, [of_peak, of_rms]: [f64; 2]| {
        let trial = Trial::new(name, move || apart(grid, of_peak, of_rms));
        Trial { is_at_mean_gap: true, ..trial }
    };
    let of_kind = |(kind, grid): (&str, Grid)| {
        let far = TO_THE_PEAK.map(|share| trial(format!("gap-{kind}-peak-{share}"), grid, [share, 0.0]));
        let near = TO_ZERO.map(|share| trial(format!("gap-{kind}-rms-{share:e}"), grid, [0.0, share]));
        far.into_iter().chain(near)
    };
    grids.named().into_iter().flat_map(of_kind).collect()
}

/// A rough surface at a mean gap that is so many times its highest peak, or its rms height.
fn apart(grid: Grid, of_peak: f64, of_rms: f64) -> Result<Problem, SetupError> {
    let problem = pressed(rough(grid).surface(grid)?, Load::ReducedPressure(0.1))?;
    let peak = problem.height().iter().fold(0.0, |highest: f64, &h| highest.max(h));
    let mean_gap = of_peak * peak + of_rms * problem.rms_height();
    Ok(problem.with_load(Load::MeanGap(mean_gap))?)
}
