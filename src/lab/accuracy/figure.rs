//! The figure of a scene: error against seconds and against transforms, side by side.

use super::curve::{ConvergenceCurve, ConvergencePoint};
use super::experiment::Measurements;
use super::quantity::{KAPPA_R, KAPPA_R_COUNTED};
use crate::lab::Rival;
use crate::plot::{Axis, Colour, Dot, Figure, Mark, Panel, Symbol};

/// Errors above this value are meaningless and are not drawn.
const TOP: f64 = 10.0;

/// The figure of the findings on a scene. One panel has a legend of the solvers, the other a legend of the lines.
pub fn figure(findings: &Measurements) -> Figure {
    let points = findings.finest().next().map_or(0, |curve| curve.shape[1]);
    let kind = if findings.scene.is_line() { "points" } else { "points per side" };
    let title = format!("{}, {points} {kind}: error against work", findings.scene.name());
    let seconds = panel(findings, "run time in s, median", ConvergencePoint::median, |rival| rival.title);
    let mut transforms = panel(findings, "Fourier transforms", |point| point.transforms as f64, |_| "");
    transforms.add("pressure, relative L2", Colour::GREY, Mark::Line, []);
    transforms.add("certificate η", Colour::GREY, Mark::Dotted, []);
    transforms.add("κ_r of a grid, resolved", Colour::GREY, Mark::Dashed, []);
    transforms.add("κ_r of a grid, counted", Colour::ORANGE, Mark::Dashed, []);
    Figure { title, panels: vec![seconds, transforms] }
}

/// Errors of grids, then certificate and error of each solver, against the given measure of work.
fn panel(
    findings: &Measurements,
    name: &str,
    work: fn(&ConvergencePoint) -> f64,
    legend: fn(&Rival) -> &'static str,
) -> Panel {
    let rungs = || findings.ladder.rungs.iter();
    let mut grids: Vec<_> = rungs().filter_map(|rung| Some((rung.shape[1], rung.errors[KAPPA_R]?))).collect();
    grids.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    let counted: Vec<f64> = rungs().filter_map(|rung| rung.errors[KAPPA_R_COUNTED]).collect();
    let points = || findings.finest().flat_map(|curve| &curve.points);
    let [least, most] = extent(points().map(work));
    let ends = [0.2 * least, 1.3 * most]; // with room for the legends
    let of_grids = grids.iter().map(|&(_, error)| error);
    let [least, most] = extent(
        points().flat_map(|point| [point.eta, point.pressure_error]).chain(of_grids.clone()).chain(counted.clone()),
    );
    let decades = [10f64.powf(least.log10().floor()), 10f64.powf(most.min(TOP).log10().ceil())];
    let sides: Vec<String> = grids.iter().map(|(side, _)| side.to_string()).collect();
    let title = format!("dashed, downwards: κ_r on n = {} points", sides.join(", "));
    let mut panel = Panel::new(title, Axis::log(name, ends), Axis::log("relative error", decades));
    counted.into_iter().for_each(|error| panel.add("", Colour::ORANGE, Mark::Dashed, ends.map(|x| Dot::at(x, error))));
    of_grids.for_each(|error| panel.add("", Colour::GREY, Mark::Dashed, ends.map(|x| Dot::at(x, error))));
    findings.finest().for_each(|curve| add_curve(&mut panel, curve, work, legend(&curve.rival)));
    panel
}

/// Adds certificate and error of the pressure.
fn add_curve(panel: &mut Panel, curve: &ConvergenceCurve, work: fn(&ConvergencePoint) -> f64, name: &str) {
    let (colour, symbol) = look(&curve.rival);
    let mut add = |name, mark, error: fn(&ConvergencePoint) -> f64| {
        panel.add(name, colour, mark, curve.points.iter().map(|point| Dot::at(work(point), error(point))));
    };
    add("", Mark::Dotted, |point| point.eta);
    add(name, Mark::Joined { symbol, filled: true }, |point| point.pressure_error);
}

fn look(rival: &Rival) -> (Colour, Symbol) {
    match rival.name {
        "multilevel" => (Colour::BLUE, Symbol::Circle),
        "polonsky-keer" => (Colour::VERMILION, Symbol::Square),
        "gfmd" => (Colour::GREEN, Symbol::Triangle),
        _ => (Colour::PURPLE, Symbol::Diamond),
    }
}

/// The least and the largest positive value.
fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.filter(|&v| v > 0.0).fold([f64::INFINITY, 0.0], |[least, most], v| [v.min(least), v.max(most)])
}
