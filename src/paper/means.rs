//! Means of solved points over realisations.

use super::measure::{Measure, ObservableFn};
use crate::plot::Dot;
use crate::study::{Estimate, GridValues, Limit, Point, Spread};
use std::collections::BTreeMap;

/// Solved points, all converged, with a contact on their grid.
pub(crate) struct Points(pub Vec<Point>);

impl Points {
    /// The points of the realisations of a name.
    pub(crate) fn named(&self, name: &str) -> impl Iterator<Item = &Point> {
        self.0.iter().filter(move |row| row.name == name)
    }

    /// A quantity of the points of the realisations of a name.
    pub(crate) fn values(&self, name: &str, quantity: ObservableFn) -> impl Iterator<Item = f64> {
        self.named(name).map(move |row| quantity(&row.observables))
    }

    /// One dot per point of the realisations of a name.
    pub(crate) fn dots(&self, name: &str, x: ObservableFn, y: ObservableFn) -> impl Iterator<Item = Dot> {
        self.values(name, x).zip(self.values(name, y)).map(|(x, y)| Dot::at(x, y))
    }

    /// The points on the grid of `nx` points along x.
    pub(crate) fn on(&self, nx: usize) -> impl Iterator<Item = &Point> {
        self.0.iter().filter(move |row| row.nx == nx)
    }

    /// Points along x of the grids, coarsest first.
    pub(crate) fn grids(&self) -> Vec<usize> {
        let mut grids: Vec<usize> = self.0.iter().map(|row| row.nx).collect();
        grids.sort_unstable();
        grids.dedup();
        grids
    }

    /// Points along x of the finest grid.
    pub(crate) fn finest(&self) -> usize {
        self.0.iter().map(|row| row.nx).max().unwrap_or(0)
    }

    /// `quantity` at one Hurst exponent and load, over the realisations.
    pub(crate) fn at(&self, hurst: f64, load: f64, nx: usize, quantity: ObservableFn) -> Spread {
        let is_it = |row: &&Point| row.hurst == Some(hurst) && row.observables.reduced_pressure == load;
        Spread::from_values(self.on(nx).filter(is_it).map(|row| quantity(&row.observables)))
    }

    /// The loads, lightest first.
    pub(crate) fn loads(&self) -> Vec<f64> {
        let mut loads: Vec<f64> = self.0.iter().map(|row| row.observables.reduced_pressure).collect();
        loads.sort_unstable_by(f64::total_cmp);
        loads.dedup();
        loads
    }

    /// The points under some loads.
    pub(crate) fn under(mut self, loads: &[f64]) -> Self {
        self.0.retain(|row| loads.contains(&row.observables.reduced_pressure));
        self
    }

    /// The Hurst exponents, in their order.
    pub(crate) fn exponents(&self) -> Vec<f64> {
        let mut exponents: Vec<f64> = self.0.iter().filter_map(|row| row.hurst).collect();
        exponents.sort_unstable_by(f64::total_cmp);
        exponents.dedup();
        exponents
    }

    /// `quantity` on a grid, over the realisations: of one Hurst exponent, or averaged over all; averaged over the loads.
    pub(crate) fn average(&self, hurst: Option<f64>, nx: usize, quantity: ObservableFn) -> Estimate {
        Estimate::from_values(self.averages(hurst, None, nx, quantity).into_values())
    }

    /// How much larger `quantity` is at the second of two Hurst exponents than at the first, by pairs of the same seed, which
    /// share their random waves; averaged over the loads.
    pub(crate) fn contrast(&self, pair: [f64; 2], nx: usize, quantity: ObservableFn) -> Estimate {
        Estimate::from_values(self.contrasts(pair, None, nx, quantity).into_values())
    }

    /// A quantity of a measure as [`Points::average`] and under one load or averaged over all, extrapolated from the grids that
    /// there are to one of `nx` points along x, or to the continuum.
    pub(crate) fn limit(
        &self,
        hurst: Option<f64>,
        load: Option<f64>,
        nx: Option<usize>,
        measure: Measure,
        quantity: ObservableFn,
    ) -> Estimate {
        self.extrapolated(nx, measure, |nx| self.averages(hurst, load, nx, quantity))
    }

