//! The ZON files of Keyence's measuring macroscopes of the series VR.

use super::archive::{self, Archive};
use super::axis::number;
use super::bytes::{ByteReader, left_over, nodes};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use std::io;

/// Four bytes that name the format, a picture, and an archive whose files have fixed names: heights as integers row by row, in a unit that a
/// description in XML says, and marks of points. A row may be followed by bytes that fill it up. A point is void if one of the two lowest bits
/// of its mark is set. Archives of the kind `KPK1`, which are packed twice, are refused.
///
/// # Source
/// SurfaceTopography 1.27 (`ZON.py`), after files that M. Malburg took apart. Files that follow it are read; no file of an instrument has been tried
/// yet.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Keyence ZON", is_it, channels };

/// What files begin with, the second one where all files of the archive are packed once more.
const MAGIC: [&[u8]; 2] = [b"KPK0", b"KPK1"];
/// Names of the files of heights, of marks and of units.
const HEIGHTS: &str = "4cdb0c75-5706-48cc-a9a1-adf395d609ae";
const MARKS: &str = "9e7ca6dd-0e6a-4d7b-8986-f0a7b773c916";
const UNITS: &str = "686613b8-27b5-4a29-8ffc-438c2780873e";
/// Bytes before the points of a file.
const HEAD: usize = 16;
/// The bits of the mark of a void point.
const VOID: u8 = 3;

fn is_it(bytes: &[u8]) -> bool {
    MAGIC.iter().any(|magic| bytes.starts_with(magic))
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    if bytes.starts_with(MAGIC[1]) {
        return Err(malformed(
            "it is of the kind KPK1, whose files are packed twice: export its heights as a table of numbers",
        ));
    }
    let mut archive = archive::open(bytes)?;
    let text = archive::text(&mut archive, UNITS, bytes.len())?;
    let units = archive::document(&text, "description of units")?;
    let unit = |path: &str| {
        let found = number::<f64>(units.root_element(), path)?;
        found.ok_or_else(|| malformed(format!("its description of units has no {path}")))
    };
    let [spacing, unit] = [unit("XYCalibration/MeterPerPixel")?, unit("ZCalibration/MeterPerUnit")?];
    let heights = ZonGrid::new(&mut archive, HEIGHTS, [4, bytes.len()])?;
    let marks =
        archive.index_for_name(MARKS).map(|_| ZonGrid::new(&mut archive, MARKS, [1, bytes.len()])).transpose()?;
    if let Some(marks) = marks.as_ref().filter(|it| it.shape != heights.shape) {
        return Err(malformed(format!("it has marks of {:?} points for {:?} heights", marks.shape, heights.shape)));
    }
    let (shape, doubts) = (heights.shape, heights.doubt().into_iter().collect());
    let values = move || {
        let number = |bytes: &[u8]| ByteReader::new(bytes).i32().map(f64::from);
        let mut values = heights.points(&mut archive, number)?;
        if let Some(marks) = marks {
            let marks = marks.points(&mut archive, |bytes| Ok(bytes[0] & VOID != 0))?;
            values.iter_mut().zip(marks).filter(|(_, is_void)| *is_void).for_each(|(value, _)| *value = f64::NAN);
        }
        Ok(values)
    };
    Ok(vec![Channel {
        spacing: Some([spacing; 2]),
        lateral_unit: Some(1.0),
        unit: Some(unit),
        doubts,
        ..Channel::map("height", shape, values)
    }])
}

/// Points in a file of the archive.
struct ZonGrid {
    name: &'static str,
    shape: [usize; 2],
    /// Bytes of a point and of a row.
    size: usize,
    row: usize,
    /// Bytes of the file.
    length: usize,
}

impl ZonGrid {
    /// The points of a file, each of `size` bytes, in an archive of some length.
    fn new(archive: &mut Archive, name: &'static str, [size, all]: [usize; 2]) -> io::Result<Self> {
        let length = archive::size(archive, name, all)?;
        let head = archive::first(archive, name, HEAD)?;
        let mut at = ByteReader::new(&head);
        let [columns, rows, stated, row] = [at.i32()?, at.i32()?, at.i32()?, at.i32()?].map(i64::from);
        let row_of = usize::try_from(row).unwrap_or(0);
        let shape = nodes(rows, columns, size, length - HEAD)?;
        if stated != size as i64 || row_of < shape[1] * size {
            return Err(malformed(format!(
                "its file {name:?} states {stated} bytes for a point and {row} for a row of {columns} points"
            )));
        }
        nodes(rows, row, 1, length - HEAD)?;
        Ok(Self { name, shape, size, row: row_of, length })
    }

    /// The doubt that there are more points than those stated.
    fn doubt(&self) -> Option<String> {
        left_over(self.length - HEAD - self.shape[0] * self.row, "the heights")
    }

    /// All points row by row.
    fn points<T>(&self, archive: &mut Archive, point: impl Fn(&[u8]) -> io::Result<T>) -> io::Result<Vec<T>> {
        let bytes = archive::first(archive, self.name, HEAD + self.shape[0] * self.row)?;
        let rows = bytes[HEAD..].chunks_exact(self.row);
        rows.flat_map(|row| row.chunks_exact(self.size).take(self.shape[1])).map(point).collect()
    }
}
