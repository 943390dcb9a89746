//! What is recorded, and the quantities and ranges of its axes.

use super::axes::{Axis, Quantity};
use super::part::Parts;
use crate::contact::{Contact, Problem, Step};
use crate::theory::Exact;

/// One contact problem of a recording.
pub struct Scene<'a> {
    /// Root of its entities, such as `hertz_line`; characters other than letters, digits, `_` and `-` become `_`.
    pub name: String,
    /// Title of its tab and pictures.
    pub title: String,
    /// The problem whose steps will be recorded.
    pub problem: &'a Problem,
    /// Parameters, units, seed, solver and settings, in Markdown.
    pub description: String,
    /// The exact solution, where there is one; its pressure is drawn beside the computed one. A line is then shown around
    /// its contact only.
    pub exact: Option<Exact>,
}

/// The fields of a frame, row by row.
#[derive(Clone, Copy)]
pub struct Fields<'a> {
    /// They hold every so many-th node of the scene along y and x: 1 on its own grid, a power of two on coarser ones.
    pub stride: [usize; 2],
    /// Pressure.
    pub pressure: &'a [f64],
    /// Gap; empty if nothing is drawn of it.
    pub gap: &'a [f64],
}

impl<'a> Fields<'a> {
    /// Those of `step` that `parts` show.
    pub fn of(step: &'a Step<'_>, stride: [usize; 2], parts: Parts) -> Self {
        let gap = if parts.has_gap() { step.gap() } else { &[] };
        Self { stride, pressure: step.pressure(), gap }
    }
}

/// What `draw` makes of the fields of `contact`.
pub fn with_fields<T>(contact: &Contact, draw: impl FnOnce(&Fields<'_>) -> T) -> T {
    let [pressure, gap] = [&contact.pressure, &contact.gap].map(|field| field.as_standard_layout());
    let [pressure, gap] = [&pressure, &gap].map(|field| field.as_slice().unwrap_or_default());
    draw(&Fields { stride: [1, 1], pressure, gap })
}

/// How far the fields of some states reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The largest pressure.
    pub pressure: f64,
    /// The largest gap.
    pub gap: f64,
    /// The lowest and the highest place of the relief.
    pub relief: [f64; 2],
}

impl Extent {
    /// That of no state.
    pub const NONE: Self = Self { pressure: 0.0, gap: 0.0, relief: [f64::INFINITY, f64::NEG_INFINITY] };

    /// That of both.
    pub fn and(self, other: Self) -> Self {
        let [low, high] = [f64::min(self.relief[0], other.relief[0]), f64::max(self.relief[1], other.relief[1])];
        Self { pressure: self.pressure.max(other.pressure), gap: self.gap.max(other.gap), relief: [low, high] }
    }
}

/// The smallest gap, over the rms height, that an axis is fitted to: below it a full contact would show its rounding errors.
pub const LEAST_GAP: f64 = 1e-3;

/// Pressure over `E*`, from 0 to `highest`.
pub fn pressure_axis(highest: f64) -> Axis {
    Axis::new(Quantity { symbol: "p / E*", unit: String::new() }, 0.0, headroom(highest))
}

/// Gap over the rms height, from 0 to `highest`.
pub fn gap_axis(highest: f64) -> Axis {
    Axis::new(Quantity { symbol: "gap / h_rms", unit: String::new() }, 0.0, headroom(highest))
}

/// A length.
pub fn length_axis(symbol: &'static str, unit: &str, low: f64, high: f64) -> Axis {
    Axis::new(Quantity { symbol, unit: unit.into() }, low, high)
}

/// A little more than `highest`.
pub fn headroom(highest: f64) -> f64 {
    1.08 * highest
}

/// Smallest and largest finite value.
pub fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let finite = values.into_iter().filter(|v| v.is_finite());
    finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}
