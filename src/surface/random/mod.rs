//! Random roughness: which waves, which lay, how high, and which distribution of heights.
//!
//! ```text
//! SelfAffine | SpectrumFile --> waves --(Lay, RoughnessScale)--> Gaussian heights --(TargetHeights, RankMap)--> heights
//! ```

mod distribution;
mod johnson;
mod keys;
mod lay;
mod rank_map;
mod self_affine;
mod spectral_density;
mod spectrum_file;
mod spectrum_table;
mod synthesis;

pub use distribution::{HeightDistribution, TargetHeights};
pub use keys::RolloffForm;
pub use lay::Lay;
pub use rank_map::{ExactPart, RankMap};
pub use self_affine::{Rolloff, SelfAffine};
pub use spectral_density::{RoughnessScale, SpectralDensity};
pub use spectrum_file::{MeasuredSpectrum, SpectrumConvention, SpectrumFile};
pub use spectrum_table::{SpectrumKind, SpectrumTable};

use super::{Field, Surface};
use crate::error::RoughnessError;
use crate::files::InputFile;
use crate::grid::Grid;
use keys::RoughnessKeys;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use synthesis::WaveSource;

/// Wavenumbers at which a spectrum is integrated.
const WAVES: usize = 512;

/// Random roughness: a spectrum, a lay, a scale, and a distribution of heights. A seed picks one realisation of it.
///
/// ```
/// use asperity::surface::{Lay, RandomRoughness, Rolloff, RoughnessScale, SelfAffine, SpectralDensity, Texture};
/// use asperity::Grid;
/// let spectrum = SelfAffine { hurst: 0.8, rolloff: Rolloff::Plateau(0.125), short_cutoff: 0.03 };
/// let ground = RandomRoughness {
///     spectrum: SpectralDensity::SelfAffine(spectrum),
///     lay: Lay { peklenik: 6.0, angle: 0.0 },
///     scale: RoughnessScale::RmsHeight(1e-3),
///     heights: None,
/// };
/// let surface = ground.surface(Grid::surface([256, 256], [1.0, 1.0])?, 1)?;
/// let texture = Texture::new(&surface);
/// assert!((texture.rms_height / 1e-3 - 1.0).abs() < 1e-12);
/// assert!(texture.peklenik().unwrap() > 4.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "RoughnessKeys", into = "RoughnessKeys")]
pub struct RandomRoughness {
    /// The spectrum of the isotropic surface.
    pub spectrum: SpectralDensity,
    /// The lay.
    pub lay: Lay,
    /// What sets the heights.
    pub scale: RoughnessScale,
    /// Heights that are not Gaussian.
    pub heights: Option<TargetHeights>,
}

impl RandomRoughness {
    /// The realisation of a seed on a grid.
    ///
    /// Each Fourier coefficient is `sqrt(C(q)) (xi + i eta)` with independent standard normal `xi`, `eta`: Gaussian amplitudes, uniform
    /// phases. Then the heights get their distribution, see [`RankMap`], and their scale.
    ///
    /// One seed gives one realisation of Gaussian heights: a finer grid samples the same waves at more points. Heights of another
    /// distribution depend on the grid.
    ///
    /// # Errors
    /// The errors of [`RandomRoughness::check`], and those of the files of a spectrum and of heights.
    pub fn surface(&self, grid: Grid, seed: u64) -> Result<Surface, RoughnessError> {
        self.surface_in_stream(grid, seed, 0)
    }

    /// The realisation from another stream of random numbers of the same seed, which is independent of the first.
    pub(crate) fn surface_in_stream(&self, grid: Grid, seed: u64, stream: u64) -> Result<Surface, RoughnessError> {
        let waves = self.waves(&grid)?;
        let mut height = synthesis::heights(&grid, &waves, &self.lay, [seed, stream]).into_raw_vec_and_offset().0;
        let rank_map = match &self.heights {
            Some(TargetHeights { distribution, exact }) => {
                let sorted = distribution.quantiles(grid.len())?;
                Some(RankMap::apply(&grid, &mut height, &sorted, *exact))
            }
            None => None,
        };
        let field = Field::from_shape_vec(grid.shape(), height).expect("one height per node");
        let unscaled = Surface::new(grid, field)?;
        let factor = match self.scale {
            RoughnessScale::RmsGradient(gradient) => Some(gradient / unscaled.rms_gradient()),
            RoughnessScale::RmsHeight(height) => Some(height / unscaled.rms_height()),
            RoughnessScale::AsGiven => None,
        };
        let scaled = match factor {
            Some(factor) => Surface::new(grid, unscaled.height * factor)?,
            None => unscaled,
        };
        Ok(Surface { seed: Some(seed), rank_map, ..scaled })
    }

    /// Checks that the roughness makes sense and that `grid` can carry it.
    ///
    /// # Errors
    /// [`RoughnessError`] for
    /// - a wavelength, a scale, a shape or a Peklenik number that is not positive and finite;
    /// - a Hurst exponent outside `(0, 1]`;
    /// - a short cut-off that is not shorter than the roll-off, and a roll-off that is longer than the longest period;
    /// - waves that are shorter than two spacings, and no wave of the cell in the band of the spectrum;
    /// - the lay of a line, and a kurtosis that is not above the square of the skewness + 1;
    /// - the file of a spectrum that cannot be read.
    pub fn check(&self, grid: &Grid) -> Result<(), RoughnessError> {
        self.waves(grid)?;
        Ok(())
    }

