//! Smooth indenters of one asperity per cell.

use super::plateau::Plateaus;
use super::{Field, Surface, check_positive};
use crate::chunks;
use crate::error::SurfaceError;
use crate::grid::Grid;
use crate::quantity;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// A smooth indenter, one per periodic cell, with its highest point at height 0 (waves: at their amplitude).
///
/// The peak lies on the node of row `ny/2` and column `nx/2` (integer division; row 0 for a line). `r` is the distance
/// to it over the periodic cell, `x` that along a line.
///
/// Source: Eq. 2 and Fig. 1 of the paper for the parabolas; K. L. Johnson, *Contact Mechanics* (1985), chapters 4, 5,
/// 13.
///
/// ```
/// use asperity::Grid;
/// use asperity::surface::Indenter;
/// let surface = Indenter::Cylinder { radius: 0.25 }.surface(Grid::line(8, 1.0)?)?;
/// // the peak is at 0 as given, and above the mean as kept
/// let height = surface.heights_as_given();
/// assert!(height[[0, 4]].abs() < 1e-15 && (height[[0, 0]] + 0.5).abs() < 1e-15);
/// assert!(surface.heights()[4] > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(tag = "shape", rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
#[strum(serialize_all = "kebab-case")]
pub enum Indenter {
    /// A parabolic cylinder on a line, `-x^2/(2R)`.
    #[strum(message = "-x^2 / (2 radius), a line")]
    Cylinder {
        /// Radius of curvature `R`, a length.
        #[serde(deserialize_with = "quantity::length")]
        radius: f64,
    },
    /// A paraboloid on a surface, `-r^2/(2R)`.
    #[strum(message = "-r^2 / (2 radius), a surface")]
    Sphere {
        /// Radius of curvature `R`, a length.
        #[serde(deserialize_with = "quantity::length")]
        radius: f64,
    },
    /// A paraboloid of two radii of curvature on a surface, `-x^2/(2 Rx) - y^2/(2 Ry)`, such as a crowned roller, or crossed cylinders.
    #[strum(message = "-x^2 / (2 radius-x) - y^2 / (2 radius-y), a surface")]
    EllipticParaboloid {
        /// Radius of curvature `Rx` of the section along x, a length.
        #[serde(deserialize_with = "quantity::length")]
        radius_x: f64,
        /// Radius of curvature `Ry` of the section along y, a length.
        #[serde(deserialize_with = "quantity::length")]
        radius_y: f64,
    },
    /// One period of a cosine on a line, `D cos(2 pi x/L)`.
    #[strum(message = "amplitude cos(2 pi x / L), a line")]
    Sine {
        /// Amplitude `D`, a length: half the height from valley to peak.
        #[serde(deserialize_with = "quantity::length")]
        amplitude: f64,
    },
    /// One period of a product of two cosines on a surface, `D cos(2 pi x/Lx) cos(2 pi y/Ly)`.
    #[strum(message = "amplitude cos(2 pi x / Lx) cos(2 pi y / Ly), a surface")]
    CrossedSine {
        /// Amplitude `D`, a length: half the height from valley to peak.
        #[serde(deserialize_with = "quantity::length")]
        amplitude: f64,
    },
    /// A wedge on a line, `-m |x|`.
    #[strum(message = "-slope |x|, a line")]
    Wedge {
        /// Slope `m` of its flanks, a length per length.
        #[serde(deserialize_with = "quantity::slope")]
        slope: f64,
    },
    /// A cone on a surface, `-m r`.
    #[strum(message = "-slope r, a surface")]
    Cone {
        /// Slope `m` of its flank, a length per length.
        #[serde(deserialize_with = "quantity::slope")]
        slope: f64,
    },
    /// A pyramid with four faces on a surface, `-m max(|x|, |y|)`. The faces of Vickers have 68 degrees from the axis, `m = cot 68 = 0.4040`.
    #[strum(message = "-slope max(|x|, |y|), a surface")]
    Pyramid {
        /// Slope `m` of its faces, a length per length.
        #[serde(deserialize_with = "quantity::slope")]
        slope: f64,
    },
    /// A power of the distance on a line or a surface, `-A r^n`.
    #[strum(message = "-coefficient r^exponent")]
    PowerLaw {
        /// Coefficient `A`, a length to the power `1 - n`.
        coefficient: f64,
        /// Exponent `n`, any positive number; 1 is the wedge and the cone, 2 the cylinder and the sphere.
        exponent: f64,
    },
    /// A flat punch, a strip on a line and a disc on a surface: 0 where `r <= b`, else `-depth`.
    #[strum(message = "flat within half-width, lower by depth outside")]
    Punch {
        /// Half-width or radius `b`, a length below half the shortest period.
        #[serde(deserialize_with = "quantity::length")]
        half_width: f64,
        /// Height of the step, a length.
        #[serde(deserialize_with = "quantity::length")]
        depth: f64,
    },
}

