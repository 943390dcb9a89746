//! Statistics of a surface, and its power spectrum.

use super::Surface;
use crate::chunks;
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use std::f64::consts::TAU;

/// Statistics of the heights of a surface.
///
/// With `z = h - <h>`, averages over all nodes and periodic finite differences over nearest neighbours.
///
/// ```
/// use asperity::Grid;
/// use asperity::surface::{Indenter, Roughness};
/// let surface = Indenter::Sine { amplitude: 2.0 }.surface(Grid::line(4096, 1.0)?)?;
/// let roughness = Roughness::new(&surface);
/// assert!((roughness.rms_height - 2f64.sqrt()).abs() < 1e-12);
/// assert!((roughness.kurtosis - 1.5).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Roughness {
    /// `sqrt <z^2>`, a length.
    pub rms_height: f64,
    /// `gbar = sqrt <g^2>`, see [`Surface::square_gradient`].
    pub rms_gradient: f64,
    /// Root mean square of the second difference for lines, of half the sum of both (the mean curvature) for surfaces;
    /// 1/length.
    pub rms_curvature: f64,
    /// Largest `z`, a length.
    pub peak: f64,
    /// Largest `-z`, a length.
    pub valley: f64,
    /// `<z^3> / <z^2>^(3/2)`; 0 for a flat.
    pub skewness: f64,
    /// `<z^4> / <z^2>^2`, which is 3 for Gaussian heights; 0 for a flat.
    pub kurtosis: f64,
}

impl Roughness {
    /// The statistics of `surface`.
    pub fn new(surface: &Surface) -> Self {
        let z = surface.heights();
        let peak = z.iter().fold(0.0_f64, |m, &z| m.max(z));
        let valley = z.iter().fold(0.0_f64, |m, &z| m.max(-z));
        let largest = peak.max(valley);
        let unit = if largest > 0.0 { largest } else { 1.0 };
        let [second, third, fourth] = [2, 3, 4].map(|power| mean(z.len(), |i| (z[i] / unit).powi(power)));
        let standardised = |moment: f64, power: f64| if second > 0.0 { moment / second.powf(power) } else { 0.0 };
        Self {
            rms_height: unit * second.sqrt(),
            rms_gradient: surface.rms_gradient(),
            rms_curvature: rms_curvature(surface),
            peak,
            valley,
            skewness: standardised(third, 1.5),
            kurtosis: standardised(fourth, 2.0),
        }
    }
}

/// Mean of `term(node)` over `n` nodes.
fn mean(n: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    chunks::sum(n, term) / n as f64
}

fn rms_curvature(surface: &Surface) -> f64 {
    let (h, [ny, nx], [dy, dx]) = (surface.heights(), surface.grid().shape(), surface.grid().spacing());
    let second =
        |before: f64, height: f64, after: f64, spacing: f64| ((after - height) - (height - before)) / spacing / spacing;
    let curvature = |node: usize| {
        let (y, x) = (node / nx, node % nx);
        let at = |y: usize, x: usize| h[(y % ny) * nx + x % nx];
        let along_x = second(at(y, x + nx - 1), h[node], at(y, x + 1), dx);
        let along_y = second(at(y + ny - 1, x), h[node], at(y + 1, x), dy);
        if ny > 1 { 0.5 * (along_x + along_y) } else { along_x }
    };
    mean(h.len(), |node| curvature(node).powi(2)).sqrt()
}

/// The power spectral density of a field, such as the heights of a surface, averaged over directions.
///
/// Both signs of `q` (and all directions) are counted, with `h_q` as in [`crate::fourier`]:
///
/// ```text
/// line     C(q) = (L/2 pi) |h_q|^2          <z^2> = int C dq, q from -infinity to infinity
/// surface  C(q) = (Lx Ly/4 pi^2) |h_q|^2    <z^2> = int C d^2q = int C(q) 2 pi q dq, q from 0 to infinity
/// ```
///
/// A line has one value per wave. A surface has one per ring `|q| = (i +- 1/2) dq` that holds waves, `dq = 2 pi` over
/// the shortest period: the averages over its waves of `C` and of `|q|`.
///
/// ```
/// use asperity::Grid;
/// use asperity::surface::{Indenter, PowerSpectrum, Roughness};
/// let surface = Indenter::Sine { amplitude: 2.0 }.surface(Grid::line(64, 1.0)?)?;
/// let spectrum = PowerSpectrum::new(&surface);
/// // the mean square of the heights, and that of their gradient
/// let square = spectrum.integral(|_, density| density);
/// assert!((square / Roughness::new(&surface).rms_height.powi(2) - 1.0).abs() < 1e-12);
/// let gradient = spectrum.integral(|q, density| q * q * density);
/// assert!((gradient / (std::f64::consts::TAU.powi(2) * square) - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PowerSpectrum {
    /// `q = 2 pi / wavelength`, ascending, without `q = 0`; 1/length.
    pub wavenumber: Vec<f64>,
    /// `C(q)`; of heights length^3 for lines, length^4 for surfaces.
    pub density: Vec<f64>,
    /// Measure of the waves that each value represents in the integrals above, all signs and directions counted:
    /// 1/length for lines, 1/length^2 for surfaces.
    pub measure: Vec<f64>,
}

