//! Fig. 1: `kappa_r` of cylinder and sphere against `p_r*`.

use super::Made;
use super::comparison::Finding;
use super::means::Quantity;
use super::part::Part;
use super::smooth::{LINE, PERIOD, half_width, periodic_cylinder, realisation, widths};
use super::study::Study;
use anyhow::Result;
use asperity::plot::{Axis, Colour, Corner, Figure, Mark, Panel, Point, Series, Symbol};
use asperity::study::{Realisation, Spread};
use asperity::theory::{Geometry, hertz};

/// Half-widths of the contacts over the period, from and to.
const WIDTHS: [f64; 2] = [0.005, 0.1];
/// Cylinders and spheres between these; every so many-th cylinder is as wide as a sphere.
const CYLINDERS: i32 = 33;
const SPHERES: i32 = 5;
/// The widest contact that counts as one without neighbours: the exact periodic `kappa_r` is then within 0.4 %.
const WIDEST: f64 = 0.05;
/// Reduced pressures shown.
const RANGE: [f64; 2] = [3e-5, 0.3];

/// Cylinder and sphere from narrow to wider contacts.
pub fn realisations(study: &Study) -> Result<Vec<Realisation>> {
    let [side, _] = study.smooth_surface;
    Ok(vec![
        realisation(Geometry::Line, LINE, &widths(WIDTHS, CYLINDERS))?,
        realisation(Geometry::Point, side, &widths(WIDTHS, SPHERES))?,
    ])
}

/// Half-widths over the period of the contacts that are recorded.
#[cfg(feature = "record")]
pub fn shown_widths() -> Vec<f64> {
    widths(WIDTHS, SPHERES)
}

/// The figure and how far it is from the analytical lines.
pub fn make(study: &Study) -> Result<Made> {
    let points = study.points(Part::Fig1)?;
    let x = Axis::log("p_r* = p / (g_r E*)", RANGE);
    let mut panel = Panel::new("smooth indenters", x, Axis::linear("κ_r = a_rel / p_r*", [1.3, 2.0]), Corner::TopRight);
    let cases = [
        ("cylinder", Colour::VERMILION, Symbol::Circle, hertz::KAPPA_R_LINE),
        ("sphere", Colour::BLUE, Symbol::Square, hertz::KAPPA_R_POINT),
    ];
    for (name, colour, symbol, exact) in cases {
        let level = RANGE.map(|p| Point::at(p, exact)).to_vec();
        panel.series.push(Series::new(format!("{name}, analytical: {exact:.4}"), colour, Mark::Line, level));
        let measured = |quantity: Quantity| {
            let rows = points.0.iter().filter(|row| row.name == name);
            rows.map(|row| Point::at(row.reduced_pressure_contact, quantity(row))).collect::<Vec<_>>()
        };
        let mark = |filled| Mark::Symbol { symbol, filled };
        panel.series.push(Series::new(
            format!("{name}, nodes counted"),
            colour,
            mark(true),
            measured(|row| row.kappa_r),
        ));
        let corrected = measured(|row| row.kappa_r_corrected);
        panel.series.push(Series::new(format!("{name}, corrected"), colour, mark(false), corrected));
    }
    let periodic = periodic_cylinder(0.2);
    panel.series.push(Series::new("cylinders side by side, exact", Colour::VERMILION, Mark::Dashed, periodic));
    let title = "Fig. 1: κ_r of smooth indenters, L/R = 4".into();
    let mean = |name: &str, quantity: Quantity| {
        let rows = points.0.iter().filter(|row| row.name == name && half_width(row) < 1.1 * WIDEST * PERIOD);
        Spread::of(rows.map(quantity))
    };
    let findings = vec![
        Finding::number("fig1.line", "nodes counted", mean("cylinder", |row| row.kappa_r)),
        Finding::number("fig1.line", "corrected", mean("cylinder", |row| row.kappa_r_corrected)),
        Finding::number("fig1.point", "nodes counted", mean("sphere", |row| row.kappa_r)),
        Finding::number("fig1.point", "corrected", mean("sphere", |row| row.kappa_r_corrected)),
    ];
    Ok(Made { figure: Some(Figure { title, panels: vec![panel] }), findings })
}
