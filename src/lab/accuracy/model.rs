//! The errors of theories.

use super::quantity::{self, QuantityValues, errors};
use super::scene::{AMPLITUDE, AccuracyScene, RADIUS};
use crate::theory::{PowerLaw, SummitHeights, hertz, persson};
use std::f64::consts::{PI, TAU};

/// A theory held against the truth.
pub struct Model {
    pub theory: &'static str,
    /// Relative errors, with their signs.
    pub errors: QuantityValues,
}

/// The errors of the theories of `scene`, whose true values are `truth`.
pub(crate) fn models(scene: AccuracyScene, truth: &QuantityValues, reduced_pressure: f64) -> Vec<Model> {
    let of = |theory, values: QuantityValues| Model { theory, errors: errors(&values, truth) };
    match scene {
        AccuracyScene::Sine => vec![of("Hertz at the crest", isolated(&hertz::cylinder(crest_radius(), 1.0), scene))],
        AccuracyScene::Cylinder => vec![of("Hertz, isolated", isolated(&hertz::cylinder(RADIUS, 1.0), scene))],
        AccuracyScene::Sphere => vec![of("Hertz, isolated", isolated(&hertz::sphere(RADIUS, 1.0), scene))],
        AccuracyScene::RoughLine | AccuracyScene::RoughSurface => {
            let area = |area| quantity::truth([Some(area), None, None, None]);
            vec![
                of("Persson", area(persson::relative_area(reduced_pressure))),
                of("Bush-Gibson-Thomas", area(persson::KAPPA_BGT * reduced_pressure)),
                // exponential heights: no parameter of the model enters
                of(
                    "Greenwood-Williamson",
                    quantity::truth([None, Some(SummitHeights::Exponential.kappa_r(0.0)), None, None]),
                ),
            ]
        }
    }
}

/// An isolated contact in a cell of length 1.
fn isolated(contact: &PowerLaw, scene: AccuracyScene) -> QuantityValues {
    let a = contact.half_width(scene.mean_pressure());
    let area = if scene.is_line() { 2.0 * a } else { PI * a * a };
    quantity::truth([Some(area), Some(contact.kappa_r()), None, Some(contact.pressure(a, 0.0))])
}

/// Radius of curvature of the sine at its crest.
fn crest_radius() -> f64 {
    1.0 / (AMPLITUDE * TAU * TAU)
}
