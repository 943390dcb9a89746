//! The stiffness of waves that a result was computed with.

use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use std::f64::consts::TAU;

/// How the stiffness of a wave along `y` and `x` depends on its wavenumbers. That of a half-space is `E* |q| / 2`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum WaveStiffness {
    /// By `|q|`, the length of the wave vector.
    #[default]
    Norm,
    /// By `|qx| + |qy|`, which many codes have by mistake. Waves along the axes have the right stiffness, those across them up to 1.4 times as much.
    Sum,
}

impl WaveStiffness {
    /// Divides the displacement by a pressure, which is that of the half-space, by the ratio of both stiffnesses.
    pub(crate) fn soften(self, grid: &Grid, displacement: &mut [f64]) {
        if self == Self::Sum {
            scale(grid, displacement, |ratio| 1.0 / ratio);
        }
    }

    /// Multiplies the pressure of a displacement, which is that of the half-space, by the ratio of both stiffnesses.
    pub(crate) fn stiffen(self, grid: &Grid, pressure: &mut [f64]) {
        if self == Self::Sum {
            scale(grid, pressure, |ratio| ratio);
        }
    }
}

/// Multiplies the waves of a field by a factor of `(|qx| + |qy|) / |q|`, and leaves the mean as it is.
fn scale(grid: &Grid, field: &mut [f64], factor: impl Fn(f64) -> f64) {
    let ([ny, _], [ly, lx]) = (grid.shape(), grid.size());
    let (mut fourier, mut modes) = (Fourier::new(grid), vec![Complex::default(); grid.modes()]);
    fourier.forward(field, &mut modes);
    for (mode, it) in modes.iter_mut().enumerate().skip(1) {
        let (kx, ky) = (mode / ny, (mode % ny).min(ny - mode % ny));
        let [qy, qx] = [TAU * ky as f64 / ly, TAU * kx as f64 / lx];
        *it *= factor((qx + qy) / qx.hypot(qy));
    }
    fourier.inverse(&mut modes, field);
}
