//! The stress at one place.

use std::f64::consts::FRAC_PI_3;

/// The stress at one place, positive in tension.
///
/// ```
/// use asperity::elastic::stress::Tensor;
/// let pure_shear = Tensor { xz: 2.0, ..Tensor::default() };
/// assert!((pure_shear.max_shear() - 2.0).abs() < 1e-15);
/// assert!((pure_shear.von_mises() - 2.0 * 3f64.sqrt()).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tensor {
    /// Normal stress along `x`.
    pub xx: f64,
    /// Normal stress along `y`.
    pub yy: f64,
    /// Normal stress along `z`.
    pub zz: f64,
    /// Shear stress along `z` on planes across `y`.
    pub yz: f64,
    /// Shear stress along `z` on planes across `x`.
    pub xz: f64,
    /// Shear stress along `y` on planes across `x`.
    pub xy: f64,
}

impl Tensor {
    /// Half the difference of the principal stresses in the plane of `x` and `z`, if `y` is a principal direction.
    pub fn shear_in_plane(&self) -> f64 {
        (0.5 * (self.xx - self.zz)).hypot(self.xz)
    }

    /// Half the difference of the largest and the smallest principal stress: `sqrt(J2) sin(theta + pi/3)` with the Lode angle
    /// `cos 3 theta = (sqrt 27/2) J3 / J2^(3/2)`, which lies between 0 and `pi/3`.
    pub fn max_shear(&self) -> f64 {
        let j2 = self.j2();
        if j2 <= 0.0 {
            return 0.0;
        }
        let cosine = 0.5 * 27f64.sqrt() * self.over(j2.sqrt()).j3();
        j2.sqrt() * (cosine.clamp(-1.0, 1.0).acos() / 3.0 + FRAC_PI_3).sin()
    }

    /// The equivalent stress of von Mises, `sqrt(3 J2)`.
    pub fn von_mises(&self) -> f64 {
        (3.0 * self.j2()).sqrt()
    }

    /// The stress over a scale, which must not be zero.
    fn over(&self, scale: f64) -> Self {
        let Self { xx, yy, zz, yz, xz, xy } = *self;
        let [xx, yy, zz, yz, xz, xy] = [xx, yy, zz, yz, xz, xy].map(|value| value / scale);
        Self { xx, yy, zz, yz, xz, xy }
    }

    /// The second invariant of the deviator.
    fn j2(&self) -> f64 {
        let Self { xx, yy, zz, yz, xz, xy } = *self;
        let differences = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
        differences / 6.0 + yz.powi(2) + xz.powi(2) + xy.powi(2)
    }

    /// The third invariant of the deviator, its determinant.
    fn j3(&self) -> f64 {
        let Self { xx, yy, zz, yz, xz, xy } = *self;
        let [x, y, z] = [xx, yy, zz].map(|value| value - (xx + yy + zz) / 3.0);
        x * (y * z - yz * yz) - xy * (xy * z - yz * xz) + xz * (xy * yz - y * xz)
    }
}
