//! Values that are not numbers, not positive, or barely so.

use super::shapes::{Grids, LOAD, STRAIN, pressed, rough, setup, shaped};
use super::units::posed;
use crate::contact::Load;
use crate::lab::stability::trial::Trial;
use crate::lab::stability::verdict::Demand;

const POINTS: usize = 64;
const NOT_POSITIVE: [f64; 5] = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e-310];

pub fn trials(grids: Grids) -> Vec<Trial> {
    // a line of heights that depend on the column
    let heights = |name: &str, height: fn(usize) -> f64| {
        let line = grids.line;
        Trial::new(name, move || pressed(shaped(line, |_, x| height(x))?, Load::MeanPressure(STRAIN)))
    };
    let refused = |name: &str, value: f64, [length, modulus, pressure]: [f64; 3]| {
        let pose = move || posed(POINTS, [length, 1.0], modulus, pressure);
        Trial::new(format!("{name}-{value:e}"), pose).demanding(Demand::Refusal)
    };
    let mut trials = vec![
        heights("flat", |_| 7.0).demanding(Demand::Refusal),
        heights("height-NaN", |x| if x == 5 { f64::NAN } else { x as f64 }).demanding(Demand::Refusal),
        heights("height-inf", |x| if x == 5 { f64::INFINITY } else { x as f64 }).demanding(Demand::Refusal),
        heights("height-1e308", |x| if x % 2 == 0 { 1e308 } else { -1e308 }).demanding(Demand::Either),
        heights("height-1e-310", |x| 1e-310 * (x % 7) as f64).demanding(Demand::Either),
    ];
    trials.extend(NOT_POSITIVE.map(|value| refused("length", value, [value, 1.0, STRAIN])));
    trials.extend(NOT_POSITIVE.map(|value| refused("modulus", value, [1.0, value, STRAIN])));
    trials.extend(NOT_POSITIVE.map(|value| refused("pressure", value, [1.0, 1.0, value])));
    trials.extend([f64::NAN, -1.0, 0.0].map(|tolerance| {
        let setup = setup(rough(grids.line), grids.line, LOAD);
        Trial::of(format!("tolerance-{tolerance:e}"), setup).to(tolerance).demanding(Demand::Refusal)
    }));
    trials
}
