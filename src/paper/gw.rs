//! Section 6: the model of Greenwood and Williamson, with the gradient taken over the contact.

use super::reproduction::{Ramp, RampCurve, Reproduction};
use super::theory_lines::level;
use super::verdict::Verdict;
use crate::plot::{Axis, Colour, Corner, Figure, Mark, Panel, Point, Series};
use crate::theory::SummitHeights::{self, Exponential, Gaussian};
use serde::Serialize;

/// Separations over the scale of the heights.
const RANGE: [f64; 2] = [-2.0, 10.0];
const STEPS: i32 = 120;
/// A separation so large that it stands for the limit.
const FAR: f64 = 1e6;
/// The separation at which one value is told.
const NEAR: f64 = 3.0;
/// Half of the last digit that the paper prints of `kappa_r`.
const READING: f64 = 0.005;

/// Both kinds of heights with their colours.
const KINDS: [(&str, Colour, SummitHeights); 2] =
    [("exponential heights", Colour::BLUE, Exponential), ("Gaussian heights", Colour::VERMILION, Gaussian)];

/// `kappa_r` at one separation.
#[derive(Serialize)]
pub struct Separation {
    separation: f64,
    exponential: f64,
    gaussian: f64,
}

/// `kappa_r` at all separations.
pub fn separations() -> Vec<Separation> {
    let [low, high] = RANGE;
    let row = |i: i32| {
        let separation = low + (high - low) * f64::from(i) / f64::from(STEPS);
        let [exponential, gaussian] = [Exponential, Gaussian].map(|heights| heights.kappa_r(separation));
        Separation { separation, exponential, gaussian }
    };
    (0..=STEPS).map(row).collect()
}

/// The figure, and what the paper says of it.
pub fn reproduce(rows: &[Separation]) -> Reproduction {
    let y = Axis::linear("κ_r", [1.70, 1.80]);
    let mut panel = Panel::new("independent spheres", Axis::linear("d/σ", RANGE), y, Corner::BottomRight);
    let limit = std::f64::consts::PI.sqrt();
    let exponential = rows.iter().filter(|row| row.separation >= 0.0);
    let exponential = exponential.map(|row| Point::at(row.separation, row.exponential)).collect();
    let gaussian = rows.iter().map(|row| Point::at(row.separation, row.gaussian)).collect();
    let curves = KINDS.into_iter().zip([exponential, gaussian]);
    panel.series = curves.map(|((name, colour, _), curve)| Series::new(name, colour, Mark::Line, curve)).collect();
    let level = level(&panel.x, limit);
    panel.series.push(Series::new(format!("√π = {limit:.4}"), Colour::BLACK, Mark::Dashed, level));
    let title = "Section 6: Greenwood and Williamson with the gradient over the contact".into();
    let verdicts = vec![
        Verdict::exact("gw.exponential", "", Exponential.kappa_r(NEAR)),
        Verdict::exact("gw.gaussian", "", Gaussian.kappa_r(FAR)),
        depends_on_separation(),
    ];
    Reproduction { figure: Some(Figure { title, panels: vec![panel] }), verdicts, ramp: Some(ramp()) }
}

/// Whether Gaussian heights differ from their limit by more than the printed digits show.
fn depends_on_separation() -> Verdict {
    let [near, far] = [NEAR, FAR].map(|separation| Gaussian.kappa_r(separation));
    Verdict::statement("gw.finite", format!("{near:.4} at d/σ = {NEAR}"), (near - far).abs() > READING)
}

/// Both kinds of heights against whole separations; no contacts.
fn ramp() -> Ramp {
    let separations: Vec<f64> = (0..=10).map(f64::from).collect();
    let curve = |(name, colour, heights): (&str, Colour, SummitHeights)| {
        let values = separations.iter().map(|&separation| heights.kappa_r(separation)).collect();
        RampCurve { view: "κ_r", name: name.into(), colour, values }
    };
    Ramp {
        captions: separations.iter().map(|separation| format!("d/σ = {separation}")).collect(),
        curves: KINDS.map(curve).into(),
        cursor: separations,
        contacts: Vec::new(),
        length_unit: "",
    }
}
