//! Pictures of contacts, and of load curves.

use super::units::Units;
use asperity::contact::{Contact, Observables};
use asperity::error::FileError;
use asperity::plot::{Axis, Colour, Dot, Figure, Mark, Panel, Symbol, write_png, write_svg};
use asperity::quantity::{LENGTHS, PRESSURES};
use std::cmp::Ordering;
use std::path::Path;

/// Largest number of dots of a curve.
const DOTS: usize = 4096;
/// Room beyond the extreme values of a curve, over their distance.
const ROOM: f64 = 0.05;

/// Writes a picture as SVG or PNG, by the ending of its name.
pub fn write(path: &Path, figure: &Figure) -> Result<(), FileError> {
    let is_svg = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("svg"));
    if is_svg { write_svg(path, figure) } else { write_png(path, figure) }
}

/// The picture of a contact. Of a line: both surfaces, and the pressure along it. Of a surface: the outline of the contact, and the
/// pressure along the row of the highest one.
pub fn of_contact(title: &str, contact: &Contact, units: Units) -> Figure {
    let grid = contact.problem.surface().grid();
    let first = if grid.is_line() { profile(contact, units) } else { outline(contact, units) };
    Figure { title: title.into(), panels: vec![first, pressure(contact, units)] }
}

/// The picture of contacts under several loads: area and `kappa_r` over the mean pressure, with their errors. Values
/// that are not resolved are shown as counted values, with open symbols.
pub fn of_loads(title: &str, found: &[&Observables], units: Units) -> Figure {
    let area = LoadPanel {
        title: "relative contact area",
        label: "a_rel",
        resolved: |it| it.resolved_area(),
        counted: |it| it.relative_area_counted,
        error: |it| it.relative_area_error,
        is_logarithmic: true,
    };
    let kappa_r = LoadPanel {
        title: "area per load, with the rms gradient in contact",
        label: "kappa_r",
        resolved: |it| it.resolved_kappa_r(),
        counted: |it| it.kappa_r_counted,
        error: |it| it.kappa_r_error,
        is_logarithmic: false,
    };
    Figure { title: title.into(), panels: [area, kappa_r].map(|panel| panel.draw(found, units)).into() }
}

/// A quantity over the mean pressure.
struct LoadPanel {
    title: &'static str,
    label: &'static str,
    resolved: fn(&Observables) -> Option<f64>,
    counted: fn(&Observables) -> f64,
    /// The relative error of the resolved value.
    error: fn(&Observables) -> f64,
    is_logarithmic: bool,
}

impl LoadPanel {
    fn draw(&self, found: &[&Observables], units: Units) -> Panel {
        let highest = found.iter().map(|it| it.mean_pressure).fold(0.0, f64::max);
        let (unit, size) = unit(units.pascals, &PRESSURES, highest);
        let (name, load): (_, &dyn Fn(&Observables) -> f64) = match units.pascals {
            true => (label("mean pressure", unit), &|it| it.mean_pressure / size),
            false => ("p*".into(), &|it| it.reduced_pressure),
        };
        let loads = range(found.iter().map(|it| load(it)));
        let resolved = |it: &&Observables| {
            let value = (self.resolved)(it).unwrap_or(f64::NAN);
            Dot { spread: value * (self.error)(it), ..Dot::at(load(it), value) }
        };
        let counted = |it: &&Observables| match (self.resolved)(it) {
            Some(_) => Dot::at(load(it), f64::NAN),
            None => Dot::at(load(it), (self.counted)(it)),
        };
        let dots: [Vec<Dot>; 2] = [found.iter().map(resolved).collect(), found.iter().map(counted).collect()];
        let x = Axis::log(name, [loads[0] / 1.2, loads[1] * 1.2]);
        let mut panel = Panel::new(self.title, x, self.axis(dots.iter().flatten()));
        let is_counted = dots[1].iter().any(|dot| dot.y.is_finite());
        let [resolved, counted] = dots;
        let mark = Mark::Joined { symbol: Symbol::Circle, filled: true };
        panel.add(if is_counted { "resolved" } else { "" }, Colour::ORANGE, mark, resolved);
        if is_counted {
            let mark = Mark::Symbol { symbol: Symbol::Circle, filled: false };
            panel.add("counted, not resolved", Colour::SKY, mark, counted);
        }
        panel
    }

    /// The axis upwards: of the values alone if it is logarithmic, else from 0 to the end of all error bars.
    fn axis<'a>(&self, dots: impl Iterator<Item = &'a Dot>) -> Axis {
        if self.is_logarithmic {
            let [low, high] = range(dots.map(|dot| dot.y).filter(|y| *y > 0.0));
            return Axis::log(self.label, [low / 1.2, high * 1.2]);
        }
        let ends = dots.flat_map(|dot| [dot.y - dot.spread, dot.y + dot.spread]);
        Axis::linear(self.label, wider(range(ends.chain([0.0]))))
    }
}

