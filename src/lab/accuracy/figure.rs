//! The figure of a scene: error against seconds and against transforms, side by side.

use super::curve::{Curve, Point};
use super::experiment::Findings;
use super::quantity::KAPPA_R;
use crate::lab::Rival;
use crate::plot::{Axis, Colour, Dot, Figure, Mark, Panel, Symbol};

/// Errors above this tell nothing and are left out.
const TOP: f64 = 10.0;

/// The figure of the findings on a scene.
pub fn figure(findings: &Findings) -> Figure {
    let points = findings.finest().next().map_or(0, |curve| curve.shape[1]);
    let kind = if findings.scene.is_line() { "points" } else { "points a side" };
    let title = format!("{}, {points} {kind}: error against work", findings.scene.name());
    Figure { title, panels: vec![against_seconds(findings), against_transforms(findings)] }
}

/// The panel whose legend tells the solvers apart.
fn against_seconds(findings: &Findings) -> Panel {
    let mut panel = panel(findings, "run time in s, median", Point::median);
    for (series, rival) in panel.series.iter_mut().rev().step_by(2).zip(Rival::ALL.into_iter().rev()) {
        series.name = rival.title.into();
    }
    panel
}

/// The panel whose legend tells the lines apart.
fn against_transforms(findings: &Findings) -> Panel {
    let mut panel = panel(findings, "Fourier transforms", |point| point.transforms as f64);
    panel.add("pressure, relative L2", Colour::GREY, Mark::Line, []);
    panel.add("certificate η", Colour::GREY, Mark::Dotted, []);
    panel.add("κ_r, error of a grid", Colour::GREY, Mark::Dashed, []);
    panel
}

/// Errors of grids, then of each solver the certificate and the error, against what `work` counts.
fn panel(findings: &Findings, name: &str, work: fn(&Point) -> f64) -> Panel {
    let x = Axis::log(name, works(findings, work));
    let grids = grids(findings);
    let sides: Vec<String> = grids.iter().map(|(side, _)| side.to_string()).collect();
    let title = format!("dashed, downwards: corrected κ_r on n = {} points", sides.join(", "));
    let mut panel = Panel::new(title, x, Axis::log("relative error", errors(findings)));
    grids.iter().for_each(|(_, error)| panel.add_curve("", Colour::GREY, Mark::Dashed, |_| *error));
    findings.finest().for_each(|curve| add_curve(&mut panel, curve, work));
    panel
}

/// Points along a side and error of each grid that has one, the largest error first.
fn grids(findings: &Findings) -> Vec<(usize, f64)> {
    let rungs = findings.ladder.rungs.iter();
    let mut grids: Vec<_> = rungs.filter_map(|rung| Some((rung.shape[1], rung.errors[KAPPA_R]?))).collect();
    grids.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    grids
}

/// Adds certificate and error of the pressure.
fn add_curve(panel: &mut Panel, curve: &Curve, work: fn(&Point) -> f64) {
    let (colour, symbol) = look(&curve.rival);
    let mut add = |mark, error: fn(&Point) -> f64| {
        panel.add("", colour, mark, curve.points.iter().map(|point| Dot::at(work(point), error(point))));
    };
    add(Mark::Dotted, |point| point.eta);
    add(Mark::Joined { symbol, filled: true }, |point| point.pressure_error);
}

fn look(rival: &Rival) -> (Colour, Symbol) {
    match rival.name {
        "multilevel" => (Colour::BLUE, Symbol::Circle),
        "polonsky-keer" => (Colour::VERMILION, Symbol::Square),
        "gfmd" => (Colour::GREEN, Symbol::Triangle),
        _ => (Colour::PURPLE, Symbol::Diamond),
    }
}

/// From the least to the most work, with room for the legends.
fn works(findings: &Findings, work: fn(&Point) -> f64) -> [f64; 2] {
    let [least, most] = extent(findings.finest().flat_map(|curve| curve.points.iter().map(work)));
    [0.2 * least, 1.3 * most]
}

/// Whole powers of ten around all errors.
fn errors(findings: &Findings) -> [f64; 2] {
    let points = findings.finest().flat_map(|curve| &curve.points);
    let grids = grids(findings).into_iter().map(|(_, error)| error);
    let [least, most] = extent(points.flat_map(|point| [point.eta, point.pressure_error]).chain(grids));
    [10f64.powf(least.log10().floor()), 10f64.powf(most.min(TOP).log10().ceil())]
}

/// The least and the largest positive value.
fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.filter(|&v| v > 0.0).fold([f64::INFINITY, 0.0], |[least, most], v| [v.min(least), v.max(most)])
}
