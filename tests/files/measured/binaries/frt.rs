//! FRT: points, or images of an intensity and of heights, from the lowest row on.

use super::{POINTS, VOID, by_rows, height};

/// A file of a version, of whose blocks lengths have four or eight bytes.
fn written(is_long: bool, data: &[(u16, Vec<u8>)]) -> Vec<u8> {
    let [nx, ny] = POINTS.map(|it| it as u32);
    let doubles = |numbers: &[f64]| numbers.iter().flat_map(|it| it.to_le_bytes()).collect::<Vec<u8>>();
    let common = [
        (0x65, b"steel\0\0".to_vec()),
        (0x66, [nx, ny, 16].map(u32::to_le_bytes).concat()),
        (0x67, [doubles(&[10e-6, 12e-6, 0.0, 0.0, 2.0]), vec![1, 0, 0, 0]].concat()),
        (0x99, vec![7; 3]),
        (0x6c, [vec![5, 0, 0, 0], doubles(&[1e-9])].concat()),
    ];
    let block = |(kind, bytes): &(u16, Vec<u8>)| {
        let length = (bytes.len() as u64).to_le_bytes();
        [&kind.to_le_bytes(), &length[..if is_long { 8 } else { 4 }], bytes].concat()
    };
    let version: &[u8] = if is_long { b"FRTM_GLIDERV1.01" } else { b"FRTM_GLIDERV1.00" };
    let blocks = common.iter().chain(data).flat_map(block).collect();
    [version.to_vec(), vec![(common.len() + data.len()) as u8, 0], blocks].concat()
}

/// Heights above the lowest one that can be told from a void, the last row first.
fn points<const N: usize>(number: impl Fn(i32) -> [u8; N]) -> Vec<u8> {
    let point = |ix, row| {
        let node = [ix, POINTS[1] - 1 - row];
        if node == VOID { 1 } else { i32::from(height(node[0], node[1])) + 100 }
    };
    by_rows(|ix, row| number(point(ix, row))).concat()
}

pub fn file() -> Vec<u8> {
    written(false, &[(0x0b, points(|it| (it as u16).to_le_bytes()))])
}

/// Several images, the heights with four bytes.
pub fn images() -> Vec<u8> {
    let [nx, ny] = POINTS.map(|it| it as u32);
    let head = |kind: u32, bits: u32| [kind, nx, ny, bits].map(u32::to_le_bytes).concat();
    let short = points(|it| (it as u16).to_le_bytes());
    let long = points(i32::to_le_bytes);
    let images = [vec![0; 8], head(2, 16), short.clone(), head(0x1000_0004, 32), long].concat();
    written(true, &[(0x0b, short), (0x7d, images)])
}