/// The rigid surface above the solid along a line.
fn profile(contact: &Contact, units: Units) -> Panel {
    let solid: Vec<f64> = contact.displacement.row(0).iter().map(|u| -u).collect();
    let rigid: Vec<f64> = contact.gap.row(0).iter().zip(&solid).map(|(gap, solid)| gap + solid).collect();
    let (x, heights) = (positions(contact, units), range(solid.iter().chain(&rigid).copied()));
    let (unit, size) = unit(units.metres, &LENGTHS, heights[1] - heights[0]);
    let y = Axis::linear(label("height", unit), wider(heights.map(|height| height / size)));
    let mut panel = Panel::new("surfaces", x.axis(), y);
    panel.add("rigid surface", Colour::SKY, Mark::Line, x.dots(&rigid, f64::min, size));
    panel.add("elastic solid", Colour::ORANGE, Mark::Line, x.dots(&solid, f64::max, size));
    panel
}

/// The outline of the contact of a surface.
fn outline(contact: &Contact, units: Units) -> Panel {
    let grid = contact.problem.surface().grid();
    let ([dy, dx], x) = (grid.spacing(), positions(contact, units));
    let end = |[row, column]: [f64; 2]| Dot::at(column * dx / x.size, row * dy / x.size);
    let gap = Dot::at(f64::NAN, f64::NAN);
    let lines = contact.edges().contour().into_iter().flat_map(|[a, b]| [end(a), end(b), gap]);
    let mut panel = Panel::new(
        "outline of the contact",
        x.axis(),
        Axis::linear(label("y", x.unit), [0.0, grid.size()[0] / x.size]),
    );
    panel.add("", Colour::ORANGE, Mark::Line, lines.collect::<Vec<_>>());
    panel
}

/// The pressure along the row of the highest one.
fn pressure(contact: &Contact, units: Units) -> Panel {
    let highest = contact.max_pressure();
    let row = contact.pressure.rows().into_iter().position(|row| row.iter().any(|p| *p == highest)).unwrap_or(0);
    let pressure = contact.pressure.row(row).to_vec();
    let (x, (unit, size)) = (positions(contact, units), unit(units.pascals, &PRESSURES, highest));
    let title = match contact.problem.surface().grid().is_line() {
        true => "pressure".into(),
        false => format!("pressure along row {row}"),
    };
    let y = Axis::linear(label("p", unit), [0.0, (1.0 + ROOM) * highest / size]);
    let mut panel = Panel::new(title, x.axis(), y);
    panel.add("", Colour::ORANGE, Mark::Line, x.dots(&pressure, f64::max, size));
    panel
}

/// Positions along x in a unit.
struct NodePositions {
    length: f64,
    spacing: f64,
    unit: &'static str,
    size: f64,
}

fn positions(contact: &Contact, units: Units) -> NodePositions {
    let grid = contact.problem.surface().grid();
    let (length, spacing) = (grid.size()[1], grid.spacing()[1]);
    let (unit, size) = unit(units.metres, &LENGTHS, length);
    NodePositions { length, spacing, unit, size }
}

impl NodePositions {
    fn axis(&self) -> Axis {
        Axis::linear(label("x", self.unit), [0.0, self.length / self.size])
    }

    /// The dots of a curve in a unit; of several nodes at a dot, the value that `pick` leaves of them.
    fn dots(&self, values: &[f64], pick: fn(f64, f64) -> f64, unit: f64) -> Vec<Dot> {
        let nodes = values.len().div_ceil(DOTS);
        let dot = |(i, values): (usize, &[f64])| {
            let middle = (i * nodes) as f64 + 0.5 * (values.len() - 1) as f64;
            let value = values.iter().copied().reduce(pick).unwrap_or(f64::NAN);
            Dot::at(middle * self.spacing / self.size, value / unit)
        };
        values.chunks(nodes).enumerate().map(dot).collect()
    }
}

/// The name of the largest unit that is not larger than a value, and its size; none of unknown units.
pub fn unit(is_known: bool, units: &[(&'static str, f64)], value: f64) -> (&'static str, f64) {
    let fits = |unit: &&(&str, f64)| value.abs() >= unit.1;
    if is_known { *units.iter().find(fits).unwrap_or(&units[units.len() - 1]) } else { ("", 1.0) }
}

/// The name of an axis with its unit, if there is one.
pub fn label(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.into() } else { format!("{name} / {unit}") }
}

/// The least and the largest of the finite values, or two values around the only one.
pub fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = values.filter(|it| it.is_finite()).fold(ends, |[low, high], it| [low.min(it), high.max(it)]);
    match low.total_cmp(&high) {
        Ordering::Less => [low, high],
        Ordering::Equal if low != 0.0 => [low - 0.5 * low.abs(), high + 0.5 * high.abs()],
        _ => [0.1, 1.0],
    }
}

/// A range with some room at both ends.
pub fn wider([low, high]: [f64; 2]) -> [f64; 2] {
    let room = ROOM * (high - low);
    [low - room, high + room]
}
