//! Numbers that are none, or hardly.

use super::{Size, pressed, rough, shaped};
use crate::cli::stability::case::Case;
use crate::cli::stability::verdict::Demand;
use anyhow::Result;
use asperity::{Grid, Problem, Surface};

const LOAD: f64 = 0.05;
const STRAIN: f64 = 0.01;
const NOT_POSITIVE: [f64; 5] = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e-310];

pub fn cases(size: Size) -> Vec<Case> {
    let mut cases = vec![
        of_heights("flat", size, |_| 7.0).demanding(Demand::Refusal),
        of_heights("height-NaN", size, |x| if x == 5 { f64::NAN } else { x as f64 }).demanding(Demand::Refusal),
        of_heights("height-inf", size, |x| if x == 5 { f64::INFINITY } else { x as f64 }).demanding(Demand::Refusal),
        of_heights("height-1e308", size, |x| if x % 2 == 0 { 1e308 } else { -1e308 }).demanding(Demand::Either),
        of_heights("height-1e-310", size, |x| 1e-310 * (x % 7) as f64).demanding(Demand::Either),
    ];
    cases.extend(NOT_POSITIVE.map(|value| refused("length", value, |value| posed(value, 1.0, STRAIN))));
    cases.extend(NOT_POSITIVE.map(|value| refused("modulus", value, |value| posed(1.0, value, STRAIN))));
    cases.extend(NOT_POSITIVE.map(|value| refused("pressure", value, |value| posed(1.0, 1.0, value))));
    cases.extend([f64::NAN, -1.0, 0.0].map(|tolerance| {
        let name = format!("tolerance-{tolerance:e}");
        Case::new(name, move || pressed(rough(size.line()?)?, LOAD)).to(tolerance).demanding(Demand::Refusal)
    }));
    cases
}

/// A line of heights that depend on the column.
fn of_heights(name: &str, size: Size, height: fn(usize) -> f64) -> Case {
    Case::new(name, move || Ok(Problem::new(shaped(size.line()?, |_, x| height(x))?, 1.0, STRAIN)?))
}

/// A quantity that must be refused.
fn refused(name: &str, value: f64, pose: fn(f64) -> Result<Problem>) -> Case {
    Case::new(format!("{name}-{value:e}"), move || pose(value)).demanding(Demand::Refusal)
}

/// A rough line of the given length, modulus and mean pressure.
fn posed(length: f64, modulus: f64, mean_pressure: f64) -> Result<Problem> {
    let unit = rough(Grid::line(64, 1.0)?)?;
    let surface = Surface::new(Grid::line(64, length)?, unit.height().clone())?;
    Ok(Problem::new(surface, modulus, mean_pressure)?)
}
