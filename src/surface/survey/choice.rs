//! The automatic choice of a preparation.

use super::seam::{form_of, has_kink};
use super::{Artefact, Artefacts, Noise, Survey};
use crate::error::SurfaceError;
use crate::formats::Scan;
use crate::quantity::number_in_words;
use crate::sentence::{LengthValue, Sentence, sentence};
use crate::surface::{Crop, Detrend, Fill, Mirror, Preparation, Resample};

/// The share of the mean square gradient from which on noise is filtered out. Roughness down to the nodes may be taken for less.
const NOISE: f64 = 0.12;

/// The share of the mean square gradient from which on a filter of the noise would leave no surface.
const ALL_NOISE: f64 = 0.98;

/// The error of areas that is told at least after a filter of much noise, since what is left of the noise touches as the surface does not.
const LEAST_ERROR: f64 = 0.15;
/// The least error of areas by the filter of noise, over the share of the noise in the mean square gradient: of 20 maps with noise, four had an error
/// up to 1.2 times what is told with it.
const ERROR_PER_SHARE: f64 = 0.4;
/// The difference of the rms gradients of a part and of the whole from which on it is told.
const OTHER_PART: f64 = 0.05;
/// The share of the mean square height from which on a plane is a tilt, though there is a step: the plane through a step in the middle makes three quarters.
const TILTED: f64 = 0.9;
/// Halvings of the range of cut-offs.
const BISECTIONS: usize = 6;

/// A preparation chosen for heights, with a reason for each step.
///
/// Uneven positions are resampled. Artefacts that can be mended are mended, see [`Artefacts`]: offsets of scan lines are taken off, and single
/// heights that stand off, and scars, become voids. Voids are filled. From heights that are not periodic, the polynomial of second
/// order is subtracted (or only the plane, if the boundary is free and the heights may be a body; nothing, if they have a step). They are then
/// mirrored along the axes on which they still jump. Waves that cannot be distinguished from noise are filtered out
/// where the noise makes more than an eighth of the mean square gradient, and not all of it; noise is what is independent from node to node, and the same along all axes.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparationChoice {
    /// The steps.
    pub preparation: Preparation,
    /// The reasons for the steps, in one sentence each.
    pub reasons: Vec<Sentence>,
}

impl PreparationChoice {
    /// The preparation of heights that are at even positions or not, on a cell that is periodic along y and x or free.
    ///
    /// # Errors
    /// The errors of [`Survey::new`].
    pub fn new(scan: &Scan, is_even: bool, periodic: [bool; 2]) -> Result<Self, SurfaceError> {
        let mut choice = Self { preparation: Preparation::default(), reasons: Vec::new() };
        if !is_even {
            choice.preparation.resample = Some(Resample::Linear);
            choice.because("the positions are not evenly spaced: the heights are resampled to even spacing");
        }
        let part = choice.cropped(scan);
        let scan = part.as_ref().unwrap_or(scan);
        choice.add_steps(&Survey::new(scan)?, scan, periodic)?;
        Ok(choice)
    }

    /// The preparation of heights at even positions whose survey is known, on a cell that is periodic along y and x or free.
    ///
    /// # Errors
    /// The errors of [`Survey::new`].
    pub fn of_survey(survey: &Survey, scan: &Scan, periodic: [bool; 2]) -> Result<Self, SurfaceError> {
        if Crop::to_measured(scan).is_some() {
            return Self::new(scan, true, periodic);
        }
        let mut choice = Self { preparation: Preparation::default(), reasons: Vec::new() };
        choice.add_steps(survey, scan, periodic)?;
        Ok(choice)
    }

    /// Adds the steps after resampling and cropping, of some heights and their survey.
    fn add_steps(&mut self, survey: &Survey, scan: &Scan, periodic: [bool; 2]) -> Result<(), SurfaceError> {
        let artefacts = &survey.found;
        self.mend(artefacts, scan);
        let voids = artefacts.rest.voids();
        if voids > 0 {
            self.preparation.fill = Some(Fill::Harmonic);
            let all = scan.height.len();
            let share = 100.0 * voids as f64 / all as f64;
            self.because(sentence!("{voids} of {all} heights ({share:.1} %) are void: they are filled with the smoothest heights, and each contact says how much of it \
                 is on them", voids, all, share));
        }
        // a trend through a step would tilt both sides of it, unless the heights are a tilt with a small step
        let has_step = artefacts.all.iter().any(|it| matches!(it, Artefact::Step { .. }));
        let full = Fill::Harmonic.apply(artefacts.rest.clone()).unwrap_or(artefacts.rest.clone());
        self.tell_of_fill(&artefacts.rest, &full);
        let is_bent = [0, 1].into_iter().any(|axis| periodic[axis] && has_kink(&full, axis));
        let needs_trend = is_bent || ends(survey, periodic) != [false; 2] || periodic == [false; 2];
        let flat = match (needs_trend, has_step) {
            (false, _) => None,
            (true, false) => Some(self.detrended(full.clone(), periodic)),
            (true, true) => self.levelled(&full),
        };
        let of_flat = flat.as_ref().map(Survey::new).transpose()?;
        let (survey, full) = (of_flat.as_ref().unwrap_or(survey), flat.as_ref().unwrap_or(&full));
        self.mirror(survey, periodic);
        self.filter(survey, full);
        Ok(())
    }

