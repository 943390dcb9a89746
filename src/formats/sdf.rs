//! The surface data file of ISO 25178-71 and of its predecessor, in text and binary.

use super::bytes::{ByteReader, latin, left_over, nodes};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use std::io;
use std::str::FromStr;

/// A header of fixed fields (binary) or of `name = value` lines (text), heights row by row as integers or floating point numbers, and a
/// trailer of remarks. The scales turn numbers into metres; the distance of rows has no meaning for a profile, which has one row. In ISO the
/// smallest number of a signed type is void, in the predecessor BCR, and of an unsigned type, the largest one; a text may say `BAD` instead.
/// ISO-2.0 counts rows and columns with four bytes, not two. ISO knows neither compression nor check sums, and files that use those of BCR
/// are refused. Rows are kept in the order of the file: ISO says that y grows with them, BCR does not say.
///
/// # Source
/// ISO 25178-71:2017 and 2026, and report EUR 15178 EN (1993) for BCR, as the page "SDF Format" and the names of types of sdfio 1.4 render them;
/// Gwyddion 2.61 for files of ISO-1.0 with eight bytes more than a header has.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "ISO 25178-71 (SDF)", is_it, channels };

/// The dialects, each after the letter that distinguishes text from binary.
const DIALECTS: [&[u8]; 3] = [b"ISO-1.0", b"ISO-2.0", b"BCR-1.0"];
/// Names of the types of numbers in texts of BCR, in the order of their codes.
const TYPES: [&str; 8] = ["UCHAR", "UINTEGER", "ULONGINT", "FLOAT", "CHAR", "INTEGER", "LONGINT", "DOUBLE"];
/// What a writer of files of ISO-1.0 puts between header and heights.
const SUPERFLUOUS: [u8; 8] = [5, 0, 0, 0, 1, 0, 0, 0];

fn is_it(bytes: &[u8]) -> bool {
    let [first, rest @ ..] = bytes else { return false };
    let is_dialect = DIALECTS.iter().any(|name| rest.starts_with(name));
    match first.to_ascii_lowercase() {
        b'a' => is_dialect || is_header(rest),
        b'b' => is_dialect,
        _ => false,
    }
}

/// Whether the second line of a text is the first one of a header, as in files of institutes with versions of their own.
fn is_header(text: &[u8]) -> bool {
    let mut lines = text.split(|byte| b"\r\n".contains(byte)).filter(|line| !line.is_empty());
    let name = lines.nth(1).and_then(|line| line.get(..9));
    name.is_some_and(|name| name.eq_ignore_ascii_case(b"ManufacID"))
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let is_text = bytes.first().is_some_and(|first| first.eq_ignore_ascii_case(&b'a'));
    Ok(vec![if is_text { text(bytes)? } else { binary(bytes)? }])
}

/// Whether a file is of ISO: all others are like BCR.
fn is_iso(bytes: &[u8]) -> bool {
    bytes.get(1..).is_some_and(|rest| rest.starts_with(b"ISO"))
}

/// What both kinds of files say.
struct Header {
    shape: [i64; 2],
    scale: [f64; 3],
    compression: u8,
    check: u8,
    header: Vec<(String, String)>,
}

impl Header {
    /// The channel of these heights, if they fit into `bytes`; each takes at least `size`.
    fn channel<'a>(
        self,
        size: usize,
        bytes: usize,
        values: impl FnOnce() -> io::Result<Vec<f64>> + 'a,
    ) -> io::Result<Channel<'a>> {
        self.refuse_codes()?;
        let [x, y, z] = self.scale;
        if !(z > 0.0 && z.is_finite()) {
            return Err(malformed(format!("it states that a unit of its heights is {z:?} metres")));
        }
        let shape = nodes(self.shape[0], self.shape[1], size, bytes)?;
        let is_profile = shape[0] == 1;
        Ok(Channel {
            spacing: Some([if is_profile { x } else { y }, x]),
            is_profile,
            lateral_unit: Some(1.0),
            unit: Some(z),
            header: self.header,
            ..Channel::map("height", shape, values)
        })
    }

    fn refuse_codes(&self) -> io::Result<()> {
        match (self.compression, self.check) {
            (0, 0) => Ok(()),
            (0, check) => Err(malformed(format!("it has a check sum of type {check}: save it without one"))),
            (compression, _) => {
                Err(malformed(format!("it has a compression of type {compression}: save it without compression")))
            }
        }
    }
}

