//! Means of a study over its seeds, each with its scatter and the error of the grid.

use super::plan::Plan;
use super::point::Point;
use super::spread::Spread;
use crate::contact::{Observables, Quantity};
use serde::Serialize;

/// A mean over the seeds, with its errors, all in the unit of the quantity. A number that is not known is NaN.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SeedMean {
    /// Mean.
    pub mean: f64,
    /// Standard deviation of single realisations, of a sample; not known for a single one.
    pub standard_deviation: f64,
    /// Standard error of the mean; not known for a single realisation.
    pub standard_error: f64,
    /// Mean of the estimated errors of the grid. They have the same sign for all seeds, so that more seeds do not make it smaller.
    pub grid_error: f64,
    /// Number of realisations.
    pub count: usize,
}

impl SeedMean {
    /// The mean of values, each with the error of its grid.
    ///
    /// ```
    /// use asperity::study::SeedMean;
    /// let mean = SeedMean::from_values([(1.0, 0.1), (3.0, 0.3)]);
    /// assert_eq!((mean.mean, mean.standard_deviation, mean.standard_error, mean.count), (2.0, 2f64.sqrt(), 1.0, 2));
    /// assert_eq!((mean.grid_error, mean.bar()), (0.2, 2f64.sqrt() + 0.2));
    /// ```
    pub fn from_values(values: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let (values, errors): (Vec<f64>, Vec<f64>) = values.into_iter().unzip();
        let spread = Spread::from_values(values);
        Self {
            mean: spread.mean,
            standard_deviation: if spread.count > 1 { spread.deviation } else { f64::NAN },
            standard_error: spread.error(),
            grid_error: Spread::from_values(errors).mean,
            count: spread.count,
        }
    }

    /// The mean of values whose grid errors are not known.
    fn without_grid(values: impl IntoIterator<Item = f64>) -> Self {
        Self::from_values(values.into_iter().map(|value| (value, f64::NAN)))
    }

    /// Half the length of an error bar: the standard deviation plus the error of the grid, as far as they are known.
    pub fn bar(&self) -> f64 {
        [self.standard_deviation, self.grid_error].into_iter().filter(|error| error.is_finite()).sum()
    }
}

/// The means under one load, for one combination of values from the lists.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadMeans {
    /// The combination in words, without the seed.
    pub values: String,
    /// Number of the load, from 1.
    pub load_number: usize,
    /// Mean of the reduced pressures.
    pub reduced_pressure: f64,
    /// The relative area, of rows whose contact is resolved.
    pub relative_area: SeedMean,
    /// `kappa_r`, of rows whose contact is resolved.
    pub kappa_r: SeedMean,
}

/// The means of histories with adhesion, for one combination of values from the lists. Only those that were followed to their ends count.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AdhesionMeans {
    /// The combination in words, without the seed.
    pub values: String,
    /// The pull-off pressure.
    pub pull_off: SeedMean,
    /// Energy lost in jumps, of histories that did not part under the load.
    pub lost_in_jumps: SeedMean,
    /// The largest relative area.
    pub largest_area: SeedMean,
    /// The number of jumps.
    pub jumps: SeedMean,
    /// Number of histories whose surfaces parted.
    pub separated: usize,
}

/// The means of histories of a solid that yields below its surface, for one combination of values. Only those that converged count.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct YieldMeans {
    /// The combination in words, without the seed.
    pub values: String,
    /// The depth of the imprint, a length.
    pub imprint_depth: SeedMean,
    /// The energy that flow has taken up, per area.
    pub plastic_work: SeedMean,
    /// The largest accumulated plastic strain.
    pub max_plastic_strain: SeedMean,
    /// The largest relative area of the history.
    pub largest_area: SeedMean,
}

impl Plan {
    /// The means over the seeds of all `points` of a study of solids that yield below their surface, for one combination of values after the other.
    pub fn yield_means(&self, points: &[Point]) -> Vec<YieldMeans> {
        let seeds = self.seeds();
        let group = |(group, points): (usize, &[Point])| {
            let mean = |of: Quantity| {
                let converged = points.iter().filter(|point| point.is_converged());
                SeedMean::without_grid(converged.filter_map(|point| point.get(of)))
            };
            YieldMeans {
                values: self.words_but_seed(group * seeds),
                imprint_depth: mean(Quantity::ImprintDepth),
                plastic_work: mean(Quantity::PlasticWork),
                max_plastic_strain: mean(Quantity::MaxPlasticStrain),
                largest_area: mean(Quantity::LargestArea),
            }
        };
        points.chunks(seeds).enumerate().map(group).collect()
    }

    /// The means over the seeds of all `points` of a study without adhesion: load by load, for one combination of values after the other.
    pub fn means(&self, points: &[Point]) -> Vec<LoadMeans> {
        let (loads, seeds) = (self.loads().len(), self.seeds());
        let groups = points.chunks(loads * seeds).enumerate();
        let under = |(group, points, load): (usize, &[Point], usize)| {
            let found = || points.iter().skip(load).step_by(loads);
            LoadMeans {
                values: self.words_but_seed(group * seeds),
                load_number: load + 1,
                reduced_pressure: Spread::from_values(found().map(|it| it.observables.reduced_pressure)).mean,
                relative_area: resolved(found(), Point::relative_area, |it| it.relative_area_error),
                kappa_r: resolved(found(), Point::kappa_r, |it| it.kappa_r_error),
            }
        };
        groups.flat_map(|(group, points)| (0..loads).map(move |load| (group, points, load))).map(under).collect()
    }

    /// The means over the seeds of all `points` of a study with adhesion, for one combination of values after the other.
    pub fn adhesion_means(&self, points: &[Point]) -> Vec<AdhesionMeans> {
        let seeds = self.seeds();
        let group = |(group, points): (usize, &[Point])| {
            let mean = |of: fn(&Point) -> Option<f64>| {
                SeedMean::without_grid(points.iter().filter(|it| it.is_converged()).filter_map(of))
            };
            AdhesionMeans {
                values: self.words_but_seed(group * seeds),
                pull_off: mean(Point::pull_off),
                lost_in_jumps: mean(Point::lost),
                largest_area: mean(|it| it.get(Quantity::LargestArea)),
                jumps: mean(|it| it.get(Quantity::Jumps)),
                separated: points.iter().filter(|it| it.get(Quantity::Separated) == Some(1.0)).count(),
            }
        };
        points.chunks(seeds).enumerate().map(group).collect()
    }
}

/// The mean of a quantity of points that are resolved, with the relative error of their grid.
fn resolved<'a>(
    points: impl Iterator<Item = &'a Point>,
    value: fn(&Point) -> Option<f64>,
    error: fn(&Observables) -> f64,
) -> SeedMean {
    SeedMean::from_values(points.filter_map(|it| value(it).map(|value| (value, value * error(&it.observables)))))
}
