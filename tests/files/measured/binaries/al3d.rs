//! AL3D: rows of five points, which are filled up to six.

use super::{POINTS, filled, singles};

/// Bytes before the depth image: what a file begins with, eight tags and the comment.
const HEADER: usize = 17 + 8 * 52 + 256;

fn tag(name: &str, value: &str) -> Vec<u8> {
    [filled(name, 20), filled(value, 30), b"\r\n".to_vec()].concat()
}

pub fn file() -> Vec<u8> {
    let [nx, ny] = POINTS.map(|count| count.to_string());
    let tags = [
        tag("Version", "1"),
        tag("TagCount", "6"),
        tag("Cols", &nx),
        tag("Rows", &ny),
        tag("DepthImageOffset", &HEADER.to_string()),
        tag("InvalidPixelValue", "3.0000000281e+15"),
        tag("PixelSizeXMeter", "2e-06"),
        tag("PixelSizeYMeter", "3e-06"),
    ];
    let comment = [filled("steel", 254), b"\r\n".to_vec()].concat();
    let rows = singles(3e15).chunks(20).flat_map(|row| [row, &[0xff; 4]].concat()).collect();
    [b"AliconaImaging\0\r\n".to_vec(), tags.concat(), comment, rows].concat()
}
