//! PLU: a topography of two layers, and a profile.

use super::{POINTS, filled, height, singles};

/// The fields before the layers.
fn fields(kind: u32, layers: u8, pictures: u8) -> Vec<u8> {
    let axes = [0.0, 2.0, 3.0, 10.0, 20.0, 0.0, 30.0_f32].map(f32::to_le_bytes).concat();
    let settings = [kind, 2, 0, 14, 3].map(u32::to_le_bytes).concat();
    let file = [
        filled("Fri Mar 10 16:35:59 2023", 128 + 4),
        filled("steel", 256),
        [POINTS[1], POINTS[0], POINTS[0]].iter().flat_map(|count| (*count as u32).to_le_bytes()).collect(),
        axes,
        settings,
        vec![0; 40],
        vec![0, layers, 0xfb, 6, pictures, 0, 0, 0, 1, 0, 0, 0],
    ];
    file.concat()
}

fn layer(counts: [usize; 2], heights: Vec<u8>, pictures: usize) -> Vec<u8> {
    let counts = counts.map(|count| (count as u32).to_le_bytes()).concat();
    let pictures = vec![7; 8 + heights.len() / 4 * 3 * pictures];
    [counts, heights, pictures].concat()
}

pub fn file() -> Vec<u8> {
    let [nx, ny] = POINTS;
    let flat = vec![0; 4 * nx * ny];
    [fields(3, 2, 1), layer([ny, nx], flat, 1), layer([ny, nx], singles(1_000_001.0), 1)].concat()
}

pub fn profile() -> Vec<u8> {
    let heights = (0..POINTS[0]).flat_map(|ix| f32::from(height(ix, 0)).to_le_bytes());
    [fields(1, 1, 0), layer([1, POINTS[0]], heights.collect(), 0)].concat()
}