/// A file of lines, whose parts end in a line of an asterisk.
fn text(bytes: &[u8]) -> io::Result<Channel<'_>> {
    let (text, is_iso) = (latin(bytes), is_iso(bytes));
    let lines: Vec<&str> = text.split(['\r', '\n']).collect();
    let mut parts = lines.splitn(3, |line| bare(line, is_iso) == "*");
    let [head, data, trailer] = [0; 3].map(|_| parts.next().unwrap_or_default());
    let entries = head.iter().filter_map(|line| bare(line, is_iso).split_once('='));
    let entries = entries.map(|it| (it.0.trim().to_owned(), it.1.trim().to_owned()));
    let version = head.first().map(|line| ("Version".to_owned(), bare(line, is_iso).to_owned()));
    let mut header: Vec<_> = version.into_iter().chain(entries).collect();
    let scale = [number(&header, "Xscale")?, number(&header, "Yscale")?, number(&header, "Zscale")?];
    let shape = [number(&header, "NumProfiles")?, number(&header, "NumPoints")?];
    let [compression, check] = [code(&header, "Compression")?, code(&header, "CheckType")?];
    let numbers = find(&header, "DataType").map(|_| code(&header, "DataType")).transpose()?.map(numbers).transpose()?;
    header.extend(remarks(&trailer.join("\n")));
    let data = data.iter().map(|line| bare(line, is_iso)).collect::<Vec<_>>().join("\n");
    let length = data.len();
    let values = move || data.split_whitespace().map(|word| height(word, numbers, is_iso)).collect();
    Header { shape, scale, compression, check, header }.channel(2, length + 1, values)
}

/// A line without the comment that BCR allows.
fn bare(line: &str, is_iso: bool) -> &str {
    let comment = if is_iso { None } else { line.split_once(';') };
    comment.map_or(line, |it| it.0).trim()
}

fn find<'a>(header: &'a [(String, String)], name: &str) -> Option<&'a str> {
    header.iter().find(|it| it.0.eq_ignore_ascii_case(name)).map(|it| it.1.as_str())
}

fn number<T: FromStr>(header: &[(String, String)], name: &str) -> io::Result<T> {
    let value = find(header, name).ok_or_else(|| malformed(format!("its header has no {name}")))?;
    value.parse().map_err(|_| malformed(format!("its header has the invalid value {name} = {value:?}")))
}

/// A number with a meaning, or the name of that meaning; zero if it is missing.
fn code(header: &[(String, String)], name: &str) -> io::Result<u8> {
    let value = find(header, name).unwrap_or("0").to_uppercase();
    let named = TYPES.iter().position(|it| *it == value).and_then(|it| u8::try_from(it).ok());
    match (value.as_str(), named) {
        ("NULL" | "NONE", _) => Ok(0),
        (_, Some(code)) => Ok(code),
        _ => number(header, name),
    }
}

/// A height in a text.
fn height(word: &str, numbers: Option<SdfNumber>, is_iso: bool) -> io::Result<f64> {
    if word.eq_ignore_ascii_case("BAD") {
        return Ok(f64::NAN);
    }
    let value = word.parse().map_err(|_| malformed(format!("its heights contain {word:?}")))?;
    Ok(numbers.map_or(value, |it| it.known(value, is_iso)))
}

/// The trailer, if it is text that says anything.
fn remarks(trailer: &str) -> Option<(String, String)> {
    let said = trailer.trim().trim_end_matches('*').trim();
    let is_text = !said.is_empty() && !said.contains(|letter: char| letter.is_control() && !letter.is_whitespace());
    is_text.then(|| ("Trailer".to_owned(), said.to_owned()))
}

