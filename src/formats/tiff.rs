//! The pages of TIFF files.

use super::bytes::{ByteReader, nodes};
use super::format::malformed;
use super::limits::{STRIPS, TAG_BYTES, TAG_TEXT, check_channels};
use super::number_type::NumberType;
use std::io;

/// What files begin with, the least or the most significant byte of a number first.
const MAGICS: [&[u8]; 2] = [b"II*\0", b"MM\0*"];

/// Tags of the layout of an image.
const COLUMNS: u16 = 256;
const ROWS: u16 = 257;
const BITS: u16 = 258;
const COMPRESSION: u16 = 259;
const PLACES: u16 = 273;
const SAMPLES: u16 = 277;
const LENGTHS: u16 = 279;
const SAMPLE_FORMAT: u16 = 339;

/// A page of a file, whose tags have numbers, types and values.
pub(super) struct TiffPage<'a> {
    tags: Vec<Tag<'a>>,
    file: ByteReader<'a>,
}

/// A tag, whose values are not read before they are asked for.
struct Tag<'a> {
    number: u16,
    kind: u16,
    values: ByteReader<'a>,
}

/// Whether bytes begin as a TIFF file.
pub(super) fn is_tiff(bytes: &[u8]) -> bool {
    MAGICS.iter().any(|magic| bytes.starts_with(magic))
}

/// All pages of a file.
///
/// # Errors
/// For places beyond the end, for more pages than can be read, and for pages that share their tags, as those of a ring do.
pub(super) fn pages(bytes: &[u8]) -> io::Result<Vec<TiffPage<'_>>> {
    let file = ByteReader::new(bytes).big_endian(bytes.starts_with(MAGICS[1]));
    let mut next = file.seek(4)?.u32()?;
    let (mut pages, mut left) = (Vec::new(), bytes.len() / TAG_BYTES);
    while next != 0 {
        let mut at = file.seek(next as usize)?;
        let count = at.u16()?;
        left = left.checked_sub(usize::from(count)).ok_or_else(|| malformed("its pages share their tags"))?;
        let tags = (0..count).map(|_| tag(file, &mut at)).collect::<io::Result<_>>()?;
        pages.push(TiffPage { tags, file });
        check_channels(pages.len())?;
        next = at.u32()?;
    }
    Ok(pages)
}

/// The next tag. Values of up to four bytes stand in it, others where it says.
fn tag<'a>(file: ByteReader<'a>, at: &mut ByteReader<'a>) -> io::Result<Tag<'a>> {
    let [number, kind] = [at.u16()?, at.u16()?];
    let length = (at.u32()? as usize).saturating_mul(size(kind));
    let mut inside = at.part(4)?;
    let values = if length <= 4 { inside.part(length)? } else { file.seek(inside.u32()? as usize)?.part(length)? };
    Ok(Tag { number, kind, values })
}

/// Bytes of a value of a type.
fn size(kind: u16) -> usize {
    match kind {
        3 | 8 => 2,
        4 | 9 | 11 => 4,
        5 | 10 | 12 => 8,
        _ => 1,
    }
}

impl<'a> TiffPage<'a> {
    fn tag(&self, number: u16) -> Option<&Tag<'a>> {
        self.tags.iter().find(|it| it.number == number)
    }

    /// The text of a tag, as far as [`TAG_TEXT`] goes.
    pub(crate) fn text(&self, number: u16) -> Option<String> {
        let mut values = self.tag(number)?.values;
        values.text(values.rest().len().min(TAG_TEXT)).ok()
    }

    /// The numbers of a tag, read one by one.
    fn numbers(&self, number: u16) -> impl Iterator<Item = f64> {
        let (kind, mut values) = match self.tag(number) {
            Some(tag) => (tag.kind, tag.values),
            None => (0, ByteReader::new(&[])),
        };
        let kind = match kind {
            3 => NumberType::U16,
            4 => NumberType::U32,
            6 => NumberType::I8,
            8 => NumberType::I16,
            9 => NumberType::I32,
            11 => NumberType::F32,
            12 => NumberType::F64,
            _ => NumberType::U8,
        };
        std::iter::from_fn(move || kind.read(&mut values).ok())
    }

    /// The first number of a tag.
    pub(crate) fn number(&self, number: u16) -> Option<f64> {
        self.numbers(number).next()
    }

    /// The image of a page.
    ///
    /// # Errors
    /// For an image that is compressed, has colours or other numbers than those of [`NumberType`], or fewer bytes than points.
    pub(crate) fn image(&self) -> io::Result<TiffImage<'a>> {
        let value = |number: u16, default: f64| self.number(number).unwrap_or(default) as i64;
        if value(COMPRESSION, 1.0) != 1 || value(SAMPLES, 1.0) != 1 {
            return Err(malformed("its images are compressed or have colours: save them without"));
        }
        let kind = match (value(BITS, 1.0), value(SAMPLE_FORMAT, 1.0)) {
            (8, 1) => NumberType::U8,
            (16, 1) => NumberType::U16,
            (16, 2) => NumberType::I16,
            (32, 1) => NumberType::U32,
            (32, 2) => NumberType::I32,
            (32, 3) => NumberType::F32,
            (64, 3) => NumberType::F64,
            (bits, _) => {
                return Err(malformed(format!("its images have {bits} bits per point of a kind that is not read")));
            }
        };
        if self.numbers(PLACES).nth(STRIPS).is_some() {
            return Err(malformed(format!("its images have more than {STRIPS} strips")));
        }
        let strip = |(place, length): (f64, f64)| self.file.seek(place as usize)?.part(length as usize);
        let strips =
            self.numbers(PLACES).zip(self.numbers(LENGTHS)).map(strip).collect::<io::Result<Vec<ByteReader>>>()?;
        let bytes = strips.iter().map(|it| it.rest().len()).sum::<usize>().min(self.file.seek(0)?.rest().len());
        let shape = nodes(value(ROWS, 0.0), value(COLUMNS, 0.0), kind.size(), bytes)?;
        Ok(TiffImage { shape, kind, strips })
    }
}

/// The points of a page.
pub(super) struct TiffImage<'a> {
    /// Rows and columns.
    pub shape: [usize; 2],
    kind: NumberType,
    strips: Vec<ByteReader<'a>>,
}

impl TiffImage<'_> {
    /// All numbers row by row.
    pub(crate) fn numbers(self) -> io::Result<Vec<f64>> {
        let Self { shape, kind, strips } = self;
        let read = |mut strip: ByteReader| {
            (0..strip.rest().len() / kind.size()).map(|_| kind.read(&mut strip)).collect::<io::Result<Vec<_>>>()
        };
        let mut numbers = Vec::new();
        for strip in strips {
            if numbers.len() < shape[0] * shape[1] {
                numbers.extend(read(strip)?);
            }
        }
        numbers.truncate(shape[0] * shape[1]);
        Ok(numbers)
    }
}
