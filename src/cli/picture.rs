//! Pictures of contacts, and of load curves.

use super::hatch::hatch;
use super::units::Units;
use asperity::Grid;
use asperity::contact::{Contact, Load, Observables};
use asperity::plot::{Axis, Colour, Dot, FieldMap, Figure, Mark, Panel, Symbol, label, unit};
use asperity::quantity::{LENGTHS, PRESSURES, number_in_words};
use asperity::setup::Recipe;
use asperity::surface::Field;
use std::cmp::Ordering;

/// Largest number of dots of a curve.
const MOST_DOTS: usize = 4096;
/// Room beyond the extreme values of a curve, over their distance.
const AXIS_MARGIN: f64 = 0.05;

/// The share of the nodes in contact with the largest pressures that may be beyond the colours, and how many times as much as the others they then have.
const CLIPPED_NODES: f64 = 0.005;
const CLIPPED_PRESSURE_RATIO: f64 = 1.5;

/// The largest number of pixels of a map along an axis.
const MOST_PIXELS: usize = 1024;

/// The picture of a contact. Of a line: both surfaces, and the pressure along it. Of a surface: maps of the pressure and of the gap.
pub(crate) fn of_contact(title: &str, contact: &Contact, units: Units) -> Figure {
    let panels = match contact.problem.surface().grid().is_line() {
        true => vec![profile(contact, units), pressure(contact, units)],
        false => {
            let grid = contact.problem.surface().grid();
            let map = |title: &str, field: &Field| NamedMap { title: title.into(), grid: *grid, field: field.clone() };
            let [pressure, gap] = [map("pressure", &contact.pressure), map("gap", &contact.gap)];
            let mut panels = [pressures(&[pressure], units), gaps(&[gap], units)].concat();
            panels.iter_mut().for_each(|panel| hatch(panel, grid, contact.problem.surface().filled(), units));
            panels
        }
    };
    Figure { title: title.into(), panels }
}

/// A field of a result with a title.
pub(crate) struct NamedMap {
    pub title: String,
    pub grid: Grid,
    pub field: Field,
}

/// The title of a picture of a surface, see [`with_images`].
pub(crate) fn title_of(recipe: &Recipe, grid: &Grid) -> String {
    with_images(recipe.title(grid), recipe)
}

/// A title that says where mirror images are beside what was measured.
pub(crate) fn with_images(title: String, recipe: &Recipe) -> String {
    if recipe.prepare.mirror.is_some() { format!("{title} with its mirror images") } else { title }
}

/// The picture of contacts under several loads: area and `kappa_r` over the load as it was prescribed, with their errors. Values
/// that are not resolved are shown as counted values, with open symbols.
pub(crate) fn of_loads(title: &str, found: &[Observables], kind: Load, units: Units) -> Figure {
    let area = LoadPanel {
        title: "relative contact area",
        label: "aᵣₑₗ",
        resolved: |it| it.resolved_area(),
        counted: |it| it.relative_area_counted,
        error: |it| it.relative_area_error,
        is_logarithmic: true,
    };
    let kappa_r = LoadPanel {
        title: "area per load, with the rms gradient in contact",
        label: "κᵣ",
        resolved: |it| it.resolved_kappa_r(),
        counted: |it| it.kappa_r_counted,
        error: |it| it.kappa_r_error,
        is_logarithmic: false,
    };
    Figure { title: title.into(), panels: [area, kappa_r].map(|panel| panel.draw(found, kind, units)).into() }
}

/// A quantity over the load.
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
    fn draw(&self, found: &[Observables], kind: Load, units: Units) -> Panel {
        let (name, load) = load_axis(found, kind, units);
        let loads = range(found.iter().map(&load));
        let resolved = |it: &Observables| {
            let value = (self.resolved)(it).unwrap_or(f64::NAN);
            Dot { spread: value * (self.error)(it), ..Dot::at(load(it), value) }
        };
        let counted = |it: &Observables| match (self.resolved)(it) {
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

    /// The axis upwards, to the ends of all error bars; a linear one begins at 0.
    fn axis<'a>(&self, dots: impl Iterator<Item = &'a Dot>) -> Axis {
        if self.is_logarithmic {
            let ends = dots.flat_map(|dot| [dot.y - dot.spread, dot.y, dot.y + dot.spread]);
            let [low, high] = range(ends.filter(|y| *y > 0.0));
            return Axis::log(self.label, [low / 1.2, high * 1.2]);
        }
        let ends = dots.flat_map(|dot| [dot.y - dot.spread, dot.y + dot.spread]);
        Axis::linear(self.label, wider(range(ends.chain([0.0]))))
    }
}