    /// The contrast of two Hurst exponents in the continuum, under one load or averaged over all.
    pub(crate) fn limit_of_contrast(
        &self,
        pair: [f64; 2],
        load: Option<f64>,
        measure: Measure,
        quantity: ObservableFn,
    ) -> Estimate {
        self.extrapolated(None, measure, |nx| self.contrasts(pair, load, nx, quantity))
    }

    /// The contrast of two Hurst exponents in the continuum, averaged over the loads by the inverse squares of their errors. The
    /// error is that of these averages, seed by seed: loads of one profile are not independent.
    pub(crate) fn mean_contrast(&self, pair: [f64; 2], measure: Measure, quantity: ObservableFn) -> Estimate {
        let weight = |load: &f64| {
            let weight = self.limit_of_contrast(pair, Some(*load), measure, quantity).uncertainty().powi(-2);
            (*load, if weight.is_finite() { weight } else { 0.0 })
        };
        let weights: Vec<(f64, f64)> = self.loads().iter().map(weight).collect();
        let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
        self.extrapolated(None, measure, |nx| {
            let mut means = BTreeMap::new();
            for (load, weight) in &weights {
                for (seed, value) in self.contrasts(pair, Some(*load), nx, quantity) {
                    *means.entry(seed).or_insert(0.0) += weight / sum * value;
                }
            }
            means
        })
    }

    /// Values of a measure on each grid, by their seeds, extrapolated.
    fn extrapolated(
        &self,
        nx: Option<usize>,
        measure: Measure,
        values: impl Fn(usize) -> BTreeMap<u64, f64>,
    ) -> Estimate {
        let spacing = |nx: usize| 1.0 / nx as f64;
        let grid = |nx| GridValues { spacing: spacing(nx), values: values(nx) };
        let grids: Vec<GridValues> = self.grids().into_iter().map(grid).collect();
        Limit { order: measure.order(), spacing: nx.map_or(0.0, spacing) }.extrapolate(&grids)
    }

    /// `quantity` under one load or averaged over all, at one Hurst exponent or averaged over all, by the seeds.
    ///
    /// The surfaces of one seed share their random waves, so that those of several Hurst exponents are not independent: only the
    /// averages over them, seed by seed, are.
    fn averages(&self, hurst: Option<f64>, load: Option<f64>, nx: usize, quantity: ObservableFn) -> BTreeMap<u64, f64> {
        let is_asked = |row: &&Point| {
            hurst.is_none_or(|hurst| row.hurst == Some(hurst))
                && load.is_none_or(|load| row.observables.reduced_pressure == load)
        };
        let mut values: BTreeMap<u64, Vec<f64>> = BTreeMap::new();
        for row in self.on(nx).filter(is_asked) {
            values.entry(row.seed.unwrap_or_default()).or_default().push(quantity(&row.observables));
        }
        // a seed some of whose points are left out would be an average over others
        let whole = values.values().map(Vec::len).max().unwrap_or(0);
        let values = values.into_iter().filter(|(_, values)| values.len() == whole);
        values.map(|(seed, values)| (seed, Spread::from_values(values).mean)).collect()
    }

    fn contrasts(&self, pair: [f64; 2], load: Option<f64>, nx: usize, quantity: ObservableFn) -> BTreeMap<u64, f64> {
        let [first, second] = pair.map(|hurst| self.averages(Some(hurst), load, nx, quantity));
        second.into_iter().filter_map(|(seed, value)| Some((seed, value - first.get(&seed)?))).collect()
    }

    /// The points of each realisation on a grid.
    pub(crate) fn realisations(&self, nx: usize) -> Vec<Vec<&Point>> {
        let mut groups: Vec<Vec<&Point>> = Vec::new();
        for row in self.on(nx) {
            match groups.last_mut() {
                Some(group) if (group[0].hurst, group[0].seed) == (row.hurst, row.seed) => group.push(row),
                _ => groups.push(vec![row]),
            }
        }
        groups
    }

