//! WSxM: an image from right to left and from the lowest row on.

use super::{by_rows, height};

/// An image whose heights span a difference in nanometres.
fn written(kind: &str, number: impl Fn(i8) -> Vec<u8>) -> Vec<u8> {
    let header = format!(
        "WSxM file copyright UAM\nSxM Image file\nImage header size: 1\n\n[Control]\n\n    X Amplitude: 0.01 mm\n    \
         Y Amplitude: 12000 nm\n\n[General Info]\n\n    Acquisition channel: Topography\n    \
         Acquisition time: 03/11/2011, 20:23\n    Image Data Type: {kind}\n    Number of columns: 5\n    \
         Number of rows: 4\n    Z Amplitude: 46 nm\n\n[Header end]\n"
    );
    let mut numbers = by_rows(|ix, iy| number(height(ix, iy)));
    numbers.reverse();
    [header.replace('\n', "\r\n").into_bytes(), numbers.concat()].concat()
}

/// Numbers whose zero is another one.
pub fn file() -> Vec<u8> {
    written("short", |z| (7 * i16::from(z)).to_le_bytes().to_vec())
}

pub fn double() -> Vec<u8> {
    written("double", |z| f64::from(z).to_le_bytes().to_vec())
}
