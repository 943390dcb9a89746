//! Positions and heights in columns of a text.

use super::file_writer::FileWriter;
use crate::formats::Scan;
use std::io::{self, Write};

/// Writes x, y and height of each point of a map, or x and height of a profile, in metres, below a header that states
/// the unit. Voids of a map are left out; those of a profile are NaN, as its positions would be uneven without them.
pub(super) fn write(scan: &Scan, file: &mut FileWriter) -> io::Result<()> {
    let is_profile = scan.is_line();
    let [y, x] = [0, 1].map(|axis| positions(scan, axis));
    writeln!(file, "{}", if is_profile { "# x (m), height (m)" } else { "# x (m), y (m), height (m)" })?;
    for ((row, column), height) in scan.height.indexed_iter() {
        if is_profile {
            writeln!(file, "{} {height:e}", x[column])?;
        } else if height.is_finite() {
            writeln!(file, "{} {} {height:e}", x[column], y[row])?;
        }
    }
    Ok(())
}

/// The positions along an axis.
fn positions(scan: &Scan, axis: usize) -> Vec<String> {
    (0..scan.shape()[axis]).map(|i| format!("{:e}", i as f64 * scan.spacing[axis])).collect()
}
