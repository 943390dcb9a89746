//! The numbers that say how an attraction compares with a surface and a solid.

use super::attraction::Attraction;
use crate::contact::Problem;
use crate::grid::Grid;
use crate::surface::Roughness;
use serde::Serialize;
use std::f64::consts::PI;

/// The proportionality of pressure and area without adhesion in the number of Pastewka and Robbins.
const KAPPA: f64 = 2.0;

/// The relative error of a pull-off force by an attraction that jumps, times the spacings in the process zone. Against Maugis' solution for a
/// sphere it is 0.27 to 0.30 at Maugis' number 1, for 3 to 10 spacings, and 0.36 to 0.47 at 0.5, for 8 to 26 spacings.
const SNAPPING: f64 = 0.35;

/// The numbers that say how an attraction compares with a surface and a solid.
///
/// | number             | definition                                                                                     |
/// |--------------------|------------------------------------------------------------------------------------------------|
/// | process zone       | `l = E* rho^2/(pi w)`, a length: where the attraction acts at the edge of a contact             |
/// | Tabor              | `(R w^2/(E*^2 rho^3))^(1/3)` with the radius `R` of the highest peak; small: long range (DMT), large: short range (JKR) |
/// | Maugis             | `2 sigma_0 (R/(pi w K^2))^(1/3)`, `K = 4 E*/3`                                                   |
/// | Pastewka-Robbins   | `(h' E* rho/(kappa w)) (h'^2/(h'' rho))^(2/3)`, `kappa = 2`, with rms gradient and curvature; the theory expects rough surfaces to stick where it is below 1 |
///
/// # Source
/// Tabor, J. Colloid Interface Sci. 58, 2 (1977); Maugis, J. Colloid Interface Sci. 150, 243 (1992); Pastewka & Robbins, PNAS 111, 3298
/// (2014). Ciavarella, J. Mech. Phys. Solids 119 (2018), and others dispute the last one: it is a number to compare, and no verdict.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AdhesionScales {
    /// Length of the process zone.
    pub process_zone: f64,
    /// Length of the process zone over the larger spacing of the grid.
    pub spacings: f64,
    /// Estimated relative error of pull-off forces that the grid causes: 0.35 spacings over the process zone, with an attraction that jumps, such
    /// as Dugdale's. Nodes at the edge of a contact then snap one by one, and hold the edge. None for other attractions, whose error is not
    /// estimated.
    pub grid_error: Option<f64>,
    /// Tabor's number; none where the highest node is no peak.
    pub tabor: Option<f64>,
    /// Maugis' number; none where the highest node is no peak.
    pub maugis: Option<f64>,
    /// The number of Pastewka and Robbins.
    pub pastewka_robbins: f64,
}

impl AdhesionScales {
    /// Length of the process zone of an attraction on a solid of a contact modulus, and this length over the larger spacing of a grid.
    pub(super) fn zone(grid: &Grid, modulus: f64, attraction: &Attraction) -> [f64; 2] {
        let [dy, dx] = grid.spacing();
        let spacing = if grid.is_line() { dx } else { dx.max(dy) };
        let zone = modulus * attraction.range().powi(2) / (PI * attraction.work());
        [zone, zone / spacing]
    }

    /// The numbers of a problem with an attraction.
    pub fn new(problem: &Problem, attraction: &Attraction) -> Self {
        let (modulus, work, range) = (problem.contact_modulus(), attraction.work(), attraction.range());
        let surface = problem.surface();
        let [process_zone, spacings] = Self::zone(surface.grid(), modulus, attraction);
        let heights = surface.heights();
        let highest = (0..heights.len()).max_by(|&i, &j| heights[i].total_cmp(&heights[j])).unwrap_or(0);
        let curvature = surface.curvature()(highest);
        let radius = Some(curvature.recip()).filter(|radius| radius.is_finite() && *radius > 0.0);
        let roughness = Roughness::new(surface);
        let (slope, bend) = (roughness.rms_gradient, roughness.rms_curvature);
        let stiff = 4.0 / 3.0 * modulus;
        Self {
            process_zone,
            spacings,
            grid_error: attraction.steepest().is_infinite().then(|| SNAPPING / spacings),
            tabor: radius.map(|radius| (radius * work * work / (modulus * modulus * range.powi(3))).cbrt()),
            maugis: radius.map(|radius| 2.0 * attraction.strength() * (radius / (PI * work * stiff * stiff)).cbrt()),
            pastewka_robbins: slope * modulus * range / (KAPPA * work)
                * (slope * slope / (bend * range)).powf(2.0 / 3.0),
        }
    }
}
