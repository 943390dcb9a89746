//! The quantity in which another code gives its result.

use super::wave_stiffness::WaveStiffness;
use crate::contact::Problem;
use crate::elastic::Response;
use serde::Serialize;
use strum::{Display, EnumIter, EnumMessage, EnumString, IntoStaticStr};

/// A field that another code gives as its result.
///
/// | quantity       | unit     | convention                                                        |
/// |----------------|----------|-------------------------------------------------------------------|
/// | `Pressure`     | pressure | positive in compression                                           |
/// | `Gap`          | length   | between the surfaces, positive where they are apart               |
/// | `Displacement` | length   | of the solid's surface, positive into the solid; its mean is free |
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Display, EnumIter, EnumMessage, EnumString, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum GivenField {
    /// Pressure, positive in compression.
    Pressure,
    /// Gap between the surfaces, positive where they are apart.
    Gap,
    /// Displacement of the solid's surface, positive into the solid; its mean is free.
    Displacement,
}

impl GivenField {
    /// Its name in archives and on the command line.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The pressure that corresponds to `values` of this quantity, row by row: a pressure is taken as it is; else it is
    /// the pressure that makes the displacement.
    ///
    /// A gap `g = u - h + d` determines the displacement except for its mean. The stiffness `K` gives `K u`, the
    /// pressure less its mean. The mean is the one that is prescribed or, at a given mean gap, the one that leaves no
    /// work: `<p g> = 0`. Rounding of `u` is rough, and comes out of `K` much enlarged; its size shows in the largest
    /// tension, so where the surfaces are apart a pressure up to twice as large counts as none.
    ///
    /// # Panics
    /// If the length of `values` does not fit the grid.
    pub fn pressure(self, problem: &Problem, values: &[f64], response: &mut Response) -> Vec<f64> {
        self.pressure_by(WaveStiffness::Norm, problem, values, response)
    }

    /// The pressure of [`GivenField::pressure`], of a solid whose waves have another stiffness.
    pub(super) fn pressure_by(
        self,
        kernel: WaveStiffness,
        problem: &Problem,
        values: &[f64],
        response: &mut Response,
    ) -> Vec<f64> {
        let gap = match self {
            Self::Pressure => return values.to_vec(),
            Self::Gap => values.to_vec(),
            Self::Displacement => gap_of(problem, values),
        };
        let displacement: Vec<f64> = gap.iter().zip(problem.height()).map(|(g, h)| g + h).collect();
        let mut pressure = vec![0.0; gap.len()];
        response.pressure(&displacement, &mut pressure);
        kernel.stiffen(problem.surface().grid(), &mut pressure);
        let mean = problem.mean_pressure().unwrap_or_else(|| -mean_weighted(&pressure, &gap));
        pressure.iter_mut().for_each(|p| *p += mean);
        let noise = 2.0 * pressure.iter().fold(0.0, |most: f64, p| most.max(-p));
        for (p, g) in pressure.iter_mut().zip(&gap) {
            if *g > 0.0 && *p <= noise {
                *p = p.min(0.0);
            }
        }
        pressure
    }
}

/// The gap of a displacement: at the mean gap that is prescribed, or else touching at its lowest node.
fn gap_of(problem: &Problem, displacement: &[f64]) -> Vec<f64> {
    let apart: Vec<f64> = displacement.iter().zip(problem.height()).map(|(u, h)| u - h).collect();
    let datum = match problem.mean_gap() {
        Some(mean_gap) => mean_gap - apart.iter().sum::<f64>() / apart.len() as f64,
        None => -apart.iter().copied().fold(f64::INFINITY, f64::min),
    };
    apart.into_iter().map(|v| v + datum).collect()
}

/// The mean of `values` weighted by `weights`.
fn mean_weighted(values: &[f64], weights: &[f64]) -> f64 {
    values.iter().zip(weights).map(|(value, weight)| value * weight).sum::<f64>() / weights.iter().sum::<f64>()
}
