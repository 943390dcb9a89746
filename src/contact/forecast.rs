//! Estimates of contact area and pressure before the solve, for its memory, and for ranges of axes and colours, which
//! are fixed at the first frame.

use crate::contact::Problem;
use libm::erf;
use std::f64::consts::PI;

/// `kappa = a_rel / p*` of rough surfaces at small loads, as van Dokkum et al. (2018) find it.
const KAPPA: f64 = 2.2;
/// Approximate `kappa_r` of rough lines and surfaces.
const KAPPA_R: f64 = 1.9;
/// Largest pressure over `E* gbar_r`: pressures in contact follow a Rayleigh law of width 1/2 (from Persson's theory), and
/// one in a few thousand independent points exceeds four widths.
const LARGEST: f64 = 2.0;
/// Nodes looked at.
const SAMPLES: usize = 1 << 16;

/// Expected area and pressure of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// Share of the area in contact.
    pub relative_area: f64,
    /// Largest pressure.
    pub max_pressure: f64,
}

impl Forecast {
    /// The expected relative area of a rough surface under a reduced pressure, without its heights: `kappa p*` at small
    /// loads, and Persson's error function up to full contact.
    pub fn relative_area_at(reduced_pressure: f64) -> f64 {
        erf(0.5 * PI.sqrt() * KAPPA * reduced_pressure.max(0.0))
    }

    /// The forecast for a problem: the highest nodes touch, as many as `a_rel = kappa_r p_mean / (gbar_r E*)` asks for with the
    /// `gbar_r` of them.
    pub fn new(problem: &Problem) -> Self {
        let strain = problem.expected_mean_pressure() / problem.contact_modulus();
        let squares = highest_first(problem);
        let (mut sum, mut gradient, mut area) = (0.0, 0.0, 1.0);
        for (i, square) in squares.iter().enumerate() {
            sum += square;
            let touching = (i + 1) as f64;
            gradient = f64::sqrt(sum / touching);
            area = touching / squares.len() as f64;
            if area * gradient >= KAPPA_R * strain {
                break;
            }
        }
        let max_pressure = problem.expected_mean_pressure() / area + LARGEST * problem.contact_modulus() * gradient;
        Self { relative_area: area, max_pressure }
    }
}

/// Square gradients of a sample of nodes, those of the highest first.
fn highest_first(problem: &Problem) -> Vec<f64> {
    let (height, square_gradient) = (problem.height(), problem.surface().square_gradient());
    let mut nodes: Vec<usize> = (0..height.len()).step_by((height.len() / SAMPLES) | 1).collect();
    nodes.sort_unstable_by(|&a, &b| height[b].total_cmp(&height[a]));
    nodes.into_iter().map(square_gradient).collect()
}