    /// Mends artefacts, and tells of those that cannot be mended.
    fn mend(&mut self, artefacts: &Artefacts, scan: &Scan) {
        let Preparation { level_rows, level_columns, outliers, scars, .. } = artefacts.steps.clone();
        let resample = self.preparation.resample.or(artefacts.steps.resample);
        self.preparation =
            Preparation { resample, level_rows, level_columns, outliers, scars, ..self.preparation.clone() };
        for artefact in &artefacts.all {
            let what = artefact.sentence();
            self.because(match artefact {
                Artefact::Offsets { .. } => sentence!("{what}: these offsets are taken off", what),
                Artefact::Settling { .. } => sentence!("{what}: the exponential is taken off", what),
                Artefact::Repeated { .. } => sentence!("{what}: they are interpolated between their middles", what),
                Artefact::Outliers { .. } | Artefact::Scars { .. } => sentence!("{what}: they become voids", what),
                _ => what,
            });
        }
        if !self.reasons.is_empty() && artefacts.all.iter().any(Artefact::can_be_mended) {
            let [before, after] = [scan, &artefacts.rest].map(|it| number_in_words(it.rms_gradient()));
            self.because(sentence!("without these artefacts the rms gradient is {after}, not {before}", after, before));
        }
    }

    /// Crops voids at the rim away, and returns what is left.
    fn cropped(&mut self, scan: &Scan) -> Option<Scan> {
        let crop = Crop::to_measured(scan)?;
        let part = crop.apply(scan)?;
        let [[ny, nx], [rows, columns]] = [part.shape(), scan.shape()];
        let lost =
            100.0 * (1.0 - (part.height.len() - part.voids()) as f64 / (scan.height.len() - scan.voids()) as f64);
        self.because(sentence!("voids reach the rim of the {rows} x {columns} heights: they are cropped to the largest rectangle without such voids, {ny} x {nx}, \
             which leaves out {lost:.0} % of the measured heights", rows, columns, ny, nx, lost));
        let [whole, left] = [scan, &part].map(|it| Detrend::Curvature.apply(it.clone()).rms_gradient());
        let off = (left / whole - 1.0).abs();
        if off > OTHER_PART {
            let off = 100.0 * off;
            self.because(sentence!(
                "the rms gradient of the whole is {off:.0} % off that of this part: areas may be {off:.0} % off",
                off
            ));
        }
        self.preparation.crop = Some(crop);
        Some(part)
    }

    /// Tells by how much areas may be off since filled heights are smooth.
    fn tell_of_fill(&mut self, with_voids: &Scan, full: &Scan) {
        let error = 100.0 * Fill::area_error(with_voids, full);
        if error > 2.0 {
            self.because(sentence!("filled heights are smooth: areas may be up to {error:.1} % too large", error));
        }
    }

    fn because(&mut self, reason: impl Into<Sentence>) {
        self.reasons.push(reason.into());
    }

    /// Takes off the trend.
    fn detrended(&mut self, scan: Scan, periodic: [bool; 2]) -> Scan {
        let (trend, reason) = if periodic == [false; 2] {
            (Detrend::Plane, "the boundary is free: only the plane is subtracted, and the curvature is kept".into())
        } else {
            let trend = form_of(&scan);
            let order = if trend == Detrend::Cubic { "third" } else { "second" };
            let [before, after] = [Detrend::Plane, trend].map(|it| super::square(&it.apply(scan.clone())));
            let share = if before > 0.0 { 100.0 * (1.0 - after / before) } else { 0.0 };
            let reason =
                sentence!("the heights are not periodic: the polynomial of {order} order is subtracted", order);
            (trend, sentence!("{reason}, {share:.1} % of the mean square height about the plane", reason, share))
        };
        self.preparation.detrend = Some(trend);
        self.because(reason);
        trend.apply(scan)
    }

