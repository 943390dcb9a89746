//! The surface data file of ISO 25178-71, in text and binary.

use super::bytes::{Bytes, latin, nodes};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use std::io;

/// A header of fixed fields (binary) or of `name = value` lines (text), heights row by row as integers or floating point numbers, and a
/// trailer of remarks. The scales turn numbers into metres. A value of the format is void if it is the smallest of its type, and `BAD` in
/// text.
///
/// # Source
/// ISO 25178-71:2017. Compression and check sums are not defined there, and files that use them are refused.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "ISO 25178-71 (SDF)", is_it, channels };

fn is_it(bytes: &[u8]) -> bool {
    bytes.len() > 8
        && [b"ISO-1.0", b"BCR-1.0"].iter().any(|magic| bytes[1..].starts_with(*magic))
        && b"ab".contains(&bytes[0])
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    Ok(vec![if bytes[0] == b'a' { text(bytes)? } else { binary(bytes)? }])
}

/// The header: what both kinds of files say.
struct Header {
    shape: [i64; 2],
    scale: [f64; 3],
    compression: i64,
    header: Vec<(String, String)>,
}

impl Header {
    /// The channel of these heights in so many bytes, of which each takes `size` at least.
    fn channel<'a>(
        self,
        size: usize,
        bytes: usize,
        values: impl FnOnce() -> io::Result<Vec<f64>> + 'a,
    ) -> io::Result<Channel<'a>> {
        if self.compression != 0 {
            return Err(malformed(format!("its compression is {}: write it without", self.compression)));
        }
        let [x, y, z] = self.scale;
        let shape = nodes(self.shape[0], self.shape[1], size, bytes)?;
        Ok(Channel {
            spacing: Some([y, x]),
            is_profile: shape[0] == 1,
            lateral_unit: Some(1.0),
            unit: Some(z),
            header: self.header,
            ..Channel::map("height", shape, values)
        })
    }
}

/// A file of lines, whose parts end in a line of an asterisk.
fn text(bytes: &[u8]) -> io::Result<Channel<'_>> {
    let text = latin(bytes);
    let mut parts = text.splitn(3, '*');
    let (head, data) = (parts.next().unwrap_or_default(), parts.next().unwrap_or_default().to_owned());
    let header: Vec<(String, String)> = head
        .lines()
        .filter_map(|line| line.split_once('='))
        .map(|(name, value)| (name.trim().to_owned(), value.trim().to_owned()))
        .collect();
    let find = |name: &str| header.iter().find(|it| it.0.eq_ignore_ascii_case(name)).map(|it| it.1.as_str());
    let number = |name: &str| {
        let value = find(name).ok_or_else(|| malformed(format!("its header does not say {name}")))?;
        value.parse::<f64>().map_err(|_| malformed(format!("its header says {name} = {value:?}, which is no number")))
    };
    let scale = [number("Xscale")?, number("Yscale")?, number("Zscale")?];
    let shape = [number("NumProfiles")? as i64, number("NumPoints")? as i64];
    let compression = find("Compression").map_or(Ok(0.0), |_| number("Compression"))? as i64;
    let length = data.len();
    let value = |word: &str| match word {
        "BAD" => Ok(f64::NAN),
        word => word.parse().map_err(|_| malformed(format!("it holds {word:?} among its heights"))),
    };
    let values = move || data.split_whitespace().map(value).collect();
    Header { shape, scale, compression, header: header.clone() }.channel(1, length + 1, values)
}

/// A file of fixed fields.
fn binary(bytes: &[u8]) -> io::Result<Channel<'_>> {
    let mut at = Bytes::new(bytes);
    let header = ["Version", "ManufacID", "CreateDate", "ModDate"].into_iter().zip([8, 10, 12, 12]);
    let header: Vec<_> =
        header.map(|(name, length)| Ok((name.to_owned(), at.text(length)?))).collect::<io::Result<_>>()?;
    let [columns, rows] = [at.u16()?, at.u16()?].map(i64::from);
    let scale = [at.f64()?, at.f64()?, at.f64()?];
    at.f64()?; // resolution of the heights
    let [compression, kind, _] = [at.u8()?, at.u8()?, at.u8()?];
    let compression = compression.into();
    let (size, value) = numbers(kind)?;
    let (rest, shape) = (at.rest(), [rows, columns]);
    let values = move || rest.chunks_exact(size).take((rows * columns) as usize).map(value).collect();
    Header { shape, scale, compression, header }.channel(size, rest.len(), values)
}

/// A number in the bytes of a file.
type Number = fn(&[u8]) -> io::Result<f64>;

/// The bytes of a number of a type, and how it is read.
fn numbers(kind: u8) -> io::Result<(usize, Number)> {
    Ok(match kind {
        0 => (1, |it| Ok(Bytes::new(it).u8()?.into())),
        1 => (2, |it| Ok(Bytes::new(it).u16()?.into())),
        2 => (4, |it| Ok(Bytes::new(it).u32()?.into())),
        3 => (4, |it| Ok(Bytes::new(it).f32()?).map(|z| if z == f32::MIN { f64::NAN } else { z.into() })),
        5 => (2, |it| Ok(Bytes::new(it).i16()?).map(|z| if z == i16::MIN { f64::NAN } else { z.into() })),
        6 => (4, |it| Ok(Bytes::new(it).i32()?).map(|z| if z == i32::MIN { f64::NAN } else { z.into() })),
        7 => (8, |it| Ok(Bytes::new(it).f64()?).map(|z| if z == f64::MIN { f64::NAN } else { z })),
        _ => return Err(malformed(format!("its heights are of the type {kind}, which ISO 25178-71 does not know"))),
    })
}