    /// One dot per load, on the finest grid: the means of `x` and `y`, with the scatter of `y`.
    pub(crate) fn curve(&self, hurst: f64, loads: &[f64], [x, y]: [ObservableFn; 2]) -> Vec<Dot> {
        let nx = self.finest();
        let dot = |&load: &f64| {
            let (x, y) = (self.at(hurst, load, nx, x), self.at(hurst, load, nx, y));
            Dot { x: x.mean, y: y.mean, spread: y.deviation }
        };
        loads.iter().map(dot).collect()
    }

    /// The mean of a quantity under each load, on the finest grid.
    pub(crate) fn along(&self, hurst: f64, loads: &[f64], quantity: ObservableFn) -> Vec<f64> {
        loads.iter().map(|&load| self.at(hurst, load, self.finest(), quantity).mean).collect()
    }

    /// A number that is computed of all points by counting nodes, such as the range of a quantity, with its errors.
    ///
    /// The standard error is found by leaving out one seed after the other (the jackknife): such a number is no mean, so that its scatter from seed
    /// to seed is not known. The error of the grid is the distance from the same number with resolved edges, whose own error is of second order.
    pub(crate) fn counted(&self, number: impl Fn(&Self, Measure) -> f64) -> Estimate {
        let mut seeds: Vec<Option<u64>> = self.0.iter().map(|row| row.seed).collect();
        seeds.sort_unstable();
        seeds.dedup();
        let without = |seed: &Option<u64>| {
            let rest = Self(self.0.iter().filter(|row| row.seed != *seed).cloned().collect());
            number(&rest, Measure::Counted)
        };
        let (count, mean) = (seeds.len() as f64, number(self, Measure::Counted));
        let Spread { deviation: scatter, .. } = Spread::from_values(seeds.iter().map(without));
        let error = if seeds.len() > 1 { scatter * (count - 1.0) / count.sqrt() } else { f64::NAN };
        Estimate { mean, error, grid: (mean - number(self, Measure::Resolved)).abs(), scatter: error * count.sqrt() }
    }

    /// Means over the realisations of each grid, Hurst exponent and load.
    pub(crate) fn means(&self) -> Vec<Mean> {
        let mut means: Vec<Mean> = Vec::new();
        for Point { nx, hurst, observables, .. } in &self.0 {
            let (hurst, load) = (hurst.unwrap_or(f64::NAN), observables.reduced_pressure);
            if !means.iter().any(|mean| (mean.nx, mean.hurst, mean.reduced_pressure) == (*nx, hurst, load)) {
                means.push(Mean::new(self, *nx, hurst, load));
            }
        }
        means
    }
}

/// Means over realisations with their standard deviations.
#[derive(serde::Serialize)]
pub(crate) struct Mean {
    nx: usize,
    hurst: f64,
    reduced_pressure: f64,
    realisations: usize,
    reduced_pressure_contact: f64,
    reduced_pressure_contact_counted: f64,
    relative_area: f64,
    relative_area_deviation: f64,
    relative_area_counted: f64,
    relative_area_counted_deviation: f64,
    relative_area_corrected: f64,
    kappa: f64,
    kappa_deviation: f64,
    kappa_counted: f64,
    kappa_counted_deviation: f64,
    kappa_corrected: f64,
    kappa_r: f64,
    kappa_r_deviation: f64,
    kappa_r_counted: f64,
    kappa_r_counted_deviation: f64,
    kappa_r_corrected: f64,
}

