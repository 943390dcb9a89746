//! Fig. 3: fits of Eq. 11 to the rough lines, for each Hurst exponent and for all.

use super::fit::{Fit, Weights};
use super::means::Points;
use super::measure::Measure;
use super::reproduction::{Ramp, RampCurve, Reproduction};
use super::rough::{COLD, Rough, ShadedCurve, WARM};
use super::verdict::Verdict;
use crate::plot::{Axis, Colour, Mark, Panel};
use crate::theory::persson::{self, CorrectedArea};
use serde::Serialize;

/// The reduced pressure up to which a fit should be level.
const LEVEL: f64 = 1e-1;

/// Title of the view of a recording.
const VIEW: &str = "κ and κ_r";

/// Why the fits are not level.
const BENT: &str =
    "Eq. 11 has the curvature of its points: kappa itself decreases from p* = 0.01 to 0.1, for all weights.";

/// A fit to the points of one Hurst exponent, or of all.
#[derive(Serialize)]
pub struct FitRow {
    hurst: Option<f64>,
    area: Measure,
    weights: Weights,
    b1: f64,
    b2: f64,
    /// `kappa_fit` at small loads.
    kappa: f64,
    /// Root mean square of the relative residuals of the area.
    residual: f64,
    points: usize,
}

impl FitRow {
    fn new(points: &Points, hurst: Option<f64>, area: Measure, weights: Weights) -> Option<Self> {
        let rows = points.on(points.finest()).filter(|row| hurst.is_none() || row.hurst == hurst);
        let pairs: Vec<(f64, f64)> =
            rows.map(|row| (row.observables.reduced_pressure, area.area()(&row.observables))).collect();
        let Fit { area: form, residual } = Fit::new(&pairs, weights)?;
        let CorrectedArea { b1, b2 } = form;
        Some(Self { hurst, area, weights, b1, b2, kappa: form.kappa(0.0), residual, points: pairs.len() })
    }

    /// `kappa_fit` at a load.
    fn kappa_at(&self, reduced_pressure: f64) -> f64 {
        CorrectedArea { b1: self.b1, b2: self.b2 }.kappa(reduced_pressure)
    }

    /// The points that it is a fit to, and its parameters.
    fn name(&self) -> String {
        let of = self.hurst.map_or("all H".into(), |hurst| format!("H = {hurst}"));
        format!("κ_fit, {of}: b1 = {:.3}, b2 = {:.2}", self.b1, self.b2)
    }
}

/// All fits, each to every Hurst exponent and in the end to all: first those to the counted area with equal weights.
pub fn fits(lines: &Rough, points: &Points) -> Vec<Vec<FitRow>> {
    let exponents = || lines.hurst.iter().copied().map(Some).chain([None]);
    let kinds = Measure::ALL.into_iter().flat_map(|area| Weights::ALL.map(|weights| (area, weights)));
    let fits = |(area, weights)| exponents().filter_map(|hurst| FitRow::new(points, hurst, area, weights)).collect();
    kinds.map(fits).collect()
}

/// The figure of the fits to the counted area with equal weights, and what the paper says of it.
pub fn reproduce(lines: &Rough, points: &Points, all: &[Vec<FitRow>]) -> Reproduction {
    let (fits, mut verdicts) = (all[0].as_slice(), Vec::new());
    if !fits.is_empty() {
        verdicts.push(is_level(fits));
        verdicts.push(is_level(&all[1]).beside());
        verdicts.extend((lines.hurst.len() > 1).then(|| strongly_depends(fits)));
    }
    let (title, panel) = ("Fig. 3: κ_fit of rough lines by Eq. 11", panel(lines, points, fits));
    Reproduction::new(title, vec![panel], ramp(lines, points, fits), verdicts)
}

fn panel(lines: &Rough, points: &Points, fits: &[FitRow]) -> Panel {
    let [low, high] = lines.ends();
    let x = Axis::log("p*", [low / 1.3, (high * 1.3).max(1.0)]);
    let mut panel = Panel::new("fitted and measured", x, Axis::linear("κ_fit", [1.0, 4.6]));
    for fit in fits {
        let (colour, mark) =
            if fit.hurst.is_some() { (Colour::VERMILION, Mark::Line) } else { (Colour::GREEN, Mark::Dashed) };
        panel.add_curve(fit.name(), colour, mark, |p| fit.kappa_at(p));
    }
    panel.add_curve("Persson, erf(√2 p*)/p*", Colour::BLACK, Mark::Dotted, |p| persson::relative_area(p) / p);
    for (hurst, symbol) in lines.exponents() {
        let curve = points.curve(hurst, &lines.loads, [|it| it.reduced_pressure, Measure::Counted.kappa()]);
        panel.add(format!("κ, H = {hurst}"), Colour::GREY, Mark::Symbol { symbol, filled: false }, curve);
    }
    panel
}

/// The fits beside what is fitted; no contacts.
fn ramp(lines: &Rough, points: &Points, fits: &[FitRow]) -> Ramp {
    let kappa = Measure::Counted.kappa();
    let mut ramp =
        lines.ramp(&[ShadedCurve::new(VIEW, "κ", &WARM, kappa)], |hurst, of| points.along(hurst, &lines.loads, of));
    ramp.curves.extend(fits.iter().zip(COLD.into_iter().cycle()).map(|(fit, colour)| {
        RampCurve::new(VIEW, fit.name(), colour, lines.loads.iter().map(|&load| fit.kappa_at(load)))
    }));
    ramp
}

/// Whether the fits of single exponents lie on either side of the one of all.
fn strongly_depends(fits: &[FitRow]) -> Verdict {
    let words: Vec<String> = fits.iter().map(|fit| format!("{:.2}", fit.kappa)).collect();
    let all = fits.iter().find(|fit| fit.hurst.is_none()).map_or(f64::NAN, |fit| fit.kappa);
    let single = || fits.iter().filter(|fit| fit.hurst.is_some());
    let holds = single().any(|fit| fit.kappa > 1.02 * all) && single().any(|fit| fit.kappa < 0.98 * all);
    Verdict::statement("fig3.hurst", format!("{} (last: all H)", words.join(", ")), holds)
}

/// Whether each fit is level to 5 % up to `p* = 0.1`.
fn is_level(fits: &[FitRow]) -> Verdict {
    let change = |p: f64| fits.iter().map(|fit| 100.0 * (fit.kappa_at(p) / fit.kappa - 1.0).abs()).fold(0.0, f64::max);
    let weights = match fits.first().map(|fit| fit.weights) {
        Some(Weights::Relative) => "relative",
        _ => "equal",
    };
    let words = format!("to {:.0} %; to {:.0} % at 0.01; {weights} weights", change(LEVEL), change(0.1 * LEVEL));
    Verdict::statement("fig3.level", words, change(LEVEL) < 5.0).because(BENT)
}