/// The name of the load, and its number of a contact in the unit of the name.
fn load_axis(found: &[Observables], kind: Load, units: Units) -> (String, impl Fn(&Observables) -> f64) {
    let (name, of): (_, fn(&Observables) -> f64) = match kind {
        Load::ReducedPressure(_) => ("p*", |it| it.reduced_pressure),
        Load::MeanGap(_) => ("mean gap", |it| it.mean_gap),
        Load::Approach(_) => ("approach", |it| it.approach),
        Load::MeanPressure(_) | Load::Force(_) => ("mean pressure", |it| it.mean_pressure),
    };
    let highest = found.iter().map(of).fold(0.0, f64::max);
    let (unit, size) = match kind {
        Load::ReducedPressure(_) => ("", 1.0),
        Load::MeanGap(_) | Load::Approach(_) => unit(units.metres, &LENGTHS, highest),
        Load::MeanPressure(_) | Load::Force(_) => unit(units.pascals, &PRESSURES, highest),
    };
    (label(name, unit), move |it| of(it) / size)
}

/// The rigid surface above the solid along a line.
fn profile(contact: &Contact, units: Units) -> Panel {
    let solid: Vec<f64> = contact.displacement.row(0).iter().map(|u| -u).collect();
    let rigid: Vec<f64> = contact.gap.row(0).iter().zip(&solid).map(|(gap, solid)| gap + solid).collect();
    let (x, heights) = (positions(contact.problem.surface().grid(), units), range(solid.iter().chain(&rigid).copied()));
    let (unit, size) = unit(units.metres, &LENGTHS, heights[1] - heights[0]);
    let y = Axis::linear(label("height", unit), wider(heights.map(|height| height / size)));
    let mut panel = Panel::new("surfaces", x.axis(), y);
    panel.add("rigid surface", Colour::SKY, Mark::Line, x.dots(&rigid, f64::min, size));
    panel.add("elastic solid", Colour::ORANGE, Mark::Line, x.dots(&solid, f64::max, size));
    panel
}

/// Pressures of surfaces in the same colours; where there is none, a map is white.
pub(crate) fn pressures(maps: &[NamedMap], units: Units) -> Vec<Panel> {
    let largest = |of: fn(&Field) -> f64| maps.iter().map(|it| of(&it.field)).fold(0.0, f64::max);
    let (highest, end) = (largest(most), largest(end_of_colours));
    let (unit, size) = unit(units.pascals, &PRESSURES, highest);
    let value = |p: f64| if p > 0.0 { p / size } else { f64::NAN };
    let beyond = if end < highest { format!(", at most {}", number_in_words(highest / size)) } else { String::new() };
    let scale = Axis::linear(label("pressure", unit) + &beyond, [0.0, (end / size).max(f64::MIN_POSITIVE)]);
    maps.iter().map(|it| map(it, it.field.mapv(value), f64::max, scale.clone(), units)).collect()
}

/// The pressure at which the colours end: the largest one, unless a few nodes have several times as much as all others, which would be of one colour.
fn end_of_colours(pressure: &Field) -> f64 {
    let mut pressures: Vec<f64> = pressure.iter().copied().filter(|p| *p > 0.0).collect();
    let highest = most(pressure);
    if pressures.is_empty() {
        return highest;
    }
    let place = ((1.0 - CLIPPED_NODES) * (pressures.len() - 1) as f64) as usize;
    let (_, most, _) = pressures.select_nth_unstable_by(place, f64::total_cmp);
    if highest > CLIPPED_PRESSURE_RATIO * *most { *most } else { highest }
}

