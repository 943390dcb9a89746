//! TMD: heights in millimetres behind a comment of any length.

use super::{POINTS, singles};

/// A file of a version with a comment.
pub fn written(version: &str, comment: &str) -> Vec<u8> {
    let [nx, ny] = POINTS;
    let head = format!("Binary TrueMap Data File{version}\r\n\0{comment}\0");
    let counts = [nx as u32, ny as u32].map(u32::to_le_bytes).concat();
    let lengths = [2e-3 * nx as f32, 3e-3 * ny as f32, 0.5, 0.25].map(f32::to_le_bytes).concat();
    [head.into_bytes(), counts, lengths, singles(f32::NAN)].concat()
}

pub fn file() -> Vec<u8> {
    written(" v2.0", "steel\r\n")
}
