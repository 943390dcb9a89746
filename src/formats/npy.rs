//! NumPy's `.npy`.

use super::format::{ArrayRequest, EMPTY, Format, ReadSeek, malformed};
use super::limits::{NPY_HEADER, check_brackets};
use ndarray::{ArrayD, ArrayViewD};
use ndarray_npy::npy::header::Header;
use ndarray_npy::{ReadNpyError, ReadNpyExt, ReadableElement, WriteNpyError, WriteNpyExt};
use std::io::{self, BufReader, Read, SeekFrom, Write};
use std::ops::Range;
use strum::EnumString;

/// What every file begins with.
const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// An array that fills the file.
pub(super) const FORMAT: Format = Format {
    is_it: |_| true,
    shape: |file, wanted| whole(file).and_then(|place| shape(file, place, wanted)),
    read: |file, wanted| whole(file).and_then(|place| read(file, place, wanted)),
};

fn whole(file: &mut dyn ReadSeek) -> io::Result<Range<u64>> {
    Ok(0..file.seek(SeekFrom::End(0))?)
}

/// Whether a file begins like an array.
pub(super) fn is_array(file: &mut dyn ReadSeek) -> bool {
    let mut magic = [0; 6];
    file.rewind().and_then(|()| file.read_exact(&mut magic)).is_ok() && magic == *MAGIC
}

/// The shape of the array at a place in a file.
pub(super) fn shape(file: &mut dyn ReadSeek, place: Range<u64>, wanted: &ArrayRequest) -> io::Result<Vec<usize>> {
    Ok(layout(file, place, wanted)?.0)
}

/// The array at a place in a file.
pub(super) fn read(file: &mut dyn ReadSeek, place: Range<u64>, wanted: &ArrayRequest) -> io::Result<ArrayD<f64>> {
    let (_, kind) = layout(file, place.clone(), wanted)?;
    file.seek(SeekFrom::Start(place.start))?;
    let bytes = BufReader::new(file.take(place.end - place.start));
    let array = match kind {
        Dtype::F8 => ArrayD::<f64>::read_npy(bytes),
        Dtype::F4 => widened::<f32>(bytes),
        Dtype::I1 => widened::<i8>(bytes),
        Dtype::I2 => widened::<i16>(bytes),
        Dtype::I4 => widened::<i32>(bytes),
        Dtype::I8 => ArrayD::<i64>::read_npy(bytes).map(|array| array.mapv(|value| value as f64)),
        Dtype::U1 => widened::<u8>(bytes),
        Dtype::U2 => widened::<u16>(bytes),
        Dtype::U4 => widened::<u32>(bytes),
        Dtype::U8 => ArrayD::<u64>::read_npy(bytes).map(|array| array.mapv(|value| value as f64)),
    };
    array.map_err(|error| match error {
        ReadNpyError::Io(source) => source,
        other => malformed(other.to_string()),
    })
}

fn widened<T: ReadableElement + Copy + Into<f64>>(bytes: impl Read) -> Result<ArrayD<f64>, ReadNpyError> {
    Ok(ArrayD::<T>::read_npy(bytes)?.mapv(Into::into))
}

/// Writes an array of doubles.
pub(super) fn write(array: ArrayViewD<f64>, file: impl Write) -> io::Result<()> {
    array.write_npy(file).map_err(|error| match error {
        WriteNpyError::Io(source) => source,
        other => io::Error::other(other),
    })
}

/// A type of numbers, by its name in NumPy without the order of its bytes; the digit says how many they are.
#[derive(Clone, Copy, EnumString)]
#[strum(serialize_all = "lowercase")]
enum Dtype {
    F8,
    F4,
    I1,
    I2,
    I4,
    I8,
    U1,
    U2,
    U4,
    U8,
}

/// The shape of an array and its type: type, rank and length are checked before anything of the claimed size is allocated.
fn layout(file: &mut dyn ReadSeek, place: Range<u64>, wanted: &ArrayRequest) -> io::Result<(Vec<usize>, Dtype)> {
    let (header, start) = header(file, &place)?;
    let name = header.type_descriptor.to_string();
    let plain = name.trim_matches(['\'', '"', '<', '>', '=', '|']);
    let (Ok(kind), Some(size)) = (plain.parse::<Dtype>(), plain.chars().last().and_then(|last| last.to_digit(10)))
    else {
        return Err(malformed(format!("its values have the type {name}: save integers, float32 or float64")));
    };
    let rank = header.shape.len();
    if !wanted.ranks.contains(&rank) {
        let ranks = match wanted.ranks.end() {
            2 => "rank 1 (a line) or 2 (a surface)",
            _ => "rank 1 or 2 (one step), or one more (several)",
        };
        return Err(malformed(format!("its array has rank {rank}: save {ranks}")));
    }
    let data = place.end - start;
    let expected = header.shape.iter().try_fold(u64::from(size), |product: u64, &n| product.checked_mul(n as u64));
    match expected {
        Some(expected) if expected == data => Ok((header.shape, kind)),
        _ => {
            let shape = header.shape;
            Err(malformed(format!("it has {data} bytes of data, but its shape {shape:?} needs a different number")))
        }
    }
}

/// Bytes up to the end of the header as its start states them, which the reader of headers would allocate at once: two bytes for their
/// number in version 1, and four in later ones.
fn stated_header(start: &[u8]) -> Option<u64> {
    let [version, _, rest @ ..] = start.strip_prefix(MAGIC)? else { return None };
    let counts = rest.get(..if *version == 1 { 2 } else { 4 })?;
    let number = counts.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte));
    Some(8 + counts.len() as u64 + number)
}

/// The header of an array, and where the data after it start.
pub(super) fn header(file: &mut dyn ReadSeek, place: &Range<u64>) -> io::Result<(Header, u64)> {
    let mut start = Vec::new();
    let most = NPY_HEADER.min(place.end - place.start);
    if most == 0 {
        return Err(malformed(EMPTY));
    }
    file.seek(SeekFrom::Start(place.start))?;
    file.take(most).read_to_end(&mut start)?;
    let stated = stated_header(&start).filter(|stated| *stated > start.len() as u64);
    if let Some(stated) = stated {
        let found = place.end - place.start;
        return Err(malformed(format!(
            "it is not a valid .npy file: it states a header of {stated} bytes, but it has {found} in all and headers of at most \
             {NPY_HEADER} are read"
        )));
    }
    let header_end = stated_header(&start).map_or(start.len(), |stated| stated as usize);
    check_brackets(&start[..header_end])?;
    let mut rest = start.as_slice();
    let header = Header::from_reader(&mut rest).map_err(|error| {
        let why = error.to_string(); // a syntax error draws where it is, from an arrow on
        let why = why.split("-->").next().unwrap_or_default().trim_end_matches([':', ' ', '\n']);
        malformed(format!("it is not a valid .npy file ({why})"))
    })?;
    Ok((header, place.start + (start.len() - rest.len()) as u64))
}
