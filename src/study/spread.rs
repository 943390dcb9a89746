//! Averages with their scatter, and straight lines through points.

/// Mean of some values and how they scatter.
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
    /// The spread of `values`; the mean of none is NaN.
    ///
    /// ```
    /// use asperity::study::Spread;
    /// let spread = Spread::of([1.0, 2.0, 3.0]);
    /// assert_eq!((spread.mean, spread.deviation, spread.count), (2.0, 1.0, 3));
    /// ```
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.into_iter().collect();
        let count = values.len();
        let mean = values.iter().sum::<f64>() / count as f64;
        let squares = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
        let deviation = if count > 1 { (squares / (count - 1) as f64).sqrt() } else { 0.0 };
        Self { mean, deviation, count }
    }

    /// Standard error of the mean.
    pub fn error(&self) -> f64 {
        self.deviation / (self.count.max(1) as f64).sqrt()
    }
}

/// A straight line by least squares, such as a quantity against the grid spacing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Value at 0.
    pub intercept: f64,
    /// Slope.
    pub slope: f64,
}

impl Line {
    /// The line through points `(x, y)`, level through the mean of points that share one `x`.
    ///
    /// ```
    /// use asperity::study::Line;
    /// let line = Line::through(&[(1.0, 3.0), (2.0, 5.0), (3.0, 7.0)]);
    /// assert_eq!((line.intercept, line.at(10.0)), (1.0, 21.0));
    /// ```
    pub fn through(points: &[(f64, f64)]) -> Self {
        let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
        let (x, y) = (mean(|point| point.0), mean(|point| point.1));
        let sum = |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|point| of(point.0 - x, point.1 - y)).sum::<f64>();
        let variance = sum(&|x, _| x * x);
        let slope = if variance > 0.0 { sum(&|x, y| x * y) / variance } else { 0.0 };
        Self { intercept: y - slope * x, slope }
    }

    /// The line at `x`.
    pub fn at(&self, x: f64) -> f64 {
        self.intercept + self.slope * x
    }
}
