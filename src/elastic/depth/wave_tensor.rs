//! A tensor of one wave, in the frame of the wave.

use crate::fourier::Complex;

/// A symmetric tensor of one wave in one layer, in the frame of the wave: `n` along the wave vector, `t` across it, `z` into the solid. The
/// components `nz` and `tz` are stored times `i`: then strain and stress are related by real numbers.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct WaveTensor {
    pub nn: Complex,
    pub tt: Complex,
    pub zz: Complex,
    pub nt: Complex,
    pub nz: Complex,
    pub tz: Complex,
}

/// The direction of a wave, `(n_x, n_y)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Direction(pub f64, pub f64);

/// The components `xx`, `yy`, `zz`, `xy`, `xz`, `yz` of a wave below a surface.
pub(super) type Components = [Complex; 6];

impl WaveTensor {
    /// The tensor of a wave with these components.
    pub(crate) fn from_components([xx, yy, zz, xy, xz, yz]: Components, Direction(a, b): Direction) -> Self {
        Self {
            nn: xx * (a * a) + xy * (2.0 * a * b) + yy * (b * b),
            tt: xx * (b * b) - xy * (2.0 * a * b) + yy * (a * a),
            zz,
            nt: (yy - xx) * (a * b) + xy * (a * a - b * b),
            nz: turned(xz * a + yz * b),
            tz: turned(yz * a - xz * b),
        }
    }

    /// The components of the tensor of a wave.
    pub(crate) fn into_components(self, Direction(a, b): Direction) -> Components {
        let Self { nn, tt, zz, nt, .. } = self;
        let [nz, tz] = [self.nz, self.tz].map(|value| -turned(value));
        [
            nn * (a * a) + tt * (b * b) - nt * (2.0 * a * b),
            nn * (b * b) + tt * (a * a) + nt * (2.0 * a * b),
            zz,
            (nn - tt) * (a * b) + nt * (a * a - b * b),
            nz * a - tz * b,
            nz * b + tz * a,
        ]
    }
}

/// `i` times a number.
fn turned(value: Complex) -> Complex {
    Complex::new(-value.im, value.re)
}
