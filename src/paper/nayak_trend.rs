//! The solved points of spectra of several breadths, and how they differ.

use super::breadths::{Breadth, Breadths};
use super::means::Points;
use super::measure::{Measure, ObservableFn};
use crate::error::SetupError;
use crate::study::{Estimate, GridValues, Limit, Point, Realisation, Spread};
use crate::surface::SpectralMoments;
use std::collections::BTreeMap;

/// The solved points of one spectrum.
pub(crate) struct SolvedBreadth {
    /// Hurst exponent.
    pub hurst: f64,
    /// Nayak's parameter of the spectrum.
    pub wanted: f64,
    /// Nayak's parameter of the realisations.
    pub nayak: Spread,
    /// Shortest wavelength over the roll-off.
    pub cutoff: f64,
    /// Roll-off wavelengths along a side of the cell.
    pub waves: f64,
    /// Points along a side of each grid, coarsest first.
    pub grids: Vec<usize>,
    /// Points per shortest wavelength on each grid.
    points_per_wave: Vec<usize>,
    points: Points,
}

impl SolvedBreadth {
    fn new(breadths: &Breadths, it: Breadth, points: &Points) -> Result<Self, SetupError> {
        let Breadth { nayak, spectrum, waves, points: grids } = &it;
        let is_it = |row: &&Point| {
            (row.ny == 1) == breadths.is_line
                && row.hurst == Some(spectrum.hurst)
                && row.short_cutoff == Some(spectrum.short_cutoff)
        };
        // the waves of the coarsest grid are those of all grids
        let of = |it: Realisation| Ok(SpectralMoments::new(&it.setup.surface()?).nayak());
        let realised = breadths.on(&it, 0).into_iter().map(of).collect::<Result<Vec<f64>, SetupError>>()?;
        Ok(Self {
            hurst: spectrum.hurst,
            wanted: *nayak,
            nayak: Spread::from_values(realised),
            cutoff: spectrum.short_cutoff / spectrum.rolloff_wavelength,
            waves: *waves,
            grids: grids.clone(),
            points_per_wave: breadths.points_per_wave.clone(),
            points: Points(points.0.iter().filter(is_it).cloned().collect()),
        })
    }

    /// A quantity under a load on one of the grids, by the seeds.
    fn values(&self, grid: usize, load: f64, quantity: ObservableFn) -> BTreeMap<u64, f64> {
        let under = self.points.on(self.grids[grid]).filter(|row| row.observables.reduced_pressure == load);
        under.map(|row| (row.seed.unwrap_or_default(), quantity(&row.observables))).collect()
    }

    /// A quantity under a load in the continuum.
    pub(crate) fn limit(&self, load: f64, quantity: ObservableFn) -> Estimate {
        weighted(&[(1.0, self)], load, quantity)
    }
}

/// A sum over spectra of a quantity under a load, each with its weight, in the continuum.
///
/// Surfaces of one seed and equally large cells share their waves. So sums are taken seed by seed on each grid first, and their errors are those of the sums.
fn weighted(terms: &[(f64, &SolvedBreadth)], load: f64, quantity: ObservableFn) -> Estimate {
    let Some((_, first)) = terms.first() else { return Estimate::exact(f64::NAN) };
    let on_grid = |(grid, &points): (usize, &usize)| {
        let each: Vec<_> = terms.iter().map(|(weight, it)| (weight, it.values(grid, load, quantity))).collect();
        let sum =
            |seed: &u64| each.iter().map(|(weight, values)| Some(*weight * values.get(seed)?)).sum::<Option<f64>>();
        let seeds = each[0].1.keys().filter_map(|seed| Some((*seed, sum(seed)?)));
        GridValues { spacing: 1.0 / points as f64, values: seeds.collect() }
    };
    let grids: Vec<GridValues> = first.points_per_wave.iter().enumerate().map(on_grid).collect();
    Limit { order: Measure::Resolved.order(), spacing: 0.0 }.extrapolate(&grids)
}

/// The lines, or else the surfaces, of all spectra.
pub(crate) struct SolvedBreadths<'a> {
    /// What was asked for.
    pub breadths: &'a Breadths,
    /// The spectra, exponent by exponent, the narrowest first.
    pub all: Vec<SolvedBreadth>,
}

