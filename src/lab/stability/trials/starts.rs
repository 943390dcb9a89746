//! Starts from garbage, and goals below rounding.

use super::shapes::{Grids, LOAD, rough, setup};
use crate::lab::stability::trial::Trial;
use crate::lab::stability::verdict::Demand;

const GARBAGE: [f64; 7] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, 1e300, 1e-300];
const BELOW_ROUNDING: f64 = 1e-16;

pub fn trials(grids: Grids) -> Vec<Trial> {
    let rough = |name, grid| Trial::of(name, setup(rough(grid), grid, LOAD));
    let starts = GARBAGE.map(|garbage| {
        let trial = rough(format!("start-{garbage:e}"), grids.line);
        Trial { start: Some(garbage), ..trial }
    });
    let limits = grids
        .named()
        .map(|(kind, grid)| rough(format!("tolerance-1e-16-{kind}"), grid).to(BELOW_ROUNDING).demanding(Demand::Limit));
    starts.into_iter().chain(limits).collect()
}
