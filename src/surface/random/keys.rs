//! The keys of random roughness in a scene.

use super::{
    ExactPart, HeightDistribution, Lay, MeasuredSpectrum, Rolloff, RoughnessScale, SelfAffine, SpectralDensity,
    SpectrumConvention, SpectrumFile, TargetHeights,
};
use crate::formats::HeightFile;
use crate::quantity::{some_angle, some_length};
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// What a self-affine spectrum does at waves that are longer than its roll-off wavelength.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum RolloffForm {
    /// It is constant above the roll-off wavelength.
    Plateau,
    /// It is zero above the roll-off wavelength.
    Drop,
    /// There is no roll-off wavelength: the power law holds up to the longest wave.
    None,
}

/// The keys, none of which is needed in all cases.
#[derive(Clone, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct RoughnessKeys {
    #[serde(skip_serializing_if = "Option::is_none")]
    hurst: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_length")]
    rolloff_wavelength: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rolloff_form: Option<RolloffForm>,
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_length")]
    short_cutoff: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    table: Option<SpectrumFile>,
    #[serde(skip_serializing_if = "Option::is_none")]
    convention: Option<SpectrumConvention>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rms_gradient: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_length")]
    rms_height: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    peklenik: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_angle")]
    lay_angle: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    skewness: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kurtosis: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    weibull: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    beta: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    heights_like: Option<HeightFile>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<ExactPart>,
}

impl RoughnessKeys {
    /// The keys of a spectrum and what is done with it.
    pub(crate) fn from_parts(
        spectrum: SpectralDensity,
        lay: Lay,
        scale: RoughnessScale,
        heights: Option<TargetHeights>,
    ) -> Self {
        let mut keys = Self::default();
        match spectrum {
            SpectralDensity::SelfAffine(law) => {
                keys.hurst = Some(law.hurst);
                keys.rolloff_wavelength = law.rolloff_wavelength();
                keys.rolloff_form = match law.rolloff {
                    Rolloff::Plateau(_) => None,
                    Rolloff::Drop(_) => Some(RolloffForm::Drop),
                    Rolloff::None => Some(RolloffForm::None),
                };
                keys.short_cutoff = Some(law.short_cutoff);
            }
            SpectralDensity::Measured(MeasuredSpectrum { file, convention, short_cutoff }) => {
                keys.table = Some(file);
                keys.convention = convention;
                keys.short_cutoff = short_cutoff;
            }
        }
        match scale {
            RoughnessScale::RmsGradient(gradient) => keys.rms_gradient = Some(gradient),
            RoughnessScale::RmsHeight(height) => keys.rms_height = Some(height),
            RoughnessScale::AsGiven => (),
        }
        if !lay.is_isotropic() {
            keys.peklenik = Some(lay.peklenik);
            keys.lay_angle = (lay.angle != 0.0).then_some(lay.angle);
        }
        if let Some(TargetHeights { distribution, exact }) = heights {
            keys.exact = (exact != ExactPart::default()).then_some(exact);
            match distribution {
                HeightDistribution::Moments { skewness, kurtosis } => {
                    (keys.skewness, keys.kurtosis) = (Some(skewness), Some(kurtosis));
                }
                HeightDistribution::Weibull { shape } => keys.weibull = Some(shape),
                HeightDistribution::Beta { shapes } => keys.beta = Some(shapes),
                HeightDistribution::Like(file) => keys.heights_like = Some(file),
            }
        }
        keys
    }

    pub(crate) fn spectrum(&self) -> Result<SpectralDensity, String> {
        let law = self.hurst.is_some() || self.rolloff_wavelength.is_some() || self.rolloff_form.is_some();
        match &self.table {
            Some(_) if law => {
                Err("both a table and a Hurst exponent with its wavelengths are given: give one of them".into())
            }
            Some(table) => Ok(SpectralDensity::Measured(MeasuredSpectrum {
                file: table.clone(),
                convention: self.convention,
                short_cutoff: self.short_cutoff,
            })),
            None if self.convention.is_some() => Err("a convention is given without a table: leave it out".into()),
            None => {
                let hurst = needed(self.hurst, "hurst")?;
                Ok(SpectralDensity::SelfAffine(SelfAffine {
                    hurst,
                    rolloff: self.rolloff()?,
                    short_cutoff: needed(self.short_cutoff, "short-cutoff")?,
                }))
            }
        }
    }

    fn rolloff(&self) -> Result<Rolloff, String> {
        let wavelength = || needed(self.rolloff_wavelength, "rolloff-wavelength");
        match self.rolloff_form.unwrap_or(RolloffForm::Plateau) {
            RolloffForm::Plateau => Ok(Rolloff::Plateau(wavelength()?)),
            RolloffForm::Drop => Ok(Rolloff::Drop(wavelength()?)),
            RolloffForm::None if self.rolloff_wavelength.is_some() => {
                Err("a roll-off wavelength is given, but the roll-off form is none: leave one of them out".into())
            }
            RolloffForm::None => Ok(Rolloff::None),
        }
    }

    pub(crate) fn lay(&self) -> Result<Lay, String> {
        match (self.peklenik, self.lay_angle) {
            (None, Some(_)) => Err("the angle of a lay is given without a Peklenik number: give it as well".into()),
            (peklenik, angle) => Ok(Lay { peklenik: peklenik.unwrap_or(1.0), angle: angle.unwrap_or(0.0) }),
        }
    }

    pub(crate) fn scale(&self) -> Result<RoughnessScale, String> {
        match (self.rms_gradient, self.rms_height) {
            (Some(_), Some(_)) => Err("both the rms gradient and the rms height are given: give one of them".into()),
            (Some(gradient), None) => Ok(RoughnessScale::RmsGradient(gradient)),
            (None, Some(height)) => Ok(RoughnessScale::RmsHeight(height)),
            (None, None) if self.table.is_some() => Ok(RoughnessScale::AsGiven),
            (None, None) => Err("give the scale of the roughness: `rms-gradient` or `rms-height`".into()),
        }
    }

    pub(crate) fn heights(&self) -> Result<Option<TargetHeights>, String> {
        let moments = match (self.skewness, self.kurtosis) {
            (Some(skewness), Some(kurtosis)) => Some(HeightDistribution::Moments { skewness, kurtosis }),
            (None, None) => None,
            _ => return Err("a skewness needs a kurtosis, and a kurtosis a skewness: give both".into()),
        };
        let weibull = self.weibull.map(|shape| HeightDistribution::Weibull { shape });
        let beta = self.beta.map(|shapes| HeightDistribution::Beta { shapes });
        let like = self.heights_like.clone().map(HeightDistribution::Like);
        let mut given = [moments, weibull, beta, like].into_iter().flatten();
        match (given.next(), given.next()) {
            (_, Some(_)) => Err("several distributions of heights are given: give one of them".into()),
            (Some(distribution), None) => {
                Ok(Some(TargetHeights { distribution, exact: self.exact.unwrap_or_default() }))
            }
            (None, None) if self.exact.is_some() => {
                Err("Gaussian heights have their spectrum, and both are exact: leave out `exact`".into())
            }
            (None, None) => Ok(None),
        }
    }
}

fn needed(value: Option<f64>, key: &str) -> Result<f64, String> {
    value.ok_or_else(|| format!("missing field `{key}`"))
}
