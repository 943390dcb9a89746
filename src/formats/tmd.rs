//! The TMD files of TrueMap and of GelSight.

use super::bytes::{ByteReader, left_over, nodes};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use std::io;

/// 32 bytes of text, a comment that ends in a zero, columns and rows, lengths and offsets along x and y, and heights row by row in single
/// precision. All lengths are millimetres, and those along x and y are points times their distance. Points that are not numbers are void.
/// Version 1, of another header, is refused.
///
/// # Source
/// GelSight's `readtmd.m` and `writetmd.m` (2014-2020), whose comment may be of any length.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "TrueMap TMD", is_it, channels };

/// What a file of any version begins with.
const MAGIC: &[u8] = b"Binary TrueMap Data File";
/// What follows in version 2.
const VERSION: &[u8] = b" v2.0\r\n\0";
/// Metres in the unit of all lengths.
const MILLIMETRE: f64 = 1e-3;

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let mut at = ByteReader::new(bytes).seek(MAGIC.len())?;
    let version = at.take(VERSION.len())?;
    if version != VERSION {
        let version = ByteReader::new(version).text(version.len())?;
        return Err(malformed(format!("it is of the version {version:?}: only version v2.0 is read")));
    }
    let end = at.rest().iter().position(|byte| *byte == 0);
    let comment = at.text(end.ok_or_else(|| malformed("its comment does not end: it is incomplete"))? + 1)?;
    let [columns, rows] = [at.u32()?, at.u32()?];
    let [x, y, x_0, y_0] = [at.f32()?, at.f32()?, at.f32()?, at.f32()?].map(f64::from);
    let points = at.rest();
    let [ny, nx] = nodes(rows.into(), columns.into(), 4, points.len())?;
    let values =
        move || points.chunks_exact(4).take(nx * ny).map(|it| ByteReader::new(it).f32().map(f64::from)).collect();
    let header = [("Comment", comment), ("X0", format!("{x_0} mm")), ("Y0", format!("{y_0} mm"))];
    let header =
        header.into_iter().filter(|it| !it.1.is_empty()).map(|(name, value)| (name.to_owned(), value)).collect();
    Ok(vec![Channel {
        spacing: Some([y / ny as f64, x / nx as f64]),
        lateral_unit: Some(MILLIMETRE),
        unit: Some(MILLIMETRE),
        header,
        doubts: left_over(points.len() - 4 * nx * ny, "the heights").into_iter().collect(),
        ..Channel::map("height", [ny, nx], values)
    }])
}
