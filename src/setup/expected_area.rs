//! The expected contact of a setup, without solving it or generating a large surface.

use super::{Cell, Setup};
use crate::contact::{Forecast, Load};
use crate::error::SetupError;
use crate::grid::Grid;
use std::f64::consts::SQRT_2;

/// Nodes along a side of the grid on which a smooth surface is sampled: lines, surfaces.
const SIDES: [usize; 2] = [4096, 64];

impl Setup {
    /// The approximate relative contact area: of random roughness by its reduced pressure or, at a mean gap, by the
    /// nodes that lie above it; of smooth shapes from the heights on a small grid; of measured heights from the heights
    /// themselves.
    ///
    /// # Errors
    /// The errors of [`Setup::problem`].
    pub(super) fn expected_area(&self, grid: &Grid) -> Result<f64, SetupError> {
        let modulus = self.contact_modulus()?;
        if let Load::ReducedPressure(pressure) = self.load
            && self.surface.smooth().is_none()
        {
            return Ok(Forecast::relative_area_at(pressure));
        }
        let Some(roughness) = &self.surface.spectrum else { return self.looked_at(grid) };
        let [rms_height, rms_gradient] = roughness.expected(grid)?;
        let under = |pressure: f64| Forecast::relative_area_at(pressure / (rms_gradient * modulus));
        Ok(match self.load {
            Load::ReducedPressure(pressure) => Forecast::relative_area_at(pressure),
            Load::MeanPressure(pressure) => under(pressure),
            Load::Force(force) => under(force / grid.area()),
            // half of the nodes above the mean plane of the solid touch
            Load::MeanGap(gap) => 0.25 * libm::erfc(gap / (SQRT_2 * rms_height)),
            Load::Approach(_) => 1.0,
        })
    }

    /// The forecast for the heights themselves where they are measured, or else for those on a small grid.
    fn looked_at(&self, grid: &Grid) -> Result<f64, SetupError> {
        if self.surface.is_measured() {
            // on the nodes of the file: heights between them change little
            let grid = Cell { refine: None, ..self.grid.clone() };
            return Ok(Forecast::new(&Setup { grid, ..self.clone() }.problem()?).relative_area);
        }
        let most = SIDES[usize::from(!grid.is_line())];
        let mut small = self.clone();
        small.grid.points.iter_mut().for_each(|points| *points = (*points).min(most));
        Ok(small.problem().map_or(1.0, |problem| Forecast::new(&problem).relative_area))
    }
}
