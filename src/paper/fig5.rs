//! Fig. 5: the proportionality factors of lines over those of surfaces.

use super::means::Points;
use super::measure::{Measure, ObservableFn};
use super::reproduction::{Ramp, Reproduction};
use super::rough::{COLD, Rough, ShadedCurve, SymbolCurve, WARM};
use super::verdict::Verdict;
use crate::plot::{Axis, Colour, Dot, Mark, Panel};
use crate::study::Estimate;
use crate::theory::hertz;
use serde::Serialize;

/// `kappa_r` of a cylinder over that of a sphere.
const SMOOTH: f64 = hertz::KAPPA_R_LINE / hertz::KAPPA_R_POINT;

/// The ratios at one Hurst exponent and load with their errors, that of the grid of surfaces included: counted with the paper's
/// points per shortest wavelength, and resolved in the continuum.
#[derive(Serialize)]
pub(crate) struct Ratio {
    hurst: f64,
    reduced_pressure: f64,
    kappa_counted: f64,
    kappa_counted_error: f64,
    kappa_r_counted: f64,
    kappa_r_counted_error: f64,
    kappa: f64,
    kappa_error: f64,
    kappa_r: f64,
    kappa_r_error: f64,
}

/// One of the ratios with its error, and without.
type Of = fn(&Ratio) -> [f64; 2];
type ValueOf = fn(&Ratio) -> f64;

/// The points of lines and surfaces under the same loads.
pub(crate) struct Both<'a> {
    rough: &'a Rough,
    lines: Points,
    surfaces: Points,
}

impl Both<'_> {
    /// Those of the points that have a partner under the same load; `rough` are the surfaces.
    pub(crate) fn new(rough: &Rough, [lines, surfaces]: [Points; 2]) -> Both<'_> {
        let shared = [&lines, &surfaces].map(Points::loads);
        Both { rough, lines: lines.under(&shared[1]), surfaces: surfaces.under(&shared[0]) }
    }

    /// The ratio of a quantity of a measure at a Hurst exponent or averaged over all, under one load or averaged over all.
    fn ratio(&self, hurst: Option<f64>, load: Option<f64>, measure: Measure, quantity: ObservableFn) -> Estimate {
        let side = (measure == Measure::Counted).then(|| self.rough.paper_side());
        let line = self.lines.limit(hurst, load, Some(self.lines.finest()), measure, quantity);
        line.over(self.surfaces.limit(hurst, load, side, measure, quantity))
    }

    /// The ratios at all Hurst exponents and loads.
    pub(crate) fn ratios(&self) -> Vec<Ratio> {
        let [counted, resolved] = Measure::ALL;
        let ratio = |(hurst, load): (f64, f64)| {
            let of = |measure, quantity| {
                let ratio = self.ratio(Some(hurst), Some(load), measure, quantity);
                [ratio.mean, ratio.uncertainty()]
            };
            let [kappa_counted, kappa_counted_error] = of(counted, counted.kappa());
            let [kappa_r_counted, kappa_r_counted_error] = of(counted, counted.kappa_r());
            let [kappa, kappa_error] = of(resolved, resolved.kappa());
            let [kappa_r, kappa_r_error] = of(resolved, resolved.kappa_r());
            Ratio {
                hurst,
                reduced_pressure: load,
                kappa_counted,
                kappa_counted_error,
                kappa_r_counted,
                kappa_r_counted_error,
                kappa,
                kappa_error,
                kappa_r,
                kappa_r_error,
            }
        };
        let loads = self.surfaces.loads();
        let exponents = self.surfaces.exponents().into_iter();
        exponents.flat_map(|hurst| loads.iter().map(move |&load| (hurst, load))).map(ratio).collect()
    }

    /// The figure, and what the paper says of it.
    pub(crate) fn reproduce(&self, ratios: &[Ratio]) -> Reproduction {
        let panels = vec![panel(self.rough, ratios)];
        Reproduction::new("Fig. 5: lines over surfaces", panels, ramp(self.rough, ratios), self.verdicts())
    }

    fn verdicts(&self) -> Vec<Verdict> {
        let [counted, resolved] = Measure::ALL;
        let kappa = |measure: Measure| {
            Verdict::number("fig5.kappa", measure.name(), self.ratio(None, None, measure, measure.kappa()))
        };
        let kappa_r = |measure: Measure| {
            Verdict::number("fig5.kappa_r", measure.name(), self.ratio(None, None, measure, measure.kappa_r()))
        };
        vec![
            kappa_r(counted),
            kappa_r(resolved).beside(),
            kappa(counted),
            kappa(resolved).beside(),
            Verdict::exact("fig5.smooth", "", SMOOTH),
        ]
    }
}

fn panel(rough: &Rough, ratios: &[Ratio]) -> Panel {
    let [low, high] = rough.ends();
    let x = Axis::log("p*", [low / 1.3, high * 1.3]);
    let panel = Panel::new("proportionality factors", x, Axis::linear("1D / 2D", [0.8, 1.8]));
    let curves: [SymbolCurve<Of>; 3] = [
        SymbolCurve::new("κ counted", Colour::VERMILION, true, |ratio| {
            [ratio.kappa_counted, ratio.kappa_counted_error]
        }),
        SymbolCurve::new("κ_r counted", Colour::BLUE, true, |ratio| {
            [ratio.kappa_r_counted, ratio.kappa_r_counted_error]
        }),
        SymbolCurve::new("κ_r resolved", Colour::SKY, false, |ratio| [ratio.kappa_r, ratio.kappa_r_error]),
    ];
    let dots = |hurst, quantity: Of| {
        let dot = |ratio: &Ratio| {
            let [y, spread] = quantity(ratio);
            Dot { x: ratio.reduced_pressure, y, spread }
        };
        ratios.iter().filter(|ratio| ratio.hurst == hurst).map(dot).collect()
    };
    let mut panel = rough.drawn(panel, &curves, dots);
    let name = format!("κ_r, cylinder over sphere: {SMOOTH:.3}");
    panel.add_curve(name, Colour::BLACK, Mark::Dashed, |_| SMOOTH);
    panel
}

/// The ratios against the loads; no contacts.
fn ramp(rough: &Rough, ratios: &[Ratio]) -> Ramp {
    let view = "lines over surfaces";
    let curves: [ShadedCurve<ValueOf>; 2] = [
        ShadedCurve::new(view, "κ", &WARM, |ratio| ratio.kappa_counted),
        ShadedCurve::new(view, "κ_r", &COLD, |ratio| ratio.kappa_r_counted),
    ];
    rough.ramp(&curves, |hurst, of| ratios.iter().filter(|ratio| ratio.hurst == hurst).map(of).collect())
}
