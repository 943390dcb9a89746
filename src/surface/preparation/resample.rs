//! Heights at uneven positions, interpolated to even spacing.

use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// How heights at uneven positions are interpolated to the same number of even positions over the same length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Resample {
    /// Linear interpolation to the same number of evenly spaced positions.
    Linear,
}

impl Resample {
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
