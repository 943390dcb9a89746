//! Beyond the paper: `kappa_r` of rough lines depends on the Hurst exponent once the excess of counted nodes is undone.

use super::means::Points;
use super::measure::Measure;
use super::reproduction::Reproduction;
use super::rough::{Rough, shade};
use super::verdict::{StatementVerdict, Verdict};
use crate::plot::{Axis, Colour, Dot, Mark, Panel};
use crate::study::Estimate;

/// Room of error bars on an axis of factors.
const FACTORS: [f64; 2] = [1.55, 1.95];
/// The load whose errors on all grids are shown is the one nearest to this reduced pressure.
const SHOWN: f64 = 1e-2;

/// The figure, and whether the paper's statement holds.
pub(crate) fn reproduce(lines: &Rough, points: &Points) -> Reproduction {
    let title = format!("κ_r of rough lines and the Hurst exponent, {} profiles each", lines.seeds_on(0).len());
    let panels = vec![factors(lines, points), contrasts(lines, points), grids(lines, points)];
    let verdicts = lines_apart(points).map(|pair| depends_on_hurst(points, pair)).into_iter().collect();
    Reproduction::new(title, panels, lines.ramp_of(points, lines.lines()), verdicts)
}

/// The lowest and the highest Hurst exponent, if there are two.
fn lines_apart(points: &Points) -> Option<[f64; 2]> {
    match points.exponents().as_slice() {
        [first, .., last] => Some([*first, *last]),
        _ => None,
    }
}

/// `kappa_r` against the load: in the continuum, and counted.
fn factors(lines: &Rough, points: &Points) -> Panel {
    let counted_on = lines.paper_line();
    let axis = Axis::linear("κ_r", FACTORS);
    let mut panel = Panel::new("(a) in the continuum, and by counted nodes", load_axis(lines), axis);
    for (i, (hurst, symbol)) in lines.exponents().enumerate() {
        let dot = |of: &dyn Fn(f64) -> Estimate| {
            let dot = |&load: &f64| {
                let it = of(load);
                Dot { x: load, y: it.mean, spread: it.uncertainty() }
            };
            lines.loads.iter().map(dot).collect::<Vec<_>>()
        };
        let of = |load, nx, measure: Measure| points.limit(Some(hurst), Some(load), nx, measure, measure.kappa_r());
        let mark = |filled| Mark::Joined { symbol, filled };
        let counted = dot(&|load| Estimate::exact(of(load, Some(counted_on), Measure::Counted).mean));
        panel.add(format!("H = {hurst}, counted on {counted_on} points"), Colour::GREY, mark(false), counted);
        panel.add(
            format!("H = {hurst}, continuum"),
            shade(i),
            mark(true),
            dot(&|load| of(load, None, Measure::Resolved)),
        );
    }
    panel
}

/// How much larger `kappa_r` is at the highest Hurst exponent than at the lowest, by pairs of profiles with the same waves.
fn contrasts(lines: &Rough, points: &Points) -> Panel {
    let axis = Axis::linear("difference of κ_r", [-0.1, 0.1]);
    let mut panel = Panel::new("(b) highest less lowest H, by pairs of profiles", load_axis(lines), axis);
    panel.add_curve("", Colour::BLACK, Mark::Dotted, |_| 0.0);
    let Some(pair) = lines_apart(points) else { return panel };
    let (_, symbol) = lines.exponents().next().expect("there are two exponents");
    let [counted, resolved] = Measure::ALL;
    let dot = |load: f64, it: Estimate| Dot { x: load, y: it.mean, spread: it.uncertainty() };
    let at = |&load: &f64| dot(load, points.limit_of_contrast(pair, Some(load), resolved, resolved.kappa_r()));
    let continuum: Vec<Dot> = lines.loads.iter().map(at).collect();
    let nx = lines.paper_line();
    let count = |&load: &f64| {
        let [low, high] =
            pair.map(|hurst| points.limit(Some(hurst), Some(load), Some(nx), counted, counted.kappa_r()).mean);
        Dot::at(load, high - low)
    };
    let counts: Vec<Dot> = lines.loads.iter().map(count).collect();
    let name = format!("counted on {nx} points");
    panel.add(name, Colour::GREY, Mark::Joined { symbol, filled: false }, counts);
    panel.add("continuum", Colour::BLUE, Mark::Joined { symbol, filled: true }, continuum);
    panel
}

/// How far `kappa_r` is from the continuum on each grid under one load.
fn grids(lines: &Rough, points: &Points) -> Panel {
    let nearest = |a: &&f64, b: &&f64| (*a / SHOWN).ln().abs().total_cmp(&(*b / SHOWN).ln().abs());
    let load = lines.loads.iter().min_by(nearest).copied().unwrap_or(f64::NAN);
    let waves = |nx: usize| lines.points_per_wave_of_line(nx);
    let grids = points.grids();
    let [first, last] = [grids.first(), grids.last()].map(|nx| waves(nx.copied().unwrap_or(1)));
    let x = Axis::log("points per shortest wavelength", [first / 1.5, last * 1.5]);
    let title = format!("(c) error of κ_r, p* = {load:.0e}");
    let mut panel = Panel::new(title, x, Axis::log("distance from the continuum, %", [1e-3, 30.0]));
    for (i, (hurst, symbol)) in lines.exponents().enumerate() {
        for measure in Measure::ALL {
            let limit = |nx| points.limit(Some(hurst), Some(load), nx, Measure::Resolved, Measure::Resolved.kappa_r());
            let continuum = limit(None).mean;
            let dot = |&nx: &usize| {
                let found = points.at(hurst, load, nx, measure.kappa_r()).mean;
                Dot::at(waves(nx), 100.0 * (found / continuum - 1.0).abs())
            };
            let mark = Mark::Joined { symbol, filled: measure == Measure::Resolved };
            panel.add(format!("H = {hurst}, {}", measure.name()), shade(i), mark, grids.iter().map(dot));
        }
    }
    panel
}

fn load_axis(lines: &Rough) -> Axis {
    let [low, high] = lines.ends();
    Axis::log("p*", [low / 1.5, high * 1.5])
}

/// Whether `kappa_r` is the same in the continuum at the lowest and the highest Hurst exponent.
fn depends_on_hurst(points: &Points, pair: [f64; 2]) -> Verdict {
    let (resolved, kappa_r) = (Measure::Resolved, Measure::Resolved.kappa_r());
    let average = points.limit(Some(pair[0]), None, None, resolved, kappa_r);
    let apart = points.mean_contrast(pair, resolved, kappa_r);
    let (change, sigma) = (apart.times(100.0 / average.mean), apart.mean / apart.uncertainty());
    let ([low, high], off, error) = (pair, change.mean, change.uncertainty());
    let words = format!("H = {high} above {low} by {off:.2} ± {error:.2} %, {sigma:+.1} σ");
    Verdict::statement("hurst.kappa_r", words, StatementVerdict::is_constant(change))
}
