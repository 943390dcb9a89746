//! OPD: arrays column by column, each from the last row on.

use super::{POINTS, VOID, filled, height};

/// A block: its name, its type and its bytes.
type Block = (&'static str, u16, Vec<u8>);

/// Numbers of an array in the order of the file.
fn array(size: u16, number: impl Fn(usize, usize) -> Vec<u8>) -> Vec<u8> {
    let [nx, ny] = POINTS;
    let head = [nx as u16, ny as u16, size].map(u16::to_le_bytes).concat();
    let nodes = (0..nx).flat_map(|ix| (0..ny).rev().map(move |iy| (ix, iy)));
    [head, nodes.flat_map(|(ix, iy)| number(ix, iy)).collect()].concat()
}

fn written(blocks: &[Block]) -> Vec<u8> {
    let entry = |name, kind: u16, length: usize, flags: u16| {
        let numbers = [&kind.to_le_bytes()[..], &(length as u32).to_le_bytes(), &flags.to_le_bytes()].concat();
        [filled(name, 16), numbers].concat()
    };
    let empty = entry("", 0, 0, 0);
    let directory = entry("Directory", 1, 24 * (blocks.len() + 2), 0xffff);
    let entries = blocks.iter().flat_map(|(name, kind, bytes)| entry(name, *kind, bytes.len(), 8));
    let data = blocks.iter().flat_map(|block| block.2.iter().copied());
    [vec![1, 0], directory, entries.collect(), empty, data.collect()].concat()
}

/// Blocks that all files have.
fn common() -> Vec<Block> {
    vec![
        ("Wavelength", 7, 500_f32.to_le_bytes().to_vec()),
        ("Pixel_size", 7, 0.25_f32.to_le_bytes().to_vec()),
        ("Aspect", 7, 1.5_f32.to_le_bytes().to_vec()),
        ("Title", 5, filled("steel", 20)),
        ("MeasMode", 15, b"\x12\x01\x03PSI".to_vec()),
        ("Image", 3, array(1, |ix, _| vec![ix as u8])),
    ]
}

pub fn file() -> Vec<u8> {
    let number = |ix, iy| if [ix, iy] == VOID { 2e38 } else { f32::from(height(ix, iy)) };
    written(&[common(), vec![("Raw", 3, array(4, |ix, iy| number(ix, iy).to_le_bytes().to_vec()))]].concat())
}

pub fn integers() -> Vec<u8> {
    let number = |ix, iy| if [ix, iy] == VOID { 32767 } else { i16::from(height(ix, iy)) };
    let array = array(2, |ix, iy| number(ix, iy).to_le_bytes().to_vec());
    written(&[common(), vec![("Mult", 6, vec![10, 0]), ("RAW_DATA", 3, array)]].concat())
}
