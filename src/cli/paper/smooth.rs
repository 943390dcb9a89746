//! Cylinder and sphere of Section 2.

use anyhow::Result;
use asperity::Grid;
use asperity::plot::Point;
use asperity::study::{Realisation, Row, Shape};
use asperity::surface::Indenter;
use asperity::theory::{Geometry, Periodic, PowerLaw, hertz};

/// Points of smooth lines, as in the paper.
pub const LINE: usize = 1 << 13;
/// Radius; lengths are in its units.
pub const RADIUS: f64 = 1.0;
/// Length of the cell: `L/R = 4`.
pub const PERIOD: f64 = 4.0;

/// A cylinder or sphere on `points` per direction, loaded to the contact half-widths `widths`, over the period.
pub fn realisation(geometry: Geometry, points: usize, widths: &[f64]) -> Result<Realisation> {
    let (name, grid, indenter, hertz) = match geometry {
        Geometry::Line => (
            "cylinder",
            Grid::line(points, PERIOD)?,
            Indenter::Cylinder { radius: RADIUS },
            hertz::cylinder(RADIUS, 1.0),
        ),
        Geometry::Point => (
            "sphere",
            Grid::surface([points; 2], [PERIOD; 2])?,
            Indenter::Sphere { radius: RADIUS },
            hertz::sphere(RADIUS, 1.0),
        ),
    };
    let loads = widths.iter().map(|width| reduced_pressure(&hertz, *width)).collect();
    Ok(Realisation { name: name.into(), grid, shape: Shape::Smooth(indenter), loads })
}

/// So many half-widths of contacts over the period between two, equally far apart in their logarithm. The nodes of a contact
/// come in whole numbers: means over many widths are rid of that.
pub fn widths([low, high]: [f64; 2], count: i32) -> Vec<f64> {
    (0..count).map(|i| low * (high / low).powf(f64::from(i) / f64::from(count - 1))).collect()
}

/// `p*` at which an isolated contact of a line, or of a sphere, is `2 width` periods wide; `gbar` is that of the cell.
pub fn reduced_pressure(indenter: &PowerLaw, width: f64) -> f64 {
    let PowerLaw { geometry, coefficient, exponent: n, .. } = *indenter;
    let directions = if geometry == Geometry::Line { 1.0 } else { 2.0_f64 };
    let area = if geometry == Geometry::Line { PERIOD } else { PERIOD * PERIOD };
    let slope = coefficient * n * (0.5 * PERIOD).powf(n - 1.0) / (2.0 * n - 1.0).sqrt();
    indenter.load(width * PERIOD) / (area * directions.sqrt() * slope)
}

/// Half-width or radius of the contact of a row, from the corrected area.
pub fn half_width(row: &Row) -> f64 {
    match row.ny {
        1 => 0.5 * row.relative_area_corrected * PERIOD,
        _ => (row.relative_area_corrected / std::f64::consts::PI).sqrt() * PERIOD,
    }
}

/// Mean pressure of a row over the contact modulus.
pub fn strain(row: &Row) -> f64 {
    row.reduced_pressure * row.rms_gradient
}

/// The exact `kappa_r` of periodic cylinders against `p_r*`, up to contacts `2 widest` periods wide.
pub fn periodic_cylinder(widest: f64) -> Vec<Point> {
    let cylinder = Periodic { slope: |s| s / RADIUS, period: PERIOD, contact_modulus: 1.0 };
    let point = |i: i32| {
        let a = widest * PERIOD * 10f64.powf(-2.0 + f64::from(i) / 50.0);
        let reduced = cylinder.load(a) / PERIOD / cylinder.rms_gradient_contact(a);
        Point::at(reduced, cylinder.kappa_r(a))
    };
    (0..=100).map(point).collect()
}
