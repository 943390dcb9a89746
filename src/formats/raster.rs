//! Maps as they stand in binary data.

use super::bytes::{ByteReader, nodes};
use super::number_type::NumberType;
use std::io;

/// The points of a map, row by row as numbers of one type.
#[derive(Clone, Copy)]
pub(super) struct ChannelRaster<'a> {
    /// Rows and columns.
    pub shape: [usize; 2],
    kind: NumberType,
    points: ByteReader<'a>,
}

impl<'a> ChannelRaster<'a> {
    /// The next points, rows of columns.
    ///
    /// # Errors
    /// For counts that are not positive, and for more points than bytes.
    pub(crate) fn new(at: &mut ByteReader<'a>, kind: NumberType, [rows, columns]: [i64; 2]) -> io::Result<Self> {
        let shape = nodes(rows, columns, kind.size(), at.rest().len())?;
        Ok(Self { shape, kind, points: at.part(shape[0] * shape[1] * kind.size())? })
    }

    /// All numbers in the order of the file.
    pub(crate) fn numbers(self) -> io::Result<Vec<f64>> {
        let mut at = self.points;
        (0..self.shape[0] * self.shape[1]).map(|_| self.kind.read(&mut at)).collect()
    }

    /// All numbers of a map whose last row stands first in the file.
    pub(crate) fn numbers_from_below(self) -> io::Result<Vec<f64>> {
        Ok(from_below(&self.numbers()?, self.shape[1]))
    }
}

/// The rows of so many columns in the opposite order.
pub(super) fn from_below(numbers: &[f64], columns: usize) -> Vec<f64> {
    numbers.chunks(columns).rev().flatten().copied().collect()
}
