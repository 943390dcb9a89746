//! Fig. 3: fits of Eq. 11 to the rough lines, for each Hurst exponent and for all.

use super::Made;
use super::comparison::Finding;
use super::means::{Points, Quantity};
use super::part::Part;
use super::rough::along;
use super::study::Study;
use anyhow::Result;
use asperity::plot::{Axis, Colour, Corner, Figure, Mark, Panel, Series};
use asperity::study::{Fit, Row};
use asperity::theory::persson;
use serde::Serialize;

/// Up to which `p*` a fit should be level.
const LEVEL: f64 = 1e-1;

/// Why the fits are not level.
const BENT: &str =
    "Eq. 11 bends where its points do: kappa itself falls from p* = 0.01 to 0.1, where the squares weigh most.";

/// A fit to the points of one Hurst exponent, or of all.
#[derive(Serialize)]
pub struct Fitted {
    hurst: Option<f64>,
    area: &'static str,
    b1: f64,
    b2: f64,
    /// `kappa_fit` at small loads.
    kappa: f64,
    /// Root mean square of the relative residuals of the area.
    residual: f64,
    points: usize,
}

impl Fitted {
    fn of(points: &Points, hurst: Option<f64>, area: &'static str, quantity: Quantity) -> Option<Self> {
        let rows = points.0.iter().filter(|row| hurst.is_none() || row.hurst == hurst);
        let pairs: Vec<(f64, f64)> = rows.map(|row| (row.reduced_pressure, quantity(row))).collect();
        let Fit { area: form, residual } = Fit::of(&pairs)?;
        let persson::CorrectedArea { b1, b2 } = form;
        Some(Self { hurst, area, b1, b2, kappa: form.kappa(0.0), residual, points: pairs.len() })
    }

    /// `kappa_fit` at a load.
    pub fn kappa_at(&self, reduced_pressure: f64) -> f64 {
        persson::CorrectedArea { b1: self.b1, b2: self.b2 }.kappa(reduced_pressure)
    }

    /// What it is a fit to, and its parameters.
    pub fn name(&self) -> String {
        let of = self.hurst.map_or("all H".into(), |hurst| format!("H = {hurst}"));
        format!("κ_fit, {of}: b1 = {:.3}, b2 = {:.2}", self.b1, self.b2)
    }
}

/// The fits to the counted area, for each Hurst exponent and in the end for all.
pub fn fits(study: &Study, points: &Points) -> Vec<Fitted> {
    all_fits(study, points, "counted", |row| row.relative_area)
}

fn all_fits(study: &Study, points: &Points, area: &'static str, quantity: Quantity) -> Vec<Fitted> {
    let exponents = study.lines.hurst.iter().copied().map(Some).chain([None]);
    exponents.filter_map(|hurst| Fitted::of(points, hurst, area, quantity)).collect()
}

/// The figure; the fits go into fig3.csv.
pub fn make(study: &Study) -> Result<Made> {
    let points = study.points(Part::Fig2)?;
    let mut fits = fits(study, &points);
    let panel = panel(study, &points, &fits);
    let mut findings = Vec::new();
    if !fits.is_empty() {
        findings.push(is_level(&fits));
        findings.extend((study.lines.hurst.len() > 1).then(|| strongly_depends(&fits)));
    }
    fits.extend(all_fits(study, &points, "corrected", |row| row.relative_area_corrected));
    super::write_csv(&study.file("fig3", "csv"), &fits)?;
    let title = "Fig. 3: κ_fit of rough lines by Eq. 11".into();
    Ok(Made { figure: Some(Figure { title, panels: vec![panel] }), findings })
}

fn panel(study: &Study, points: &Points, fits: &[Fitted]) -> Panel {
    let [low, high] = study.lines.ends();
    let x = Axis::log("p*", [low / 1.3, (high * 1.3).max(1.0)]);
    let mut panel = Panel::new("fitted and measured", x, Axis::linear("κ_fit", [1.0, 4.6]), Corner::TopRight);
    let mut series = Vec::new();
    for fit in fits {
        let (colour, mark) =
            if fit.hurst.is_some() { (Colour::VERMILION, Mark::Line) } else { (Colour::GREEN, Mark::Dashed) };
        series.push(Series::new(fit.name(), colour, mark, along(&panel.x, |p| fit.kappa_at(p))));
    }
    let persson = along(&panel.x, |p| persson::relative_area(p) / p);
    series.push(Series::new("Persson, erf(√2 p*)/p*", Colour::BLACK, Mark::Dotted, persson));
    for (hurst, symbol) in study.lines.exponents() {
        let of: [Quantity; 2] = [|row| row.reduced_pressure, |row: &Row| row.kappa];
        let curve = points.curve(hurst, &study.lines.loads, study.lines.points[0], of);
        series.push(Series::new(
            format!("κ, H = {hurst}"),
            Colour::GREY,
            Mark::Symbol { symbol, filled: false },
            curve,
        ));
    }
    panel.series = series;
    panel
}

/// Whether the fits of single exponents lie on either side of the one of all.
fn strongly_depends(fits: &[Fitted]) -> Finding {
    let words: Vec<String> = fits.iter().map(|fit| format!("{:.2}", fit.kappa)).collect();
    let all = fits.iter().find(|fit| fit.hurst.is_none()).map_or(f64::NAN, |fit| fit.kappa);
    let single = || fits.iter().filter(|fit| fit.hurst.is_some());
    let holds = single().any(|fit| fit.kappa > 1.02 * all) && single().any(|fit| fit.kappa < 0.98 * all);
    Finding::statement("fig3.hurst", format!("{} (last: all H)", words.join(", ")), holds)
}

/// Whether each fit is level to 5 % up to `p* = 0.1`.
fn is_level(fits: &[Fitted]) -> Finding {
    let change = |p: f64| fits.iter().map(|fit| 100.0 * (fit.kappa_at(p) / fit.kappa - 1.0).abs()).fold(0.0, f64::max);
    let words = format!("to {:.0} %; to {:.0} % at 0.01", change(LEVEL), change(0.1 * LEVEL));
    Finding::statement("fig3.level", words, change(LEVEL) < 5.0).because(BENT)
}
