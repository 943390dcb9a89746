//! Nanoscope: a phase and heights, of which the last line is at y = 0.

use super::{POINTS, by_rows, height};

/// Bytes before the images.
const HEADER: usize = 4096;
/// The size of a scan, as an image says it.
const SIZE: &str = "\\Scan Size: 10 12 ~m";

/// A header of a version with images whose numbers count as `scaled` bytes and take `stored`, of a size, and with more lines on the scan.
fn written(version: &str, scaled: usize, stored: usize, [size, scan]: [&str; 2]) -> Vec<u8> {
    let [nx, ny] = POINTS;
    let length = nx * ny * stored;
    let image = |(i, kind, scale): (usize, &str, &str)| {
        let offset = HEADER + i * length;
        format!(
            "\\*Ciao image list\n\\Data offset: {offset}\n\\Data length: {length}\n\\Bytes/pixel: {scaled}\n\
             \\Samps/line: {nx}\n\\Number of lines: {ny}\n{size}\n\\Line Direction: Retrace\n\
             \\@2:Image Data: S {kind}\n\\@2:Z scale: V {scale}\n"
        )
    };
    let images = [
        (0, "[Phase] \"Phase\"", "[Sens. Phase] (0.005 \u{b0}/LSB) 360.0 \u{b0}"),
        (1, "[ZSensor] \"Height Sensor\"", "[Sens. ZsensSens] (0.0003 V/LSB) 6.5536 V"),
        (2, "[Height] \"Height\"", "[Sens. Zsens] (0.1 mV/LSB) 65.536 mV"),
        (3, "[Height] \"Height\"", "(0.1 nm/LSB) 131.072 nm"),
        (4, "[Deflection] \"Deflection\"", "[Sens. Zsens] (0.1 V/LSB) 65.536 V"),
        (5, "[LogModulus] \"LogModulus\"", "[Sens. Modulus] (0.0001 log(Arb)/LSB) 4.8 log(Arb)"),
    ];
    let lists = images.map(image).concat();
    let head = format!(
        "\\*File list\n\\Version: {version}\n\\Data length: {HEADER}\n\\Text: \n\\*Equipment list\n\\Microscope: M\n\
         \\*Scanner list\n\\@Sens. Zsens: V 20.0 nm/V\n\\*Ciao scan list\n\\Scan Rate: 1.5\n\\Junk: 1\n\
         \\@Sens. ZsensSens: V 400.0 nm/V\n\\@Sens. Modulus: V 1.0 log(Pa)/log(Arb)\n{scan}\\@Sens. Phase: V 1.0 \n{lists}\\*File list end\n\u{1a}"
    );
    let mut file: Vec<u8> = head.replace('\n', "\r\n").chars().map(|letter| letter as u8).collect();
    assert!(file.len() < HEADER);
    file.resize(HEADER, 0xcc);
    let number = |ix, iy| i32::from(height(ix, POINTS[1] - 1 - iy)).to_le_bytes()[..stored].to_vec();
    let numbers = by_rows(number).concat();
    file.extend(numbers.repeat(images.len()));
    file
}

pub fn file() -> Vec<u8> {
    written("0x07200000", 2, 2, [SIZE, ""])
}

pub fn long() -> Vec<u8> {
    written("0x09200000", 2, 4, [SIZE, ""])
}

pub fn full() -> Vec<u8> {
    written("0x09400000", 4, 4, [SIZE, ""])
}

/// Images with other lines on their size, and with more lines on the scan.
pub fn sized(image: &str, scan: &str) -> Vec<u8> {
    written("0x07200000", 2, 2, [image, scan])
}