    /// The heights without their plane, where it makes most of them: more than that through any step over the whole width.
    fn levelled(&mut self, scan: &Scan) -> Option<Scan> {
        let level = Detrend::Plane.apply(scan.clone());
        let about_mean = super::square(scan) - scan.height.mean().unwrap_or(0.0).powi(2);
        let share = 1.0 - super::square(&level) / about_mean;
        (share > TILTED).then(|| {
            self.preparation.detrend = Some(Detrend::Plane);
            self.because(sentence!(
                "a plane makes {percent:.1} % of the mean square height: it is subtracted",
                percent = 100.0 * share
            ));
            level
        })
    }

    /// Mirrors along the axes on which heights end.
    fn mirror(&mut self, survey: &Survey, periodic: [bool; 2]) {
        let (mirror, axes) = match ends(survey, periodic) {
            [true, true] => (Mirror::Both, "y and x"),
            [true, false] => (Mirror::Y, "y"),
            [false, true] => (Mirror::X, "x"),
            [false, false] => return,
        };
        self.preparation.mirror = Some(mirror);
        let jump = jump(survey, periodic);
        self.because(sentence!(
            "the heights jump by {jump:.3} rms steps across the period: they are mirrored along {axes}",
            jump,
            axes
        ));
    }

    /// Filters noise out of full heights, and tells how much of the gradient goes with it. Less noise is told.
    fn filter(&mut self, survey: &Survey, full: &Scan) {
        let Noise { share, shortest_wavelength: wavelength, .. } = survey.noise;
        let (part, error) = (survey.noise.part_of_gradient(), survey.noise.area_error());
        if share <= NOISE {
            if error > Noise::TOLD {
                let error = 100.0 * error;
                self.because(sentence!(
                    "noise makes {part}, and is kept: areas may be up to {error:.0} % off",
                    part,
                    error
                ));
            }
            return;
        }
        if share > ALL_NOISE {
            self.because(sentence!("noise makes {part}, so that no surface can be told from it: the heights are kept, and what is found is that of the noise", part));
            return;
        }
        let before = full.rms_gradient();
        let [without, least] = survey.noise.gradients_without().map(|it| it * before);
        let wavelength = wavelength_of_gradient(full, without, wavelength);
        self.preparation.low_pass = Some(wavelength);
        let after = full.low_pass(wavelength).rms_gradient();
        let error = (after / without - 1.0)
            .abs()
            .max(1.0 - least / after)
            .max((ERROR_PER_SHARE * share).max(share.min(LEAST_ERROR)));
        self.because(sentence!(
            "noise makes {part}: waves below {wavelength:.3e} are filtered out",
            part,
            wavelength = LengthValue(wavelength)
        ));
        self.because(sentence!("without noise the rms gradient is estimated as {before}, after the filter it is {after}: areas may be up to {error:.0} % off", before = number_in_words(without), after = number_in_words(after), error = 100.0 * error));
    }
}

/// The cut-off of the low-pass filter that leaves an rms gradient, up to twice a wavelength at most: what it takes of the roughness, it leaves
/// of the noise.
fn wavelength_of_gradient(scan: &Scan, gradient: f64, most: f64) -> f64 {
    let shortest = 2.0 * scan.axes().map(|axis| scan.spacing[axis]).fold(0.0, f64::max);
    let longest = (2.0 * most).clamp(shortest, 2.0 * scan.half());
    let (mut low, mut high) = (shortest, longest);
    for _ in 0..BISECTIONS {
        let middle = (low * high).sqrt();
        let is_longer = scan.low_pass(middle).rms_gradient() > gradient;
        *(if is_longer { &mut low } else { &mut high }) = middle;
    }
    // four digits are enough, and are what the reason says
    format!("{:.3e}", (low * high).sqrt()).parse().unwrap_or(high)
}

/// The axes on which heights end that are to be periodic.
fn ends(survey: &Survey, periodic: [bool; 2]) -> [bool; 2] {
    [0, 1].map(|axis| periodic[axis] && survey.ends[axis])
}

/// The largest jump across a period.
fn jump(survey: &Survey, periodic: [bool; 2]) -> f64 {
    (0..2).filter(|&axis| periodic[axis]).map(|axis| survey.jumps[axis]).fold(0.0, f64::max)
}
