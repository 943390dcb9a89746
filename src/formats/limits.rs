//! What a file may ask for: memory for its points, and the lengths, numbers and depths of what it describes.
//!
//! A file may come from anywhere. Whatever a reader makes room for, unpacks, or walks through in more than linear time is checked against a limit of this
//! file first. Packed data are opened by [`archive`](super::archive) and [`zlib`](super::zlib) alone, and documents by [`archive`](super::archive).

use super::format::malformed;
use crate::memory::check_room;
use std::io;

/// Fields of doubles that are needed to read heights and prepare them: those of the file, copies that are kept, and what a step makes of them.
const FIELDS: usize = 5;
/// Points for which there is always memory.
const FEW_POINTS: usize = 1 << 20;

/// The largest number of bytes that one byte of a stream of zlib can unpack to, by its compression.
#[cfg(feature = "instruments")]
pub(super) const LARGEST_RATIO: usize = 1032;

/// Bytes that every description in an archive may have.
#[cfg(feature = "instruments")]
pub(super) const SHORT_TEXT: u64 = 1 << 16;
/// The most bytes of a description: per byte of its archive, and in all. A list of ten million points as text has fewer.
#[cfg(feature = "instruments")]
const TEXT_RATIO: u64 = 64;
#[cfg(feature = "instruments")]
const LONGEST_TEXT: u64 = 1 << 27;
/// The most nodes of a document in XML: each takes about a hundred bytes of memory.
#[cfg(feature = "instruments")]
pub(super) const XML_NODES: u32 = 1 << 22;
/// The most attributes of an element, and spaces of names of a document: the time that they take grows with their square.
#[cfg(feature = "instruments")]
pub(super) const XML_ATTRIBUTES: usize = 1024;

/// The most channels that a file may have if it can state any number of them, each with a header of its own.
#[cfg(feature = "microscopes")]
const CHANNELS: usize = 64;

/// The most groups within each other in a file of HDF5: paths of all its datasets then have at most as many times the bytes of the file.
#[cfg(feature = "microscopes")]
pub(super) const HDF5_DEPTH: usize = 32;
/// The most links of the groups of a file of HDF5, which lead to groups and datasets. A soft link may lead through a thousand others: the worst
/// file with 256 of them (10 kB) takes 1.6 seconds.
#[cfg(feature = "microscopes")]
pub(super) const HDF5_LINKS: u64 = 256;
/// The most bytes of the header of a dataset or group of HDF5. Attributes of more than 64 kB are stored elsewhere.
#[cfg(feature = "microscopes")]
pub(super) const HDF5_OBJECT_HEADER: usize = 1 << 20;

/// The most bytes of the text of a tag. Many tags of a file may share one text, so that a short file would hold any number of long ones.
#[cfg(feature = "microscopes")]
pub(super) const TAG_TEXT: usize = 1 << 14;
/// Bytes of a tag of a TIFF file. All pages together have at most as many tags as fit the file, so that no page is read over and over.
#[cfg(feature = "microscopes")]
pub(super) const TAG_BYTES: usize = 12;
/// The most strips of an image.
#[cfg(feature = "microscopes")]
pub(super) const STRIPS: usize = 1 << 16;

/// The most nodes below the triangles of a body, summed over the triangles: their heights take some ten seconds then. A map of 2048 x 2048 corners has
/// 2^26 of them.
pub(super) const STEPS_OVER_TRIANGLES: f64 = (1_u64 << 31) as f64;

/// Bytes at the start of a file of NumPy that must hold the whole header; NumPy writes 128.
pub(super) const NPY_HEADER: u64 = 4096;
/// The most brackets around each other in such a header. The time of its parser doubles with each; the header of a structured array has three.
const NPY_BRACKETS: usize = 6;

/// Checks the number of points that a file states before anything is unpacked or allocated for them.
///
/// # Errors
/// For more points than there is memory for.
pub(super) fn check_points(shape: &[usize]) -> io::Result<()> {
    let points = shape.iter().fold(1, |product: usize, n| product.saturating_mul(*n));
    if points <= FEW_POINTS {
        return Ok(());
    }
    let needed = (FIELDS * size_of::<f64>()) as f64 * points as f64;
    check_room(needed).map_err(|room| {
        let points = shape.iter().map(usize::to_string).collect::<Vec<_>>().join(" x ");
        malformed(format!("its {points} points do not fit in memory: they need {room}: save fewer points"))
    })
}

/// Bytes that a description in an archive of some length may have.
#[cfg(feature = "instruments")]
pub(super) fn text_limit(length: u64) -> u64 {
    LONGEST_TEXT.min(SHORT_TEXT + TEXT_RATIO.saturating_mul(length))
}

/// Refuses a file that states more channels than can be read.
///
/// # Errors
/// For too many channels.
#[cfg(feature = "microscopes")]
pub(super) fn check_channels(count: usize) -> io::Result<()> {
    match count {
        ..=CHANNELS => Ok(()),
        _ => Err(malformed(format!("it contains {count} channels, but at most {CHANNELS} are read"))),
    }
}

/// Refuses the header of a file of NumPy with brackets in brackets.
///
/// # Errors
/// For more than a header can have.
pub(super) fn check_brackets(header: &[u8]) -> io::Result<()> {
    let (mut depth, mut most) = (0_usize, 0);
    for byte in header {
        match byte {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            _ => (),
        }
        most = most.max(depth);
    }
    match most {
        ..=NPY_BRACKETS => Ok(()),
        _ => Err(malformed(format!(
            "it is not a valid .npy file: its header has {most} brackets around each other, and at most {NPY_BRACKETS} are read"
        ))),
    }
}
