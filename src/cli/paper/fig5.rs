//! Fig. 5: the proportionality factors of lines over those of surfaces.

use super::Made;
use super::comparison::Finding;
use super::means::{Points, Quantity};
use super::part::Part;
use super::study::Study;
use anyhow::Result;
use asperity::plot::{Axis, Colour, Corner, Figure, Mark, Panel, Point, Series};
use asperity::study::Spread;
use asperity::theory::hertz;
use serde::Serialize;

/// Why ratios are larger.
const FINER: &str = "kappa_r of surfaces falls on finer grids, see fig4, and that of lines hardly.";

/// The ratios at one Hurst exponent and load.
#[derive(Serialize)]
pub struct Ratio {
    /// Hurst exponent.
    pub hurst: f64,
    /// `p*`.
    pub reduced_pressure: f64,
    /// Of `kappa`.
    pub kappa: f64,
    /// Of `kappa_r`.
    pub kappa_r: f64,
    kappa_finest: f64,
    kappa_r_finest: f64,
    kappa_corrected: f64,
    kappa_r_corrected: f64,
}

/// The figure; the ratios go into fig5.csv.
pub fn make(study: &Study) -> Result<Made> {
    let ratios = ratios(study)?;
    super::write_csv(&study.file("fig5", "csv"), &ratios)?;
    let title = "Fig. 5: lines over surfaces".into();
    let finest = study.surfaces.points.last().copied().unwrap_or(0);
    let findings = findings(&ratios, &format!("counted, surfaces of {finest}^2"));
    Ok(Made { figure: Some(Figure { title, panels: vec![panel(study, &ratios)] }), findings })
}

/// The ratios at all Hurst exponents and loads.
///
/// Raw ones compare lines and surfaces with the paper's points per shortest wavelength, to which surfaces of several grids are
/// extrapolated, and `finest` ones those on the finest grid; corrected ones those without spacing.
pub fn ratios(study: &Study) -> Result<Vec<Ratio>> {
    let (lines, surfaces) = (study.points(Part::Fig2)?, study.points(Part::Fig4)?);
    let (raw, limit) = (surfaces.extrapolated(Some(study.surfaces.paper_side())), surfaces.extrapolated(None));
    let mean = |points: &Points, hurst: f64, load: f64, quantity: Quantity| {
        points.at(hurst, load, points.grids().last().copied().unwrap_or(0), quantity).mean
    };
    let ratio = |hurst: f64, reduced_pressure: f64| {
        let of = |surfaces: &Points, quantity: Quantity| {
            mean(&lines, hurst, reduced_pressure, quantity) / mean(surfaces, hurst, reduced_pressure, quantity)
        };
        Ratio {
            hurst,
            reduced_pressure,
            kappa: of(&raw, |row| row.kappa),
            kappa_r: of(&raw, |row| row.kappa_r),
            kappa_finest: of(&surfaces, |row| row.kappa),
            kappa_r_finest: of(&surfaces, |row| row.kappa_r),
            kappa_corrected: of(&limit, |row| row.kappa_corrected),
            kappa_r_corrected: of(&limit, |row| row.kappa_r_corrected),
        }
    };
    let pairs = study.lines.hurst.iter().flat_map(|&hurst| study.lines.loads.iter().map(move |&load| (hurst, load)));
    Ok(pairs.map(|(hurst, load)| ratio(hurst, load)).collect())
}

fn panel(study: &Study, ratios: &[Ratio]) -> Panel {
    let [low, high] = study.lines.ends();
    let x = Axis::log("p*", [low / 1.3, high * 1.3]);
    let mut panel = Panel::new("proportionality factors", x, Axis::linear("1D / 2D", [0.8, 1.8]), Corner::TopRight);
    type Curve = (&'static str, Colour, bool, fn(&Ratio) -> f64);
    let curves: [Curve; 3] = [
        ("κ", Colour::VERMILION, true, |ratio| ratio.kappa),
        ("κ_r", Colour::BLUE, true, |ratio| ratio.kappa_r),
        ("κ_r corrected", Colour::SKY, false, |ratio| ratio.kappa_r_corrected),
    ];
    for (name, colour, filled, quantity) in curves {
        panel.series.push(Series::new(name, colour, Mark::Line, Vec::new()));
        for (hurst, symbol) in study.lines.exponents() {
            let rows = ratios.iter().filter(|ratio| ratio.hurst == hurst);
            let points = rows.map(|ratio| Point::at(ratio.reduced_pressure, quantity(ratio))).collect();
            panel.series.push(Series::new("", colour, Mark::Joined { symbol, filled }, points));
        }
    }
    study.lines.add_legend(&mut panel);
    let smooth = hertz::KAPPA_R_LINE / hertz::KAPPA_R_POINT;
    let level = panel.x.range.map(|p| Point::at(p, smooth)).to_vec();
    panel.series.push(Series::new(
        format!("κ_r, cylinder over sphere: {smooth:.3}"),
        Colour::BLACK,
        Mark::Dashed,
        level,
    ));
    panel
}

fn findings(ratios: &[Ratio], finest: &str) -> Vec<Finding> {
    let spread = |quantity: fn(&Ratio) -> f64| Spread::of(ratios.iter().map(quantity));
    let kappa_r = |how: &str, quantity| Finding::number("fig5.kappa_r", how, spread(quantity)).because(FINER);
    vec![
        kappa_r("counted, surfaces extrapolated", |ratio| ratio.kappa_r),
        kappa_r(finest, |ratio| ratio.kappa_r_finest),
        kappa_r("corrected", |ratio| ratio.kappa_r_corrected),
        Finding::number("fig5.kappa", "counted, surfaces extrapolated", spread(|ratio| ratio.kappa)),
        Finding::number("fig5.kappa", finest, spread(|ratio| ratio.kappa_finest)),
        Finding::exact("fig5.smooth", "", hertz::KAPPA_R_LINE / hertz::KAPPA_R_POINT),
    ]
}
