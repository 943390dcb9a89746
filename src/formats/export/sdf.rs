//! The text of ISO 25178-71.

use super::file_writer::FileWriter;
use crate::formats::Scan;
use std::io::{self, Write};

/// Writes a text of ISO-1.0 with heights in metres, whose unit is 1 and whose voids are `BAD`. The dates of the header are those of a file
/// that does not record them, all zeros, so that the same heights are the same file; a profile has no distance of rows.
///
/// # Source
/// ISO 25178-71:2017, as the program sdfio 2.0 renders it.
pub(super) fn write(scan: &Scan, file: &mut FileWriter) -> io::Result<()> {
    let ([rows, points], [dy, dx]) = (scan.shape(), scan.spacing);
    let dy = if scan.is_line() { 0.0 } else { dy };
    write!(file, "aISO-1.0\r\nManufacID = asperity\r\nCreateDate = 000000000000\r\nModDate = 000000000000\r\n")?;
    write!(file, "NumPoints = {points}\r\nNumProfiles = {rows}\r\nXscale = {dx:e}\r\nYscale = {dy:e}\r\n")?;
    write!(file, "Zscale = 1\r\nZresolution = -1\r\nCompression = 0\r\nDataType = 7\r\nCheckType = 0\r\n*\r\n")?;
    for row in scan.height.rows() {
        for (x, height) in row.iter().enumerate() {
            let gap = if x == 0 { "" } else { " " };
            if height.is_finite() { write!(file, "{gap}{height:e}") } else { write!(file, "{gap}BAD") }?;
        }
        write!(file, "\r\n")?;
    }
    write!(file, "*\r\n")
}
