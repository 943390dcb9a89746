//! Streams in compound documents, which are file systems within a file.

use super::bytes::ByteReader;
use super::format::malformed;
use std::io;

/// What a compound document begins with.
pub(super) const MAGIC: &[u8] = &[0xd0, 0xcf, 0x11, 0xe0, 0xa1, 0xb1, 0x1a, 0xe1];
/// Places of sectors of the table of sectors that the header itself has, and where they are.
const FIRST: usize = 109;
const FIRST_PLACE: usize = 76;
/// Numbers of sectors from here on are marks, such as the end of a chain.
const MARKS: u32 = 0xffff_fff0;
/// Bytes of an entry of the directory.
const ENTRY: usize = 128;
/// The type of an entry of a stream.
const STREAM: u8 = 2;

/// The bytes of a stream by its name. Streams that are so small that they share sectors with others are not read.
///
/// # Source
/// "[MS-CFB]: Compound File Binary File Format" (Microsoft).
///
/// # Errors
/// For a stream that is not there or is cut short.
pub(super) fn stream(bytes: &[u8], name: &str) -> io::Result<Vec<u8>> {
    let document = Document::new(bytes)?;
    let directory = document.chain(ByteReader::new(bytes).seek(48)?.u32()?)?;
    let smallest = ByteReader::new(bytes).seek(56)?.u32()? as usize;
    let wanted: Vec<u8> = name.encode_utf16().chain([0]).flat_map(u16::to_le_bytes).collect();
    let is_wanted = |entry: &&[u8]| entry.starts_with(&wanted) && entry[66] == STREAM;
    let entry = directory.chunks_exact(ENTRY).find(is_wanted);
    let mut at = ByteReader::new(entry.ok_or_else(|| malformed(format!("it has no stream {name:?}")))?).seek(116)?;
    let [first, length] = [at.u32()?, at.u32()?];
    let length = length as usize;
    let mut stream = if length < smallest { Vec::new() } else { document.chain(first)? };
    if stream.len() < length {
        return Err(malformed(format!("its stream {name:?} of {length} bytes is incomplete")));
    }
    stream.truncate(length);
    Ok(stream)
}

/// A document and the table that says which sector follows each one.
struct Document<'a> {
    bytes: &'a [u8],
    /// Bytes of a sector.
    size: usize,
    next: Vec<u32>,
}

impl<'a> Document<'a> {
    fn new(bytes: &'a [u8]) -> io::Result<Self> {
        let size = match ByteReader::new(bytes).seek(30)?.u16()? {
            shift @ (9 | 12) => 1 << shift,
            shift => return Err(malformed(format!("its sectors have 2^{shift} bytes, neither 2^9 nor 2^12"))),
        };
        let mut document = Self { bytes, size, next: Vec::new() };
        for place in document.places()? {
            let table = document.sector(place)?;
            document.next.extend(table.chunks_exact(4).map(|it| u32::from_le_bytes([it[0], it[1], it[2], it[3]])));
        }
        Ok(document)
    }

    /// The number of sectors, the last of which may be incomplete.
    fn count(&self) -> usize {
        self.bytes.len().div_ceil(self.size)
    }

    /// The sectors of the table: those in the header, and those in further sectors, each of which ends in the number of the next one.
    fn places(&self) -> io::Result<Vec<u32>> {
        let mut at = ByteReader::new(self.bytes).seek(FIRST_PLACE)?;
        let mut places = (0..FIRST).map(|_| at.u32()).collect::<io::Result<Vec<_>>>()?;
        let mut further = ByteReader::new(self.bytes).seek(68)?.u32()?;
        while further < MARKS && places.len() <= self.count() {
            let mut at = ByteReader::new(self.sector(further)?);
            for _ in 1..self.size / 4 {
                places.push(at.u32()?);
            }
            further = at.u32()?;
        }
        places.retain(|place| *place < MARKS);
        places.truncate(self.count());
        Ok(places)
    }

    fn sector(&self, place: u32) -> io::Result<&'a [u8]> {
        let start = (place as usize).saturating_add(1).saturating_mul(self.size);
        let rest = ByteReader::new(self.bytes).seek(start)?.rest();
        Ok(&rest[..rest.len().min(self.size)])
    }

    /// The bytes of the sectors that follow each other from one on.
    fn chain(&self, first: u32) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let mut place = first;
        while place < MARKS {
            if bytes.len() > self.bytes.len() {
                return Err(malformed("its sectors follow each other in a circle"));
            }
            bytes.extend(self.sector(place)?);
            let next = self.next.get(place as usize).copied();
            place =
                next.ok_or_else(|| malformed(format!("it refers to its sector {place}, which it does not have")))?;
        }
        Ok(bytes)
    }
}
