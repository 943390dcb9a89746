//! Depths for a stress.

/// The surface and `count - 1` depths below it, with a constant ratio, from `first` (best a fraction of the spacing) to
/// `last` (best a fraction of the cell).
///
/// ```
/// use asperity::elastic::stress::depths;
/// let found = depths(0.5, 8.0, 6);
/// assert!(found.iter().zip([0.0, 0.5, 1.0, 2.0, 4.0, 8.0]).all(|(z, expected)| (z - expected).abs() < 1e-14));
/// ```
pub fn depths(first: f64, last: f64, count: usize) -> Vec<f64> {
    let steps = count.saturating_sub(2).max(1) as f64;
    let below = (1..count).map(|i| first * (last / first).powf((i - 1) as f64 / steps));
    std::iter::once(0.0).chain(below).take(count).collect()
}
