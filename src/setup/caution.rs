//! Warnings about surfaces for which the numbers of a contact mean little.

use super::Recipe;
use crate::surface::{Detrend, HeightFile, Layout, Scales, Surface, Survey};

/// Steps across the period above this many rms steps are a jump: periodic random lines have 0.05 to 2, measured traces less their
/// plane up to 100.
const JUMP: f64 = 10.0;
/// Rms gradients of measured heights above this one come from a wrong unit, as they differ by thousands.
const STEEPEST: f64 = 10.0;
/// Lengths whose logarithms to the base of ten differ from a whole number by less than this may be the same in another unit.
const SAME_LENGTH: f64 = 0.01;
/// The share of noise in the mean square gradient above which it is told.
const NOISIEST: f64 = 0.25;
/// Rms gradients at the spacing over those at twice the spacing above this are told: those of resolved heights are about equal.
const LARGEST_GROWTH: f64 = 1.1;
/// Spacings that differ by less than this share count as equal.
const UNEQUAL: f64 = 0.01;

impl Recipe {
    /// Warnings about the surface that was made, a sentence each: jumps across the period, unequal spacings, gradients of a wrong unit, and
    /// noise.
    pub fn warnings(&self, surface: &Surface) -> Vec<String> {
        let measured = self.height.as_ref().map(|file| {
            let refined = refinement(self, file, surface);
            let told = [spacing(surface), gradient(surface), spacing_of_file(self, file, surface, refined)];
            told.into_iter().flatten().chain(warning_of_noise(&Scales::of_surface(surface, refined)))
        });
        self.warnings_of_jumps(surface.jumps()).into_iter().chain(measured.into_iter().flatten()).collect()
    }

    /// Warnings about heights with voids, a sentence each.
    pub fn warnings_of_voids(&self, survey: &Survey, points: usize) -> Vec<String> {
        let voids = format!(
            "{} of {points} heights are void, and no contact can be solved with them: fill them by --fill harmonic, or --crop them \
             away",
            survey.voids
        );
        let jumps = self.warnings_of_jumps(survey.jumps);
        [voids]
            .into_iter()
            .chain(jumps)
            .chain(warning_of_noise(&survey.axes))
            .chain(survey.warning_of_growth())
            .collect()
    }

    /// Warnings about jumps across the period along y and x.
    fn warnings_of_jumps(&self, jumps: [f64; 2]) -> Vec<String> {
        let remedy = match self.prepare.detrend {
            Some(Detrend::Plane | Detrend::Curvature) => {
                "mirror them by --mirror, or leave the period out by --boundary free"
            }
            _ if self.is_measured() => {
                "take off their trend and mirror them by --prepare auto, or leave the period out by --boundary free"
            }
            _ => "give a longer cell, or leave the period out by --boundary free",
        };
        let jump = |(axis, jump): (&str, f64)| {
            format!(
                "the heights jump by {jump:.3} rms steps across the period along {axis}, where the contact is not real: {remedy}"
            )
        };
        ["y", "x"].into_iter().zip(jumps).filter(|(_, jump)| *jump > JUMP).map(jump).collect()
    }
}

impl Survey {
    /// The warning that heights are as rough as their spacing lets them be.
    pub fn warning_of_growth(&self) -> Option<String> {
        let growth = self.gradient_growth();
        (growth > LARGEST_GROWTH).then(|| {
            format!(
                "the rms gradient is {:.0} % larger at the spacing than at twice the spacing, so that area and kappa are those of this spacing: \
                 compare with other files after the same --low-pass only",
                100.0 * (growth - 1.0)
            )
        })
    }
}

/// The warning that much of the gradient is noise, so that area has no limit as the spacing shrinks.
fn warning_of_noise(axes: &[Scales]) -> Option<String> {
    let share = axes.iter().map(|it| it.noise_share).fold(0.0, f64::max);
    let wavelength = axes.iter().map(|it| it.shortest_wavelength).fold(0.0, f64::max);
    (share > NOISIEST).then(|| {
        format!(
            "noise at the spacing makes {:.0} % of the mean square gradient, so that area and kappa are those of the instrument and have no \
             limit: filter it out by --low-pass {wavelength:.3e}, or by --prepare auto",
            100.0 * share
        )
    })
}

/// Lengths of measured surfaces that may have been swapped.
fn spacing(surface: &Surface) -> Option<String> {
    let [dy, dx] = surface.grid().spacing();
    let is_unequal = !surface.grid().is_line() && (dy / dx - 1.0).abs() > UNEQUAL;
    is_unequal.then(|| {
        format!(
            "the spacing is {dy:.4e} along y (rows) and {dx:.4e} along x (columns): if the axes are the other way round, swap Width and Height, which --size takes as y,x"
        )
    })
}

/// Distances in a file that do not fit the size, of a file that does not say its units in none.
fn spacing_of_file(recipe: &Recipe, file: &HeightFile, surface: &Surface, refined: usize) -> Option<String> {
    let Layout { spacing, is_in_metres, .. } = file.layout(recipe.channel.as_deref()).ok()?;
    let [_, told] = spacing?;
    let spacing = surface.grid().spacing()[1] * refined as f64;
    let power = (spacing / told).log10();
    let unit = if is_in_metres { 0.0 } else { power.round() };
    let is_same = (power - unit).abs() < SAME_LENGTH;
    (!is_same).then(|| {
        format!(
            "the points in {} are {told:.6e} apart and those of the grid {spacing:.6e}: leave the size out, or give that of the file",
            file.display()
        )
    })
}

/// The nodes of a surface for each of its file along an axis.
fn refinement(recipe: &Recipe, file: &HeightFile, surface: &Surface) -> usize {
    let layout = file.layout(recipe.channel.as_deref()).ok();
    let shape = layout.and_then(|it| recipe.prepare.shape(it.shape).ok());
    shape.map_or(1, |[_, nx]| surface.grid().shape()[1] / nx).max(1)
}

/// Heights that may have another unit than the size.
fn gradient(surface: &Surface) -> Option<String> {
    let gradient = surface.rms_gradient();
    (gradient > STEEPEST).then(|| format!("the rms gradient is {gradient:.3e}: give heights and size in the same unit"))
}
