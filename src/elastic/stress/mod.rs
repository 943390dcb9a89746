//! The stress below the surface of an elastic half-space, in a vertical cut along `x`.
//!
//! Stresses are positive in tension and depths `z` positive into the solid, so that a pressure `p` makes `sigma_zz = -p` at the
//! surface, where the shear stresses vanish.
//!
//! | function       | solid                          | pressure                                             |
//! |----------------|--------------------------------|------------------------------------------------------|
//! | [`under_row`]  | periodic lines and surfaces    | a sum of waves, each with a closed form              |
//! | [`under_strips`] | lines without any neighbours | uniform on an element about each node                |
//!
//! ```
//! use asperity::Grid;
//! use asperity::elastic::stress;
//! use std::f64::consts::TAU;
//! // below a wave of pressure the shear stress is largest at the depth 1/q
//! let grid = Grid::line(64, TAU)?;
//! let pressure: Vec<f64> = grid.x().map(|x| 1.0 + x.cos()).collect();
//! let stress = stress::under_row(&grid, &pressure, 0, 0.5, &[0.0, 1.0])?;
//! assert!((stress.zz[[0, 0]] + 2.0).abs() < 1e-14);
//! assert!((stress.xz[[1, 16]] + (-1f64).exp()).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod below;
mod depths;
mod modes;
mod strips;
mod tensor;

pub use below::{below, is_known};
pub use depths::depths;
pub use modes::{highest_row, under_row};
pub use strips::under_strips;
pub use tensor::Tensor;

use crate::error::SolidError;
use ndarray::Array2;

/// The assumed Poisson's ratio of a solid if only the contact modulus is known: that of most metals.
pub const USUAL_POISSON: f64 = 0.3;

/// The stress in a vertical cut along `x`.
///
/// | field                          | shape           | unit     | meaning                                              |
/// |--------------------------------|-----------------|----------|------------------------------------------------------|
/// | `depth`                        | `depths`        | length   | depths `z` below the surface                         |
/// | `xx`, `yy`, `zz`               | `(depths, nx)`  | pressure | normal stresses, positive in tension                 |
/// | `yz`, `xz`, `xy`               | `(depths, nx)`  | pressure | shear stresses; below a line only `xz` is not zero   |
#[derive(Debug, Clone, PartialEq)]
pub struct Stress {
    /// Depths.
    pub depth: Vec<f64>,
    /// Poisson's ratio of the solid.
    pub poisson: f64,
    /// Whether nothing varies along `y`, as below a line: plane strain.
    pub is_plane: bool,
    /// Normal stress along `x`.
    pub xx: Array2<f64>,
    /// Normal stress along `y`.
    pub yy: Array2<f64>,
    /// Normal stress along `z`.
    pub zz: Array2<f64>,
    /// Shear stress along `z` on planes across `y`.
    pub yz: Array2<f64>,
    /// Shear stress along `z` on planes across `x`.
    pub xz: Array2<f64>,
    /// Shear stress along `y` on planes across `x`.
    pub xy: Array2<f64>,
}

impl Stress {
    /// No stress at all at some depths below `nx` columns.
    fn zero(depth: &[f64], nx: usize, poisson: f64, is_plane: bool) -> Self {
        let zeros = || Array2::zeros([depth.len(), nx]);
        let [xx, yy, zz, yz, xz, xy] = [zeros(), zeros(), zeros(), zeros(), zeros(), zeros()];
        Self { depth: depth.to_vec(), poisson, is_plane, xx, yy, zz, yz, xz, xy }
    }

    /// The stress at one depth below one column.
    pub fn at(&self, place: [usize; 2]) -> Tensor {
        let [xx, yy, zz] = [&self.xx, &self.yy, &self.zz].map(|field| field[place]);
        let [yz, xz, xy] = [&self.yz, &self.xz, &self.xy].map(|field| field[place]);
        Tensor { xx, yy, zz, yz, xz, xy }
    }

    /// The largest shear stress, shape `(depths, nx)`: below a line half the difference of the principal stresses in the cut, as
    /// photoelastic fringes show it, and below a surface half the difference of the extreme ones of all three.
    pub fn tau_max(&self) -> Array2<f64> {
        if self.is_plane { self.each(Tensor::shear_in_plane) } else { self.each(Tensor::max_shear) }
    }

    /// The equivalent stress of von Mises, shape `(depths, nx)`.
    pub fn von_mises(&self) -> Array2<f64> {
        self.each(Tensor::von_mises)
    }

    fn each(&self, of: impl Fn(&Tensor) -> f64) -> Array2<f64> {
        Array2::from_shape_fn(self.zz.dim(), |(depth, column)| of(&self.at([depth, column])))
    }
}

/// Checks Poisson's ratio, `-1 < nu <= 1/2`.
fn check(poisson: f64) -> Result<(), SolidError> {
    if poisson > -1.0 && poisson <= 0.5 { Ok(()) } else { Err(SolidError::Poisson { poisson }) }
}
