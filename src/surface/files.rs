//! Height files.

use super::member::{find_member, is_archive};
use crate::error::FileError;
use crate::files::write_beside;
use ndarray::{ArrayD, ArrayViewD};
use ndarray_npy::npy::header::Header;
use ndarray_npy::{ReadNpyError, ReadNpyExt, WriteNpyError, WriteNpyExt};
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::Path;

/// The array of an archive that holds the heights.
const MEMBER: &str = "height";

/// Bytes at the start of a file that must hold the whole `.npy` header; NumPy writes 128.
const HEADER_BYTES: u64 = 4096;

/// Reads heights from a NumPy `.npy` file of doubles (`float64`) or singles (`float32`), of rank 1 (a line) or 2 (rows
/// of a surface), in C or Fortran order and either byte order; or from the array `height` of an `.npz` archive, such as a
/// result.
///
/// # Errors
/// [`FileError::Read`] for a file that is missing or unreadable; [`FileError::Format`] with the reason for one that is
/// no such file, is truncated, or holds another type or rank.
pub fn read_heights(path: impl AsRef<Path>) -> Result<ArrayD<f64>, FileError> {
    let path = path.as_ref();
    let unreadable = |source| FileError::Read { path: path.into(), source };
    let (mut file, layout) = open(path)?;
    file.seek(SeekFrom::Start(layout.place.start)).map_err(unreadable)?;
    let bytes = BufReader::new(file.take(layout.place.end - layout.place.start));
    let heights = if layout.is_single {
        ArrayD::<f32>::read_npy(bytes).map(|heights| heights.mapv(f64::from))
    } else {
        ArrayD::<f64>::read_npy(bytes)
    };
    heights.map_err(|error| match error {
        ReadNpyError::Io(source) => unreadable(source),
        other => FileError::Format { path: path.into(), reason: other.to_string() },
    })
}

/// The shape of the heights in a file, as its header says.
///
/// # Errors
/// The errors of [`read_heights`].
pub fn read_shape(path: impl AsRef<Path>) -> Result<Vec<usize>, FileError> {
    Ok(open(path.as_ref())?.1.shape)
}

/// Reads the text that an archive carries as an array of bytes; none from any other file.
///
/// # Errors
/// [`FileError::Read`] for a file that cannot be read, [`FileError::Format`] with the reason for an archive without that text.
pub fn read_text(path: impl AsRef<Path>, name: &str) -> Result<Option<String>, FileError> {
    let path = path.as_ref();
    let unreadable = |source| FileError::Read { path: path.into(), source };
    let malformed = |reason: String| FileError::Format { path: path.into(), reason };
    let mut file = File::open(path).map_err(unreadable)?;
    if !is_archive(&mut file) {
        return Ok(None);
    }
    let place = find_member(&mut file, name).map_err(malformed)?;
    let (_, start) = header(&mut file, &place).map_err(malformed)?;
    let mut text = String::new();
    file.seek(SeekFrom::Start(start)).map_err(unreadable)?;
    file.take(place.end - start).read_to_string(&mut text).map_err(unreadable)?;
    Ok(Some(text))
}

/// Shape and precision of the heights in a file, and where in it they are.
struct Layout {
    shape: Vec<usize>,
    is_single: bool,
    place: Range<u64>,
}

/// Opens a file whose header is usable.
fn open(path: &Path) -> Result<(File, Layout), FileError> {
    let unreadable = |source| FileError::Read { path: path.into(), source };
    let malformed = |reason| FileError::Format { path: path.into(), reason };
    if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err(malformed("it is a directory or a device, give a .npy file".into()));
    }
    let mut file = File::open(path).map_err(unreadable)?;
    let place = match is_archive(&mut file) {
        true => find_member(&mut file, MEMBER).map_err(malformed)?,
        false => 0..file.metadata().map_err(unreadable)?.len(),
    };
    let layout = layout(&mut file, place).map_err(malformed)?;
    Ok((file, layout))
}

/// Checks type, rank and length before anything of the claimed size is allocated.
fn layout(file: &mut File, place: Range<u64>) -> Result<Layout, String> {
    let (header, start) = header(file, &place)?;
    let kind = header.type_descriptor.to_string();
    let size = match kind.trim_matches(['\'', '"', '<', '>', '=']) {
        "f8" => 8,
        "f4" => 4,
        _ => return Err(format!("it holds values of type {kind}, save float64 or float32")),
    };
    let rank = header.shape.len();
    if !(1..=2).contains(&rank) {
        return Err(format!("its array has rank {rank}, save rank 1 (a line) or 2 (a surface)"));
    }
    let data = place.end - start;
    let expected = header.shape.iter().try_fold(size, |product: u64, &n| product.checked_mul(n as u64));
    match expected {
        Some(expected) if expected == data => Ok(Layout { shape: header.shape, is_single: size == 4, place }),
        _ => Err(format!("it holds {data} bytes of data, which is not what its shape {:?} needs", header.shape)),
    }
}

/// The header of an array, and where the data after it start.
fn header(file: &mut File, place: &Range<u64>) -> Result<(Header, u64), String> {
    let mut start = Vec::new();
    let most = HEADER_BYTES.min(place.end - place.start);
    file.seek(SeekFrom::Start(place.start)).map_err(|error| error.to_string())?;
    file.take(most).read_to_end(&mut start).map_err(|error| error.to_string())?;
    let mut rest = start.as_slice();
    let header = Header::from_reader(&mut rest).map_err(|error| format!("it is no .npy file ({error})"))?;
    Ok((header, place.start + (start.len() - rest.len()) as u64))
}

/// Writes heights (or any field) as a NumPy `.npy` file of doubles.
///
/// # Errors
/// The errors of [`write_beside`].
///
/// ```
/// use asperity::surface::{read_heights, write_heights};
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("heights.npy");
/// let heights = ndarray::arr1(&[0.0, 1.0, 0.5, -1.0]).into_dyn();
/// write_heights(&path, heights.view())?;
/// assert_eq!(read_heights(&path)?, heights);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_heights(path: impl AsRef<Path>, heights: ArrayViewD<f64>) -> Result<(), FileError> {
    write_beside(path.as_ref(), |writer| {
        heights.write_npy(writer).map_err(|error| match error {
            WriteNpyError::Io(source) => source,
            other => io::Error::other(other),
        })
    })
}
