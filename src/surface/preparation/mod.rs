//! The preparation of measured heights.

mod cluster;
mod crop;
mod detrend;
mod fill;
mod form;
mod gaussian;
mod laplace;
mod least_squares;
mod line_level;
mod mirror;
mod outliers;
mod resample;
mod scan;
mod scars;
mod stand_off;
mod taper;

pub(in crate::surface) use cluster::clusters;
pub use crop::Crop;
pub use detrend::Detrend;
pub use fill::Fill;
pub use form::Form;
pub use line_level::{LineLevel, LineOffsets, Settling};
pub use mirror::Mirror;
pub use outliers::Outliers;
pub use resample::Resample;
pub use scars::Scars;

use crate::error::PreparationError;
use crate::formats::Scan;
use crate::quantity::{number_in_words, some_length};
use crate::sentence::{LengthValue, Sentence, sentence};
use ndarray::Array2;
use serde::{Deserialize, Serialize};

/// The steps that prepare measured heights, in their order. Only the given steps are done, and each one reports its
/// effect.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Preparation {
    /// First step: how heights at uneven positions, or of which each is there several times, are interpolated to even spacing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resample: Option<Resample>,
    /// The part to keep.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crop: Option<Crop>,
    /// What is subtracted from each row, see [`LineLevel`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub level_rows: Option<LineLevel>,
    /// What is subtracted from each column.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub level_columns: Option<LineLevel>,
    /// What becomes of single heights that stand off all their neighbours.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outliers: Option<Outliers>,
    /// What becomes of stretches of scan lines that stand off the lines beside them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scars: Option<Scars>,
    /// How voids are filled.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fill: Option<Fill>,
    /// The trend to subtract.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub detrend: Option<Detrend>,
    /// The body whose fitted form is subtracted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remove_form: Option<Form>,
    /// The wavelength above which waves are removed, see [`Scan::high_pass`].
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_length")]
    pub high_pass: Option<f64>,
    /// The wavelength below which waves are removed, see [`Scan::low_pass`].
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_length")]
    pub low_pass: Option<f64>,
    /// The fraction of each side within which the heights go to their mean, see [`Scan::tapered`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub taper: Option<f64>,
    /// The axes along which heights are mirrored.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mirror: Option<Mirror>,
}

/// Prepared heights, and the effect of each step, in one sentence each.
#[derive(Debug, Clone, PartialEq)]
pub struct Prepared {
    /// The heights.
    pub scan: Scan,
    /// The nodes whose heights were not measured but filled in; none if no void was filled.
    pub filled: Option<Array2<bool>>,
    /// The effect of each step.
    pub effects: Vec<Sentence>,
}

impl Preparation {
    /// The automatic choices of the steps, and their names in scenes, with a short description.
    pub const WAYS: [(&str, &str); 1] =
        [("auto", "Automatic choice: resample, mend artefacts, fill voids, make the heights periodic, filter noise")];

