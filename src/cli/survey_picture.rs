//! The picture of a survey: the heights with their artefacts, their power spectrum, and how they are distributed.

use super::height_picture::{density, material_ratio};
use super::picture::{range, wider};
use super::units::Units;
use asperity::formats::Scan;
use asperity::plot::{Axis, Colour, Dot, Figure, Mark, Panel, Symbol, label, unit};
use asperity::quantity::LENGTHS;
use asperity::surface::{AbbottCurve, Artefacts, Detrend, Survey};
use std::f64::consts::{PI, TAU};

/// The most tiles of a map along an axis.
const MOST_TILES: usize = 128;
/// Shades of a map, from valleys to peaks.
const SHADES: usize = 32;
/// The colours of valleys, of mean heights and of peaks.
const RAMP: [[f64; 3]; 3] = [[20.0, 50.0, 110.0], [150.0, 170.0, 185.0], [255.0, 240.0, 200.0]];
/// Densities below this part of the largest one are rounding.
const LEAST_DENSITY: f64 = 1e-12;
/// The share of the heights beyond the colours at either end, so that a few of them do not hide the rest.
const CLIPPED_HEIGHTS: f64 = 0.005;

/// The picture of heights, which may be void, and of their survey.
pub(crate) fn of_survey(title: &str, scan: &Scan, survey: &Survey, units: Units) -> Figure {
    let rest = Artefacts::new(scan).rest;
    let first = if scan.is_line() { profile(scan, &rest, units) } else { map(scan, &rest, units) };
    // heights of a map are shown above their plane, and so are their distributions
    let curve = match scan.is_line() {
        true => AbbottCurve::from_scan(scan),
        false => AbbottCurve::from_scan(&Detrend::Plane.apply(scan.clone())),
    };
    let heights = curve.iter().flat_map(|curve| [density(curve, units), material_ratio(curve, units)]);
    let panels = [first, spectrum(survey, scan, units)].into_iter().chain(heights).collect();
    Figure { title: title.into(), panels }
}

/// Nodes, rows and columns, that the mending of artefacts takes for voids.
fn artefacts<'a>(scan: &'a Scan, rest: &'a Scan) -> impl Iterator<Item = [usize; 2]> + 'a {
    let both = scan.height.indexed_iter().zip(&rest.height);
    both.filter(|((_, before), after)| !before.is_nan() && after.is_nan()).map(|((node, _), _)| node.into())
}

/// Heights of a map above their plane in colours, with its artefacts.
fn map(scan: &Scan, rest: &Scan, units: Units) -> Panel {
    let (shape, tiles) = (scan.shape(), scan.shape().map(|n| n.min(MOST_TILES)));
    let lengths = [0, 1].map(|axis| shape[axis] as f64 * scan.spacing[axis]);
    let (name, size) = unit(units.metres, &LENGTHS, lengths[1]);
    let [y, x] = lengths.map(|length| length / size);
    let flat = Detrend::Plane.apply(scan.clone());
    let mut heights: Vec<f64> = flat.height.iter().copied().filter(|h| !h.is_nan()).collect();
    heights.sort_unstable_by(f64::total_cmp);
    let at = |share: f64| heights.get((share * (heights.len() as f64 - 1.0)) as usize).copied().unwrap_or(0.0);
    let [low, high] = [at(CLIPPED_HEIGHTS), at(1.0 - CLIPPED_HEIGHTS)];
    let mut dots = vec![Vec::new(); SHADES];
    for (row, column) in (0..tiles[0]).flat_map(|row| (0..tiles[1]).map(move |column| (row, column))) {
        let node = [row * shape[0] / tiles[0], column * shape[1] / tiles[1]];
        let share = (flat.height[node] - low) / (high - low).max(f64::MIN_POSITIVE);
        if !share.is_nan() {
            let shade = ((share * SHADES as f64) as usize).min(SHADES - 1);
            let place = |i: usize, axis: usize| (i as f64 + 0.5) / tiles[axis] as f64 * lengths[axis] / size;
            dots[shade].push(Dot::at(place(column, 1), place(row, 0)));
        }
    }
    let ends = [low, high].map(|h| units.length(h)).join(" to ");
    let axes = [Axis::linear(label("x", name), [0.0, x]), Axis::linear(label("y", name), [0.0, y])];
    let [x_axis, y_axis] = axes;
    let mut panel = Panel::new(format!("heights above their plane, dark to light: {ends}"), x_axis, y_axis);
    let mark = Mark::Tile { columns: tiles[1] as u32, rows: tiles[0] as u32 };
    dots.into_iter().enumerate().for_each(|(shade, dots)| panel.add("", colour(shade), mark, dots));
    let place = |node: [usize; 2]| {
        let [y, x] = [0, 1].map(|axis| (node[axis] as f64 + 0.5) * scan.spacing[axis] / size);
        Dot::at(x, y)
    };
    let found: Vec<Dot> = artefacts(scan, rest).map(place).collect();
    if !found.is_empty() {
        panel.add("artefacts", Colour::VERMILION, Mark::Symbol { symbol: Symbol::Circle, filled: false }, found);
    }
    panel
}