/// A change of a quantity from spectrum to spectrum under one load, in per cent of its mean.
pub(crate) struct BreadthTrend {
    /// The change in per cent.
    pub percent: Estimate,
    /// Nayak's parameters from and to, as the realisations have them.
    pub between: [f64; 2],
}

impl BreadthTrend {
    /// The change over its error.
    pub(crate) fn sigma(&self) -> f64 {
        self.percent.mean / self.percent.uncertainty()
    }

    fn new(terms: &[(f64, &SolvedBreadth)], load: f64, quantity: ObservableFn) -> Self {
        let [sum, mean] = [
            weighted(terms, load, quantity),
            weighted(&terms.iter().map(|(_, it)| (1.0 / terms.len() as f64, *it)).collect::<Vec<_>>(), load, quantity),
        ];
        let percent = sum.times(100.0 / mean.mean);
        let nayak = || terms.iter().map(|(_, it)| it.nayak.mean);
        let between = [nayak().fold(f64::INFINITY, f64::min), nayak().fold(0.0, f64::max)];
        Self { percent, between }
    }
}

impl<'a> SolvedBreadths<'a> {
    /// The solved `points` of the spectra of `breadths`.
    ///
    /// # Errors
    /// For surfaces that cannot be.
    pub(crate) fn new(breadths: &'a Breadths, points: &Points) -> Result<Self, SetupError> {
        let all = breadths.all().into_iter().map(|it| SolvedBreadth::new(breadths, it, points));
        Ok(Self { breadths, all: all.collect::<Result<_, _>>()? })
    }

    /// `line` or `surface`.
    pub(crate) fn name(&self) -> &'static str {
        if self.breadths.is_line { "line" } else { "surface" }
    }

    /// The spectra of a Hurst exponent.
    pub(crate) fn at_hurst(&self, hurst: f64) -> impl Iterator<Item = &SolvedBreadth> {
        self.all.iter().filter(move |it| it.hurst == hurst)
    }

    /// The change of a quantity per decade of Nayak's parameter at a Hurst exponent: the slope of the straight line of least squares
    /// in its logarithm, seed by seed. None with fewer than two spectra.
    pub(crate) fn per_decade(&self, hurst: f64, load: f64, quantity: ObservableFn) -> Option<BreadthTrend> {
        let all: Vec<&SolvedBreadth> = self.at_hurst(hurst).collect();
        let place = |it: &&SolvedBreadth| it.nayak.mean.log10();
        let mean = all.iter().map(place).sum::<f64>() / all.len() as f64;
        let square = all.iter().map(|it| (place(it) - mean).powi(2)).sum::<f64>();
        let terms: Vec<_> = all.iter().map(|it| ((place(it) - mean) / square, *it)).collect();
        (terms.len() > 1).then(|| BreadthTrend::new(&terms, load, quantity))
    }

    /// How much larger a quantity is at the highest Hurst exponent than at the lowest, at equal Nayak's parameters of the spectra: the
    /// mean over all parameters that both have, seed by seed. None without such.
    pub(crate) fn at_equal_nayak(&self, load: f64, quantity: ObservableFn) -> Option<BreadthTrend> {
        let [lowest, highest] = self.ends()?;
        let pairs = self.at_hurst(lowest).flat_map(|low| {
            self.at_hurst(highest).filter(|high| high.wanted == low.wanted).map(move |high| [low, high])
        });
        let pairs: Vec<[&SolvedBreadth; 2]> = pairs.collect();
        let share = 1.0 / pairs.len() as f64;
        let terms: Vec<_> = pairs.into_iter().flat_map(|[low, high]| [(-share, low), (share, high)]).collect();
        (!terms.is_empty()).then(|| BreadthTrend::new(&terms, load, quantity))
    }

    /// The lowest and the highest Hurst exponent, if there are two.
    pub(crate) fn ends(&self) -> Option<[f64; 2]> {
        match self.breadths.hurst.as_slice() {
            [first, .., last] => Some([*first, *last]),
            _ => None,
        }
    }
}