fn most(field: &Field) -> f64 {
    field.iter().copied().fold(0.0, f64::max)
}

/// Gaps of surfaces in the same colours.
pub(crate) fn gaps(maps: &[NamedMap], units: Units) -> Vec<Panel> {
    lengths("gap", maps, f64::min, units)
}

/// Depths of imprints below the highest place that the body would have without load, in the same colours.
pub(crate) fn imprints(maps: &[NamedMap], units: Units) -> Vec<Panel> {
    lengths("depth of the imprint", maps, f64::max, units)
}

/// Fields of lengths from 0 on, of a name, in the same colours. Of several nodes at a pixel they show the value that `pick` leaves of them.
fn lengths(name: &str, maps: &[NamedMap], pick: fn(f64, f64) -> f64, units: Units) -> Vec<Panel> {
    let longest = maps.iter().map(|it| most(&it.field)).fold(0.0, f64::max);
    let (unit, size) = unit(units.metres, &LENGTHS, longest);
    let scale = Axis::linear(label(name, unit), [0.0, (longest / size).max(f64::MIN_POSITIVE)]);
    maps.iter().map(|it| map(it, it.field.mapv(|length| length / size), pick, scale.clone(), units)).collect()
}

/// A field of a surface in colours. Of several nodes at a pixel it shows the value that `pick` leaves of them.
fn map(named: &NamedMap, field: Field, pick: fn(f64, f64) -> f64, scale: Axis, units: Units) -> Panel {
    let NamedMap { title, grid, .. } = named;
    let x = positions(grid, units);
    let nodes = grid.shape().map(|points| points.div_ceil(MOST_PIXELS));
    let pixels = field.exact_chunks((nodes[0], nodes[1])).into_iter();
    let values = pixels.map(|nodes| nodes.iter().copied().reduce(pick).unwrap_or(f64::NAN)).collect();
    let shape = [0, 1].map(|axis| grid.shape()[axis] / nodes[axis]);
    let lengths = [0, 1].map(|axis| (shape[axis] * nodes[axis]) as f64 * grid.spacing()[axis] / x.size);
    let axes =
        [Axis::linear(label("x", x.unit), [0.0, lengths[1]]), Axis::linear(label("y", x.unit), [0.0, lengths[0]])];
    let [x_axis, y_axis] = axes;
    Panel { map: Some(FieldMap { shape, values, scale }), ..Panel::new(title.clone(), x_axis, y_axis) }
}

/// The pressure along a line.
fn pressure(contact: &Contact, units: Units) -> Panel {
    let highest = contact.max_pressure();
    let pressure = contact.pressure.row(0).to_vec();
    let (x, (unit, size)) =
        (positions(contact.problem.surface().grid(), units), unit(units.pascals, &PRESSURES, highest));
    let y = Axis::linear(label("pressure", unit), [0.0, (1.0 + AXIS_MARGIN) * highest / size]);
    let mut panel = Panel::new("pressure", x.axis(), y);
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

fn positions(grid: &Grid, units: Units) -> NodePositions {
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
        let nodes = values.len().div_ceil(MOST_DOTS);
        let dot = |(i, values): (usize, &[f64])| {
            let middle = (i * nodes) as f64 + 0.5 * (values.len() - 1) as f64;
            let value = values.iter().copied().reduce(pick).unwrap_or(f64::NAN);
            Dot::at(middle * self.spacing / self.size, value / unit)
        };
        values.chunks(nodes).enumerate().map(dot).collect()
    }
}

/// The least and the largest of the finite values, or two values around the only one.
pub(crate) fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = values.filter(|it| it.is_finite()).fold(ends, |[low, high], it| [low.min(it), high.max(it)]);
    match low.total_cmp(&high) {
        Ordering::Less => [low, high],
        Ordering::Equal if low != 0.0 => [low - 0.5 * low.abs(), high + 0.5 * high.abs()],
        _ => [0.1, 1.0],
    }
}

/// A range with some room at both ends.
pub(crate) fn wider([low, high]: [f64; 2]) -> [f64; 2] {
    let room = AXIS_MARGIN * (high - low);
    [low - room, high + room]
}
