//! Flags that tell more of measured heights than the heights do: the radius of the instrument's tip, and a second measurement of the same place.

use super::exit_status::usage;
use super::units::Units;
use anyhow::Result;
use asperity::formats::{HeightFile, Scan};
use asperity::quantity::length_of;
use asperity::setup::{Cell, Recipe};
use asperity::surface::{Prepared, RepeatNoise, TipReach};
use clap::Args;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The part by which the sides of two measurements of the same place may differ.
const SIDE_TOLERANCE: f64 = 1e-3;

/// The part of the heights that may be sharper than the tip by chance; with more the tip has not measured these heights.
const LARGEST_SHARPER_SHARE: f64 = 0.05;

/// The highest part of the nodes, of which the verdict says how much the tip has not reached. Elastic contacts of rough surfaces mostly cover less than a tenth.
const HIGHEST_SHARE: f64 = 0.1;

/// The flags of a measurement: the radius of its tip, and its repetition.
#[derive(Args)]
pub(crate) struct MeasurementArgs {
    /// A second measurement of the same place: tell the noise by their difference, and what it does to rms gradient and areas
    #[arg(long, value_name = "FILE", help_heading = "Measurement")]
    repeat: Option<PathBuf>,
    /// Radius of the ball-shaped tip that measured the heights, such as 5um: tell how many heights it has not reached
    #[arg(long, value_name = "R", value_parser = radius, help_heading = "Measurement")]
    tip_radius: Option<f64>,
}

/// The findings about heights by the radius of the tip and by a second measurement; each is absent where its flag is not given.
#[derive(Serialize, Default)]
pub(crate) struct MeasurementReport {
    #[serde(skip_serializing_if = "Option::is_none")]
    tip: Option<TipReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    repeat: Option<RepeatNoise>,
}

/// The heights that a ball-shaped tip has not reached, and what that does to gradient and areas.
#[derive(Serialize)]
struct TipReport {
    /// The radius of the tip, which is the least radius of curvature of valleys in its image.
    radius: f64,
    /// The part of the nodes that it has not reached for certain.
    unreached_share: f64,
    /// The part of the highest tenth of the nodes that the tip has not reached for certain.
    unreached_share_of_highest: f64,
    /// The part of the nodes that are sharper than the tip, so that it cannot have measured them.
    sharper_share: f64,
    /// The rms gradient of the image, and of the highest heights with this image.
    rms_gradient: [f64; 2],
    /// The least relative error of areas: one minus the ratio of these gradients. On maps that were dilated by a ball the true error was several times as
    /// large.
    area_error: f64,
}

impl MeasurementArgs {
    /// Whether something is given.
    pub(crate) fn is_given(&self) -> bool {
        self.repeat.is_some() || self.tip_radius.is_some()
    }

    /// The files that are read.
    pub(crate) fn files(&self) -> impl Iterator<Item = PathBuf> {
        self.repeat.iter().cloned()
    }

    /// The findings about the prepared heights of a recipe.
    ///
    /// # Errors
    /// For a surface that was not measured, and a second measurement of another shape or size.
    pub(crate) fn report(&self, recipe: &Recipe, cell: &Cell) -> Result<MeasurementReport> {
        if !self.is_given() {
            return Ok(MeasurementReport::default());
        }
        let Some(file) = &recipe.height else {
            return usage("--tip-radius and --repeat are for measured heights: give a file of heights");
        };
        let heights = original(recipe, file, cell)?;
        let tip = self.tip_radius.map(|radius| TipReport::new(&heights, radius)).transpose()?;
        let repeat = match &self.repeat {
            Some(path) => Some(repeated(recipe, cell, &heights, path)?),
            None => None,
        };
        Ok(MeasurementReport { tip, repeat })
    }
}

impl MeasurementReport {
    /// The findings in sentences, for people.
    pub(crate) fn sentences(&self, units: Units) -> Vec<String> {
        let words = |length: f64| units.length(length);
        let mut lines: Vec<String> = self.tip.iter().map(|tip| tip.sentence(units)).collect();
        lines.extend(self.repeat.iter().flat_map(|it| it.sentences_in(&words)));
        lines
    }
}

impl TipReport {
    fn new(heights: &Scan, radius: f64) -> Result<Self> {
        let found = TipReach::new(heights, radius)?;
        Ok(Self {
            radius,
            unreached_share: found.unreached_share(),
            unreached_share_of_highest: found.unreached_share_of_highest(HIGHEST_SHARE),
            sharper_share: found.sharper_share(heights),
            rms_gradient: [heights.rms_gradient(), found.height.rms_gradient()],
            area_error: found.area_error(heights),
        })
    }

    fn sentence(&self, units: Units) -> String {
        let radius = units.length(self.radius);
        if self.sharper_share > LARGEST_SHARPER_SHARE {
            return format!(
                "A ball-shaped tip of radius {radius} cannot have measured {:.0} % of the heights, which are sharper: they are noise, to be filtered \
                 out first, or the tip is smaller",
                100.0 * self.sharper_share
            );
        }
        let [image, below] = self.rms_gradient;
        format!(
            "A ball-shaped tip of radius {radius} has not reached {:.1} % of the heights for certain, and {:.1} % of the highest tenth, where contacts \
             begin: valleys there have its radius at least, and summits have it in addition to their own. Without the tip the rms gradient is at \
             least {below:.4}, not {image:.4}, and areas are at least {:.0} % too large",
            100.0 * self.unreached_share,
            100.0 * self.unreached_share_of_highest,
            100.0 * self.area_error
        )
    }
}

/// The prepared heights of a file without their mirror images.
fn original(recipe: &Recipe, file: &HeightFile, cell: &Cell) -> Result<Scan> {
    let Prepared { scan, .. } = recipe.prepared(file, &recipe.grid(cell)?)?;
    Ok(recipe.prepare.mirror.map_or_else(|| scan.clone(), |mirror| mirror.original(&scan)))
}

/// The noise of heights by a second measurement, which is prepared as they are.
fn repeated(recipe: &Recipe, cell: &Cell, heights: &Scan, path: &Path) -> Result<RepeatNoise> {
    let file = HeightFile::from(path.to_path_buf());
    let second = Recipe { height: Some(file.clone()), ..recipe.clone() };
    let other = original(&second, &file, cell)?;
    let is_same = |axis: usize| (other.spacing[axis] / heights.spacing[axis] - 1.0).abs() < SIDE_TOLERANCE;
    if other.shape() != heights.shape() || ![0, 1].into_iter().all(is_same) {
        let [one, two] = [heights, &other].map(in_words);
        return usage(format!(
            "{} has {two}, but the heights have {one}: give a second measurement of the same place with the same points and size",
            path.display()
        ));
    }
    Ok(RepeatNoise::new(heights, &other)?)
}

/// The points and the spacing of heights.
fn in_words(scan: &Scan) -> String {
    let ([ny, nx], [dy, dx]) = (scan.shape(), scan.spacing);
    if scan.is_line() {
        format!("{nx} points {dx:.4e} apart")
    } else {
        format!("{ny} x {nx} points {dy:.4e} x {dx:.4e} apart")
    }
}

/// A radius as a number or a length with a unit.
fn radius(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().or_else(|| length_of(text));
    value.filter(|it: &f64| it.is_finite() && *it > 0.0).ok_or_else(|| "give a positive length, such as 5um".to_owned())
}
