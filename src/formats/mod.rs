//! Files of heights and other fields, whose format is recognised from their content.

mod al3d;
#[cfg(feature = "instruments")]
mod archive;
#[cfg(feature = "instruments")]
mod axis;
#[cfg(feature = "microscopes")]
mod bcr;
mod bytes;
mod cdf;
mod cells;
mod channel;
mod columns;
#[cfg(feature = "microscopes")]
mod compound;
mod coordinates;
#[cfg(feature = "microscopes")]
mod datx;
#[cfg(feature = "microscopes")]
mod entries;
mod export;
mod format;
#[cfg(feature = "microscopes")]
mod frt;
mod gwy;
#[cfg(feature = "microscopes")]
mod hdf5;
#[cfg(feature = "microscopes")]
mod hdf5_file;
mod height_file;
#[cfg(feature = "microscopes")]
mod hfm;
#[cfg(feature = "microscopes")]
mod ibw;
mod instrument;
#[cfg(feature = "microscopes")]
mod jpk;
mod layout;
mod limits;
mod measurement;
#[cfg(feature = "microscopes")]
mod metropro;
#[cfg(feature = "microscopes")]
mod mi;
#[cfg(feature = "microscopes")]
mod mnt;
mod nanoscope;
mod netcdf;
#[cfg(feature = "microscopes")]
mod nid;
mod npy;
mod npz;
#[cfg(feature = "microscopes")]
mod number_type;
mod numbers;
mod opd;
#[cfg(feature = "microscopes")]
mod opdx;
mod plu;
#[cfg(feature = "microscopes")]
mod plux;
#[cfg(feature = "microscopes")]
mod png_image;
mod points;
mod profile;
#[cfg(feature = "microscopes")]
mod raster;
mod remarks;
mod said;
mod scan;
mod sdf;
#[cfg(feature = "instruments")]
mod sur;
mod table;
mod text;
#[cfg(feature = "microscopes")]
mod tiff;
#[cfg(feature = "microscopes")]
mod tiff_image;
#[cfg(feature = "microscopes")]
mod tmd;
mod triangles;
mod unit;
#[cfg(feature = "microscopes")]
mod vk4;
mod void;
#[cfg(feature = "microscopes")]
mod wsxm;
mod wyko_text;
#[cfg(feature = "instruments")]
mod x3p;
#[cfg(feature = "microscopes")]
mod xlsx;
#[cfg(feature = "instruments")]
mod zlib;
#[cfg(feature = "microscopes")]
mod zon;
mod zygo_text;

pub use height_file::HeightFile;
pub use layout::{FileUnits, Layout};
pub use measurement::Measurement;
pub use npz::MemberSum;
pub use scan::Scan;
pub(crate) use scan::overflowing;

use crate::error::{FileError, reason};
use crate::files::{open_regular, write_beside};
use format::{ArrayRequest, Format, ReadSeek};
use instrument::Instrument;
use ndarray::{Array1, ArrayD, ArrayViewD};
use std::io;
use std::path::Path;

/// All formats; the last one accepts every file, and explains why it cannot be read.
static FORMATS: [Format; 3] = [npz::FORMAT, text::FORMAT, npy::FORMAT];

/// All formats of instruments, of which the first that fits is taken: texts of numbers come last.
const INSTRUMENTS: &[Instrument] = &[
    al3d::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    bcr::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    frt::INSTRUMENT,
    gwy::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    ibw::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    jpk::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    png_image::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    tiff_image::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    metropro::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    mi::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    hfm::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    mnt::INSTRUMENT,
    nanoscope::INSTRUMENT,
    netcdf::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    datx::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    hdf5::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    nid::INSTRUMENT,
    opd::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    opdx::INSTRUMENT,
    plu::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    plux::INSTRUMENT,
    sdf::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    tmd::INSTRUMENT,
    triangles::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    vk4::INSTRUMENT,
    #[cfg(feature = "instruments")]
    sur::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    wsxm::INSTRUMENT,
    #[cfg(feature = "instruments")]
    x3p::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    xlsx::INSTRUMENT,
    #[cfg(feature = "microscopes")]
    zon::INSTRUMENT,
    wyko_text::INSTRUMENT,
    zygo_text::INSTRUMENT,
    numbers::INSTRUMENT,
];

/// Heights of a line or a surface.
const HEIGHTS: ArrayRequest<'static> = ArrayRequest { name: "height", ranks: 1..=2 };

/// Reads heights from a NumPy `.npy` file of integers, singles or doubles, of rank 1 (a line) or 2 (rows of a surface), in C or
/// Fortran order and either byte order; from the array `height` of an `.npz` archive, such as a result; or from a text of
/// numbers, in one column or row (a line) or in a matrix (rows of a surface). Two columns or rows hold positions and heights of a
/// line, and the positions must be evenly spaced.
///
/// # Errors
/// [`FileError::Read`] for a file that is missing or unreadable; [`FileError::Format`] with the reason for one that is
/// no such file, is truncated, or holds another type or rank.
pub fn read_heights(path: impl AsRef<Path>) -> Result<ArrayD<f64>, FileError> {
    read_field(path, HEIGHTS.name)
}

/// The heights of arrays like [`read_heights`], and the positions beside them, evenly spaced or not, if there are any.
fn profile_of(arrays: &mut dyn ReadSeek, name: &str) -> io::Result<(ArrayD<f64>, Option<Array1<f64>>)> {
    (format(arrays).read)(arrays, &ArrayRequest { name, ..HEIGHTS }).map(profile::split)
}

