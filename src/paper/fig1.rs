//! Fig. 1: `kappa_r` of cylinder and sphere against `p_r*`.

use super::means::{Points, Quantity};
use super::reproduction::{Ramp, RampCurve, Reproduction, captions};
use super::smooth::{LINE, PERIOD, cylinder, half_width, periodic_cylinder, sphere, widths};
use super::theory_lines::level;
use super::verdict::Verdict;
use crate::plot::{self, Axis, Colour, Corner, Figure, Mark, Panel, Series, Symbol};
use crate::study::{Point, Realisation, Spread};
use crate::theory::hertz;

/// Half-widths of the contacts over the period, from and to.
const WIDTHS: [f64; 2] = [0.005, 0.1];
/// Cylinders and spheres between these; every so many-th cylinder is as wide as a sphere.
const CYLINDERS: i32 = 33;
const SPHERES: i32 = 5;
/// Points of the cylinder, and along a side of the sphere, that are shown in a recording.
const SHOWN_LINE: usize = 1 << 12;
const SHOWN_SIDE: usize = 1 << 9;
/// The widest contact that counts as one without neighbours: the exact periodic `kappa_r` is then within 0.4 %.
const WIDEST: f64 = 0.05;
/// Reduced pressures shown.
const RANGE: [f64; 2] = [3e-5, 0.3];

/// Cylinder and sphere from narrow to wider contacts, the sphere on a grid of `side` points a side.
pub fn realisations(side: usize) -> Vec<Realisation> {
    vec![cylinder(LINE, &widths(WIDTHS, CYLINDERS)), sphere(side, &widths(WIDTHS, SPHERES))]
}

/// The figure and how far it is from the analytical lines.
pub fn reproduce(points: &Points) -> Reproduction {
    let title = "Fig. 1: κ_r of smooth indenters, L/R = 4".into();
    let figure = Figure { title, panels: vec![panel(points)] };
    let mean = |name: &str, quantity: Quantity| {
        let narrow = points.named(name).filter(|row| half_width(row) < 1.1 * WIDEST * PERIOD);
        Spread::of(narrow.map(|row| quantity(&row.observables)))
    };
    let verdicts = vec![
        Verdict::number("fig1.line", "nodes counted", mean("cylinder", |it| it.kappa_r)),
        Verdict::number("fig1.line", "corrected", mean("cylinder", |it| it.kappa_r_corrected)),
        Verdict::number("fig1.point", "nodes counted", mean("sphere", |it| it.kappa_r)),
        Verdict::number("fig1.point", "corrected", mean("sphere", |it| it.kappa_r_corrected)),
    ];
    Reproduction { figure: Some(figure), verdicts, ramp: Some(ramp(points)) }
}

fn panel(points: &Points) -> Panel {
    let x = Axis::log("p_r* = p / (g_r E*)", RANGE);
    let mut panel = Panel::new("smooth indenters", x, Axis::linear("κ_r = a_rel / p_r*", [1.3, 2.0]), Corner::TopRight);
    let cases = [
        ("cylinder", Colour::VERMILION, Symbol::Circle, hertz::KAPPA_R_LINE),
        ("sphere", Colour::BLUE, Symbol::Square, hertz::KAPPA_R_POINT),
    ];
    for (name, colour, symbol, exact) in cases {
        let exact_line = level(&panel.x, exact);
        panel.series.push(Series::new(format!("{name}, analytical: {exact:.4}"), colour, Mark::Line, exact_line));
        let kinds: [(&str, bool, Quantity); 2] =
            [("nodes counted", true, |it| it.kappa_r), ("corrected", false, |it| it.kappa_r_corrected)];
        for (kind, filled, quantity) in kinds {
            let point =
                |row: &Point| plot::Point::at(row.observables.reduced_pressure_contact, quantity(&row.observables));
            let measured = points.named(name).map(point).collect();
            panel.series.push(Series::new(
                format!("{name}, {kind}"),
                colour,
                Mark::Symbol { symbol, filled },
                measured,
            ));
        }
    }
    let periodic = periodic_cylinder(0.2);
    panel.series.push(Series::new("cylinders side by side, exact", Colour::VERMILION, Mark::Dashed, periodic));
    panel
}

/// Cylinder and sphere with contacts of the same widths, on grids for the eye.
fn ramp(points: &Points) -> Ramp {
    let widths = widths(WIDTHS, SPHERES);
    let rows = |name: &str| {
        let rows: Vec<&Point> = points.named(name).collect();
        let every = (rows.len().saturating_sub(1) / (widths.len() - 1)).max(1);
        rows.into_iter().step_by(every).collect::<Vec<_>>()
    };
    let [cylinders, spheres] = ["cylinder", "sphere"].map(rows);
    let curve = |name: &str, colour, rows: &[&Point]| {
        let values = rows.iter().map(|row| row.observables.kappa_r_corrected).collect();
        RampCurve { view: "κ_r corrected", name: name.into(), colour, values }
    };
    Ramp {
        captions: captions("a/L", &widths),
        cursor: cylinders.iter().map(|row| row.observables.reduced_pressure_contact).collect(),
        curves: vec![curve("cylinder", Colour::VERMILION, &cylinders), curve("sphere", Colour::BLUE, &spheres)],
        contacts: vec![cylinder(SHOWN_LINE, &widths), sphere(SHOWN_SIDE, &widths)],
        length_unit: "R",
    }
}
