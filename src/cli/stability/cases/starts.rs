//! Starts from garbage, and goals below rounding.

use super::{Size, pressed, rough};
use crate::cli::stability::case::Case;
use crate::cli::stability::verdict::Demand;

const LOAD: f64 = 0.05;
const GARBAGE: [f64; 7] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, 1e300, 1e-300];
const BELOW_ROUNDING: f64 = 1e-16;

pub fn cases(size: Size) -> Vec<Case> {
    let mut cases = Vec::from(GARBAGE.map(|garbage| start(size, garbage)));
    cases.extend([limit_line(size), limit_surface(size)]);
    cases
}

/// A rough line from a pressure that is none.
fn start(size: Size, garbage: f64) -> Case {
    Case::new(format!("start-{garbage:e}"), move || pressed(rough(size.line()?)?, LOAD)).from(garbage)
}

/// A tolerance below rounding on a line.
fn limit_line(size: Size) -> Case {
    Case::new("tolerance-1e-16-line", move || pressed(rough(size.line()?)?, LOAD))
        .to(BELOW_ROUNDING)
        .demanding(Demand::Limit)
}

/// And on a surface.
fn limit_surface(size: Size) -> Case {
    Case::new("tolerance-1e-16-surface", move || pressed(rough(size.surface()?)?, LOAD))
        .to(BELOW_ROUNDING)
        .demanding(Demand::Limit)
}
