//! The memory that heights of a file need.

use super::format::malformed;
use crate::memory::check_room;
use std::io;

/// Fields of doubles that are needed to read heights and prepare them: those of the file, copies that are kept, and what a step makes of them.
const FIELDS: usize = 5;
/// Points for which there is always memory.
const FEW: usize = 1 << 20;

/// Checks the number of points that a file states before anything is unpacked or allocated for them.
///
/// # Errors
/// For more points than there is memory for.
pub(super) fn check_points(shape: &[usize]) -> io::Result<()> {
    let points = shape.iter().fold(1, |product: usize, n| product.saturating_mul(*n));
    if points <= FEW {
        return Ok(());
    }
    let needed = (FIELDS * size_of::<f64>()) as f64 * points as f64;
    check_room(needed).map_err(|room| {
        let points = shape.iter().map(usize::to_string).collect::<Vec<_>>().join(" x ");
        malformed(format!("its {points} points do not fit in memory: they need {room}: save fewer points"))
    })
}
