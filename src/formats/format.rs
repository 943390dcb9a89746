//! The interface of formats of files of heights and other fields.

use crate::sentence::Sentence;
use ndarray::ArrayD;
use std::io::{self, Read, Seek};
use std::ops::RangeInclusive;

/// What a file is read from: one on disk, or its bytes in memory.
pub(crate) trait ReadSeek: Read + Seek {}

impl<T: Read + Seek> ReadSeek for T {}

/// The array that is wanted of a file.
pub(crate) struct ArrayRequest<'a> {
    /// What it holds, and its name in an archive.
    pub name: &'a str,
    /// The ranks that it may have.
    pub ranks: RangeInclusive<usize>,
}

/// A format of files of arrays. Errors of the kind [`io::ErrorKind::InvalidData`] say what is wrong with a file.
pub(crate) struct Format {
    /// Whether a file is of this format.
    pub is_it: fn(&mut dyn ReadSeek) -> bool,
    /// The shape of the array. It is not read if a header states the shape.
    pub shape: fn(&mut dyn ReadSeek, &ArrayRequest) -> io::Result<Vec<usize>>,
    /// The array.
    pub read: fn(&mut dyn ReadSeek, &ArrayRequest) -> io::Result<ArrayD<f64>>,
}

/// The fault of a file without a single byte.
pub(crate) const EMPTY: &str = "it is empty";

/// An error that describes the fault of a file.
pub(crate) fn malformed(reason: impl Into<Sentence>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, reason.into())
}