/// A file of fixed fields.
fn binary(bytes: &[u8]) -> io::Result<Channel<'_>> {
    let mut at = ByteReader::new(bytes);
    let header = ["Version", "ManufacID", "CreateDate", "ModDate"].into_iter().zip([8, 10, 12, 12]);
    let mut header: Vec<_> =
        header.map(|(name, length)| Ok((name.to_owned(), at.text(length)?))).collect::<io::Result<_>>()?;
    let is_long = bytes.get(1..).is_some_and(|rest| rest.starts_with(b"ISO-2"));
    let mut count = || if is_long { at.u32().map(i64::from) } else { at.u16().map(i64::from) };
    let [columns, rows] = [count()?, count()?];
    let scale = [at.f64()?, at.f64()?, at.f64()?];
    header.push(("Zresolution".to_owned(), at.f64()?.to_string()));
    let [compression, kind, check] = [at.u8()?, at.u8()?, at.u8()?];
    let (numbers, is_iso) = (numbers(kind)?, is_iso(bytes));
    let [ny, nx] = nodes(rows, columns, numbers.size, at.rest().len())?;
    let rest = heights(at.rest(), ny * nx * numbers.size);
    let trailer = rest.get(ny * nx * numbers.size..).unwrap_or_default();
    let is_text = trailer.iter().all(|byte| matches!(*byte, 0 | b'\t' | b'\n' | b'\r' | b' '..=b'~'));
    let doubts = left_over(if is_text { 0 } else { trailer.len() }, "the heights").into_iter().collect();
    header.extend(remarks(&latin(trailer)));
    let value = move |bytes| Ok(numbers.known((numbers.read)(ByteReader::new(bytes))?, is_iso));
    let values = move || rest.chunks_exact(numbers.size).take(ny * nx).map(value).collect();
    let shape = [rows, columns];
    let channel = Header { shape, scale, compression, check, header }.channel(numbers.size, rest.len(), values)?;
    Ok(Channel { doubts, ..channel })
}

/// A number of bytes of heights and the trailer, without anything that a writer puts before them.
fn heights(rest: &[u8], length: usize) -> &[u8] {
    rest.strip_prefix(&SUPERFLUOUS).filter(|rest| rest.len() == length).unwrap_or(rest)
}

/// Numbers of one type: their bytes, how one is read, and the ends of their range, the lower one of an unsigned type apart.
#[derive(Clone, Copy)]
struct SdfNumber {
    size: usize,
    read: fn(ByteReader) -> io::Result<f64>,
    least: Option<f64>,
    most: f64,
}

impl SdfNumber {
    /// A number, NaN if it is void.
    fn known(&self, value: f64, is_iso: bool) -> f64 {
        let is_void = match self.least {
            Some(least) if is_iso => value <= least,
            _ => value >= self.most,
        };
        if is_void { f64::NAN } else { value }
    }
}

/// The numbers of a type by its code.
fn numbers(kind: u8) -> io::Result<SdfNumber> {
    let of = |size, read: fn(ByteReader) -> io::Result<f64>, least, most| Ok(SdfNumber { size, read, least, most });
    match kind {
        0 => of(1, |mut it| it.u8().map(f64::from), None, u8::MAX.into()),
        1 => of(2, |mut it| it.u16().map(f64::from), None, u16::MAX.into()),
        2 => of(4, |mut it| it.u32().map(f64::from), None, u32::MAX.into()),
        3 => of(4, |mut it| it.f32().map(f64::from), Some(f32::MIN.into()), 3.4e38_f32.into()),
        4 => of(1, |mut it| it.u8().map(|it| f64::from(it as i8)), Some(i8::MIN.into()), i8::MAX.into()),
        5 => of(2, |mut it| it.i16().map(f64::from), Some(i16::MIN.into()), i16::MAX.into()),
        6 => of(4, |mut it| it.i32().map(f64::from), Some(i32::MIN.into()), i32::MAX.into()),
        7 => of(8, |mut it| it.f64(), Some(f64::MIN), 1.7e308),
        _ => Err(malformed(format!("its heights are of the type {kind}, which ISO 25178-71 does not know"))),
    }
}
