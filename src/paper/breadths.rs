//! Rough lines or surfaces whose spectra are equally broad in different ways.

use super::rough::{LINE, RMS_GRADIENT, ROLLOFF, SIDE, check_ascending};
use crate::contact::Load;
use crate::error::StudyError;
use crate::setup::{Cell, Recipe, Setup};
use crate::study::Realisation;
use crate::surface::Spectrum;

/// Points along a side are multiples of this, so that grids can be halved.
const MULTIPLE: usize = 32;
/// The largest ratio of roll-off and short cut-off that is searched.
const BROADEST: f64 = 1e6;

/// Rough lines or surfaces of given Nayak's parameters and Hurst exponents, each on several grids. The ratio of the roll-off and the
/// short cut-off follows from both. All lists ascend.
#[derive(Debug, Clone, PartialEq)]
pub struct Breadths {
    /// Lines, or else surfaces.
    pub is_line: bool,
    /// Hurst exponents.
    pub hurst: Vec<f64>,
    /// Nayak's parameters of the spectra; realisations scatter about them.
    pub nayak: Vec<f64>,
    /// Points per shortest wavelength on each grid, coarsest first, all multiples of the first.
    pub points_per_wave: Vec<usize>,
    /// Points along a side of the coarsest grid, at least. The cells of narrow spectra have more waves, so that as many patches are in
    /// contact.
    pub least: usize,
    /// Largest number of points along a side of the finest grid; spectra that need more are left out.
    pub largest: usize,
    /// Seeds on each grid; those of a finer one are among those of the coarser. With fewer lists than grids the last is that of all
    /// finer grids.
    pub seeds: Vec<Vec<u64>>,
    /// Reduced pressures, lightest first.
    pub loads: Vec<f64>,
}

/// The lines or surfaces of one spectrum.
pub(crate) struct Breadth {
    /// Nayak's parameter of the spectrum.
    pub nayak: f64,
    /// The spectrum.
    pub spectrum: Spectrum,
    /// Roll-off wavelengths along a side of the cell.
    pub waves: f64,
    /// Points along a side of each grid, coarsest first.
    pub points: Vec<usize>,
}

impl Breadths {
    /// All spectra that grids can carry, exponent by exponent, the narrowest first.
    pub(super) fn all(&self) -> Vec<Breadth> {
        let pairs = self.hurst.iter().flat_map(|&hurst| self.nayak.iter().map(move |&nayak| (hurst, nayak)));
        pairs.filter_map(|(hurst, nayak)| self.one(hurst, nayak)).collect()
    }

    fn one(&self, hurst: f64, nayak: f64) -> Option<Breadth> {
        let ratio = rolloff_over_cutoff(hurst, nayak, self.is_line)?;
        let first = *self.points_per_wave.first()?;
        let per_rolloff = ratio * first as f64;
        let fewest = if self.is_line { LINE } else { SIDE };
        let waves = (self.least as f64 / per_rolloff).floor().max(fewest);
        let coarsest = (waves * per_rolloff / MULTIPLE as f64).ceil() as usize * MULTIPLE;
        let points: Vec<usize> = self.points_per_wave.iter().map(|count| coarsest * (count / first)).collect();
        let short_cutoff = ROLLOFF / ratio;
        let spectrum = Spectrum { hurst, rolloff_wavelength: ROLLOFF, short_cutoff, rms_gradient: RMS_GRADIENT };
        points.last().is_some_and(|&points| points <= self.largest).then_some(Breadth {
            nayak,
            spectrum,
            waves,
            points,
        })
    }

    /// The realisations of all spectra, grid by grid, seed by seed.
    pub(super) fn realisations(&self) -> Vec<Realisation> {
        let grids = |it: &Breadth| (0..it.points.len()).flat_map(|grid| self.on(it, grid)).collect::<Vec<_>>();
        self.all().iter().flat_map(grids).collect()
    }

    /// The realisations of a spectrum on one of its grids.
    pub(super) fn on(&self, it: &Breadth, grid: usize) -> Vec<Realisation> {
        let (points, length) = (it.points[grid], it.waves * ROLLOFF);
        let cell = if self.is_line { Cell::line(points, length) } else { Cell::surface([points; 2], [length; 2]) };
        let heaviest = Load::ReducedPressure(self.loads.last().copied().unwrap_or(f64::NAN));
        let realisation = |&seed: &u64| Realisation {
            name: if self.is_line { "rough line" } else { "rough surface" }.into(),
            setup: Setup::new(Recipe::rough(it.spectrum, seed), cell.clone(), heaviest),
            loads: Realisation::reduced_pressures(&self.loads),
        };
        self.seeds.get(grid).or(self.seeds.last()).map_or(&[][..], Vec::as_slice).iter().map(realisation).collect()
    }

