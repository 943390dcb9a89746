//! The direction of the lay.

use crate::fourier::{Complex, Fourier};
use crate::surface::Surface;
use crate::surface::moments::stationary;
use std::f64::consts::PI;

/// Parts of half a turn of which the angular spectrum is a sum: two per degree, the resolution of the direction.
const PARTS: usize = 360;
/// Degrees of a part.
const STEP: f64 = 180.0 / PARTS as f64;

/// The direction Std of the lay, in degrees from the x axis towards y from 0 to 180: at right angles to the waves of the direction with the largest
/// power, which is the largest value of the angular spectrum. None for a flat. The heights are under a Hann window along free axes. A wave counts for all
/// directions that its place in the spectrum spans, as otherwise the few longest waves, whose directions are those of the axes, would always win.
///
/// Source: ISO 25178-2:2021, whose angular spectrum measures angles so that grooves along the reference direction have the angle 0.
pub(super) fn texture_direction(surface: &Surface) -> Option<f64> {
    let grid = surface.grid();
    let mut spectrum = vec![Complex::default(); grid.modes()];
    Fourier::new(grid).forward(&stationary(surface), &mut spectrum);
    // a disk of waves, so that the corners of the spectrum, which only some directions have, count for none
    let shortest = 2.0 * PI / grid.shortest_wavelength();
    let weights = grid.wavenumbers().zip(grid.multiplicities());
    let lowest = grid.size().map(|length| 2.0 * PI / length).into_iter().fold(0.0, f64::max);
    let mut parts = [0.0; PARTS];
    for (([qy, qx], (q, weight)), mode) in grid.wave_vectors().zip(weights).zip(&spectrum) {
        if q > 0.0 && q < shortest {
            spread(lay(qy, qx), (lowest / q).atan().to_degrees(), weight * mode.norm_sqr(), &mut parts);
        }
    }
    let (strongest, power) = parts.iter().enumerate().max_by(|one, other| one.1.total_cmp(other.1))?;
    (*power > 0.0).then_some(strongest as f64 * STEP)
}

/// Adds a power to the parts of half a turn around an angle, all in degrees, less with the distance up to a width, where it is zero.
fn spread(angle: f64, width: f64, power: f64, parts: &mut [f64; PARTS]) {
    let width = width.max(STEP);
    let reach = (width / STEP) as isize + 1;
    let nearest = (angle / STEP).round() as isize;
    let share = |at: isize| (1.0 - (at as f64 * STEP - angle).abs() / width).max(0.0);
    let sum: f64 = (nearest - reach..=nearest + reach).map(share).sum();
    for at in nearest - reach..=nearest + reach {
        parts[at.rem_euclid(PARTS as isize) as usize] += power * share(at) / sum;
    }
}

/// The direction of the crests of a wave in degrees, from 0 to 180.
fn lay(qy: f64, qx: f64) -> f64 {
    (qy.atan2(qx) + 0.5 * PI).to_degrees().rem_euclid(180.0)
}
