//! The power spectrum of self-affine roughness.

use super::{Lay, RandomRoughness, Rolloff, RoughnessScale, SelfAffine, SpectralDensity, Surface};
use crate::error::{RoughnessError, SurfaceError};
use crate::grid::Grid;

/// The power spectrum of self-affine roughness with a roll-off and a short cut-off (Eq. 10).
///
/// With `q_r = 2 pi / rolloff_wavelength` and `q_sH = 2 pi / short_cutoff`,
///
/// ```text
/// C(q) / C(q_r) = 1                    for 0 < q < q_r
///                 (q/q_r)^-(1+2H)      for q_r <= q < q_sH, lines
///                 (q/q_r)^-2(1+H)      for q_r <= q < q_sH, surfaces
///                 0                    otherwise
/// ```
///
/// [`RandomRoughness`] has other spectra, surfaces with a lay, and heights that are not Gaussian.
///
/// Source: Eq. 10 of the paper; Section 4 for the exponent of surfaces.
///
/// ```
/// use asperity::surface::Spectrum;
/// let spectrum = Spectrum { hurst: 0.5, rolloff_wavelength: 1.0, short_cutoff: 0.1, rms_gradient: 0.01 };
/// let rolloff = std::f64::consts::TAU;
/// assert_eq!(spectrum.density(0.5 * rolloff, true), 1.0);
/// assert_eq!(spectrum.density(2.0 * rolloff, true), 0.25);
/// assert_eq!(spectrum.density(2.0 * rolloff, false), 0.125);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spectrum {
    /// Hurst exponent `H`, above 0 and at most 1; the fractal dimension is `2 - H` or `3 - H`.
    pub hurst: f64,
    /// Roll-off wavelength `lambda_r`, above which the spectrum is flat; a length.
    pub rolloff_wavelength: f64,
    /// Short cut-off wavelength `lambda_sH`, at and below which there is no roughness; a length.
    pub short_cutoff: f64,
    /// Root-mean-square gradient `gbar` (Eq. 8) that each realisation is scaled to, which sets `C(q_r)`.
    pub rms_gradient: f64,
}

impl Spectrum {
    /// The spectrum up to a factor.
    pub fn self_affine(&self) -> SelfAffine {
        let Self { hurst, rolloff_wavelength, short_cutoff, .. } = *self;
        SelfAffine { hurst, rolloff: Rolloff::Plateau(rolloff_wavelength), short_cutoff }
    }

    /// `C(q) / C(q_r)` at the wavenumber `q` (1/length), of a line or else a surface, see [`SelfAffine::density`].
    pub fn density(&self, q: f64, is_line: bool) -> f64 {
        self.self_affine().density(q, is_line)
    }

    /// Checks that the spectrum makes sense and that `grid` can carry it.
    ///
    /// # Errors
    /// Those of [`RandomRoughness::check`] about values.
    pub fn validate(&self, grid: &Grid) -> Result<(), SurfaceError> {
        RandomRoughness::from(*self).check(grid).map_err(of_values)
    }
}

impl From<Spectrum> for RandomRoughness {
    fn from(spectrum: Spectrum) -> Self {
        Self {
            spectrum: SpectralDensity::SelfAffine(spectrum.self_affine()),
            lay: Lay::ISOTROPIC,
            scale: RoughnessScale::RmsGradient(spectrum.rms_gradient),
            heights: None,
        }
    }
}

impl Surface {
    /// A random self-affine surface with the power spectrum `spectrum` (Eq. 10), see [`RandomRoughness::surface`]. The root-mean-square
    /// gradient of this realisation, by the finite differences of Eq. 8, is `spectrum.rms_gradient` to rounding.
    ///
    /// # Errors
    /// The errors of [`Spectrum::validate`].
    ///
    /// # Source
    /// Section 3 of the paper and the contact-mechanics challenge (Mueser et al., Tribol. Lett. 65:118, 2017).
    ///
    /// ```
    /// use asperity::surface::{Roughness, Spectrum};
    /// use asperity::{Grid, Surface};
    /// let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.02, rms_gradient: 0.1 };
    /// let surface = Surface::rough(Grid::line(1024, 1.0)?, &spectrum, 7)?;
    /// assert!((Roughness::new(&surface).rms_gradient - 0.1).abs() < 1e-12);
    /// assert_eq!(surface.seed(), Some(7));
    /// # Ok::<(), asperity::error::SurfaceError>(())
    /// ```
    pub fn rough(grid: Grid, spectrum: &Spectrum, seed: u64) -> Result<Self, SurfaceError> {
        RandomRoughness::from(*spectrum).surface(grid, seed).map_err(of_values)
    }
}

fn of_values(error: RoughnessError) -> SurfaceError {
    match error {
        RoughnessError::Surface(error) => error,
        RoughnessError::File(_) => unreachable!("a self-affine spectrum has no file"),
    }
}
