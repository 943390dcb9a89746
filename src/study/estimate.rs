//! A mean with all of its errors.

use super::spread::Spread;

/// A mean, its standard errors, and the scatter of single realisations, from which follows the error of another sample.
///
/// ```
/// use asperity::study::Estimate;
/// let [low, high] = [[1.0, 1.2, 1.1], [2.0, 2.2, 2.1]].map(Estimate::of);
/// let mean = Estimate::mean_of(&[low, high]);
/// // two groups that differ by 1 do not scatter by 1: each has its own error
/// assert!((mean.mean - 1.6).abs() < 1e-12 && (mean.scatter - 0.1 / 2f64.sqrt()).abs() < 1e-12);
/// assert!((mean.error - mean.scatter / 3f64.sqrt()).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Mean.
    pub mean: f64,
    /// Standard error of the mean over realisations.
    pub error: f64,
    /// Error of the grid: of an extrapolation in its spacing, or of a measure that is not extrapolated.
    pub grid: f64,
    /// Standard deviation of one realisation; of one of each group for a mean of groups.
    pub scatter: f64,
}

impl Estimate {
    /// The mean of `values` of independent realisations.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let spread = Spread::of(values);
        Self { mean: spread.mean, error: spread.error(), grid: 0.0, scatter: spread.deviation }
    }

    /// A number without errors.
    pub fn exact(mean: f64) -> Self {
        Self { mean, error: 0.0, grid: 0.0, scatter: 0.0 }
    }

    /// The mean of groups that are independent of each other, each with its own mean. Errors of the grid are taken to be of one
    /// sign, and do not average out.
    pub fn mean_of(groups: &[Self]) -> Self {
        let count = groups.len() as f64;
        let mean = |of: fn(&Self) -> f64| groups.iter().map(of).sum::<f64>() / count;
        let squares = |of: fn(&Self) -> f64| groups.iter().map(|group| of(group).powi(2)).sum::<f64>().sqrt() / count;
        Self {
            mean: mean(|group| group.mean),
            error: squares(|group| group.error),
            grid: mean(|group| group.grid),
            scatter: squares(|group| group.scatter),
        }
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