    /// Whether there are no steps.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// The steps with the names of their keys, such as "fill harmonic, detrend plane".
    pub fn description(&self) -> String {
        let steps = [
            step("resample", self.resample),
            step("crop", self.crop.as_ref().map(|crop| &crop.0)),
            step("level rows", self.level_rows),
            step("level columns", self.level_columns),
            step("outliers", self.outliers),
            step("scars", self.scars),
            step("fill", self.fill),
            step("detrend", self.detrend),
            step("remove form", self.remove_form),
            step("high pass", self.high_pass),
            step("low pass", self.low_pass),
            step("taper", self.taper),
            step("mirror", self.mirror),
        ];
        steps.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    /// Rows and columns after the step, from those before it.
    ///
    /// # Errors
    /// [`PreparationError::Crop`].
    pub fn shape(&self, shape: [usize; 2]) -> Result<[usize; 2], PreparationError> {
        let cropped = match &self.crop {
            Some(crop) => crop.ranges(shape).ok_or_else(|| crop.unfit(shape))?.map(|[first, beyond]| beyond - first),
            None => shape,
        };
        Ok(self.mirror.map_or(cropped, |mirror| mirror.shape(cropped)))
    }

    /// Does all given steps.
    ///
    /// # Errors
    /// For a step that these heights do not allow.
    pub fn apply(&self, scan: Scan) -> Result<Prepared, PreparationError> {
        let mut it = Prepared { scan, filled: None, effects: Vec::new() };
        self.mend(&mut it)?;
        self.take_off(&mut it)?;
        self.filter(&mut it)?;
        Ok(it)
    }

    /// Takes a part of the heights, and mends what the instrument did to them.
    fn mend(&self, it: &mut Prepared) -> Result<(), PreparationError> {
        if self.resample == Some(Resample::Repeats) {
            let even = Resample::without_repeats(it.scan.clone());
            it.take(even, |before, after| {
                sentence!(
                    "heights that are there several times were interpolated: {gradients}",
                    gradients = gradients(before, after)
                )
            });
        }
        if let Some(crop) = &self.crop {
            let part = crop.apply(&it.scan).ok_or_else(|| crop.unfit(it.scan.shape()))?;
            it.take(part, |_, part| {
                sentence!("cropped to {rows} x {columns} points", rows = part.shape()[0], columns = part.shape()[1])
            });
        }
        for (axis, (level, line)) in [(self.level_rows, "row"), (self.level_columns, "column")].into_iter().enumerate()
        {
            let Some(level) = level else { continue };
            let flat = level.apply(it.scan.clone(), axis);
            it.take(flat, |before, after| {
                sentence!("each {line} was levelled: {gradients}", line, gradients = gradients(before, after))
            });
        }
        if let Some(outliers) = self.outliers {
            let rest = outliers.apply(it.scan.clone());
            it.take(rest, |before, after| {
                sentence!(
                    "{count} heights that stand off all their neighbours became voids: {gradients}",
                    count = after.voids() - before.voids(),
                    gradients = gradients(before, after)
                )
            });
        }
        if let Some(scars) = self.scars {
            let rest = scars.apply(it.scan.clone());
            it.take(rest, |before, after| {
                sentence!(
                    "{count} heights that are in scars of scan lines became voids: {gradients}",
                    count = after.voids() - before.voids(),
                    gradients = gradients(before, after)
                )
            });
        }
        Ok(())
    }

    /// Fills voids, and takes off trend and form, which need all heights.
    fn take_off(&self, it: &mut Prepared) -> Result<(), PreparationError> {
        if let Some(fill) = self.fill.filter(|_| it.scan.voids() > 0) {
            let full = fill.apply(it.scan.clone()).ok_or(PreparationError::AllVoid)?;
            it.filled = Some(it.scan.height.mapv(f64::is_nan));
            it.take(full, |before, _| {
                sentence!("{voids} voids filled with the smoothest heights", voids = before.voids())
            });
        }
        if let Some(detrend) = self.detrend {
            let flat = detrend.apply(it.scan.clone());
            it.take(flat, |before, after| {
                sentence!("the trend was subtracted: {gradients}", gradients = gradients(before, after))
            });
        }
        if let Some(form) = self.remove_form {
            let (flat, radius) = form.apply(it.scan.clone()).ok_or(PreparationError::NoForm)?;
            it.take(flat, |before, after| {
                sentence!(
                    "a form of radius {radius:.6e} was subtracted: {gradients}",
                    radius = LengthValue(radius),
                    gradients = gradients(before, after)
                )
            });
        }
        Ok(())
    }

    /// Filters waves, and makes the heights periodic.
    fn filter(&self, it: &mut Prepared) -> Result<(), PreparationError> {
        for (name, wavelength) in [("high", self.high_pass), ("low", self.low_pass)] {
            let Some(wavelength) = wavelength else { continue };
            let filtered = it.filtered(name == "high", wavelength)?;
            it.take(filtered, |before, after| {
                sentence!(
                    "{name}-pass filter at {wavelength:.4e}: {gradients}",
                    name,
                    wavelength = LengthValue(wavelength),
                    gradients = gradients(before, after)
                )
            });
        }
        if let Some(share) = self.taper {
            let tapered = it.tapered(share)?;
            it.take(tapered, |before, after| {
                sentence!(
                    "tapered within a fraction {share} of each side: {gradients}",
                    share,
                    gradients = gradients(before, after)
                )
            });
        }
        if let Some(mirror) = self.mirror {
            let mirrored = mirror.apply(&it.scan);
            it.filled = it.filled.take().map(|nodes| mirror.images(&nodes));
            it.take(mirrored, |_, after| {
                sentence!("mirrored to {rows} x {columns} points", rows = after.shape()[0], columns = after.shape()[1])
            });
        }
        Ok(())
    }
}

impl Prepared {
    /// Continues with the next heights, and describes the effect of the step.
    fn take(&mut self, next: Scan, effect: impl FnOnce(&Scan, &Scan) -> Sentence) {
        self.effects.push(effect(&self.scan, &next));
        self.scan = next;
    }

    fn filtered(&self, is_high: bool, wavelength: f64) -> Result<Scan, PreparationError> {
        let shortest = 2.0 * self.scan.axes().map(|axis| self.scan.spacing[axis]).fold(0.0, f64::max);
        if !(wavelength.is_finite() && wavelength >= shortest) {
            return Err(PreparationError::Wavelength { wavelength, shortest });
        }
        let longest = 2.0 * self.scan.half();
        if !is_high && wavelength > longest {
            return Err(PreparationError::LongWavelength { wavelength, longest });
        }
        Ok(if is_high { self.scan.high_pass(wavelength) } else { self.scan.low_pass(wavelength) })
    }

    fn tapered(&self, share: f64) -> Result<Scan, PreparationError> {
        if share > 0.0 && share <= 0.5 {
            Ok(self.scan.clone().tapered(share))
        } else {
            Err(PreparationError::Taper { share })
        }
    }
}

impl Crop {
    fn unfit(&self, shape: [usize; 2]) -> PreparationError {
        PreparationError::Crop { crop: self.0.clone(), shape }
    }
}

/// A step in the words of its key and value.
fn step(name: &str, value: Option<impl std::fmt::Debug>) -> Option<String> {
    value.map(|value| format!("{name} {value:?}").to_lowercase())
}

/// The rms gradient before and after a step.
fn gradients(before: &Scan, after: &Scan) -> Sentence {
    let [before, after] = [before, after].map(|scan| number_in_words(scan.rms_gradient()));
    sentence!("the rms gradient was {before} and is {after}", before, after)
}
