//! Pictures of how heights are distributed: their density, and the material ratio curve of Abbott and Firestone.

use super::picture::wider;
use super::units::Units;
use asperity::plot::{Axis, Colour, Dot, Mark, Panel, label, unit};
use asperity::quantity::LENGTHS;
use asperity::surface::AbbottCurve;
use std::f64::consts::TAU;

/// Classes of heights, and points of the material ratio curve.
const HEIGHT_CLASSES: usize = 60;
const RATIO_CURVE_POINTS: usize = 400;
/// Percent of a share.
const PERCENT: f64 = 100.0;

/// The density of the heights about their mean, over that of a normal distribution with the same rms height.
pub(crate) fn density(curve: &AbbottCurve, units: Units) -> Panel {
    let [low, high] = ends(curve);
    let (name, size) = unit(units.metres, &LENGTHS, high - low);
    let width = (high - low) / HEIGHT_CLASSES as f64;
    let class = |i: usize| {
        let edges = [low + i as f64 * width, low + (i + 1) as f64 * width];
        let share = curve.ratio(edges[0]) - curve.ratio(edges[1]);
        Dot::at(0.5 * (edges[0] + edges[1]) / size, share / (width / size))
    };
    let classes: Vec<Dot> = (0..HEIGHT_CLASSES).map(class).collect();
    let rms = curve.rms_height() / size;
    let normal = |z: f64| (-0.5 * (z / rms).powi(2)).exp() / (rms * TAU.sqrt());
    let top = classes.iter().map(|dot| dot.y).fold(normal(0.0), f64::max);
    let density = label("density", &if name.is_empty() { String::new() } else { format!("1/{name}") });
    let axes = [
        Axis::linear(label("height about the mean", name), [low / size, high / size]),
        Axis::linear(density, [0.0, 1.05 * top]),
    ];
    let [x, y] = axes;
    let mut panel = Panel::new("distribution of the heights", x, y);
    panel.add_curve("normal distribution", Colour::GREY, Mark::Dashed, normal);
    panel.add("heights", Colour::BLUE, Mark::Line, classes);
    panel
}

/// The share of the surface above each height, and the line through its core.
pub(crate) fn material_ratio(curve: &AbbottCurve, units: Units) -> Panel {
    let [low, high] = ends(curve);
    let (name, size) = unit(units.metres, &LENGTHS, high - low);
    let core = curve.core();
    let top = curve.height(core.peak_ratio);
    let axes = [
        Axis::linear("material ratio / %", [0.0, PERCENT]),
        Axis::linear(label("height about the mean", name), wider([low / size, high / size])),
    ];
    let [x, y] = axes;
    let mut panel = Panel::new("material ratio curve of Abbott and Firestone", x, y);
    let dot = |ratio: f64, height: f64| Dot::at(PERCENT * ratio, height / size);
    panel.add("core", Colour::GREY, Mark::Dashed, [dot(0.0, top), dot(1.0, top - core.core)]);
    let ratios = (0..=RATIO_CURVE_POINTS).map(|i| i as f64 / RATIO_CURVE_POINTS as f64);
    panel.add("heights", Colour::BLUE, Mark::Line, ratios.map(|ratio| dot(ratio, curve.height(ratio))));
    panel
}

/// The lowest and the highest height; some distance apart for a plane.
fn ends(curve: &AbbottCurve) -> [f64; 2] {
    let [low, high] = [1.0, 0.0].map(|ratio| curve.height(ratio));
    if low < high { [low, high] } else { [low - 0.5, high + 0.5] }
}
