//! Bumps that a user adds to a line.

use super::{Surface, check_positive};
use crate::error::SurfaceError;
use crate::grid::Grid;
use crate::quantity::Length;
use ndarray::Array2;
use serde::{Deserialize, Serialize};

/// A smooth bump on a line, `height exp(-(x - at)^2 / (2 width^2))` with the nearest of its images over a period. A hollow has a negative
/// height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bump {
    /// Position of its highest point, a length from the first node.
    pub at: f64,
    /// Its height, a length.
    pub height: f64,
    /// Its standard deviation, a length.
    pub width: f64,
}

impl Bump {
    /// The bump with a position, a height and a width, all lengths.
    pub fn from_lengths([at, height, width]: [f64; 3]) -> Self {
        Self { at, height, width }
    }
}

/// The bumps of a line. In a file, each bump is three lengths: position, height and width.
///
/// ```
/// use asperity::Grid;
/// use asperity::surface::{Bump, Bumps};
/// let bumps = Bumps(vec![Bump { at: 0.25, height: 0.01, width: 0.05 }]);
/// let line = bumps.surface(Grid::line(64, 1.0)?)?;
/// assert!((line.heights_as_given()[[0, 16]] - 0.01).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(try_from = "Vec<Length>", into = "Vec<f64>")]
pub struct Bumps(pub Vec<Bump>);

impl Bumps {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The sum of the bumps.
    ///
    /// # Errors
    /// [`SurfaceError::NotPositive`] for a width that is none, [`SurfaceError::WrongDimension`] on a surface, and
    /// [`SurfaceError::NonFinite`] for heights beyond the range of doubles.
    pub fn surface(&self, grid: Grid) -> Result<Surface, SurfaceError> {
        self.check(&grid)?;
        let (length, is_periodic) = (grid.size()[1], grid.periodic()[1]);
        let height = |x: f64| {
            let of = |bump: &Bump| {
                let away = x - bump.at;
                let away = if is_periodic { away - length * (away / length).round() } else { away };
                bump.height * (-0.5 * (away / bump.width).powi(2)).exp()
            };
            self.0.iter().map(of).sum::<f64>()
        };
        let heights: Vec<f64> = grid.x().map(height).collect();
        Surface::new(grid, Array2::from_shape_vec(grid.shape(), heights).expect("one height for each node of a line"))
    }

    /// Checks that they fit a grid, see [`Bumps::surface`].
    pub(crate) fn check(&self, grid: &Grid) -> Result<(), SurfaceError> {
        if !grid.is_line() {
            return Err(SurfaceError::WrongDimension { indenter: "bump", needs: "line", has: "surface" });
        }
        self.0.iter().try_for_each(|bump| check_positive(&[("the width of a bump", bump.width)]))
    }
}

impl TryFrom<Vec<Length>> for Bumps {
    type Error = String;

    fn try_from(lengths: Vec<Length>) -> Result<Self, String> {
        let (bumps, rest) = lengths.as_chunks::<3>();
        if rest.is_empty() {
            Ok(Self(bumps.iter().map(|lengths| Bump::from_lengths(lengths.map(|Length(length)| length))).collect()))
        } else {
            let count = lengths.len();
            Err(format!("{count} lengths do not describe bumps: give three per bump (position, height and width)"))
        }
    }
}

impl From<Bumps> for Vec<f64> {
    fn from(Bumps(bumps): Bumps) -> Self {
        bumps.iter().flat_map(|bump| [bump.at, bump.height, bump.width]).collect()
    }
}
