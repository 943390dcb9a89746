//! The expected contact of a setup, without solving it or generating a large surface.

use super::Setup;
use crate::contact::{Forecast, Load};
use crate::error::SetupError;
use crate::grid::Grid;
use crate::history::PathPoint;
use std::f64::consts::SQRT_2;

/// Nodes along a side of the grid on which a smooth surface is sampled: lines, surfaces.
const SIDES: [usize; 2] = [4096, 64];

/// The share of the places that flow where the pressure in contact of an elastic solid would be twice the yield stress, and by how much it grows with their
/// ratio; and the most: lines, surfaces.
const FLOW: [f64; 2] = [0.05, 0.1];
const MOST_FLOW: [f64; 2] = [1.0, 0.55];

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
        match self.sampled(grid).problem() {
            Ok(problem) => Ok(Forecast::new(&problem).relative_area),
            Err(error) if self.surface.is_measured() => Err(error),
            Err(_) => Ok(1.0),
        }
    }

    /// The setup on the nodes of its file, as heights between them change little, or on a small grid.
    fn sampled(&self, grid: &Grid) -> Self {
        let mut sampled = self.clone();
        if self.surface.is_measured() {
            sampled.grid.refine = None;
        } else {
            let most = SIDES[usize::from(!grid.is_line())];
            sampled.grid.points.iter_mut().for_each(|points| *points = (*points).min(most));
        }
        sampled
    }

    /// The share of the places in the layers below a grid that flow in one step, as it was measured: it grows with the pressure in contact that an elastic
    /// solid would have over the yield stress, from nearly none at twice that on.
    pub(super) fn expected_flow(&self, grid: &Grid) -> Result<f64, SetupError> {
        let most = MOST_FLOW[usize::from(!grid.is_line())];
        let heaviest = |most: f64, point: &PathPoint| most.max(point.load.value());
        let load = self.load.with_value(self.path_points().iter().fold(0.0, heaviest));
        let heaviest = Self { load, ..self.clone() };
        let pressure = match load {
            Load::Force(force) => force / grid.area(),
            Load::ReducedPressure(reduced) => {
                let gradient = match &self.surface.spectrum {
                    Some(roughness) => roughness.expected(grid)?[1],
                    None => self.sampled(grid).problem()?.rms_gradient(),
                };
                reduced * gradient * self.contact_modulus()?
            }
            Load::MeanPressure(pressure) => pressure,
            Load::MeanGap(_) | Load::Approach(_) => return Ok(most),
        };
        let ratio = pressure / (heaviest.expected_area(grid)? * self.yield_stress().unwrap_or(f64::INFINITY));
        Ok((FLOW[0] + FLOW[1] * (ratio - 2.0)).max(0.0).min(most))
    }
}