    /// The checked waves.
    fn waves(&self, grid: &Grid) -> Result<WaveSource, RoughnessError> {
        self.lay.check(grid)?;
        if let RoughnessScale::RmsGradient(value) | RoughnessScale::RmsHeight(value) = self.scale {
            let name = if matches!(self.scale, RoughnessScale::RmsHeight(_)) { "rms_height" } else { "rms_gradient" };
            super::check_positive(&[(name, value)])?;
        }
        self.heights.as_ref().map_or(Ok(()), |heights| heights.distribution.check())?;
        let waves = WaveSource::new(&self.spectrum, grid)?;
        waves.check(&self.lay, grid)?;
        Ok(waves)
    }

    /// The files of its spectrum and of its heights.
    pub(crate) fn files_mut(&mut self) -> impl Iterator<Item = &mut InputFile> {
        let spectrum = match &mut self.spectrum {
            SpectralDensity::SelfAffine(_) => None,
            SpectralDensity::Measured(measured) => Some(measured.file.file_mut()),
        };
        let heights = self.heights.as_mut().and_then(|heights| match &mut heights.distribution {
            HeightDistribution::Like(file) => Some(file.file_mut()),
            _ => None,
        });
        spectrum.into_iter().chain(heights)
    }

    /// The self-affine spectrum, if it has one.
    pub fn self_affine(&self) -> Option<SelfAffine> {
        match self.spectrum {
            SpectralDensity::SelfAffine(spectrum) => Some(spectrum),
            SpectralDensity::Measured(_) => None,
        }
    }

    /// The shortest wavelength along any axis, on a line or else a surface, if the spectrum can be read.
    pub(crate) fn shortest_wavelength(&self, is_line: bool) -> Option<f64> {
        let waves = WaveSource::from_spectrum(&self.spectrum, is_line).ok()?;
        let largest = self.lay.largest(waves.largest_wavenumber());
        Some(TAU / largest[0].max(largest[1]))
    }

    /// The expected root-mean-square height and gradient on a grid, by integrals over the spectrum.
    ///
    /// # Errors
    /// The errors of [`RandomRoughness::check`].
    pub fn expected(&self, grid: &Grid) -> Result<[f64; 2], RoughnessError> {
        let waves = self.waves(grid)?;
        let [longest, shortest] = [TAU / grid.longest_wavelength(), waves.largest_wavenumber()];
        let step = (shortest / longest).ln() / WAVES as f64;
        let dimensions = if grid.is_line() { 1 } else { 2 };
        let measure = if grid.is_line() { 2.0 } else { TAU };
        let moment = |power: i32| -> f64 {
            let at = (0..WAVES).map(|i| longest * (step * (i as f64 + 0.5)).exp());
            measure * step * at.map(|q| waves.density(q) * q.powi(dimensions + power)).sum::<f64>()
        };
        let [height, gradient] = [moment(0), moment(2) * self.lay.square_ratio()].map(f64::sqrt);
        Ok(match self.scale {
            RoughnessScale::RmsGradient(scale) => [scale * height / gradient, scale],
            RoughnessScale::RmsHeight(scale) => [scale, scale * gradient / height],
            RoughnessScale::AsGiven => [height, gradient],
        })
    }

    /// The roughness in words.
    pub fn description(&self) -> String {
        self.described(&|length| format!("{length:e}"))
    }

    /// The roughness in words, with its lengths as `in_words` writes them.
    pub fn described(&self, in_words: &dyn Fn(f64) -> String) -> String {
        let spectrum = match &self.spectrum {
            SpectralDensity::SelfAffine(SelfAffine { hurst, rolloff, short_cutoff }) => {
                let rolloff = match rolloff {
                    Rolloff::Plateau(wavelength) => format!("roll-off {}", in_words(*wavelength)),
                    Rolloff::Drop(wavelength) => format!("no waves longer than {}", in_words(*wavelength)),
                    Rolloff::None => "no roll-off".into(),
                };
                format!("self-affine roughness, H = {hurst}, {rolloff}, short cut-off {}", in_words(*short_cutoff))
            }
            SpectralDensity::Measured(MeasuredSpectrum { file, .. }) => {
                format!("roughness by the spectrum in {}", file.path().display())
            }
        };
        let lay = (!self.lay.is_isotropic())
            .then(|| format!("Peklenik number {}, lay at {} degrees", self.lay.peklenik, self.lay.angle));
        let scale = match self.scale {
            RoughnessScale::RmsGradient(gradient) => Some(format!("rms gradient {gradient:e}")),
            RoughnessScale::RmsHeight(height) => Some(format!("rms height {}", in_words(height))),
            RoughnessScale::AsGiven => None,
        };
        let heights = self.heights.as_ref().map(|heights| heights.distribution.description());
        [Some(spectrum), lay, scale, heights].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

impl TryFrom<RoughnessKeys> for RandomRoughness {
    type Error = String;

    fn try_from(keys: RoughnessKeys) -> Result<Self, String> {
        Ok(Self { spectrum: keys.spectrum()?, lay: keys.lay()?, scale: keys.scale()?, heights: keys.heights()? })
    }
}

impl From<RandomRoughness> for RoughnessKeys {
    fn from(roughness: RandomRoughness) -> Self {
        let RandomRoughness { spectrum, lay, scale, heights } = roughness;
        Self::from_parts(spectrum, lay, scale, heights)
    }
}
