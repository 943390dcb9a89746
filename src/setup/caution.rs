//! Warnings about surfaces for which the numbers of a contact mean little.

use super::Recipe;
use crate::surface::{Detrend, HeightFile, Layout, Surface};

/// Steps across the period above this many rms steps are a jump: periodic random lines have 0.05 to 2, measured traces less their
/// plane up to 100.
const JUMP: f64 = 10.0;
/// Rms gradients of measured heights above this one come from a wrong unit, as they differ by thousands.
const STEEPEST: f64 = 10.0;
/// Lengths whose logarithms to the base of ten differ from a whole number by less than this may be the same in another unit.
const SAME_LENGTH: f64 = 0.01;
/// Spacings that differ by less than this share count as equal.
const UNEQUAL: f64 = 0.01;

impl Recipe {
    /// Warnings about the surface that was made, a sentence each: jumps across the period, unequal spacings, and gradients of a wrong unit.
    pub fn warnings(&self, surface: &Surface) -> Vec<String> {
        let jumps = ["y", "x"].into_iter().zip(surface.jumps());
        let jump = |(axis, jump): (&str, f64)| {
            let remedy = match self.prepare.detrend {
                Some(Detrend::Plane | Detrend::Curvature) => {
                    "mirror them by --mirror, or leave the period out by --boundary free"
                }
                _ => "take off their tilt by --detrend plane",
            };
            (jump > JUMP).then(|| {
                format!("the heights jump by {jump:.3} rms steps across the period along {axis}, where the contact is not real: {remedy}")
            })
        };
        let measured = self
            .height
            .as_ref()
            .map(|file| [spacing(surface), gradient(surface), spacing_of_file(self, file, surface)]);
        jumps.filter_map(jump).chain(measured.into_iter().flatten().flatten()).collect()
    }
}

/// Lengths of measured surfaces that may have been swapped.
fn spacing(surface: &Surface) -> Option<String> {
    let [dy, dx] = surface.grid().spacing();
    let is_unequal = !surface.grid().is_line() && (dy / dx - 1.0).abs() > UNEQUAL;
    is_unequal.then(|| {
        format!(
            "the spacing is {dy:.4e} along y (rows) and {dx:.4e} along x (columns): if that is not so, give --size as y,x"
        )
    })
}

/// Distances in a file that do not fit the size, of a file that does not say its units in none.
fn spacing_of_file(recipe: &Recipe, file: &HeightFile, surface: &Surface) -> Option<String> {
    let Layout { spacing, shape, is_in_metres, .. } = file.layout(recipe.channel.as_deref()).ok()?;
    let [_, told] = spacing?;
    let refined = surface.grid().shape()[1] / recipe.prepare.shape(shape).ok()?[1];
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

/// Heights that may have another unit than the size.
fn gradient(surface: &Surface) -> Option<String> {
    let gradient = surface.rms_gradient();
    (gradient > STEEPEST).then(|| format!("the rms gradient is {gradient:.3e}: give heights and size in the same unit"))
}
