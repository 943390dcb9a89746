//! Grids: small, odd, prime, long, and fine enough to be stiff.

use super::shapes::{LOAD, noise, pressed, rough};
use crate::grid::Grid;
use crate::lab::Rival;
use crate::lab::stability::trial::Trial;
use crate::lab::stability::verdict::Demand;

const LINES: [usize; 6] = [4, 5, 7, 255, 251, 1021];
const SURFACES: [[usize; 2]; 5] = [[4, 4], [5, 7], [15, 33], [31, 37], [4, 4096]];

pub fn trials(is_quick: bool) -> Vec<Trial> {
    let mut trials = Vec::from(LINES.map(line));
    trials.extend(SURFACES.map(|shape| surface(shape, [1.0, 1.0])));
    trials.extend([surface([4, 4096], [1.0, 1024.0]), surface([32, 32], [1.0, 1000.0])]);
    trials.push(surface([3, 4096], [1.0, 1.0]).demanding(Demand::Refusal));
    trials.push(stiff(14));
    if !is_quick {
        trials.push(stiff(18));
    }
    trials
}

/// White noise on a line.
fn line(points: usize) -> Trial {
    Trial::new(format!("grid-{points}"), move || pressed(noise(Grid::line(points, 1.0)?)?, LOAD))
}

/// White noise on a surface.
fn surface(shape: [usize; 2], size: [f64; 2]) -> Trial {
    let ([ny, nx], [ly, lx]) = (shape, size);
    let aspect = if ly == lx { String::new() } else { format!("-size-{ly}x{lx}") };
    Trial::new(format!("grid-{ny}x{nx}{aspect}"), move || pressed(noise(Grid::surface(shape, size)?)?, LOAD))
}

/// A line whose stiffest wave is half its number of points as stiff as the softest.
fn stiff(power: u32) -> Trial {
    let trial = Trial::new(format!("stiff-2^{power}"), move || {
        let grid = Grid::line(1 << power, 1.0)?;
        pressed(rough(grid).surface(grid)?, LOAD)
    });
    Trial { rivals: &Rival::ALL, ..trial }
}
