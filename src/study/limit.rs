//! The limit of a quantity on successively finer grids, with its error.

use super::estimate::Estimate;
use super::spread::Spread;
use std::collections::BTreeMap;

/// Largest number of grids of an extrapolation, which uses the finest ones.
const GRIDS: usize = 3;

/// The values of a quantity on one grid, by the realisations.
#[derive(Debug, Clone, PartialEq)]
pub struct GridValues {
    /// Spacing of the grid, in any unit.
    pub spacing: f64,
    /// The value of each realisation, by its seed.
    pub values: BTreeMap<u64, f64>,
}

/// The order of the error of a quantity in the spacing of the grid: it is a series in `spacing^order`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Power of the spacing: 1 for counted nodes, 2 for edges between the nodes.
    pub order: i32,
    /// The spacing of the target grid; 0 for the continuum.
    pub spacing: f64,
}

impl Limit {
    /// The quantity on the target grid, from those on some `grids`, coarsest first: by the polynomial in
    /// `spacing^order` through the finest three.
    ///
    /// The means over realisations are taken grid by grid of the difference from the coarser one, which scatters far less than
    /// the quantity, so that a finer grid needs fewer realisations, and those of each must be among those of the coarser one.
    /// The error of the grid is the difference from the polynomial of one degree less, through the grids but the coarsest.
    ///
    /// ```
    /// use asperity::study::{GridValues, Limit};
    /// let value = |spacing: f64, seed: u64| (seed, 1.7 + 0.01 * seed as f64 + 2.0 * spacing + 3.0 * spacing * spacing);
    /// let grid = |spacing, seeds: std::ops::Range<u64>| GridValues {
    ///     spacing,
    ///     values: seeds.map(|seed| value(spacing, seed)).collect(),
    /// };
    /// let grids = [grid(0.04, 0..5), grid(0.02, 0..3), grid(0.01, 0..2)];
    /// let found = Limit { order: 1, spacing: 0.0 }.extrapolate(&grids);
    /// assert!((found.mean - 1.72).abs() < 1e-12 && (found.scatter - 0.0158).abs() < 1e-4);
    /// // the line through the finest two is off by the quadratic term
    /// assert!((found.grid - 3.0 * 0.02 * 0.01).abs() < 1e-12);
    /// ```
    pub fn extrapolate(&self, grids: &[GridValues]) -> Estimate {
        let grids = &grids[grids.len().saturating_sub(GRIDS)..];
        let Some(coarsest) = grids.first() else { return Estimate::exact(f64::NAN) };
        let spread = Spread::from_values(coarsest.values.values().copied());
        let finer: Vec<Spread> = grids.windows(2).map(|pair| differences(&pair[0], &pair[1])).collect();
        let [all, fewer] = [0, 1].map(|skipped| self.shares(grids, skipped));
        let sum =
            |shares: &[f64]| spread.mean + finer.iter().zip(shares).map(|(it, share)| share * it.mean).sum::<f64>();
        let squares = finer.iter().zip(&all).map(|(it, share)| (share * it.error()).powi(2)).sum::<f64>();
        let grid = if finer.is_empty() { 0.0 } else { (sum(&all) - sum(&fewer)).abs() };
        Estimate { mean: sum(&all), error: spread.error().hypot(squares.sqrt()), grid, scatter: spread.deviation }
    }

    /// The share with which each difference from a grid to the next finer one enters, if the polynomial leaves out the `skipped`
    /// coarsest grids.
    fn shares(&self, grids: &[GridValues], skipped: usize) -> Vec<f64> {
        let skipped = skipped.min(grids.len() - 1);
        let places: Vec<f64> = grids[skipped..].iter().map(|grid| grid.spacing.powi(self.order)).collect();
        let weights = lagrange(&places, self.spacing.powi(self.order));
        let weights: Vec<f64> = std::iter::repeat_n(0.0, skipped).chain(weights).collect();
        (1..grids.len()).map(|i| weights[i..].iter().sum()).collect()
    }
}

/// How much larger the values are on the finer of two grids, over the realisations that are on both.
fn differences(coarse: &GridValues, fine: &GridValues) -> Spread {
    let difference = |(seed, value): (&u64, &f64)| Some(value - coarse.values.get(seed)?);
    Spread::from_values(fine.values.iter().filter_map(difference))
}

/// The weights of values at `places` in the value at `x` of the polynomial through them.
fn lagrange(places: &[f64], x: f64) -> Vec<f64> {
    let weight = |&own: &f64| {
        let others = places.iter().filter(|&&other| other != own);
        others.map(|other| (x - other) / (own - other)).product()
    };
    places.iter().map(weight).collect()
}
