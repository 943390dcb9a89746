//! Means with their standard deviation.

/// Mean and standard deviation of some values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the values, of a sample; 0 for a single one.
    pub deviation: f64,
    /// Number of values.
    pub count: usize,
}

impl Spread {
    /// The spread of `values`; without values the mean is NaN.
    ///
    /// ```
    /// use asperity::study::Spread;
    /// let spread = Spread::from_values([1.0, 2.0, 3.0]);
    /// assert_eq!((spread.mean, spread.deviation, spread.count), (2.0, 1.0, 3));
    /// ```
    pub fn from_values(values: impl IntoIterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.into_iter().collect();
        let count = values.len();
        let mean = values.iter().sum::<f64>() / count as f64;
        let squares = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
        let deviation = if count > 1 { (squares / (count - 1) as f64).sqrt() } else { 0.0 };
        Self { mean, deviation, count }
    }

    /// Standard error of the mean; NaN for a single value, whose error is not known.
    pub fn error(&self) -> f64 {
        if self.count > 1 { self.deviation / (self.count as f64).sqrt() } else { f64::NAN }
    }
}
