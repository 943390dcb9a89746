//! The direction of the lay.

use crate::fourier::{Complex, Fourier};
use crate::surface::Surface;
use crate::surface::moments::stationary;
use std::f64::consts::PI;

/// Parts of half a turn of which the angular spectrum is a sum: one per degree.
const PARTS: usize = 180;
/// The waves of so many degrees around the strongest ones make their mean direction: a lay of one wave is then exact, and one of two is told apart.
const WIDTH: f64 = 3.0;

/// The direction Std of the lay, in degrees from the x axis towards y from 0 to 180: at right angles to the waves of the direction with the largest
/// power, which is the largest value of the angular spectrum. None for a flat. The heights are under a Hann window along free axes.
///
/// Source: ISO 25178-2:2021, whose angular spectrum measures angles so that grooves along the reference direction have the angle 0.
pub(super) fn texture_direction(surface: &Surface) -> Option<f64> {
    let grid = surface.grid();
    let mut spectrum = vec![Complex::default(); grid.modes()];
    Fourier::new(grid).forward(&stationary(surface), &mut spectrum);
    // a disk of waves, so that the corners of the spectrum, which only some directions have, count for none
    let shortest = 2.0 * PI / grid.shortest_wavelength();
    let vectors = grid.wave_vectors().zip(grid.wavenumbers()).zip(grid.multiplicities());
    let waves: Vec<[f64; 2]> = vectors
        .zip(&spectrum)
        .filter(|(((_, q), _), _)| *q > 0.0 && *q < shortest)
        .map(|((([qy, qx], _), weight), mode)| [lay(qy, qx), weight * mode.norm_sqr()])
        .collect();
    let mut parts = [0.0; PARTS];
    for [angle, power] in &waves {
        parts[(angle.round() as usize) % PARTS] += power;
    }
    let (strongest, power) = parts.iter().enumerate().max_by(|one, other| one.1.total_cmp(other.1))?;
    if *power <= 0.0 {
        return None;
    }
    let [mut sum, mut weight] = [0.0; 2];
    for [angle, power] in waves {
        // the shortest way round, as 179 degrees are beside 0
        let off = (angle - strongest as f64 + 90.0).rem_euclid(180.0) - 90.0;
        if off.abs() <= WIDTH {
            sum += power * off;
            weight += power;
        }
    }
    Some((strongest as f64 + sum / weight).rem_euclid(180.0))
}

/// The direction of the crests of a wave in degrees, from 0 to 180.
fn lay(qy: f64, qx: f64) -> f64 {
    (qy.atan2(qx) + 0.5 * PI).to_degrees().rem_euclid(180.0)
}
