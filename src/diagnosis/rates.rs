//! The convergence rates of the waves of each band, and the slowest band.

use super::spectrogram::{Spectrogram, SpectrogramRow};
use crate::contact::Relaxation;
use serde::Serialize;

/// The relaxation of the waves of a band on the finest grid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BandRate {
    /// The longest and the shortest wavelength.
    pub wavelengths: [f64; 2],
    /// Share of the steps in which the largest part of the energy of the error was theirs.
    pub share: f64,
    /// Digits that their error lost in a step in the later half of the run, if it has a later half.
    pub rate: Option<f64>,
    /// Digits that free waves of theirs lose in a step, where theory says.
    pub theory: Option<f64>,
}

impl BandRate {
    /// The rates of all bands, from the longest waves on; none without a reference.
    pub(super) fn all(spectrogram: &Spectrogram, relaxation: Option<Relaxation>) -> Vec<Self> {
        let of_finest = |row: &&SpectrogramRow| row.level == 0 && !row.error_energy.is_empty();
        let rows: Vec<&SpectrogramRow> = spectrogram.history().columns().iter().filter(of_finest).collect();
        if rows.is_empty() {
            return Vec::new();
        }
        let bands = spectrogram.bands();
        let mut slowest = vec![0usize; bands.count()];
        rows.iter().filter_map(|row| worst(row)).for_each(|band| slowest[band] += 1);
        let rate_of = |band: usize| Self {
            wavelengths: bands.wavelengths(band),
            share: slowest[band] as f64 / rows.len() as f64,
            rate: rate(&rows, band),
            theory: relaxation.map(|it| it.decades_per_step(spectrogram.stiffness(band))),
        };
        (0..bands.count()).map(rate_of).collect()
    }
}

/// The band with the largest part of the error.
fn worst(row: &SpectrogramRow) -> Option<usize> {
    (0..row.error_energy.len()).max_by(|&a, &b| row.error_energy[a].total_cmp(&row.error_energy[b]))
}

/// Digits that the error of a band lost in a step, in the later half of the run before the last tenth, in which the reference itself
/// is no better.
fn rate(rows: &[&SpectrogramRow], band: usize) -> Option<f64> {
    let (from, to) = (rows[rows.len() / 2], rows[rows.len() * 9 / 10]);
    let fall = 0.5 * (from.error_energy[band] / to.error_energy[band]).log10();
    (to.step > from.step && fall.is_finite()).then(|| fall / (to.step - from.step) as f64)
}
