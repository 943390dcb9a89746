//! VK4: an image of light and one of heights, whose numbers have no sign.

use super::{POINTS, by_rows, height};

/// Bytes before the settings, and bytes of the settings.
const HEADER: usize = 12 + 18 * 4;
const SETTINGS: usize = 77 * 4;
/// What is added to heights so that none is negative.
pub const SHIFT: i16 = 20;

/// An image of numbers of some bytes.
fn image(size: usize) -> Vec<u8> {
    let [nx, ny] = POINTS;
    let head = [nx, ny, 8 * size, 0, nx * ny * size, 0, 1].map(|it| (it as u32).to_le_bytes()).concat();
    let number = |ix, iy| (i32::from(height(ix, iy)) + i32::from(SHIFT)).to_le_bytes()[..size].to_vec();
    [head, vec![9; 768], by_rows(number).concat()].concat()
}

/// A file whose heights have some bytes.
pub fn of_size(size: usize) -> Vec<u8> {
    let (light, heights) = (image(2), image(size));
    let start = HEADER + SETTINGS;
    let mut places = [0; 18];
    (places[0], places[3], places[6]) = (HEADER, start, start + light.len());
    let mut settings = [0_u32; SETTINGS / 4];
    settings[1..7].copy_from_slice(&[2026, 11, 22, 3, 4, 5]);
    settings[42..45].copy_from_slice(&[2_000_000, 3_000_000, 1000]);
    let places = places.map(|place| (place as u32).to_le_bytes()).concat();
    [b"VK4_\x0c\x02\x00\x00\0\0\0\0".to_vec(), places, settings.map(u32::to_le_bytes).concat(), light, heights].concat()
}

pub fn file() -> Vec<u8> {
    of_size(4)
}
