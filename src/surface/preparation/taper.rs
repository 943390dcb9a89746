//! Heights that go to their mean at the rim.

use crate::formats::Scan;
use std::f64::consts::PI;

impl Scan {
    /// The heights about their mean times Tukey's window: 1 inside, and falling to 0 as half a cosine wave within the
    /// fraction `share` of each side, along y and x. It makes any heights periodic, but adds gradient where it falls.
    pub fn tapered(mut self, share: f64) -> Self {
        let there = self.height.iter().filter(|h| !h.is_nan());
        let (count, sum) = there.fold((0usize, 0.0), |(n, sum), h| (n + 1, sum + h));
        let mean = sum / count.max(1) as f64;
        let [y, x] = self.shape().map(|n| window(n, share));
        self.height.indexed_iter_mut().for_each(|((row, column), h)| *h = mean + y[row] * x[column] * (*h - mean));
        self
    }
}

/// Tukey's window of `nodes` nodes; 1 for a single node.
fn window(nodes: usize, share: f64) -> Vec<f64> {
    let last = nodes.saturating_sub(1) as f64;
    let at = |i: usize| {
        let rim = (i as f64).min(last - i as f64) / (share * last);
        if nodes == 1 || rim >= 1.0 { 1.0 } else { 0.5 * (1.0 - (PI * rim).cos()) }
    };
    (0..nodes).map(at).collect()
}
