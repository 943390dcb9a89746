//! Igor binary waves: maps of layers from the lowest row on, and a profile of an older version.

use super::{POINTS, VOID, by_rows, filled, height};

/// A file whose check sum holds: the numbers of two bytes in its headers add up to zero.
pub fn signed(mut file: Vec<u8>) -> Vec<u8> {
    let is_big = file.first() == Some(&0);
    let version = file.get(if is_big { 1 } else { 0 }).copied().unwrap_or_default();
    let (place, length) = match version {
        2 => (14, 126),
        _ => (2, 384),
    };
    if file.len() < length {
        return file;
    }
    file[place..place + 2].fill(0);
    let word = |pair: &[u8]| {
        let pair = [pair[0], pair[1]];
        if is_big { u16::from_be_bytes(pair) } else { u16::from_le_bytes(pair) }
    };
    let sum = file[..length].chunks_exact(2).map(word).fold(0, u16::wrapping_sub);
    file[place..place + 2].copy_from_slice(&if is_big { sum.to_be_bytes() } else { sum.to_le_bytes() });
    file
}

/// Numbers of one order of bytes.
struct Writer {
    is_big: bool,
    bytes: Vec<u8>,
}

impl Writer {
    fn put(&mut self, bytes: &[u8]) {
        self.bytes.extend(bytes.iter().rev().filter(|_| self.is_big));
        self.bytes.extend(bytes.iter().filter(|_| !self.is_big));
    }

    fn short(&mut self, number: u16) {
        self.put(&number.to_le_bytes());
    }

    fn integers(&mut self, numbers: &[usize]) {
        numbers.iter().for_each(|it| self.put(&(*it as u32).to_le_bytes()));
    }

    fn doubles(&mut self, numbers: &[f64]) {
        numbers.iter().for_each(|it| self.put(&it.to_le_bytes()));
    }
}

/// Heights in nanometres from the lowest row on, the factor times over.
fn layer(factor: f32) -> Vec<f32> {
    let [_, ny] = POINTS;
    by_rows(|ix, row| {
        let node = [ix, ny - 1 - row];
        if node == VOID { f32::NAN } else { factor * f32::from(height(node[0], node[1])) }
    })
}

/// A map of version 5, whose layers have labels, and what the file ends with.
fn written(is_big: bool, labels: &[&str], unit: &str, end: &str) -> Vec<u8> {
    let [nx, ny] = POINTS;
    let layers: Vec<f32> = (1..=labels.len()).flat_map(|layer_of| layer(layer_of as f32)).collect();
    let (note, long) = ("ScanSize: 1e-5\rImagingMode: AC Mode\r", if unit.len() > 3 { unit } else { "" });
    let mut file = Writer { is_big, bytes: Vec::new() };
    file.short(5);
    file.short(0);
    file.integers(&[320 + 4 * layers.len(), 0, note.len(), long.len(), 0, 0, 0, 0]);
    file.integers(&[0, 0, 32 * (labels.len() + 1), 0, 0, 0, 0]);
    file.integers(&[0, 1, 2, layers.len()]);
    [2, 0, 0, 0, 0, 1].into_iter().for_each(|it| file.short(it));
    file.bytes.extend(filled("steel", 32));
    file.integers(&[0, 0, nx, ny, labels.len(), 0]);
    file.doubles(&[2e-6, 3e-6, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    let short = if long.is_empty() { unit } else { "" };
    file.bytes.extend([filled(short, 4), filled("m", 4), filled("m", 4), filled("", 8)].concat());
    file.bytes.resize(384, 0);
    layers.iter().for_each(|it| file.put(&it.to_le_bytes()));
    file.bytes.extend([note.as_bytes(), long.as_bytes()].concat());
    file.bytes.extend(filled("", 32));
    labels.iter().for_each(|it| file.bytes.extend(filled(it, 32)));
    file.bytes.extend(end.bytes());
    signed(file.bytes)
}

/// Layers of Asylum Research, all in metres, of which the second one and the last one are heights.
pub fn file() -> Vec<u8> {
    let labels = ["AmplitudeTrace", "HeightTrace", "Phase1Trace", "HeightTrace"];
    written(false, &labels, "m", " 0506 MFP3D")
}

/// A wave of Igor Pro alone, the most significant byte first, whose unit is a text behind the numbers.
pub fn alone() -> Vec<u8> {
    written(true, &[""], "micron", "")
}

/// A wave of version 2, which is a profile of doubles.
pub fn profile() -> Vec<u8> {
    let [nx, _] = POINTS;
    let note = "Place: here";
    let mut file = Writer { is_big: false, bytes: Vec::new() };
    file.short(2);
    file.integers(&[110 + 16 + 8 * nx, note.len(), 0]);
    file.short(0);
    file.short(4);
    file.integers(&[0]);
    file.bytes.extend(filled("steel", 20 + 8));
    file.bytes.extend([filled("nm", 4), filled("um", 4)].concat());
    file.integers(&[nx]);
    file.short(0);
    file.doubles(&[2.0, 0.0]);
    file.bytes.resize(126, 0);
    (0..nx).for_each(|ix| file.doubles(&[height(ix, 0).into()]));
    file.bytes.extend([&[0; 16], note.as_bytes()].concat());
    signed(file.bytes)
}