/// The colour of a shade.
fn colour(shade: usize) -> Colour {
    let place = 2.0 * shade as f64 / (SHADES as f64 - 1.0);
    let (part, share) = ((place as usize).min(1), place - (place as usize).min(1) as f64);
    Colour(std::array::from_fn(|i| (RAMP[part][i] + share * (RAMP[part + 1][i] - RAMP[part][i])) as u8))
}

/// Heights along a profile, with its artefacts.
fn profile(scan: &Scan, rest: &Scan, units: Units) -> Panel {
    let heights = scan.height.row(0);
    let [low, high] = range(heights.iter().copied());
    let length = heights.len() as f64 * scan.spacing[1];
    let ((x_name, x_size), (z_name, z_size)) =
        (unit(units.metres, &LENGTHS, length), unit(units.metres, &LENGTHS, high - low));
    let dot = |i: usize| Dot::at(i as f64 * scan.spacing[1] / x_size, heights[i] / z_size);
    let axes = [
        Axis::linear(label("x", x_name), [0.0, length / x_size]),
        Axis::linear(label("height", z_name), wider([low / z_size, high / z_size])),
    ];
    let [x_axis, y_axis] = axes;
    let mut panel = Panel::new("heights", x_axis, y_axis);
    panel.add("", Colour::BLUE, Mark::Line, (0..heights.len()).map(dot));
    let found: Vec<Dot> = artefacts(scan, rest).map(|[_, x]| dot(x)).collect();
    if !found.is_empty() {
        panel.add("artefacts", Colour::VERMILION, Mark::Symbol { symbol: Symbol::Circle, filled: false }, found);
    }
    panel
}

/// The power spectrum of the heights without artefacts, and the level of the noise.
fn spectrum(survey: &Survey, scan: &Scan, units: Units) -> Panel {
    let dots: Vec<Dot> = survey.spectrum.iter().map(|band| Dot::at(band.wavenumber, band.density)).collect();
    let q = range(dots.iter().map(|it| it.x));
    let [low, high] = range(dots.iter().map(|it| it.y).filter(|it| *it > 0.0));
    // waves that are not there have densities of rounding
    let density = [low.max(LEAST_DENSITY * high), high];
    let name = |name: &str, unit: &str| label(name, if units.metres { unit } else { "" });
    let of_density = if scan.is_line() { "m³" } else { "m⁴" };
    let y = Axis::log(name("C", of_density), [0.5 * density[0], 2.0 * density[1]]);
    let mut panel = Panel::new("power spectrum, without artefacts", Axis::log(name("q", "1/m"), q), y);
    panel.add("heights", Colour::BLUE, Mark::Joined { symbol: Symbol::Circle, filled: true }, dots);
    if survey.noise.rms > 0.0 {
        let axes = if scan.is_line() { 1..2 } else { 0..2 };
        let cell: f64 = axes.map(|axis| scan.spacing[axis] / TAU).product();
        let level = survey.noise.rms.powi(2) * cell;
        let shortest = PI / scan.spacing[1];
        panel.add("noise", Colour::GREY, Mark::Dashed, [Dot::at(q[0], level), Dot::at(q[1].max(shortest), level)]);
    }
    panel
}
