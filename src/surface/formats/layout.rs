//! What is known of heights in a file before they are read.

use super::Measurement;
use super::npy;
use super::npz;
use super::read_shape;
use crate::error::FileError;
use std::fs::File;
use std::path::Path;

/// Shape and spacing of the heights in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Rows and columns; a profile has one row.
    pub shape: [usize; 2],
    /// Whether it is a profile, not a map of one row.
    pub is_profile: bool,
    /// Distances of neighbours along y and x, of uneven positions their mean; none where the file does not say.
    pub spacing: Option<[f64; 2]>,
    /// Whether distances and heights are metres: if not, the file does not say its units.
    pub is_in_metres: bool,
    /// Whether all positions of a profile are evenly spaced.
    pub is_even: bool,
}

impl Layout {
    /// The layout of a file like those that [`Measurement::read`] reads; of a NumPy array by its header alone.
    ///
    /// # Errors
    /// The errors of [`Measurement::read`].
    pub fn read(path: impl AsRef<Path>, channel: Option<&str>) -> Result<Self, FileError> {
        let path = path.as_ref();
        match *if is_array(path) { read_shape(path)? } else { Vec::new() } {
            [ny, nx] => {
                Ok(Self { shape: [ny, nx], is_profile: false, spacing: None, is_in_metres: false, is_even: true })
            }
            _ => Ok(Measurement::read(path, channel)?.layout()),
        }
    }
}

/// Whether a file is a NumPy array or an archive of such.
pub(super) fn is_array(path: &Path) -> bool {
    File::open(path).is_ok_and(|mut file| npz::holds_arrays(&mut file) || npy::is_array(&mut file))
}
