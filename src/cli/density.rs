//! The picture of where the error of a line sits.

use asperity::contact::{Contact, error_density};
use asperity::plot::{Axis, Colour, Dot, Figure, Mark, Panel};

/// The largest number of dots of a curve.
const MOST_DOTS: usize = 2048;
/// The lower end of the axis of the density, over its largest value.
const LOWEST_SHOWN_DENSITY: f64 = 1e-4;
/// Room above the largest value of a curve, over it.
const AXIS_MARGIN: f64 = 1.08;

/// The figure of the pressure along a line, and of the density of the error in energy beside it.
pub(crate) fn figure(surface: &str, contact: &Contact) -> Figure {
    let [pressure, gap] = [&contact.pressure, &contact.gap].map(|field| field.as_slice().unwrap_or_default());
    let grid = contact.problem.surface().grid();
    let modulus = contact.problem.contact_modulus();
    let density = error_density(pressure, gap);
    let largest = density.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let x = || Axis::linear("x", [0.0, grid.size()[1]]);
    let highest = contact.max_pressure() / modulus;
    let mut left = Panel::new("pressure", x(), Axis::linear("p / E*", [0.0, AXIS_MARGIN * highest]));
    left.add("", Colour::ORANGE, Mark::Line, curve(grid.spacing()[1], pressure, |p| p / modulus));
    let title = "where the error is: p (v - min v)";
    let mut right = Panel::new(title, x(), Axis::log("density / largest", [LOWEST_SHOWN_DENSITY, 2.0]));
    right.add(
        "",
        Colour::VERMILION,
        Mark::Line,
        curve(grid.spacing()[1], &density, |it| (it / largest).max(LOWEST_SHOWN_DENSITY)),
    );
    Figure { title: surface.into(), panels: vec![left, right] }
}

/// The curve of a field along a line; of several nodes at a dot, the largest value.
fn curve(dx: f64, field: &[f64], value: impl Fn(f64) -> f64) -> Vec<Dot> {
    let nodes = field.len().div_ceil(MOST_DOTS);
    let dot = |(i, values): (usize, &[f64])| {
        let middle = (i * nodes) as f64 + 0.5 * (values.len() - 1) as f64;
        Dot::at(middle * dx, value(values.iter().copied().fold(0.0, f64::max)))
    };
    field.chunks(nodes).enumerate().map(dot).collect()
}
