//! MetroPro: an image of the intensity, and phases.

use super::{POINTS, VOID, by_rows, filled, height};

/// A file of a format with a header of so many bytes.
fn written(format: u8, length: usize) -> Vec<u8> {
    let [nx, ny] = POINTS;
    let mut head = vec![0; length];
    let mut put = |place: usize, bytes: &[u8]| head[place..place + bytes.len()].copy_from_slice(bytes);
    put(0, &[0x88, 0x1b, 0x03, 0x6e + format, 0, format]);
    put(6, &(length as u32).to_be_bytes());
    put(12, &filled("Fri Jun 23 15:37:19 2006", 30));
    let counts = [nx as u16, ny as u16].map(u16::to_be_bytes).concat();
    put(52, &counts);
    put(56, &[0, 1]);
    put(68, &counts);
    put(80, b"steel");
    put(164, &0.5_f32.to_be_bytes());
    put(168, &6.5536e-7_f32.to_be_bytes());
    put(176, &2_f32.to_be_bytes());
    put(184, &2e-6_f32.to_be_bytes());
    put(218, &[0, 1]);
    put(232, &[0, 1]);
    let pixels = by_rows(|ix, iy| [0, (10 * ix + iy) as u8]).concat();
    let phase = |ix, iy| if [ix, iy] == VOID { i32::MAX } else { -i32::from(height(ix, iy)) };
    [head, pixels, by_rows(|ix, iy| phase(ix, iy).to_be_bytes()).concat()].concat()
}

pub fn file() -> Vec<u8> {
    written(1, 834)
}

pub fn long() -> Vec<u8> {
    written(3, 4096)
}
