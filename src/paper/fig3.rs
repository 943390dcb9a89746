//! Fig. 3: fits of Eq. 11 to the rough lines, for each Hurst exponent and for all.

use super::fit::{Fit, Weights};
use super::means::Points;
use super::measure::Measure;
use super::reproduction::{Ramp, RampCurve, Reproduction};
use super::rough::{COLD, Rough, ShadedCurve, WARM};
use super::verdict::{StatementVerdict, Verdict};
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
pub(crate) struct FitRow {
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
pub(crate) fn fits(lines: &Rough, points: &Points) -> Vec<Vec<FitRow>> {
    let kinds = Measure::ALL.into_iter().flat_map(|area| Weights::ALL.map(|weights| (area, weights)));
    kinds.map(|(area, weights)| fits_of(lines, points, area, weights)).collect()
}

/// The fits of one kind.
fn fits_of(lines: &Rough, points: &Points, area: Measure, weights: Weights) -> Vec<FitRow> {
    let exponents = lines.hurst.iter().copied().map(Some).chain([None]);
    exponents.filter_map(|hurst| FitRow::new(points, hurst, area, weights)).collect()
}

/// The figure of the fits to the counted area with equal weights, and what the paper says of it.
pub(crate) fn reproduce(lines: &Rough, points: &Points, all: &[Vec<FitRow>]) -> Reproduction {
    let (fits, mut verdicts) = (all[0].as_slice(), Vec::new());
    if !fits.is_empty() {
        let [equal, relative] = Weights::ALL.map(|weights| is_level(lines, points, weights));
        verdicts.extend([equal, relative.beside()]);
        verdicts.extend((lines.hurst.len() > 1).then(|| strongly_depends(lines, points)));
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

/// Whether the fits of single exponents lie on either side of the one of all, by 2 % and more.
fn strongly_depends(lines: &Rough, points: &Points) -> Verdict {
    let fits = |points: &Points, area| fits_of(lines, points, area, Weights::Equal);
    let words: Vec<String> = fits(points, Measure::Counted).iter().map(|fit| format!("{:.2}", fit.kappa)).collect();
    let distance = points.counted(|points, area| {
        let fits = fits(points, area);
        let all = fits.iter().find(|fit| fit.hurst.is_none()).map_or(f64::NAN, |fit| fit.kappa);
        let off = |fit: &FitRow| fit.kappa / all - 1.0;
        let [above, below] = [1.0, -1.0].map(|side| fits.iter().map(|fit| side * off(fit)).fold(0.0, f64::max));
        100.0 * above.min(below) - 2.0
    });
    Verdict::statement(
        "fig3.hurst",
        format!("{} (last: all H)", words.join(", ")),
        StatementVerdict::is_positive(distance),
    )
}

/// By how much the fits change up to a load, in per cent: the largest change of all.
fn change(fits: &[FitRow], load: f64) -> f64 {
    fits.iter().map(|fit| 100.0 * (fit.kappa_at(load) / fit.kappa - 1.0).abs()).fold(0.0, f64::max)
}

/// Whether each fit is level to 5 % up to `p* = 0.1`.
fn is_level(lines: &Rough, points: &Points, weights: Weights) -> Verdict {
    let fits = fits_of(lines, points, Measure::Counted, weights);
    let [far, near] = [LEVEL, 0.1 * LEVEL].map(|load| change(&fits, load));
    let name = match weights {
        Weights::Relative => "relative",
        Weights::Equal => "equal",
    };
    let distance = points.counted(|points, area| 5.0 - change(&fits_of(lines, points, area, weights), LEVEL));
    let words = format!("to {far:.0} %; to {near:.0} % at 0.01; {name} weights");
    Verdict::statement("fig3.level", words, StatementVerdict::is_positive(distance)).because(BENT)
}
