//! A mean with all of its errors.

use super::spread::Spread;

/// A mean, its standard errors, and the standard deviation of single realisations, from which the error of another
/// sample follows.
///
/// ```
/// use asperity::study::Estimate;
/// let [lines, surfaces] = [[1.6, 1.8, 1.7], [1.8, 2.0, 1.9]].map(Estimate::from_values);
/// assert!((lines.mean - 1.7).abs() < 1e-12 && (lines.error - 0.1 / 3f64.sqrt()).abs() < 1e-12);
/// let ratio = lines.over(surfaces);
/// assert!((ratio.error / ratio.mean - (lines.error / 1.7).hypot(surfaces.error / 1.9)).abs() < 1e-12);
/// assert!(Estimate::from_values([1.7]).error.is_nan());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Mean.
    pub mean: f64,
    /// Standard error of the mean over realisations.
    pub error: f64,
    /// Error of the grid: of an extrapolation in its spacing, or of a measure that is not extrapolated.
    pub grid: f64,
    /// Standard deviation of one realisation.
    pub scatter: f64,
}

impl Estimate {
    /// The mean of `values` of independent realisations.
    pub fn from_values(values: impl IntoIterator<Item = f64>) -> Self {
        let spread = Spread::from_values(values);
        Self { mean: spread.mean, error: spread.error(), grid: 0.0, scatter: spread.deviation }
    }

    /// A number without errors.
    pub fn exact(mean: f64) -> Self {
        Self { mean, error: 0.0, grid: 0.0, scatter: 0.0 }
    }

    /// The mean in another unit, such as per cent.
    pub fn times(self, factor: f64) -> Self {
        let [error, grid, scatter] = [self.error, self.grid, self.scatter].map(|it| factor.abs() * it);
        Self { mean: factor * self.mean, error, grid, scatter }
    }

    /// The quotient of two independent means.
    pub fn over(self, other: Self) -> Self {
        let mean = self.mean / other.mean;
        let both = |of: fn(&Self) -> f64| mean.abs() * (of(&self) / self.mean).hypot(of(&other) / other.mean);
        Self { mean, error: both(|it| it.error), grid: both(|it| it.grid), scatter: both(|it| it.scatter) }
    }

    /// Both errors together.
    pub fn uncertainty(&self) -> f64 {
        self.error.hypot(self.grid)
    }
}
