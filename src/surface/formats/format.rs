//! The interface of formats of height files.

use ndarray::ArrayD;
use std::fs::File;
use std::io;

/// A format of height files. Errors of the kind [`io::ErrorKind::InvalidData`] say what is wrong with a file.
pub struct Format {
    /// Whether a file is of this format.
    pub is_it: fn(&mut File) -> bool,
    /// The shape of the heights, without reading them where a header tells.
    pub shape: fn(&mut File) -> io::Result<Vec<usize>>,
    /// The heights.
    pub read: fn(&mut File) -> io::Result<ArrayD<f64>>,
}

/// An error that says what is wrong with a file.
pub fn malformed(reason: impl Into<String>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, reason.into())
}
