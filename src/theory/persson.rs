//! Relative area against reduced pressure, `p* = p/(gbar E*)`: Persson's theory, its corrected form for lines, and the
//! slope of Bush, Gibson and Thomas.

use crate::surface::PowerSpectrum;
use libm::erf;
use std::f64::consts::{PI, SQRT_2};

/// Slope `kappa = a_rel/p*` of Persson's theory at small pressure, `sqrt(8/pi)`.
pub const KAPPA: f64 = 1.595_769_121_605_730_8;

/// Slope `kappa` of the theory of Bush, Gibson and Thomas at small pressure, `sqrt(2 pi)` (Wear 35, 87, 1975).
pub const KAPPA_BGT: f64 = 2.506_628_274_631_000_2;

/// Relative contact area of Persson's theory, `erf(sqrt2 p*)`.
///
/// Source: B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
///
/// ```
/// use asperity::theory::persson;
/// assert!((persson::relative_area(1e-4) / 1e-4 - persson::KAPPA).abs() < 1e-7);
/// ```
pub fn relative_area(reduced_pressure: f64) -> f64 {
    erf(SQRT_2 * reduced_pressure)
}

/// The pressures of Persson's theory: Gaussian as in full contact, less their mirror image, so that none is at zero pressure in
/// contact.
///
/// In full contact the wave `q` of the heights makes the pressure `E* q h_q / 2`, so that the pressure of a surface that is known
/// down to some wavelength has the variance `s^2 = (E*/2)^2 <g^2>` of that surface; with each further wave the pressures diffuse,
/// and what comes to zero has left the contact. Hence, under the mean pressure `P`,
///
/// ```text
/// density of p > 0     f(p) = n(p - P) - n(p + P),    n the normal density of variance s^2
/// share in contact     W = int f dp = erf(P / (sqrt2 s))
/// mean                 int p f dp = P
/// mean square          d<p^2>/ds^2 = W
/// ```
///
/// The last line is that of the spectrum: a wave of variance `C(q)` of heights has that of `(E* q/2)^2 C(q) W(q)` of pressures, with
/// `s` from all waves longer than it, and Parseval's sum is met. The same holds for lines and surfaces.
///
/// Source: B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001); J. Phys.: Condens. Matter 20, 312001 (2008).
///
/// ```
/// use asperity::theory::persson::{Pressures, relative_area};
/// let pressures = Pressures { mean: 0.1, deviation: 0.5 }; // p* = 0.1 on a modulus and a gradient of 1
/// assert!((pressures.relative_area() - relative_area(0.1)).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressures {
    /// Mean pressure `P` over contact and gap.
    pub mean: f64,
    /// Standard deviation `s` of the pressure in full contact, `E* gbar / 2`; a pressure.
    pub deviation: f64,
}

impl Pressures {
    /// Density `f` of the pressure `p > 0`, 1/pressure; its integral is the share in contact.
    pub fn density(&self, pressure: f64) -> f64 {
        let normal = |p: f64| (-0.5 * (p / self.deviation).powi(2)).exp() / (self.deviation * (2.0 * PI).sqrt());
        normal(pressure - self.mean) - normal(pressure + self.mean)
    }

    /// Share in contact, `erf(P / (sqrt2 s))`.
    pub fn relative_area(&self) -> f64 {
        erf(self.mean / (SQRT_2 * self.deviation))
    }

    /// Mean square of the pressure over contact and gap.
    pub fn mean_square(&self) -> f64 {
        let Self { mean, deviation } = *self;
        let tail = (-0.5 * (mean / deviation).powi(2)).exp() * (2.0 / PI).sqrt();
        (mean * mean + deviation * deviation) * self.relative_area() + mean * deviation * tail
    }

    /// Power spectrum of the pressure on a surface with the power spectrum `heights`: `(E* q/2)^2 C(q) W(q)`, wave by wave. The
    /// variance at a wave is that of all longer ones and half of its own.
    pub fn spectrum(mean: f64, contact_modulus: f64, heights: &PowerSpectrum) -> PowerSpectrum {
        let mut variance = 0.0;
        let waves = heights.wavenumber.iter().zip(&heights.density).zip(&heights.measure);
        let wave = |((q, density), measure): ((&f64, &f64), &f64)| {
            let full = (0.5 * contact_modulus * q).powi(2) * density;
            let deviation = (variance + 0.5 * full * measure).sqrt();
            variance += full * measure;
            full * Self { mean, deviation }.relative_area()
        };
        PowerSpectrum { density: waves.map(wave).collect(), ..heights.clone() }
    }
}

/// The corrected form for lines (Eq. 11), `a_rel = erf(sqrt2 p*/Psi)` with `Psi = b1 + (1-b1) erf(b2 p*)`.
///
/// Source: Eq. 11 of the paper, after M. Scaraggi et al., Wear 297, 811 (2013).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrectedArea {
    /// `b1`, the correction at small pressure: `kappa = sqrt(8/pi)/b1`. With 1 the form is Persson's.
    pub b1: f64,
    /// `b2`, the inverse of the reduced pressure over which the correction fades.
    pub b2: f64,
}

impl CorrectedArea {
    /// `Psi(p*)`.
    pub fn correction(&self, reduced_pressure: f64) -> f64 {
        self.b1 + (1.0 - self.b1) * erf(self.b2 * reduced_pressure)
    }

    /// Relative contact area.
    pub fn relative_area(&self, reduced_pressure: f64) -> f64 {
        relative_area(reduced_pressure / self.correction(reduced_pressure))
    }

    /// `kappa = a_rel/p*`; at no pressure its limit.
    pub fn kappa(&self, reduced_pressure: f64) -> f64 {
        if reduced_pressure == 0.0 {
            return KAPPA / self.b1;
        }
        self.relative_area(reduced_pressure) / reduced_pressure
    }
}
