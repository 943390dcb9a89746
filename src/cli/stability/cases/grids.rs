//! Grids: small, odd, prime, long, and fine enough to be stiff.

use super::{noise, pressed, rough};
use crate::cli::contender::Contender;
use crate::cli::stability::case::Case;
use crate::cli::stability::verdict::Demand;
use asperity::Grid;

const LOAD: f64 = 0.05;
const LINES: [usize; 6] = [4, 5, 7, 255, 251, 1021];
const SURFACES: [[usize; 2]; 5] = [[4, 4], [5, 7], [15, 33], [31, 37], [4, 4096]];

pub fn cases(quick: bool) -> Vec<Case> {
    let mut cases = Vec::from(LINES.map(line));
    cases.extend(SURFACES.map(|shape| surface(shape, [1.0, 1.0])));
    cases.extend([surface([4, 4096], [1.0, 1024.0]), surface([32, 32], [1.0, 1000.0])]);
    cases.push(surface([3, 4096], [1.0, 1.0]).demanding(Demand::Refusal));
    cases.push(stiff(14));
    if !quick {
        cases.push(stiff(18));
    }
    cases
}

/// White noise on a line.
fn line(points: usize) -> Case {
    Case::new(format!("grid-{points}"), move || pressed(noise(Grid::line(points, 1.0)?)?, LOAD))
}

/// White noise on a surface.
fn surface(shape: [usize; 2], size: [f64; 2]) -> Case {
    let ([ny, nx], [ly, lx]) = (shape, size);
    let aspect = if ly == lx { String::new() } else { format!("-size-{ly}x{lx}") };
    Case::new(format!("grid-{ny}x{nx}{aspect}"), move || pressed(noise(Grid::surface(shape, size)?)?, LOAD))
}

/// A line whose stiffest wave is half its number of points as stiff as the softest.
fn stiff(power: u32) -> Case {
    Case::new(format!("stiff-2^{power}"), move || pressed(rough(Grid::line(1 << power, 1.0)?)?, LOAD))
        .by(&Contender::ALL)
}