impl PowerSpectrum {
    /// The spectrum of the heights of `surface`.
    pub fn new(surface: &Surface) -> Self {
        Self::from_field(surface.grid(), surface.heights())
    }

    /// The spectrum of a field, row by row.
    ///
    /// # Panics
    /// If the length of `field` does not fit the grid.
    pub fn from_field(grid: &Grid, field: &[f64]) -> Self {
        let (rings, cell) = (rings(grid, field), cell(grid));
        Self {
            wavenumber: rings.iter().map(|ring| ring.wavenumber / ring.waves).collect(),
            density: rings.iter().map(|ring| cell * ring.square / ring.waves).collect(),
            measure: rings.iter().map(|ring| ring.waves / cell).collect(),
        }
    }

    /// The integral of `of(q, C(q))` over all wave vectors but that of the mean.
    pub fn integral(&self, of: impl Fn(f64, f64) -> f64) -> f64 {
        let waves = self.wavenumber.iter().zip(&self.density).zip(&self.measure);
        waves.map(|((&q, &density), measure)| of(q, density) * measure).sum()
    }
}

/// Sums over the waves of one ring.
#[derive(Clone, Default)]
struct Ring {
    waves: f64,
    wavenumber: f64,
    /// The mean square of the field in these waves.
    square: f64,
}

/// Waves per measure of wave vectors: `L/2 pi` for lines, `Lx Ly/4 pi^2` for surfaces.
fn cell(grid: &Grid) -> f64 {
    let [ly, lx] = grid.size();
    if grid.is_line() { lx / TAU } else { lx / TAU * (ly / TAU) }
}

fn rings(grid: &Grid, field: &[f64]) -> Vec<Ring> {
    let mut spectrum = vec![Complex::default(); grid.modes()];
    Fourier::new(grid).forward(field, &mut spectrum);
    let [ly, lx] = grid.size();
    let step = TAU / if grid.is_line() { lx } else { lx.min(ly) };
    let mut rings = Vec::new();
    let waves = grid.wavenumbers().zip(grid.multiplicities()).zip(&spectrum).skip(1);
    for ((q, multiplicity), coefficient) in waves {
        let ring = (q / step).round() as usize;
        if rings.len() <= ring {
            rings.resize(ring + 1, Ring::default());
        }
        let ring = &mut rings[ring];
        ring.waves += multiplicity;
        ring.wavenumber += multiplicity * q;
        ring.square += multiplicity * coefficient.norm_sqr();
    }
    rings.retain(|ring| ring.waves > 0.0);
    rings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::Field;

    #[test]
    fn parseval_over_all_waves() {
        let grids = [
            Grid::line(64, 2.0),
            Grid::line(31, 0.1),
            Grid::surface([12, 16], [1.0, 3.0]),
            Grid::surface([9, 7], [2.0, 1.0]),
        ];
        for grid in grids.map(Result::unwrap) {
            let [_, nx] = grid.shape();
            let noise = |(i, j): (usize, usize)| 5.0 + (((i * nx + j) as f64).powi(2) * 0.7).sin();
            let surface = Surface::new(grid, Field::from_shape_fn(grid.shape(), noise)).unwrap();
            let sum = PowerSpectrum::new(&surface).integral(|_, density| density);
            let square = Roughness::new(&surface).rms_height.powi(2);
            assert!((sum / square - 1.0).abs() < 1e-12, "{:?}: {sum} against {square}", grid.shape());
        }
    }
}
