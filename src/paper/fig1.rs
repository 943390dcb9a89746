//! Fig. 1: `kappa_r` of cylinder and sphere against `p_r*`.

use super::means::Points;
use super::measure::{Measure, ObservableFn};
use super::reproduction::{Ramp, RampCurve, Reproduction, captions};
use super::smooth::{LINE, cylinder, narrow, periodic_cylinder, sphere, widths};
use super::verdict::Verdict;
use crate::plot::{Axis, AxisScale, Colour, Mark, Panel, Symbol};
use crate::study::Realisation;
use crate::theory::hertz;

/// Half-widths of the contacts over the period, from and to.
const WIDTHS: [f64; 2] = [0.005, 0.1];
/// Numbers of cylinders and spheres between these widths; every sphere is as wide as one of the cylinders.
const CYLINDERS: i32 = 33;
const SPHERES: i32 = 5;
/// Points of the cylinder, and along a side of the sphere, that are shown in a recording.
const SHOWN_LINE: usize = 1 << 12;
const SHOWN_SIDE: usize = 1 << 9;

/// Cylinder and sphere from narrow to wider contacts, the sphere on a grid of `side` points per side.
pub(crate) fn realisations(side: usize) -> Vec<Realisation> {
    vec![cylinder(LINE, &widths(WIDTHS, CYLINDERS)), sphere(side, &widths(WIDTHS, SPHERES))]
}

/// The figure and how far it is from the analytical lines.
pub(crate) fn reproduce(points: &Points) -> Reproduction {
    // the exact periodic kappa_r of contacts up to this width is within 0.4 % of the isolated one
    let mean = |name, measure: Measure| narrow(points, name, 0.05, measure.kappa_r());
    let verdicts = vec![
        Verdict::number("fig1.line", "counted", mean("cylinder", Measure::Counted)),
        Verdict::number("fig1.line", "resolved", mean("cylinder", Measure::Resolved)).beside(),
        Verdict::number("fig1.point", "counted", mean("sphere", Measure::Counted)),
        Verdict::number("fig1.point", "resolved", mean("sphere", Measure::Resolved)).beside(),
    ];
    Reproduction::new("Fig. 1: κ_r of smooth indenters, L/R = 4", vec![panel(points)], ramp(points), verdicts)
}

fn panel(points: &Points) -> Panel {
    let [x, y] = [Axis::log("p_r* = p / (g_r E*)", [3e-5, 0.3]), Axis::linear("κ_r = a_rel / p_r*", [1.3, 2.0])];
    let mut panel = Panel::new("smooth indenters", x, y);
    let cases = [
        ("cylinder", Colour::VERMILION, Symbol::Circle, hertz::KAPPA_R_LINE),
        ("sphere", Colour::BLUE, Symbol::Square, hertz::KAPPA_R_POINT),
    ];
    for (name, colour, symbol, exact) in cases {
        panel.add_curve(format!("{name}, analytical: {exact:.4}"), colour, Mark::Line, |_| exact);
        for measure in Measure::ALL {
            let mark = Mark::Symbol { symbol, filled: measure == Measure::Counted };
            let measured = points.dots(name, measure.reduced_pressure_contact(), measure.kappa_r());
            panel.add(format!("{name}, {}", measure.name()), colour, mark, measured);
        }
    }
    panel.add("cylinders side by side, exact", Colour::VERMILION, Mark::Dashed, periodic_cylinder(0.2));
    panel
}

/// Cylinder and sphere with contacts of the same widths, on grids for the eye.
fn ramp(points: &Points) -> Ramp {
    let widths = widths(WIDTHS, SPHERES);
    let each = |name: &str, quantity: ObservableFn| {
        let every = points.named(name).count().saturating_sub(1) / (widths.len() - 1);
        points.values(name, quantity).step_by(every.max(1)).collect::<Vec<_>>()
    };
    let curve = |name, colour| {
        RampCurve::new("κ_r resolved", name, colour, each(name, Measure::Resolved.kappa_r()).into_iter())
    };
    Ramp {
        captions: captions("a/L", &widths),
        quantity: ("p_r*", AxisScale::Log),
        cursor: each("cylinder", Measure::Resolved.reduced_pressure_contact()),
        curves: vec![curve("cylinder", Colour::VERMILION), curve("sphere", Colour::BLUE)],
        contacts: vec![cylinder(SHOWN_LINE, &widths), sphere(SHOWN_SIDE, &widths)],
        length_unit: "R",
    }
}
