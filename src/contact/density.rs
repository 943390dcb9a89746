//! Where the error of a pressure is.

use crate::contact::chunks;

/// The density `p (v - min v)` of the error in energy, row by row: its mean is the gap `G` of the
/// [`crate::contact::Certificate`]. Nodes contribute if they have pressure and are above the deepest node. `v = u - h`
/// may have any datum, so the gap can be used.
///
/// ```
/// use asperity::contact::error_density;
/// assert_eq!(error_density(&[0.0, 2.0, 3.0], &[5.0, 0.5, -0.5]), [0.0, 2.0, 0.0]);
/// ```
pub fn error_density(pressure: &[f64], gap: &[f64]) -> Vec<f64> {
    let lowest = lowest(gap);
    pressure.iter().zip(gap).map(|(p, g)| p * (g - lowest)).collect()
}

/// The largest gap that counts as contact: twice the largest penetration, since the gap of nodes in contact has errors
/// of both signs.
///
/// ```
/// assert_eq!(asperity::contact::contact_reach(&[0.3, -0.1, 0.05]), 0.2);
/// ```
pub fn contact_reach(gap: &[f64]) -> f64 {
    2.0 * (-lowest(gap)).max(0.0)
}

fn lowest(values: &[f64]) -> f64 {
    let lowest = chunks::visit(values.len(), |range| range.fold(f64::INFINITY, |low, i| values[i].min(low)));
    lowest.into_iter().fold(f64::INFINITY, f64::min)
}
