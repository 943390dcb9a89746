//! NumPy's `.npz`, an archive of arrays.

use super::format::{Format, ReadSeek, malformed};
use super::npy;
use crate::files::check_text;
use crc32fast::Hasher;
use std::io::{self, BufRead, BufReader, Read, SeekFrom};
use std::ops::Range;

/// An array of an archive, such as a result.
pub(super) const FORMAT: Format = Format {
    is_it: is_archive,
    shape: |file, wanted| member(file, wanted.name).and_then(|place| npy::shape(file, place, wanted)),
    read: |file, wanted| whole_member(file, wanted.name).and_then(|place| npy::read(file, place, wanted)),
};

/// The start of an archive and of each of its members.
const MARK: [u8; 4] = *b"PK\x03\x04";
/// Names of arrays at the most, for people to choose from.
const MOST: usize = 64;
/// Bytes before the name of a member.
const HEAD: usize = 30;
/// Bytes that are read at a time.
const READ: usize = 1 << 16;

/// Whether a file is an archive.
pub(super) fn is_archive(file: &mut dyn ReadSeek) -> bool {
    let mut start = [0; MARK.len()];
    file.rewind().and_then(|()| file.read_exact(&mut start)).is_ok() && start == MARK
}

/// Whether a file is an archive whose first member is an array: other archives are those of instruments.
pub(super) fn holds_arrays(file: &mut dyn ReadSeek) -> bool {
    let mut head = [0; HEAD];
    let is_read = is_archive(file) && file.rewind().and_then(|()| file.read_exact(&mut head)).is_ok();
    let mut name = vec![0; number(&head[26..28]) as usize];
    is_read && file.read_exact(&mut name).is_ok() && name.ends_with(b".npy")
}

/// The text that an archive carries as an array of bytes.
pub(super) fn text(file: &mut dyn ReadSeek, name: &str) -> io::Result<String> {
    let place = member(file, name)?;
    let (_, start) = npy::header(file, &place)?;
    check_text(place.end - start)?;
    whole_member(file, name)?;
    let mut text = String::new();
    file.seek(SeekFrom::Start(start))?;
    file.take(place.end - start).read_to_string(&mut text)?;
    Ok(text)
}

/// The bytes of a member within an archive.
///
/// # Errors
/// The names of all arrays, where there is none of that name, and the errors of [`find_member`].
fn member(file: &mut dyn ReadSeek, name: &str) -> io::Result<Range<u64>> {
    Ok(named_member(file, name)?.place)
}

/// The bytes of a member within an archive, which are as they were written.
///
/// # Errors
/// The reason, where they fail their check sum, and the errors of [`member`].
fn whole_member(file: &mut dyn ReadSeek, name: &str) -> io::Result<Range<u64>> {
    let Member { place, sum, .. } = named_member(file, name)?;
    file.seek(SeekFrom::Start(place.start))?;
    match check_sum((&mut *file).take(place.end - place.start))? == sum {
        true => Ok(place),
        false => Err(malformed(format!("its array `{name}` is damaged: it fails its check sum"))),
    }
}

fn check_sum(bytes: impl Read) -> io::Result<u32> {
    let (mut bytes, mut sum) = (BufReader::with_capacity(READ, bytes), Hasher::new());
    loop {
        let part = bytes.fill_buf()?;
        sum.update(part);
        match part.len() {
            0 => return Ok(sum.finalize()),
            count => bytes.consume(count),
        }
    }
}

fn named_member(file: &mut dyn ReadSeek, name: &str) -> io::Result<Member> {
    match find_member(file, name)? {
        Some(member) => Ok(member),
        None => {
            let names = names(file)?.join(", ");
            Err(malformed(format!("it is an archive without the array `{name}`: it contains {names}")))
        }
    }
}

/// The member of an archive, if it has one of that name. Nothing of a claimed size is allocated.
///
/// # Errors
/// The reason, where the member is compressed, or the archive is cut short.
pub(super) fn find_member(file: &mut dyn ReadSeek, name: &str) -> io::Result<Option<Member>> {
    let mut at = 0;
    while let Some(member) = next(file, at)? {
        if member.array.as_deref() == Some(name) {
            return match member.is_stored {
                true => Ok(Some(member)),
                false => Err(malformed("it is compressed: save it with numpy.savez")),
            };
        }
        at = member.place.end;
    }
    Ok(None)
}

/// The names of all arrays of an archive, at most [`MOST`].
///
/// # Errors
/// The reason, where the archive is cut short.
pub(super) fn names(file: &mut dyn ReadSeek) -> io::Result<Vec<String>> {
    let (mut names, mut at) = (Vec::new(), 0);
    while let Some(member) = next(file, at)?.filter(|_| names.len() < MOST) {
        names.extend(member.array);
        at = member.place.end;
    }
    Ok(names)
}

/// A member of an archive.
pub(super) struct Member {
    /// The name, if it is an array.
    array: Option<String>,
    place: Range<u64>,
    /// Whether it is not compressed.
    is_stored: bool,
    /// Its check sum.
    sum: u32,
}

/// The member that begins at a place, if one does.
fn next(file: &mut dyn ReadSeek, at: u64) -> io::Result<Option<Member>> {
    let cut_short = |error: io::Error| malformed(format!("it is a damaged archive ({error})"));
    let bytes = file.seek(SeekFrom::End(0))?;
    let mut head = [0; HEAD];
    let is_read = file.seek(SeekFrom::Start(at)).and_then(|_| file.read_exact(&mut head)).is_ok();
    if !is_read || head[..MARK.len()] != MARK {
        return Ok(None);
    }
    let mut found = vec![0; number(&head[26..28]) as usize];
    let mut extra = vec![0; number(&head[28..30]) as usize];
    file.read_exact(&mut found).and_then(|()| file.read_exact(&mut extra)).map_err(cut_short)?;
    let start = at + (HEAD + found.len() + extra.len()) as u64;
    let size = match number(&head[18..22]) {
        size if size == u64::from(u32::MAX) => long_size(&extra),
        size => Some(size),
    };
    let end = size.and_then(|size| start.checked_add(size)).filter(|&end| end <= bytes);
    let is_plain = head[6] & 0b1001 == 0;
    let cut = || malformed("it is an archive that is incomplete, encrypted or streamed");
    let end = end.filter(|_| is_plain).ok_or_else(cut)?;
    let array = found.strip_suffix(b".npy").map(|name| String::from_utf8_lossy(name).into_owned());
    let (is_stored, sum) = (number(&head[8..10]) == 0, number(&head[14..18]) as u32);
    Ok(Some(Member { array, place: start..end, is_stored, sum }))
}

/// The size of a member that does not fit 32 bits, from what stands beside its name.
fn long_size(mut extra: &[u8]) -> Option<u64> {
    loop {
        let (kind, size) = (extra.get(..2)?, number(extra.get(2..4)?) as usize);
        match number(kind) {
            1 => return extra.get(12..20).map(number),
            _ => extra = extra.get(4 + size..)?,
        }
    }
}

/// A number whose lowest byte comes first.
fn number(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |number, &byte| number << 8 | u64::from(byte))
}