impl Mean {
    fn new(points: &Points, nx: usize, hurst: f64, reduced_pressure: f64) -> Self {
        let of = |quantity| points.at(hurst, reduced_pressure, nx, quantity);
        let [pressure_counted, pressure] = Measure::ALL.map(|it| of(it.reduced_pressure_contact()));
        let [area_counted, area] = Measure::ALL.map(|it| of(it.area()));
        let [kappa_counted, kappa] = Measure::ALL.map(|it| of(it.kappa()));
        let [kappa_r_counted, kappa_r] = Measure::ALL.map(|it| of(it.kappa_r()));
        Self {
            nx,
            hurst,
            reduced_pressure,
            realisations: area.count,
            reduced_pressure_contact: pressure.mean,
            reduced_pressure_contact_counted: pressure_counted.mean,
            relative_area: area.mean,
            relative_area_deviation: area.deviation,
            relative_area_counted: area_counted.mean,
            relative_area_counted_deviation: area_counted.deviation,
            relative_area_corrected: of(|it| it.relative_area_corrected).mean,
            kappa: kappa.mean,
            kappa_deviation: kappa.deviation,
            kappa_counted: kappa_counted.mean,
            kappa_counted_deviation: kappa_counted.deviation,
            kappa_corrected: of(|it| it.kappa_corrected).mean,
            kappa_r: kappa_r.mean,
            kappa_r_deviation: kappa_r.deviation,
            kappa_r_counted: kappa_r_counted.mean,
            kappa_r_counted_deviation: kappa_r_counted.deviation,
            kappa_r_corrected: of(|it| it.kappa_r_corrected).mean,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Observables, Status};

    /// `kappa_r` is 1.7, more by 0.02 at the higher exponent, scatters from seed to seed in both alike, and is off by the square of
    /// the spacing.
    fn points() -> Points {
        let mut all = Vec::new();
        for nx in [64, 128, 256] {
            for i in 0..18 {
                let (hurst, seed, load) = ([0.2, 0.8][i % 2], i as u64 / 2 % 3, [0.01, 0.03, 0.1_f64][i / 6]);
                let (high, scatter) = (if hurst > 0.5 { 0.02 } else { 0.0 }, 0.05 * seed as f64 / load.sqrt());
                let own = if seed == 1 && hurst > 0.5 { 0.001 / load } else { 0.0 };
                let kappa_r = 1.7 + high + scatter + own + 50.0 / (nx * nx) as f64;
                let observables = Observables { reduced_pressure: load, kappa_r, ..Observables::default() };
                all.push(Point {
                    name: "rough line".into(),
                    ny: 1,
                    nx,
                    length: 1.0,
                    hurst: Some(hurst),
                    rolloff_wavelength: None,
                    short_cutoff: None,
                    seed: Some(seed),
                    load: 1,
                    tolerance: 1e-8,
                    status: Status::Converged,
                    setup: String::new(),
                    version: String::new(),
                    observables,
                    further: Vec::new(),
                    seconds: 0.0,
                });
            }
        }
        Points(all)
    }

    #[test]
    fn pairs_of_the_same_seed_show_what_their_scatter_hides() {
        let (points, measure) = (points(), Measure::Resolved);
        let kappa_r = measure.kappa_r();
        let [low, high] = [0.2, 0.8].map(|hurst| points.limit(Some(hurst), Some(0.1), None, measure, kappa_r));
        assert!(high.mean - low.mean < 2.0 * high.error, "{low:?} {high:?}");
        let apart = points.limit_of_contrast([0.2, 0.8], Some(0.1), measure, kappa_r);
        assert!((apart.mean - 0.02 - 0.01 / 3.0).abs() < 1e-12 && apart.mean > 5.0 * apart.uncertainty(), "{apart:?}");
        // the heaviest load is known best, and weighs most
        let all = points.mean_contrast([0.2, 0.8], measure, kappa_r);
        assert!(all.error < 1.5 * apart.error && (all.mean - apart.mean).abs() < 0.01, "{all:?}");
    }

    #[test]
    fn exponents_are_averaged_seed_by_seed() {
        let (points, kappa_r) = (points(), Measure::Resolved.kappa_r());
        let one = points.average(Some(0.2), 256, kappa_r);
        let all = points.average(None, 256, kappa_r);
        // as they share their scatter, a second exponent does not make the error smaller by the square root of two
        assert!(all.error > 0.95 * one.error, "{one:?} {all:?}");
    }
}