impl Indenter {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Cylinder { .. } => "cylinder",
            Self::Sphere { .. } => "sphere",
            Self::EllipticParaboloid { .. } => "elliptic paraboloid",
            Self::Sine { .. } => "sine",
            Self::CrossedSine { .. } => "crossed sine",
            Self::Wedge { .. } => "wedge",
            Self::Cone { .. } => "cone",
            Self::Pyramid { .. } => "pyramid",
            Self::PowerLaw { .. } => "power-law indenter",
            Self::Punch { .. } => "flat punch",
        }
    }

    /// The surface with this indenter in the middle of each cell.
    ///
    /// # Errors
    /// - [`SurfaceError::NotPositive`] for a parameter that is not positive and finite;
    /// - [`SurfaceError::WrongDimension`] for an indenter of lines on a surface or the reverse;
    /// - [`SurfaceError::TooWide`] for a punch whose half-width is not below half the shortest period;
    /// - [`SurfaceError::NonFinite`] for heights beyond the range of doubles.
    pub fn surface(&self, grid: Grid) -> Result<Surface, SurfaceError> {
        self.check(&grid)?;
        let surface = Surface::new(grid, about_peak(&grid, |offset| self.height(offset, grid.size())))?;
        Ok(Surface { plateaus: Some(Plateaus::none()), ..surface })
    }

    /// Whether the parameters make sense on `grid`, see [`Indenter::surface`].
    pub(crate) fn check(&self, grid: &Grid) -> Result<(), SurfaceError> {
        check_positive(&self.parameters())?;
        self.check_dimension(grid)?;
        match *self {
            Self::Punch { half_width, .. } if half_width >= 0.5 * shortest_period(grid) => {
                Err(SurfaceError::TooWide { indenter: self.name(), half_width, period: shortest_period(grid) })
            }
            _ => Ok(()),
        }
    }

    fn check_dimension(&self, grid: &Grid) -> Result<(), SurfaceError> {
        let needs = match self {
            Self::Cylinder { .. } | Self::Sine { .. } | Self::Wedge { .. } => "line",
            Self::Sphere { .. }
            | Self::EllipticParaboloid { .. }
            | Self::CrossedSine { .. }
            | Self::Cone { .. }
            | Self::Pyramid { .. } => "surface",
            Self::PowerLaw { .. } | Self::Punch { .. } => return Ok(()),
        };
        let has = if grid.is_line() { "line" } else { "surface" };
        if needs == has { Ok(()) } else { Err(SurfaceError::WrongDimension { indenter: self.name(), needs, has }) }
    }

    /// Its parameters by their names.
    pub fn parameters(&self) -> Vec<(&'static str, f64)> {
        match *self {
            Self::Cylinder { radius } | Self::Sphere { radius } => vec![("radius", radius)],
            Self::EllipticParaboloid { radius_x, radius_y } => vec![("radius_x", radius_x), ("radius_y", radius_y)],
            Self::Sine { amplitude } | Self::CrossedSine { amplitude } => vec![("amplitude", amplitude)],
            Self::Wedge { slope } | Self::Cone { slope } | Self::Pyramid { slope } => vec![("slope", slope)],
            Self::PowerLaw { coefficient, exponent } => vec![("coefficient", coefficient), ("exponent", exponent)],
            Self::Punch { half_width, depth } => vec![("half_width", half_width), ("depth", depth)],
        }
    }

    /// Height at the offset `[y, x]` from the peak in a cell of the periods `[ly, lx]`.
    fn height(&self, [y, x]: [f64; 2], [ly, lx]: [f64; 2]) -> f64 {
        let r = x.hypot(y);
        match *self {
            Self::Cylinder { radius } | Self::Sphere { radius } => -0.5 * r * (r / radius),
            Self::EllipticParaboloid { radius_x, radius_y } => -0.5 * (x * (x / radius_x) + y * (y / radius_y)),
            Self::Sine { amplitude } => amplitude * (TAU * (x / lx)).cos(),
            Self::CrossedSine { amplitude } => amplitude * (TAU * (x / lx)).cos() * (TAU * (y / ly)).cos(),
            Self::Wedge { slope } | Self::Cone { slope } => -slope * r,
            Self::Pyramid { slope } => -slope * x.abs().max(y.abs()),
            Self::PowerLaw { coefficient, exponent } => -coefficient * r.powf(exponent),
            Self::Punch { half_width, .. } if r <= half_width => 0.0,
            Self::Punch { depth, .. } => -depth,
        }
    }
}

/// A field of `value` at the offset `[y, x]` of each node from the nearest image of the node in the middle of the cell
/// (row `ny/2`, column `nx/2`), where indenters have their peak.
pub(crate) fn about_peak(grid: &Grid, value: impl Fn([f64; 2]) -> f64 + Sync) -> Field {
    let ([ny, nx], [dy, dx]) = (grid.shape(), grid.spacing());
    let offset = |i: usize, n: usize, spacing: f64| (i as f64 - (n / 2) as f64) * spacing;
    let at = |node: usize| value([offset(node / nx, ny, dy), offset(node % nx, nx, dx)]);
    let values = chunks::visit(grid.len(), |nodes| nodes.map(at).collect::<Vec<f64>>()).concat();
    Field::from_shape_vec([ny, nx], values).expect("one value per node")
}

/// The shortest period of the cell along which anything varies.
pub(crate) fn shortest_period(grid: &Grid) -> f64 {
    let [ly, lx] = grid.size();
    if grid.is_line() { lx } else { ly.min(lx) }
}
