//! Section 6: the model of Greenwood and Williamson, with the gradient taken over the contact.

use super::reproduction::{Ramp, RampCurve, Reproduction};
use super::verdict::{StatementVerdict, Verdict};
use crate::plot::{Axis, AxisScale, Colour, Mark, Panel};
use crate::study::Estimate;
use crate::theory::SummitHeights::{self, Exponential, Gaussian};
use serde::Serialize;

/// Separations over the scale of the heights.
const RANGE: [f64; 2] = [-2.0, 10.0];
const STEPS: i32 = 120;
/// A separation large enough to represent the limit.
const FAR: f64 = 1e6;
/// The separation at which one value is reported.
const NEAR: f64 = 3.0;

/// Both kinds of heights with their colours and the separation from which on their curves are drawn.
const KINDS: [(&str, Colour, SummitHeights, f64); 2] = [
    ("exponential heights", Colour::BLUE, Exponential, 0.0),
    ("Gaussian heights", Colour::VERMILION, Gaussian, RANGE[0]),
];

/// `kappa_r` at one separation.
#[derive(Serialize)]
pub(crate) struct Separation {
    separation: f64,
    exponential: f64,
    gaussian: f64,
}

/// `kappa_r` at all separations.
pub(crate) fn separations() -> Vec<Separation> {
    let [low, high] = RANGE;
    let row = |i: i32| {
        let separation = low + (high - low) * f64::from(i) / f64::from(STEPS);
        let [exponential, gaussian] = [Exponential, Gaussian].map(|heights| heights.kappa_r(separation));
        Separation { separation, exponential, gaussian }
    };
    (0..=STEPS).map(row).collect()
}

/// The figure, and what the paper says of it.
pub(crate) fn reproduce() -> Reproduction {
    let limit = std::f64::consts::PI.sqrt();
    let mut panel = Panel::new("independent spheres", Axis::linear("d/σ", RANGE), Axis::linear("κ_r", [1.70, 1.80]));
    for (name, colour, heights, from) in KINDS {
        let kappa_r = |separation| if separation < from { f64::NAN } else { heights.kappa_r(separation) };
        panel.add_curve(name, colour, Mark::Line, kappa_r);
    }
    panel.add_curve(format!("√π = {limit:.4}"), Colour::BLACK, Mark::Dashed, |_| limit);
    let verdicts = vec![
        Verdict::exact("gw.exponential", "", Exponential.kappa_r(NEAR)),
        Verdict::exact("gw.gaussian", "", Gaussian.kappa_r(FAR)),
        depends_on_separation(),
    ];
    Reproduction::new("Section 6: Greenwood and Williamson with the gradient in contact", vec![panel], ramp(), verdicts)
}

/// Whether Gaussian heights differ from their limit by more than half of the last digit that the paper prints.
fn depends_on_separation() -> Verdict {
    let [near, far] = [NEAR, FAR].map(|separation| Gaussian.kappa_r(separation));
    let answer = StatementVerdict::is_positive(Estimate::exact((near - far).abs() - 0.005));
    Verdict::statement("gw.finite", format!("{near:.4} at d/σ = {NEAR}"), answer)
}

/// Both kinds of heights against whole separations; no contacts.
fn ramp() -> Ramp {
    let separations: Vec<f64> = (0..=10).map(f64::from).collect();
    let curve = |(name, colour, heights, _): (&str, Colour, SummitHeights, f64)| {
        RampCurve::new("κ_r", name, colour, separations.iter().map(|&separation| heights.kappa_r(separation)))
    };
    Ramp {
        captions: separations.iter().map(|separation| format!("d/σ = {separation}")).collect(),
        curves: KINDS.map(curve).into(),
        quantity: ("d/σ", AxisScale::Linear),
        cursor: separations,
        contacts: Vec::new(),
        length_unit: "",
    }
}
