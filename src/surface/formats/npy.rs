//! NumPy's `.npy`.

use super::format::{Format, malformed};
use ndarray::ArrayD;
use ndarray_npy::npy::header::Header;
use ndarray_npy::{ReadNpyError, ReadNpyExt};
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::ops::Range;

/// Bytes at the start of a file that must hold the whole header; NumPy writes 128.
const HEADER_BYTES: u64 = 4096;

/// An array that fills the file.
pub(super) const FORMAT: Format = Format {
    is_it: |_| true,
    shape: |file| whole(file).and_then(|place| shape(file, place)),
    read: |file| whole(file).and_then(|place| read(file, place)),
};

fn whole(file: &File) -> io::Result<Range<u64>> {
    Ok(0..file.metadata()?.len())
}

/// The shape of the heights at a place in a file.
pub(super) fn shape(file: &mut File, place: Range<u64>) -> io::Result<Vec<usize>> {
    Ok(layout(file, place)?.0)
}

/// The heights at a place in a file.
pub(super) fn read(file: &mut File, place: Range<u64>) -> io::Result<ArrayD<f64>> {
    let (_, is_single) = layout(file, place.clone())?;
    file.seek(SeekFrom::Start(place.start))?;
    let bytes = BufReader::new(file.take(place.end - place.start));
    let heights = if is_single {
        ArrayD::<f32>::read_npy(bytes).map(|heights| heights.mapv(f64::from))
    } else {
        ArrayD::<f64>::read_npy(bytes)
    };
    heights.map_err(|error| match error {
        ReadNpyError::Io(source) => source,
        other => malformed(other.to_string()),
    })
}

/// The shape of heights, and whether they are singles: type, rank and length are checked before anything of the claimed size
/// is allocated.
fn layout(file: &mut File, place: Range<u64>) -> io::Result<(Vec<usize>, bool)> {
    let (header, start) = header(file, &place)?;
    let kind = header.type_descriptor.to_string();
    let size = match kind.trim_matches(['\'', '"', '<', '>', '=']) {
        "f8" => 8,
        "f4" => 4,
        _ => return Err(malformed(format!("it holds values of type {kind}, save float64 or float32"))),
    };
    let rank = header.shape.len();
    if !(1..=2).contains(&rank) {
        return Err(malformed(format!("its array has rank {rank}, save rank 1 (a line) or 2 (a surface)")));
    }
    let data = place.end - start;
    let expected = header.shape.iter().try_fold(size, |product: u64, &n| product.checked_mul(n as u64));
    match expected {
        Some(expected) if expected == data => Ok((header.shape, size == 4)),
        _ => {
            let shape = header.shape;
            Err(malformed(format!("it holds {data} bytes of data, which is not what its shape {shape:?} needs")))
        }
    }
}

/// The header of an array, and where the data after it start.
pub(super) fn header(file: &mut File, place: &Range<u64>) -> io::Result<(Header, u64)> {
    let mut start = Vec::new();
    let most = HEADER_BYTES.min(place.end - place.start);
    file.seek(SeekFrom::Start(place.start))?;
    file.take(most).read_to_end(&mut start)?;
    let mut rest = start.as_slice();
    let header = Header::from_reader(&mut rest).map_err(|error| malformed(format!("it is no .npy file ({error})")))?;
    Ok((header, place.start + (start.len() - rest.len()) as u64))
}