    /// Checks that there is something to solve, in the right order.
    pub(super) fn check(&self) -> Result<(), StudyError> {
        check_ascending("Hurst exponents", &self.hurst)?;
        check_ascending("Nayak's parameters", &self.nayak)?;
        check_ascending("points per wave", &self.points_per_wave)?;
        check_ascending("reduced pressures", &self.loads)?;
        if self.seeds.is_empty() {
            return Err(StudyError::List { what: "seeds", values: "[]".into() });
        }
        self.seeds.iter().try_for_each(|seeds| check_ascending("seeds", seeds))
    }
}

/// The ratio of roll-off and short cut-off at which a spectrum of the Hurst exponent `hurst` has Nayak's parameter `nayak`; none for
/// one narrower than the flat part of the spectrum alone.
fn rolloff_over_cutoff(hurst: f64, nayak: f64, is_line: bool) -> Option<f64> {
    let of = |log: f64| nayak_of_spectrum(hurst, log.exp(), is_line);
    let [mut low, mut high] = [0.0, BROADEST.ln()];
    if !(of(low) < nayak && nayak < of(high)) {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if of(middle) < nayak { &mut low } else { &mut high }) = middle;
    }
    Some(low.exp())
}

/// Nayak's parameter `m0 m4/m2^2` of a spectrum that is flat up to the roll-off `q_r`, and falls as the power `-(1 + 2H)` for lines and
/// `-2(1 + H)` for surfaces up to `ratio q_r`. With `q` in units of `q_r`,
///
/// ```text
/// lines      m_k = 1/(k + 1) + (ratio^(k - 2H) - 1)/(k - 2H)    alpha = m0 m4/m2^2
/// surfaces   m_k = 1/(k + 2) + (ratio^(k - 2H) - 1)/(k - 2H)    alpha = (3/2) m0 m4/m2^2
/// ```
///
/// The flat part begins at `q = 0` here. That of a cell begins at its longest wave, so that realisations have a slightly smaller
/// parameter.
fn nayak_of_spectrum(hurst: f64, ratio: f64, is_line: bool) -> f64 {
    let [dimension, scale] = if is_line { [1.0, 1.0] } else { [2.0, 1.5] };
    let moment = |k: f64| {
        let power = k - 2.0 * hurst;
        let steep = if power == 0.0 { ratio.ln() } else { (power * ratio.ln()).exp_m1() / power };
        1.0 / (k + dimension) + steep
    };
    scale * moment(0.0) * moment(4.0) / moment(2.0).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Spread;
    use crate::surface::SpectralMoments;

    fn breadths(is_line: bool) -> Breadths {
        Breadths {
            is_line,
            hurst: vec![0.3, 0.8],
            nayak: vec![4.0, 12.0, 1000.0],
            points_per_wave: vec![4, 8],
            least: 512,
            largest: 1 << 12,
            seeds: vec![(1..=12).collect()],
            loads: vec![0.1],
        }
    }

    #[test]
    fn spectra_of_two_exponents_have_the_same_breadth_and_realisations_have_it_too() {
        for is_line in [true, false] {
            let breadths = breadths(is_line);
            let all = breadths.all();
            // the broadest spectrum does not fit
            assert!(all.iter().all(|it| it.nayak < 100.0) && all.len() >= 3, "{is_line}");
            for it in all.iter().filter(|it| it.nayak == 4.0) {
                let nayak =
                    breadths.on(it, 0).into_iter().map(|it| SpectralMoments::new(&it.setup.surface().unwrap()).nayak());
                let Spread { mean, .. } = Spread::from_values(nayak);
                assert!((mean / it.nayak - 1.0).abs() < 0.1, "{is_line} {} {mean}", it.spectrum.hurst);
            }
        }
    }

    #[test]
    fn the_breadth_is_that_of_the_pure_power_law_when_the_ratio_is_large() {
        // without the flat part: M = (1-H)^2/(H(H-2)) (ratio^-2H - 1)(ratio^(4-2H) - 1)/(ratio^(2-2H) - 1)^2
        let (hurst, ratio) = (0.5f64, 1e5f64);
        let power = |exponent: f64| ratio.powf(exponent) - 1.0;
        let pure = (1.0 - hurst).powi(2) / (hurst * (hurst - 2.0)) * power(-2.0 * hurst) * power(4.0 - 2.0 * hurst)
            / power(2.0 - 2.0 * hurst).powi(2);
        // the flat part adds 1 and 1/2 to m0, which is 1/(2 H) = 1 without it
        assert!((nayak_of_spectrum(hurst, ratio, true) / (2.0 * pure) - 1.0).abs() < 1e-3);
        assert!((nayak_of_spectrum(hurst, ratio, false) / (1.5 * 1.5 * pure) - 1.0).abs() < 1e-3);
        assert!(rolloff_over_cutoff(0.5, 1.7, true).is_none() && rolloff_over_cutoff(0.5, 1.9, true).is_some());
        assert!((nayak_of_spectrum(1.0, 10.0, true) - nayak_of_spectrum(1.0 - 1e-9, 10.0, true)).abs() < 1e-6);
    }
}
