//! The lay of a surface: its preferred direction.

use crate::error::SurfaceError;
use crate::grid::Grid;
use crate::surface::check_positive;

/// The lay of a surface: how much longer its waves are along one direction than across it, and which direction that is.
///
/// With the wave vector `(q_1, q_2)` along and across the lay, the isotropic spectrum is taken at
///
/// ```text
/// q = hypot(sqrt(gamma) q_1, q_2 / sqrt(gamma))
/// ```
///
/// so that the correlation length along the lay is `gamma` times that across it (Peklenik's number), and the mean square of the heights
/// stays as it is. Every angle is possible: the surface stays periodic.
///
/// Source: Peklenik, Proc. Inst. Mech. Eng. 182(3K):108, 1967.
///
/// ```
/// use asperity::surface::Lay;
/// let lay = Lay { peklenik: 4.0, angle: 0.0 };
/// assert_eq!(lay.wavenumber(1.0, 0.0), 2.0);
/// assert_eq!(lay.wavenumber(0.0, 1.0), 0.5);
/// assert!((Lay { angle: 90.0, ..lay }.wavenumber(0.0, 1.0) - 2.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lay {
    /// Peklenik's number `gamma`, the correlation length along the lay over that across it; 1 for an isotropic surface.
    pub peklenik: f64,
    /// Angle from the x axis to the lay, towards y, in degrees.
    pub angle: f64,
}

impl Lay {
    /// That of an isotropic surface.
    pub const ISOTROPIC: Self = Self { peklenik: 1.0, angle: 0.0 };

    /// Whether the surface is isotropic.
    pub fn is_isotropic(&self) -> bool {
        self.peklenik == 1.0
    }

    /// The wavenumber at which the isotropic spectrum is taken for the wave vector `(qx, qy)`.
    pub fn wavenumber(&self, qx: f64, qy: f64) -> f64 {
        if self.is_isotropic() {
            return qx.hypot(qy);
        }
        let (sine, cosine) = self.angle.to_radians().sin_cos();
        let [along, across] = [qx * cosine + qy * sine, qy * cosine - qx * sine];
        (self.peklenik.sqrt() * along).hypot(across / self.peklenik.sqrt())
    }

    /// The largest components along y and x of wave vectors that are taken at the wavenumber `q`.
    pub(super) fn largest(&self, q: f64) -> [f64; 2] {
        if self.is_isotropic() {
            return [q; 2];
        }
        let (sine, cosine) = self.angle.to_radians().sin_cos();
        let [along, across] = [q / self.peklenik.sqrt(), q * self.peklenik.sqrt()];
        [(along * sine).hypot(across * cosine), (along * cosine).hypot(across * sine)]
    }

    /// The mean of `|(qx, qy)|^2` over that of the squares of the wavenumbers at which the spectrum is taken.
    pub(super) fn square_ratio(&self) -> f64 {
        0.5 * (self.peklenik + self.peklenik.recip())
    }

    /// Checks that the values make sense, and that `grid` has two axes where the surface is not isotropic.
    pub(super) fn check(&self, grid: &Grid) -> Result<(), SurfaceError> {
        check_positive(&[("Peklenik's number", self.peklenik)])?;
        if !self.angle.is_finite() {
            return Err(SurfaceError::Angle { value: self.angle });
        }
        match !self.is_isotropic() && grid.is_line() {
            true => Err(SurfaceError::LayOfLine { peklenik: self.peklenik }),
            false => Ok(()),
        }
    }
}