/// The shape of the heights of arrays, as their header says.
fn shape_of(arrays: &mut dyn ReadSeek, name: &str) -> io::Result<Vec<usize>> {
    (format(arrays).shape)(arrays, &ArrayRequest { name, ..HEIGHTS }).map(profile::shape)
}

/// Reads a field such as `pressure` like [`read_heights`], from the array of that name of an archive.
///
/// # Errors
/// The errors of [`read_heights`].
pub fn read_field(path: impl AsRef<Path>, name: &'static str) -> Result<ArrayD<f64>, FileError> {
    let wanted = ArrayRequest { name, ..HEIGHTS };
    with_file(path.as_ref(), &wanted, |file, format| (format.read)(file, &wanted).and_then(profile::heights))
}

/// Reads an array of rank 3 at the most, from the array `name` of an archive: fields of one step, or of several along a first axis.
///
/// # Errors
/// The errors of [`read_heights`].
pub fn read_fields(path: impl AsRef<Path>, name: &'static str) -> Result<ArrayD<f64>, FileError> {
    let wanted = ArrayRequest { name, ranks: 0..=3 };
    with_file(path.as_ref(), &wanted, |file, format| (format.read)(file, &wanted))
}

/// The shape of what [`read_fields`] reads, as the header of the file says if it has one, and fits its length.
///
/// # Errors
/// The errors of [`read_fields`].
pub fn read_fields_shape(path: impl AsRef<Path>, name: &'static str) -> Result<Vec<usize>, FileError> {
    let wanted = ArrayRequest { name, ranks: 0..=3 };
    with_file(path.as_ref(), &wanted, |file, format| (format.shape)(file, &wanted))
}

/// Whether a file is an archive with the array `name`.
///
/// # Errors
/// [`FileError::Read`] for a file that cannot be read, [`FileError::Format`] for an archive that is cut short.
pub fn has_field(path: impl AsRef<Path>, name: &'static str) -> Result<bool, FileError> {
    let wanted = ArrayRequest { name, ranks: 0..=3 };
    let is_there = |file: &mut dyn ReadSeek| Ok(npz::is_archive(file) && npz::find_member(file, name)?.is_some());
    with_file(path.as_ref(), &wanted, |file, _| is_there(file))
}

/// The shape of the heights in a file, as its header says if it has one.
///
/// # Errors
/// The errors of [`read_heights`].
pub fn read_shape(path: impl AsRef<Path>) -> Result<Vec<usize>, FileError> {
    with_file(path.as_ref(), &HEIGHTS, |file, _| shape_of(file, HEIGHTS.name))
}

/// Reads the text that an archive carries as an array of bytes; none from any other file.
///
/// # Errors
/// [`FileError::Read`] for a file that cannot be read, [`FileError::Format`] with the reason for an archive without that text.
pub fn read_text(path: impl AsRef<Path>, name: &str) -> Result<Option<String>, FileError> {
    let path = path.as_ref();
    let mut file = open_regular(path).map_err(|source| FileError::Read { path: path.into(), source })?;
    npz::is_archive(&mut file)
        .then(|| npz::text(&mut file, name))
        .transpose()
        .map_err(|error| explained(path, HEIGHTS.name, error))
}

/// The check sums of all arrays of an archive, in their order, after all of its bytes were held against them.
///
/// # Errors
/// [`FileError::Read`] for a file that cannot be read, [`FileError::Format`] for an archive that is damaged or cut short.
pub fn read_member_sums(path: impl AsRef<Path>) -> Result<Vec<MemberSum>, FileError> {
    let path = path.as_ref();
    let mut file = open_regular(path).map_err(|source| FileError::Read { path: path.into(), source })?;
    npz::sums(&mut file).map_err(|error| explained(path, HEIGHTS.name, error))
}

/// Reads what is wanted of a file by its format.
fn with_file<T>(
    path: &Path,
    wanted: &ArrayRequest<'static>,
    read: impl FnOnce(&mut dyn ReadSeek, &Format) -> io::Result<T>,
) -> Result<T, FileError> {
    let opened = open_regular(path).and_then(|mut file| {
        let format = format(&mut file);
        read(&mut file, format)
    });
    opened.map_err(|error| explained(path, wanted.name, error))
}

/// The format of arrays.
fn format(source: &mut dyn ReadSeek) -> &'static Format {
    FORMATS.iter().find(|format| (format.is_it)(source)).unwrap_or(&npy::FORMAT)
}

fn explained(path: &Path, what: &'static str, error: io::Error) -> FileError {
    match error.kind() {
        io::ErrorKind::InvalidData => FileError::Format { path: path.into(), what, reason: reason(&error) },
        _ => FileError::Read { path: path.into(), source: error },
    }
}

/// Writes heights (or any field) as a NumPy `.npy` file of doubles.
///
/// # Errors
/// The errors of [`write_beside`].
///
/// ```
/// use asperity::formats::{read_heights, write_heights};
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("heights.npy");
/// let heights = ndarray::arr1(&[0.0, 1.0, 0.5, -1.0]).into_dyn();
/// write_heights(&path, heights.view())?;
/// assert_eq!(read_heights(&path)?, heights);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_heights(path: impl AsRef<Path>, heights: ArrayViewD<f64>) -> Result<(), FileError> {
    write_beside(path.as_ref(), |file| npy::write(heights, file))
}
