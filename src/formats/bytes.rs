//! Binary data, read from its start without ever going beyond its end.

use super::format::malformed;
use super::limits::check_points;
use crate::sentence::sentence;
use std::io;

/// Bytes of a file with the place in them.
#[derive(Clone, Copy)]
pub(super) struct ByteReader<'a> {
    all: &'a [u8],
    at: usize,
    /// Whether the first byte of a number is the most significant one.
    is_big: bool,
}

impl<'a> ByteReader<'a> {
    pub(crate) fn new(all: &'a [u8]) -> Self {
        Self { all, at: 0, is_big: false }
    }

    /// The same bytes, the first byte of a number the most significant one or not.
    #[cfg(feature = "microscopes")]
    pub(crate) fn big_endian(self, is_big: bool) -> Self {
        Self { is_big, ..self }
    }

    /// The place of the next byte.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// The bytes at another place.
    ///
    /// # Errors
    /// For a place beyond the end.
    pub(crate) fn seek(mut self, at: usize) -> io::Result<Self> {
        if at > self.all.len() {
            return Err(malformed(sentence!(
                "it refers to byte {at}, but has only {length} bytes: it is incomplete",
                at,
                length = self.all.len()
            )));
        }
        self.at = at;
        Ok(self)
    }

    /// All bytes that are left.
    pub(crate) fn rest(&self) -> &'a [u8] {
        &self.all[self.at..]
    }

    /// The next `count` bytes.
    ///
    /// # Errors
    /// For fewer bytes than that.
    pub(crate) fn take(&mut self, count: usize) -> io::Result<&'a [u8]> {
        let cut =
            || malformed(sentence!("{count} bytes are missing at byte {at}: it is incomplete", count, at = self.at));
        let taken = self.at.checked_add(count).and_then(|end| self.all.get(self.at..end)).ok_or_else(cut)?;
        self.at += count;
        Ok(taken)
    }

    /// The next `count` bytes apart from the others.
    ///
    /// # Errors
    /// For fewer bytes than that.
    #[cfg(feature = "microscopes")]
    pub(crate) fn part(&mut self, count: usize) -> io::Result<Self> {
        Ok(Self { all: self.take(count)?, at: 0, ..*self })
    }

    /// The next bytes as an array.
    fn array<const N: usize>(&mut self) -> io::Result<[u8; N]> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    /// The next `count` bytes as text up to the first zero, without white space around it.
    ///
    /// # Errors
    /// For fewer bytes than that.
    pub(crate) fn text(&mut self, count: usize) -> io::Result<String> {
        let bytes = self.take(count)?;
        let text = bytes.split(|byte| *byte == 0).next().unwrap_or_default();
        Ok(latin(text).trim().to_owned())
    }
}

/// The statement that bytes are left over behind something, if there are any.
pub(super) fn left_over(count: usize, behind: &str) -> Option<String> {
    (count > 0).then(|| format!("{count} unexpected bytes follow {behind}"))
}

/// Readers of numbers of one type, the first byte the least significant one if nothing else is asked for.
macro_rules! numbers {
    ($($kind:ident)*) => {
        impl ByteReader<'_> {
            $(
                pub(crate) fn $kind(&mut self) -> io::Result<$kind> {
                    let bytes = self.array()?;
                    Ok(if self.is_big { $kind::from_be_bytes(bytes) } else { $kind::from_le_bytes(bytes) })
                }
            )*
        }
    };
}

numbers!(u8 u16 u32 i16 i32 i64 f32 f64);
#[cfg(feature = "microscopes")]
numbers!(u64 i8);

/// A text in UTF-8 or, if it is none, in Latin-1.
pub(super) fn latin(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|byte| char::from(*byte)).collect(),
    }
}

/// A text in UTF-16 with a mark of the order of its bytes, or else like [`latin`].
pub(super) fn decoded(bytes: &[u8]) -> String {
    let of_pairs = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
        char::decode_utf16(units).map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => of_pairs(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => of_pairs(rest, u16::from_be_bytes),
        _ => latin(bytes),
    }
}

/// The nodes of a map of `columns` by `rows`, each of `size` bytes, if they fit into `bytes` and their heights into memory.
///
/// # Errors
/// For counts that are not positive, for more nodes than bytes, and for more than there is memory for.
pub(super) fn nodes(rows: i64, columns: i64, size: usize, bytes: usize) -> io::Result<[usize; 2]> {
    let shape = [usize::try_from(rows), usize::try_from(columns)];
    let [Ok(ny @ 1..), Ok(nx @ 1..)] = shape else {
        return Err(malformed(format!("it states {rows} rows of {columns} points")));
    };
    match ny.checked_mul(nx).and_then(|n| n.checked_mul(size)) {
        Some(needed) if needed <= bytes => check_points(&[ny, nx]).map(|()| [ny, nx]),
        _ => Err(malformed(format!("it states {rows} rows of {columns} points, but has {bytes} bytes for them"))),
    }
}
