//! Grids that are found automatically.

use super::text::SetupTable;
use crate::error::{ConflictRule, SettingError, SetupError};

/// Default of the relative error of area and `kappa_r` that a grid may have.
const TOLERANCE: f64 = 0.01;

/// The requirements for a grid that is found automatically.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Auto {
    /// Estimated relative error of area and `kappa_r`.
    pub tolerance: f64,
    /// Number of axes, if the points are found automatically, too, from the shortest wavelength of the roughness.
    pub axes: Option<usize>,
}

impl SetupTable {
    /// Removes the request for an automatic grid from the section `grid`: `refine = "auto"` or `points = "auto"` (of a
    /// surface `["auto", "auto"]`), with `area-tolerance`. Returns none if the grid is given.
    ///
    /// ```
    /// use asperity::setup::SetupTable;
    /// let mut table = SetupTable::from_toml("grid = { size = 1.0, refine = 'auto', area-tolerance = 1e-3 }")?;
    /// let auto = table.take_auto()?.expect("a grid is to be found");
    /// assert_eq!((auto.tolerance, auto.axes), (1e-3, None));
    /// assert!(table.take_auto()?.is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// For a tolerance that is not positive or is given without an automatic grid, and for points of a surface
    /// that are automatic along one axis only.
    pub fn take_auto(&mut self) -> Result<Option<Auto>, SetupError> {
        let is_auto = |value: &toml::Value| value.as_str() == Some("auto");
        let axes = match self.find("grid.points") {
            Some(points) if is_auto(points) => Some(1),
            Some(toml::Value::Array(points)) if points.iter().any(is_auto) => {
                if !points.iter().all(is_auto) {
                    return Err(ConflictRule::SomePoints.into());
                }
                Some(points.len())
            }
            _ => None,
        };
        let is_refined = self.find("grid.refine").is_some_and(is_auto);
        let tolerance = self.find("grid.area-tolerance").cloned();
        if !is_refined && axes.is_none() {
            return tolerance.map_or(Ok(None), |_| Err(ConflictRule::ToleranceOfGrid.into()));
        }
        self.remove("grid.area-tolerance");
        if is_refined {
            self.remove("grid.refine");
        }
        if let Some(axes) = axes {
            let is_rough = self.find("surface.spectrum").is_some() && self.find("surface.height").is_none();
            if !is_rough {
                return Err(ConflictRule::PointsOfNothing.into());
            }
            self.lay("grid.points", vec![toml::Value::from(super::Cell::ANY); axes].into());
        }
        Ok(Some(Auto { tolerance: positive(tolerance)?, axes }))
    }
}

/// The given tolerance, or the default.
fn positive(given: Option<toml::Value>) -> Result<f64, SetupError> {
    let number =
        |value: toml::Value| value.as_float().or(value.as_integer().map(|value| value as f64)).unwrap_or(f64::NAN);
    let value = given.map_or(TOLERANCE, number);
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(SettingError::Range { name: "the tolerance of the area", value, range: "(0, infinity)" }.into())
    }
}
