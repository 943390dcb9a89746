//! Plain text: a number a line, a matrix, or positions and heights.

use super::format::{ArrayRequest, Format, ReadSeek, malformed};
use super::table::TextTable;
use ndarray::ArrayD;
use std::io::{self, Read};

/// A [`TextTable`] of numbers: of one column or row a line, else a matrix, row by row.
pub(super) const FORMAT: Format =
    Format { is_it: is_text, shape: |file, wanted| Ok(read(file, wanted)?.shape().to_vec()), read };

/// Number of bytes from the start of a file that are checked to distinguish text from binary data.
const START: u64 = 4096;

/// Whether a file begins with text, in any encoding of one byte for each letter of ours.
fn is_text(file: &mut dyn ReadSeek) -> bool {
    let mut start = Vec::new();
    let is_read = file.rewind().is_ok() && file.take(START).read_to_end(&mut start).is_ok();
    is_read && !start.is_empty() && !start.iter().any(is_control)
}

/// Whether a byte stands in no text.
fn is_control(byte: &u8) -> bool {
    *byte < b'\t'
}

fn read(file: &mut dyn ReadSeek, _: &ArrayRequest) -> io::Result<ArrayD<f64>> {
    let mut bytes = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    if bytes.iter().any(is_control) {
        return Err(malformed("it is neither a .npy file nor a text file"));
    }
    let table = TextTable::from_text(&String::from_utf8_lossy(&bytes))?;
    let array = match table.shape() {
        [n, 1] | [1, n] => ArrayD::from_shape_vec(vec![n], table.values),
        shape => ArrayD::from_shape_vec(shape.to_vec(), table.values),
    };
    array.map_err(|error| malformed(error.to_string()))
}
