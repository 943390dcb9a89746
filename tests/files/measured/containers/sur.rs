//! Files of Digital Surf.

use super::{SHAPE, heights};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

/// The smallest number of all points.
const SMALLEST: i32 = 90;
/// The number of a point without a measurement.
const VOID: f64 = (SMALLEST - 2) as f64;

/// The bytes of an object.
struct Object {
    magic: &'static [u8; 12],
    kind: i16,
    objects: i16,
    bits: i16,
    shape: [usize; 2],
    /// The unit along z.
    unit: &'static str,
    points: Vec<u8>,
}

impl Object {
    fn bytes(&self) -> Vec<u8> {
        let mut all = self.magic.to_vec();
        let field = |text: &str, length: usize| format!("{text:length$}").into_bytes();
        let shorts = |numbers: &[i16]| numbers.iter().flat_map(|it| it.to_le_bytes()).collect::<Vec<u8>>();
        let singles = |numbers: &[f32]| numbers.iter().flat_map(|it| it.to_le_bytes()).collect::<Vec<u8>>();
        let integers = |numbers: &[i32]| numbers.iter().flat_map(|it| it.to_le_bytes()).collect::<Vec<u8>>();
        all.extend(shorts(&[0, self.objects, 1, self.kind]));
        all.extend([field("part", 30), field("me", 30)].concat());
        all.extend(shorts(&[0, 9, 0, 1, 0]));
        all.extend([0; 8]);
        all.extend(shorts(&[self.bits]));
        let [ny, nx] = self.shape.map(|it| it as i32);
        all.extend(integers(&[SMALLEST, 1000, nx, ny, nx * ny]));
        all.extend(singles(&[2.0, 0.003, 0.5]));
        all.extend(["X", "Y", "Z"].map(|it| field(it, 16)).concat());
        all.extend(["um", "mm", self.unit, "mm", "mm", "mm"].map(|it| field(it, 16)).concat());
        all.extend(singles(&[1.0; 3]));
        all.extend(shorts(&[0; 3]));
        all.extend([0; 12]);
        all.extend(shorts(&[5, 4, 3, 22, 11, 2026, 0]));
        all.extend(singles(&[60.0]));
        all.extend([0; 10]);
        all.extend(shorts(&[7, 3]));
        all.extend([0; 128]);
        all.extend(singles(&[0.0, 0.0, -50.0, 0.0, 0.0]));
        all.extend([0; 26]);
        assert_eq!(all.len(), 512);
        [all, b"remark\0\x01\x02\x03".to_vec(), self.points.clone()].concat()
    }
}

/// A number of four bytes for each height in nanometres: twice the sum with the offset.
fn long(void: f64) -> Vec<u8> {
    let number = |z: f64| if z == void { VOID } else { 2.0 * (z + 50.0) };
    heights(void).flat_map(|z| (number(z) as i32).to_le_bytes()).collect()
}

/// A number of two bytes for each height.
fn narrow() -> Vec<u8> {
    long(-1.0).chunks_exact(4).flat_map(|it| [it[0], it[1]]).collect()
}

/// Streams of zlib behind their directory.
fn streams(bytes: &[u8], length: usize) -> Vec<u8> {
    let packed = |bytes: &[u8]| {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    };
    let streams: Vec<(u32, Vec<u8>)> = bytes.chunks(length).map(|it| (it.len() as u32, packed(it))).collect();
    let lengths = streams.iter().flat_map(|(length, packed)| [*length, packed.len() as u32]);
    let directory = [streams.len() as u32].into_iter().chain(lengths).flat_map(u32::to_le_bytes);
    directory.chain(streams.iter().flat_map(|it| it.1.clone())).collect()
}

const SURFACE: Object =
    Object { magic: b"DIGITAL SURF", kind: 2, objects: 1, bits: 32, shape: SHAPE, unit: "nm", points: Vec::new() };

/// A surface of 32 bits.
pub fn file() -> Vec<u8> {
    Object { points: long(-1.0), ..SURFACE }.bytes()
}

/// A surface of 16 bits.
pub fn short() -> Vec<u8> {
    Object { bits: 16, points: narrow(), ..SURFACE }.bytes()
}

/// Two surfaces of a series, both compressed, the first one in streams that end within a point.
pub fn packed() -> Vec<u8> {
    let magic = b"DSCOMPRESSED";
    let first = Object { magic, kind: 5, objects: 2, points: streams(&long(-1.0), 17), ..SURFACE };
    let second = Object { magic, kind: 2, bits: 16, points: streams(&narrow(), 1000), ..SURFACE };
    [first.bytes(), second.bytes()].concat()
}

/// A profile.
pub fn profile() -> Vec<u8> {
    Object { kind: 1, shape: [1, SHAPE[0] * SHAPE[1]], points: long(-1.0), ..SURFACE }.bytes()
}
