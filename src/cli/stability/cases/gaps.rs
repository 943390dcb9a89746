//! Mean gaps from just touching to nearly closed.

use super::{GRIDS, Grids, Size, rough};
use crate::cli::stability::case::Case;
use anyhow::Result;
use asperity::{Grid, Problem};

/// Mean gaps over the highest peak: from just below it.
const TO_THE_PEAK: [f64; 3] = [1.0 - 1e-9, 0.999, 0.5];
/// Mean gaps over the rms height: to near zero.
const TO_ZERO: [f64; 3] = [1e-2, 1e-4, 1e-8];

pub fn cases(size: Size) -> Vec<Case> {
    let of_kind = |(kind, grid): (&str, Grids)| {
        let far = TO_THE_PEAK.map(|share| {
            Case::new(format!("gap-{kind}-peak-{share}"), move || apart(grid(size)?, |peak, _| share * peak))
                .at_mean_gap()
        });
        let near = TO_ZERO.map(|share| {
            Case::new(format!("gap-{kind}-rms-{share:e}"), move || apart(grid(size)?, |_, rms| share * rms))
                .at_mean_gap()
        });
        far.into_iter().chain(near)
    };
    GRIDS.into_iter().flat_map(of_kind).collect()
}

/// A rough surface at a mean gap that follows from its highest peak and rms height.
fn apart(grid: Grid, mean_gap: impl Fn(f64, f64) -> f64) -> Result<Problem> {
    let pressed = super::pressed(rough(grid)?, 0.1)?;
    let peak = pressed.height().iter().fold(0.0, |highest: f64, &h| highest.max(h));
    let mean_gap = mean_gap(peak, pressed.rms_height());
    Ok(Problem::at_mean_gap(pressed.surface().clone(), 1.0, mean_gap)?)
}
