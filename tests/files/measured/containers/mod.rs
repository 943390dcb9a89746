//! Small files of instruments, written here after the formats' descriptions, but for those of HDF5.

pub mod gwy;
pub mod hdf5;
pub mod mnt;
pub mod netcdf;
pub mod plux;
pub mod sur;
pub mod x3p;
pub mod xlsx;
pub mod zon;

use std::io::{Cursor, Write};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// Rows and columns of the files.
pub const SHAPE: [usize; 2] = [4, 5];
/// Row and column of the point that is void.
pub const VOID: [usize; 2] = [1, 3];
/// What writes a file.
pub type Writer = fn() -> Vec<u8>;
/// All files, by names for people.
pub const ALL: &[(&str, Writer)] = &[
    ("datx", hdf5::zygo),
    ("datx in fringes", hdf5::fringes),
    ("netcdf 4", hdf5::scales),
    ("gwy", gwy::file),
    ("mnt", mnt::file),
    ("mnt of 16 bits", mnt::short),
    ("netcdf of CDF-1", netcdf::file),
    ("netcdf of CDF-5", netcdf::wide),
    ("netcdf of a profile", netcdf::profile),
    ("plux", plux::file),
    ("sur", sur::file),
    ("sur of 16 bits", sur::short),
    ("sur of two compressed objects", sur::packed),
    ("sur of a profile", sur::profile),
    ("x3p", x3p::file),
    ("x3p of integers", x3p::integers),
    ("x3p of a list", x3p::list),
    ("x3p of an uneven profile", x3p::profile),
    ("xlsx of an uneven profile", xlsx::file),
    ("zon", zon::file),
];

/// The height at a point, a whole number that no other point has.
pub fn height(ix: usize, iy: usize) -> f64 {
    (100 + 7 * ix + 40 * iy * iy) as f64
}

/// Rows and columns of the points, row by row.
pub fn points() -> impl Iterator<Item = [usize; 2]> {
    (0..SHAPE[0]).flat_map(|iy| (0..SHAPE[1]).map(move |ix| [iy, ix]))
}

/// Heights row by row, another one in place of the void point.
pub fn heights(void: f64) -> impl Iterator<Item = f64> {
    points().map(move |[iy, ix]| if [iy, ix] == VOID { void } else { height(ix, iy) })
}

/// An archive of files by their names.
pub fn zipped(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        archive.start_file(*name, SimpleFileOptions::default()).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}
