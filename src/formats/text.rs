//! Plain text: a number a line, a matrix, or positions and heights.

use super::bytes::decoded;
use super::format::{ArrayRequest, Format, ReadSeek, malformed};
use super::table::TextTable;
use crate::files::read_whole;
use ndarray::ArrayD;
use std::io::{self, Read};

/// A [`TextTable`] of numbers: of one column or row a line, else a matrix, row by row.
pub(super) const FORMAT: Format =
    Format { is_it: begins_with_text, shape: |file, wanted| Ok(read(file, wanted)?.shape().to_vec()), read };

/// Number of bytes from the start of a file that are checked to distinguish text from binary data.
const START: u64 = 4096;
/// The characters that stand in no text come before this one.
const FIRST: char = '\t';

/// Whether bytes begin with text: in UTF-16 with a mark of the order of its bytes, or in any encoding of one byte for each letter of ours.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(START as usize)];
    !start.is_empty() && !decoded(start).contains(|letter| letter < FIRST)
}

fn begins_with_text(file: &mut dyn ReadSeek) -> bool {
    let mut start = Vec::new();
    let is_read = file.rewind().is_ok() && file.take(START).read_to_end(&mut start).is_ok();
    is_read && is_text(&start)
}

fn read(file: &mut dyn ReadSeek, _: &ArrayRequest) -> io::Result<ArrayD<f64>> {
    let text = decoded(&read_whole(file)?);
    if text.contains(|letter| letter < FIRST) {
        return Err(malformed("it is neither a .npy file nor a text file"));
    }
    let table = TextTable::from_text(&text)?;
    let array = match table.shape() {
        [n, 1] | [1, n] => ArrayD::from_shape_vec(vec![n], table.values),
        shape => ArrayD::from_shape_vec(shape.to_vec(), table.values),
    };
    array.map_err(|error| malformed(error.to_string()))
}
