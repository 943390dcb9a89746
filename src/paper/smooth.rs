//! Cylinder and sphere of Section 2.

use super::means::Points;
use super::measure::{Measure, ObservableFn};
use crate::contact::Load;
use crate::plot::Dot;
use crate::setup::{Cell, Recipe, Setup};
use crate::study::{Estimate, Point, Realisation};
use crate::surface::Indenter;
use crate::theory::{Geometry, Periodic, PowerLaw, hertz};

/// Points of smooth lines, as in the paper.
pub(crate) const LINE: usize = 1 << 13;
/// Radius; lengths are in its units.
pub(crate) const RADIUS: f64 = 1.0;
/// Length of the cell: `L/R = 4`.
pub(crate) const PERIOD: f64 = 4.0;

/// An indenter under rising reduced pressures.
pub(crate) fn realisation(name: &str, indenter: Indenter, cell: Cell, loads: Vec<f64>) -> Realisation {
    let heaviest = Load::ReducedPressure(loads.last().copied().unwrap_or(f64::NAN));
    Realisation {
        name: name.into(),
        setup: Setup::new(Recipe::indenter(indenter), cell, heaviest),
        loads: Realisation::reduced_pressures(&loads),
    }
}

/// A cylinder on a line of `points`, loaded to the contact half-widths `widths`, over the period.
pub(crate) fn cylinder(points: usize, widths: &[f64]) -> Realisation {
    let loads = loads(&hertz::cylinder(RADIUS, 1.0), widths);
    realisation("cylinder", Indenter::Cylinder { radius: RADIUS }, Cell::line(points, PERIOD), loads)
}

/// A sphere on a surface of `side` points per side, loaded to the contact radii `widths`, over the period.
pub(crate) fn sphere(side: usize, widths: &[f64]) -> Realisation {
    let loads = loads(&hertz::sphere(RADIUS, 1.0), widths);
    realisation("sphere", Indenter::Sphere { radius: RADIUS }, Cell::surface([side; 2], [PERIOD; 2]), loads)
}

/// `count` half-widths of contacts over the period between two, equally far apart in their logarithm. The nodes of a contact
/// come in whole numbers: means over many widths are rid of that.
pub(crate) fn widths([low, high]: [f64; 2], count: i32) -> Vec<f64> {
    (0..count).map(|i| low * (high / low).powf(f64::from(i) / f64::from(count - 1))).collect()
}

/// The reduced pressures `p*` at which isolated contacts of lines, or of spheres, have the half-widths `widths`, over the
/// period; `gbar` is that of the cell.
pub(crate) fn loads(indenter: &PowerLaw, widths: &[f64]) -> Vec<f64> {
    let PowerLaw { geometry, coefficient, exponent: n, .. } = *indenter;
    let directions = if geometry == Geometry::Line { 1.0 } else { 2.0_f64 };
    let area = if geometry == Geometry::Line { PERIOD } else { PERIOD * PERIOD };
    let slope = coefficient * n * (0.5 * PERIOD).powf(n - 1.0) / (2.0 * n - 1.0).sqrt();
    widths.iter().map(|width| indenter.load(width * PERIOD) / (area * directions.sqrt() * slope)).collect()
}

/// Half-width or radius of the contact of a row, from the resolved area.
pub(crate) fn half_width(row: &Point) -> f64 {
    match row.ny {
        1 => 0.5 * Measure::Resolved.area()(&row.observables) * PERIOD,
        _ => (Measure::Resolved.area()(&row.observables) / std::f64::consts::PI).sqrt() * PERIOD,
    }
}

/// A quantity of the contacts of a name up to some `widest` half-width over the period.
pub(crate) fn narrow(points: &Points, name: &str, widest: f64, quantity: ObservableFn) -> Estimate {
    let narrow = points.named(name).filter(|row| half_width(row) < 1.1 * widest * PERIOD);
    Estimate::from_values(narrow.map(|row| quantity(&row.observables)))
}

/// Mean pressure of a row over the contact modulus.
pub(crate) fn strain(row: &Point) -> f64 {
    row.observables.reduced_pressure * row.observables.rms_gradient
}

/// The exact `kappa_r` of periodic cylinders against `p_r*`, up to contacts `2 widest` periods wide.
pub(crate) fn periodic_cylinder(widest: f64) -> impl Iterator<Item = Dot> {
    let cylinder = Periodic { slope: |s| s / RADIUS, period: PERIOD, contact_modulus: 1.0 };
    let half_widths = (0..=100).map(move |i| widest * PERIOD * 10f64.powf(-2.0 + f64::from(i) / 50.0));
    half_widths.map(move |a| Dot::at(cylinder.load(a) / PERIOD / cylinder.rms_gradient_contact(a), cylinder.kappa_r(a)))
}
