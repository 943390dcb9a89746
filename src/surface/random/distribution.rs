//! Distributions of heights.

use super::johnson::Johnson;
use super::rank_map::ExactPart;
use crate::error::{FileError, RoughnessError, SurfaceError};
use crate::formats::HeightFile;
use statrs::distribution::{Beta, ContinuousCDF, Normal};

/// The most corrections of a distribution for the steps of probability that there are, and the sum of the error of the skewness and the relative
/// one of the kurtosis at which they end.
const CORRECTIONS: usize = 12;
const CLOSE: f64 = 1e-4;

/// The distribution of the heights of a surface, up to their mean and their rms value.
#[derive(Debug, Clone, PartialEq)]
pub enum HeightDistribution {
    /// One of Johnson's system that has this skewness and this kurtosis (3 for Gaussian heights).
    Moments {
        /// `<z^3> / <z^2>^(3/2)`.
        skewness: f64,
        /// `<z^4> / <z^2>^2`, above `skewness^2 + 1`.
        kurtosis: f64,
    },
    /// Weibull's, `1 - exp(-x^shape)`, with a long tail upwards for small shapes.
    Weibull {
        /// The shape, above 0.
        shape: f64,
    },
    /// The beta distribution, with the density `x^(a-1) (1-x)^(b-1)` from 0 to 1.
    Beta {
        /// `a` and `b`, above 0.
        shapes: [f64; 2],
    },
    /// That of the heights in a file, such as those of a measured map.
    Like(HeightFile),
}

/// A distribution of heights, and what is exact.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetHeights {
    /// The distribution.
    pub distribution: HeightDistribution,
    /// What is exact where both cannot be.
    pub exact: ExactPart,
}

impl HeightDistribution {
    /// Checks the parameters.
    pub(super) fn check(&self) -> Result<(), SurfaceError> {
        let positive = |name: &'static str, value: f64| match value.is_finite() && value > 0.0 {
            true => Ok(()),
            false => Err(SurfaceError::NotPositive { name, value }),
        };
        match *self {
            Self::Moments { skewness, kurtosis } => {
                let least = skewness * skewness + 1.0;
                let is_possible = skewness.is_finite() && kurtosis.is_finite() && kurtosis > least;
                let found = is_possible.then(|| Johnson::from_moments(skewness, kurtosis)).flatten();
                match (is_possible, found) {
                    (false, _) => Err(SurfaceError::Kurtosis { skewness, kurtosis, least }),
                    (true, None) => Err(SurfaceError::ExtremeHeights { skewness, kurtosis }),
                    (true, Some(_)) => Ok(()),
                }
            }
            Self::Weibull { shape } => positive("the shape of Weibull's distribution", shape),
            Self::Beta { shapes } => {
                shapes.iter().try_for_each(|&shape| positive("a shape of the beta distribution", shape))
            }
            Self::Like(_) => Ok(()),
        }
    }

    /// Heights of this distribution at `count` equal steps of probability: ascending, of mean 0 and mean square 1.
    ///
    /// # Errors
    /// For parameters that are refused, and a file that cannot be read, has voids or is flat.
    pub(super) fn quantiles(&self, count: usize) -> Result<Vec<f64>, RoughnessError> {
        self.check()?;
        let at = |of: &dyn Fn(f64) -> f64| (0..count).map(|i| of((i as f64 + 0.5) / count as f64)).collect();
        let values: Vec<f64> = match self {
            &Self::Moments { skewness, kurtosis } => return johnson_quantiles([skewness, kurtosis], count),
            &Self::Weibull { shape } => at(&|probability| (-(-probability).ln_1p()).powf(shape.recip())),
            &Self::Beta { shapes: [a, b] } => {
                let beta = Beta::new(a, b);
                let beta =
                    beta.map_err(|_| SurfaceError::NotPositive { name: "a shape of the beta distribution", value: a })?;
                at(&|probability| beta.inverse_cdf(probability))
            }
            Self::Like(file) => {
                let sorted = sorted_heights(file)?;
                at(&|probability| between(&sorted, probability))
            }
        };
        Ok(standardised(values)?)
    }

    /// The distribution in words.
    pub fn description(&self) -> String {
        match self {
            Self::Moments { skewness, kurtosis } => format!("heights of skewness {skewness} and kurtosis {kurtosis}"),
            Self::Weibull { shape } => format!("Weibull heights of shape {shape}"),
            Self::Beta { shapes: [a, b] } => format!("beta heights of shapes {a} and {b}"),
            Self::Like(file) => format!("heights distributed as in {}", file.display()),
        }
    }
}

/// Quantiles of a distribution of Johnson's system whose own skewness and kurtosis, not those of the whole distribution, are as asked for: few steps of
/// probability do not reach far into the tails.
fn johnson_quantiles(asked: [f64; 2], count: usize) -> Result<Vec<f64>, RoughnessError> {
    let normal = Normal::standard();
    let scores: Vec<f64> = (0..count).map(|i| normal.inverse_cdf((i as f64 + 0.5) / count as f64)).collect();
    let [skewness, kurtosis] = asked;
    let (mut tried, mut best) = (asked, None::<(f64, Vec<f64>)>);
    for _ in 0..CORRECTIONS {
        let Some(fitted) = Johnson::from_moments(tried[0], tried[1]) else { break };
        let values = standardised(scores.iter().map(|&score| fitted.value(score)).collect())?;
        let found = [3, 4].map(|power| values.iter().map(|value| value.powi(power)).sum::<f64>() / count as f64);
        let off = (found[0] - skewness).abs() + (found[1] / kurtosis - 1.0).abs();
        if best.as_ref().is_none_or(|(least, _)| off < *least) {
            best = Some((off, values));
        }
        if off < CLOSE {
            break;
        }
        tried = [tried[0] + skewness - found[0], tried[1] + kurtosis - found[1]];
    }
    Ok(best.ok_or(SurfaceError::ExtremeHeights { skewness, kurtosis })?.1)
}

fn sorted_heights(file: &HeightFile) -> Result<Vec<f64>, FileError> {
    let measured = file.measurement(None)?;
    let mut heights: Vec<f64> = measured.height.iter().copied().filter(|height| height.is_finite()).collect();
    if heights.is_empty() {
        return Err(FileError::Format {
            path: file.path().into(),
            what: "height",
            reason: "all heights are void, so they have no distribution".into(),
        });
    }
    heights.sort_unstable_by(f64::total_cmp);
    Ok(heights)
}

/// The height of a probability, between the sorted heights that are nearest.
fn between(sorted: &[f64], probability: f64) -> f64 {
    let last = sorted.len() - 1;
    let place = (probability * sorted.len() as f64 - 0.5).clamp(0.0, last as f64);
    let (below, share) = (place as usize, place.fract());
    sorted[below] + share * (sorted[(below + 1).min(last)] - sorted[below])
}

/// The values with mean 0 and mean square 1.
fn standardised(mut values: Vec<f64>) -> Result<Vec<f64>, SurfaceError> {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
    if !(square.is_finite() && square > 0.0) {
        return Err(SurfaceError::OneHeight);
    }
    values.iter_mut().for_each(|value| *value = (*value - mean) / square.sqrt());
    Ok(values)
}
