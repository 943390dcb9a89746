//! The surface that the knobs make.

use super::{Domain, GAUSSIAN_KURTOSIS, Knobs, SmoothBody};
use crate::explore::refusal::{Refusal, RefusalRule};
use crate::explore::scale::CELL;
use crate::explore::source::SurfaceSource;
use crate::setup::{Cell, Recipe};
use crate::surface::{
    Bump, Bumps, ExactPart, HeightDistribution, Indenter, Lay, RandomRoughness, Rolloff, RolloffForm, RoughnessScale,
    SelfAffine, SpectralDensity, TargetHeights,
};

/// Radius of the cylinder and the sphere: a slope of 5e-3 at the edge of the cell.
const RADIUS: f64 = 100.0 * CELL;
/// Amplitude of the waves.
const AMPLITUDE: f64 = 1e-3 * CELL;

impl Knobs {
    /// The surface and its cell.
    pub(super) fn surface(&self, source: Option<&SurfaceSource>) -> Result<(Recipe, Cell), Refusal> {
        if self.body == SmoothBody::File {
            let Some(SurfaceSource::Heights(file)) = source else {
                return Err(RefusalRule::NoHeights.into());
            };
            return self.heights.surface(file);
        }
        let spectrum = self.random_roughness();
        let seed = spectrum.as_ref().map(|_| self.seed.into());
        let bumps = Bumps(self.bumps.iter().map(|it| Bump::from_lengths(it.map(|share| share * CELL))).collect());
        let recipe = Recipe { indenter: self.indenter(), spectrum, seed, bumps, ..Recipe::default() };
        Ok(match self.domain {
            Domain::Line => (recipe, Cell::line(self.points, CELL)),
            Domain::Surface => (recipe, Cell::surface([self.points; 2], [CELL; 2])),
        })
    }

    /// The roughness on the body; none where its rms gradient is 0.
    fn random_roughness(&self) -> Option<RandomRoughness> {
        let wavelength = CELL / self.rolloff;
        let rolloff = match self.rolloff_form {
            RolloffForm::Plateau => Rolloff::Plateau(wavelength),
            RolloffForm::Drop => Rolloff::Drop(wavelength),
            RolloffForm::None => Rolloff::None,
        };
        let law = SelfAffine { hurst: self.hurst, rolloff, short_cutoff: CELL / self.cutoff };
        let lay = match self.domain {
            Domain::Line => Lay::ISOTROPIC,
            Domain::Surface => Lay { peklenik: self.peklenik, angle: self.lay_angle },
        };
        let is_gaussian = self.skewness == 0.0 && self.kurtosis == GAUSSIAN_KURTOSIS;
        let distribution = HeightDistribution::Moments { skewness: self.skewness, kurtosis: self.kurtosis };
        (self.roughness != 0.0).then(|| RandomRoughness {
            spectrum: SpectralDensity::SelfAffine(law),
            lay,
            scale: RoughnessScale::RmsGradient(self.roughness),
            heights: (!is_gaussian).then_some(TargetHeights { distribution, exact: ExactPart::Heights }),
        })
    }

    /// The smooth body; none for a flat.
    fn indenter(&self) -> Option<Indenter> {
        let half = 0.5 * CELL;
        Some(match (self.body, self.domain) {
            (SmoothBody::Round, Domain::Line) => Indenter::Cylinder { radius: RADIUS },
            (SmoothBody::Round, Domain::Surface) => Indenter::Sphere { radius: RADIUS },
            (SmoothBody::Sine, Domain::Line) => Indenter::Sine { amplitude: AMPLITUDE },
            (SmoothBody::Sine, Domain::Surface) => Indenter::CrossedSine { amplitude: AMPLITUDE },
            (SmoothBody::PowerLaw, _) => {
                let coefficient = half * half / (2.0 * RADIUS) / half.powf(self.exponent);
                Indenter::PowerLaw { coefficient, exponent: self.exponent }
            }
            (SmoothBody::Flat | SmoothBody::File | SmoothBody::Scene, _) => return None,
        })
    }
}
