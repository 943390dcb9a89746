//! Voids filled with heights.

use super::laplace::Laplace;
use crate::formats::Scan;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// How voids are filled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Fill {
    /// The smoothest heights that fit those around the void.
    ///
    /// Each is the mean of its neighbours, which solves Laplace's equation.
    Harmonic,
}

impl Fill {
    /// How much larger areas may be by the smoothness of what was filled in, as a part of them: at the same load they go with the inverse rms gradient,
    /// which is smaller with the filled heights than without them.
    pub(in crate::surface) fn area_error(with_voids: &Scan, full: &Scan) -> f64 {
        let [measured, all] = [with_voids, full].map(Scan::rms_gradient);
        if all > 0.0 { (measured / all - 1.0).max(0.0) } else { 0.0 }
    }

    /// The heights without voids; none if all heights are void.
    pub fn apply(self, mut scan: Scan) -> Option<Scan> {
        let there = scan.height.iter().filter(|h| !h.is_nan());
        let (count, sum) = there.fold((0usize, 0.0), |(n, sum), h| (n + 1, sum + h));
        let is_void: Vec<bool> = scan.height.iter().map(|h| h.is_nan()).collect();
        let mean = sum / count as f64;
        scan.height = scan.height.as_standard_layout().mapv(|h| if h.is_nan() { mean } else { h });
        let (shape, weights) = (scan.shape(), scan.spacing.map(|spacing| (scan.spacing[1] / spacing).powi(2)));
        let height = scan.height.as_slice_mut().expect("standard layout");
        Laplace::new(shape, weights, height, &is_void).solve(height);
        (count > 0).then_some(scan)
    }
}
