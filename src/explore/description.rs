//! The description of a file of heights for the page.

use super::height_knobs::HeightKnobs;
use super::refusal::{KnownFault, Refusal, RefusalRule};
use crate::digest::fnv1a;
use crate::formats::{HeightFile, Measurement, Scan};
use crate::quantity::{length_in_words as length, number_in_words as figure};
use crate::sentence::{Sentence, sentence};
use crate::surface::{Preparation, Survey};
use serde::Serialize;

/// Lines of a file's own header that are shown, and letters of each.
const HEADER: [usize; 2] = [24, 100];
/// A file of heights in words, and the knobs that take it.
#[derive(Clone, Serialize)]
pub struct Description {
    /// Its name.
    pub name: String,
    /// Whether it holds a profile, not a map.
    pub is_profile: bool,
    /// The channels of heights to choose from.
    pub channels: Vec<String>,
    /// The one that was read.
    pub channel: String,
    /// Whether it says its units.
    pub is_in_metres: bool,
    /// Whether it says how far apart its points are.
    pub has_spacing: bool,
    /// The knobs, with the automatic steps if these are requested.
    pub knobs: HeightKnobs,
    /// Its description: names and values.
    pub rows: Vec<(&'static str, Sentence)>,
    /// The first lines of the file's own header, as they are written there: names and values.
    pub header: Vec<(String, String)>,
    /// Why steps were chosen, a sentence each.
    pub reasons: Vec<Sentence>,
    /// Why it cannot be solved, in one sentence.
    pub fault: Option<Sentence>,
    /// The same as data, if the page has a text for it.
    pub known_fault: Option<KnownFault>,
}

impl Description {
    /// A file as knobs take it.
    ///
    /// # Errors
    /// For a file that cannot be read.
    pub fn new(file: &HeightFile, knobs: HeightKnobs) -> Result<Self, Refusal> {
        let mark = format!("{:016x}", fnv1a([file.bytes()?.as_ref()]));
        let knobs = HeightKnobs { file: Some(mark), ..knobs };
        let measured = file.measurement(knobs.channel.as_deref())?;
        let chosen = if knobs.auto { knobs.chosen(file) } else { Ok((knobs.clone(), Vec::new())) };
        let taken = chosen.and_then(|(knobs, reasons)| Ok((scan(&knobs, file)?, knobs, reasons)));
        let mut rows = of_file(&measured, &knobs);
        let (knobs, reasons, refusal) = match taken {
            Ok((scan, knobs, reasons)) => {
                rows.extend(of_heights(&scan)?);
                let refusal = knobs.surface(file).err();
                (knobs, reasons, refusal)
            }
            Err(refusal) => (knobs, Vec::new(), Some(refusal)),
        };
        let (fault, known_fault) = refusal.map_or((None, None), |it| (Some(it.sentence), it.known));
        let short = |text: &String| text.chars().take(HEADER[1]).collect::<String>();
        let header = measured.header.iter().take(HEADER[0]).map(|(name, value)| (short(name), short(value))).collect();
        let has_spacing = measured.spacing.is_some();
        let Measurement { is_profile, channels, channel, is_in_metres, .. } = measured;
        let name = file.display().to_string();
        Ok(Self {
            name,
            is_profile,
            channels,
            channel,
            is_in_metres,
            has_spacing,
            knobs,
            rows,
            header,
            reasons,
            fault,
            known_fault,
        })
    }
}

impl Description {
    /// Refuses knobs that are for another file.
    ///
    /// # Errors
    /// For knobs with the mark of another file.
    pub(super) fn check(&self, knobs: &HeightKnobs) -> Result<(), Refusal> {
        if knobs.file.is_none() || knobs.file == self.knobs.file {
            return Ok(());
        }
        Err(RefusalRule::HeightsReplaced.with([("name", self.name.clone())]))
    }
}

/// The heights as they were measured, without those that are cropped.
fn scan(knobs: &HeightKnobs, file: &HeightFile) -> Result<Scan, Refusal> {
    let Preparation { resample, crop, .. } = knobs.prepare.clone();
    let raw = HeightKnobs { prepare: Preparation { resample, crop, ..Preparation::default() }, ..knobs.clone() };
    let (recipe, cell) = raw.surface(file)?;
    Ok(recipe.prepared(file, &recipe.grid(&cell)?)?.scan)
}

/// What a file says of itself.
fn of_file(measured: &Measurement, knobs: &HeightKnobs) -> Vec<(&'static str, Sentence)> {
    let lengths = match (measured.is_in_metres, knobs.unit) {
        (true, _) => "metres, as given in the file".into(),
        (false, Some(unit)) => sentence!("1 in the file is {length}", length = length(unit)),
        (false, None) => "not given in the file: metres assumed".into(),
    };
    let [ny, nx] = measured.height.dim().into();
    let points = if measured.is_profile { nx.to_string() } else { format!("{ny} x {nx}") };
    let rows = [
        ("format", measured.format.into()),
        ("channel", measured.channel.clone().into()),
        ("lengths", lengths),
        ("points", points.into()),
    ];
    rows.into()
}

/// What heights are like.
fn of_heights(scan: &Scan) -> Result<Vec<(&'static str, Sentence)>, Refusal> {
    let survey = Survey::new(scan)?;
    let ([ny, nx], [dy, dx]) = (scan.shape(), scan.spacing);
    let is_line = ny == 1;
    let axes = |[y, x]: [String; 2]| if is_line { x.into() } else { sentence!("{y} along y, {x} along x", y, x) };
    let size = [ny as f64 * dy, nx as f64 * dx].map(length);
    let noise = survey.axes.iter().map(|it| it.noise).fold(0.0, f64::max);
    let of_axes = |[height, width]: &[String; 2]| match is_line {
        true => Sentence::from(width.as_str()),
        false => sentence!("{height} x {width}", height, width),
    };
    let rows = [
        ("size", of_axes(&size)),
        ("voids", sentence!("{count} of {all} heights", count = survey.voids, all = ny * nx)),
        ("tilt", axes(survey.tilt.map(figure))),
        ("jump across the period", sentence!("{jump} rms steps", jump = axes(survey.jumps.map(figure)))),
        ("rms height", length(rms_height(scan)).into()),
        ("rms gradient", figure(scan.rms_gradient()).into()),
        (
            "noise",
            sentence!(
                "{length}, {share:.0} % of the mean square gradient",
                length = length(noise),
                share = 100.0 * survey.noise.share
            ),
        ),
        ("shortest wavelength above the noise", length(survey.noise.shortest_wavelength).into()),
    ];
    let hurst = survey.power_law.map(|it| {
        let [shortest, longest] = it.wavelengths.map(length);
        let found = sentence!(
            "{hurst:.2} ± {error:.2}, from {shortest} to {longest}",
            hurst = it.hurst,
            error = it.hurst_error,
            shortest,
            longest
        );
        ("Hurst exponent", found)
    });
    Ok(rows.into_iter().chain(hurst).collect())
}

/// The root mean square of heights about their mean, voids left out.
fn rms_height(scan: &Scan) -> f64 {
    let there = || scan.height.iter().filter(|h| !h.is_nan());
    let count = there().count().max(1) as f64;
    let mean = there().sum::<f64>() / count;
    (there().map(|h| (h - mean).powi(2)).sum::<f64>() / count).sqrt()
}
