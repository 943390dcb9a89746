//! Heights at uneven positions, interpolated to even spacing.

use serde::{Deserialize, Serialize};

/// How heights at uneven positions are interpolated to the same number of even positions over the same length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Resample {
    /// Linearly between neighbours.
    Linear,
}

impl Resample {
    /// The ways and their names in scenes, with a short description.
    pub const WAYS: [(&str, &str); 1] =
        [("linear", "Linear interpolation to the same number of evenly spaced positions")];

    /// The heights at even positions, and their spacing, of heights at ever larger positions `x`, two at least.
    pub fn apply(self, x: &[f64], height: &[f64]) -> (Vec<f64>, f64) {
        let last = x.len() - 1;
        let spacing = (x[last] - x[0]) / last as f64;
        let at = |i: usize| {
            let place = (x[0] + i as f64 * spacing).clamp(x[0], x[last]);
            let right = x.partition_point(|x| *x < place).clamp(1, last);
            let share = (place - x[right - 1]) / (x[right] - x[right - 1]);
            height[right - 1] + share * (height[right] - height[right - 1])
        };
        ((0..=last).map(at).collect(), spacing)
    }
}
