//! Fig. 5: the proportionality factors of lines over those of surfaces.

use super::means::{Points, Quantity};
use super::reproduction::{Ramp, Reproduction};
use super::rough::{COLD, Rough, WARM};
use super::verdict::Verdict;
use crate::plot::{Axis, Colour, Dot, Mark, Panel};
use crate::study::Spread;
use crate::theory::hertz;
use serde::Serialize;

/// Why ratios are larger.
const FINER: &str = "kappa_r of surfaces falls on finer grids, see fig4, and that of lines hardly.";

/// `kappa_r` of a cylinder over that of a sphere.
const SMOOTH: f64 = hertz::KAPPA_R_LINE / hertz::KAPPA_R_POINT;

/// The ratios at one Hurst exponent and load.
#[derive(Serialize)]
pub struct Ratio {
    hurst: f64,
    reduced_pressure: f64,
    kappa: f64,
    kappa_r: f64,
    kappa_finest: f64,
    kappa_r_finest: f64,
    kappa_corrected: f64,
    kappa_r_corrected: f64,
}

/// One of the ratios.
type Of = fn(&Ratio) -> f64;

/// The ratios at all Hurst exponents and loads.
///
/// Raw ones compare lines and surfaces with the paper's points per shortest wavelength, to which surfaces of several grids are
/// extrapolated, and `finest` ones those on the finest grid; corrected ones those without spacing.
pub fn ratios([lines, surfaces]: [&Rough; 2], [of_lines, of_surfaces]: [&Points; 2]) -> Vec<Ratio> {
    let [raw, limit] = [Some(surfaces.paper_side()), None].map(|side| of_surfaces.extrapolated(side));
    let ratio = |(hurst, load): (f64, f64)| {
        let mean = |points: &Points, quantity| points.at(hurst, load, points.finest(), quantity).mean;
        let over = |surfaces: &Points, quantity: Quantity| mean(of_lines, quantity) / mean(surfaces, quantity);
        Ratio {
            hurst,
            reduced_pressure: load,
            kappa: over(&raw, |it| it.kappa),
            kappa_r: over(&raw, |it| it.kappa_r),
            kappa_finest: over(of_surfaces, |it| it.kappa),
            kappa_r_finest: over(of_surfaces, |it| it.kappa_r),
            kappa_corrected: over(&limit, |it| it.kappa_corrected),
            kappa_r_corrected: over(&limit, |it| it.kappa_r_corrected),
        }
    };
    lines.pairs().map(ratio).collect()
}

/// The figure, and what the paper says of it; surfaces have `finest` points along a side at the most.
pub fn reproduce(lines: &Rough, finest: usize, ratios: &[Ratio]) -> Reproduction {
    let verdicts = verdicts(ratios, &format!("counted, surfaces of {finest}^2"));
    Reproduction::of("Fig. 5: lines over surfaces", vec![panel(lines, ratios)], ramp(lines, ratios), verdicts)
}

fn panel(lines: &Rough, ratios: &[Ratio]) -> Panel {
    let [low, high] = lines.ends();
    let x = Axis::log("p*", [low / 1.3, high * 1.3]);
    let panel = Panel::new("proportionality factors", x, Axis::linear("1D / 2D", [0.8, 1.8]));
    let curves: [(&str, Colour, bool, Of); 3] = [
        ("κ", Colour::VERMILION, true, |ratio| ratio.kappa),
        ("κ_r", Colour::BLUE, true, |ratio| ratio.kappa_r),
        ("κ_r corrected", Colour::SKY, false, |ratio| ratio.kappa_r_corrected),
    ];
    let dots = |hurst, quantity: Of| {
        let rows = ratios.iter().filter(|ratio| ratio.hurst == hurst);
        rows.map(|ratio| Dot::at(ratio.reduced_pressure, quantity(ratio))).collect()
    };
    let mut panel = lines.drawn(panel, &curves, dots);
    let name = format!("κ_r, cylinder over sphere: {SMOOTH:.3}");
    panel.add_curve(name, Colour::BLACK, Mark::Dashed, |_| SMOOTH);
    panel
}

/// The ratios against the loads; no contacts.
fn ramp(lines: &Rough, ratios: &[Ratio]) -> Ramp {
    let view = "lines over surfaces";
    let curves: [(&str, &str, &[Colour], Of); 2] =
        [(view, "κ", &WARM, |ratio| ratio.kappa), (view, "κ_r", &COLD, |ratio| ratio.kappa_r)];
    lines.ramp(&curves, |hurst, of| ratios.iter().filter(|ratio| ratio.hurst == hurst).map(of).collect())
}

fn verdicts(ratios: &[Ratio], finest: &str) -> Vec<Verdict> {
    let spread = |quantity: Of| Spread::of(ratios.iter().map(quantity));
    let kappa_r = |how: &str, quantity| Verdict::number("fig5.kappa_r", how, spread(quantity)).because(FINER);
    vec![
        kappa_r("counted, surfaces extrapolated", |ratio| ratio.kappa_r),
        kappa_r(finest, |ratio| ratio.kappa_r_finest),
        kappa_r("corrected", |ratio| ratio.kappa_r_corrected),
        Verdict::number("fig5.kappa", "counted, surfaces extrapolated", spread(|ratio| ratio.kappa)),
        Verdict::number("fig5.kappa", finest, spread(|ratio| ratio.kappa_finest)),
        Verdict::exact("fig5.smooth", "", SMOOTH),
    ]
}
