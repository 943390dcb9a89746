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
/// The start of each entry of the directory behind the members.
const ENTRY_MARK: [u8; 4] = *b"PK\x01\x02";
/// The start of what follows the directory: the end of an archive, and of one with sizes of 64 bits.
const END_MARKS: [[u8; 4]; 2] = [*b"PK\x05\x06", *b"PK\x06\x06"];
/// The most names of arrays that an error shows.
const MOST_NAMES: usize = 64;
/// The most members of an archive: more of them need sizes of 64 bits, and NumPy writes one for each array.
const MOST_MEMBERS: usize = u16::MAX as usize;
/// Bytes before the name of a member, and of an entry of the directory.
const HEAD: usize = 30;
const ENTRY_HEAD: usize = 46;
/// A size or a place that needs 64 bits, where there are 32: it stands elsewhere.
const LONG: u64 = u32::MAX as u64;
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

/// The name, the length and the check sum of a member of an archive.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MemberSum {
    /// Its name as an array.
    pub name: String,
    /// Its length in bytes.
    pub bytes: u64,
    /// The CRC-32 of its bytes.
    pub crc: u32,
}

/// The check sums of all arrays of an archive, in their order, each of which its bytes meet.
///
/// # Errors
/// The reason, where bytes fail their check sum, and the errors of [`members`].
pub(super) fn sums(file: &mut dyn ReadSeek) -> io::Result<Vec<MemberSum>> {
    let mut sums = Vec::new();
    for member in members(file)? {
        let Some(name) = member.array() else { continue };
        let name = String::from_utf8_lossy(name).into_owned();
        let bytes = member.place.end - member.place.start;
        file.seek(SeekFrom::Start(member.place.start))?;
        if check_sum((&mut *file).take(bytes))? != member.sum {
            return Err(malformed(format!("its array `{name}` is damaged: it fails its check sum")));
        }
        sums.push(MemberSum { name, bytes, crc: member.sum });
    }
    Ok(sums)
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
/// The reason, where the member is compressed, and the errors of [`members`].
pub(super) fn find_member(file: &mut dyn ReadSeek, name: &str) -> io::Result<Option<Member>> {
    match members(file)?.into_iter().find(|member| member.array() == Some(name.as_bytes())) {
        Some(member) if !member.is_stored => Err(malformed("it is compressed: save it with numpy.savez")),
        found => Ok(found),
    }
}

/// The names of all arrays of an archive, at most [`MOST_NAMES`].
///
/// # Errors
/// The errors of [`members`].
pub(super) fn names(file: &mut dyn ReadSeek) -> io::Result<Vec<String>> {
    let members = members(file)?;
    let arrays = members.iter().filter_map(Member::array);
    Ok(arrays.take(MOST_NAMES).map(|name| String::from_utf8_lossy(name).into_owned()).collect())
}

/// A member of an archive.
pub(super) struct Member {
    name: Vec<u8>,
    /// Where its head begins.
    at: u64,
    place: Range<u64>,
    /// Whether it is not compressed.
    is_stored: bool,
    /// Its check sum.
    sum: u32,
}

impl Member {
    /// Its name as an array, if it is one.
    fn array(&self) -> Option<&[u8]> {
        self.name.strip_suffix(b".npy")
    }
}

/// The members of an archive, which are those of its directory.
///
/// The directory stands at the end, so that an archive that was cut has none. Both places hold each name: without the comparison, an array whose
/// name is damaged would seem absent, and a reader would take the default for it.
///
/// # Errors
/// The reason, where the archive is cut short or damaged.
fn members(file: &mut dyn ReadSeek) -> io::Result<Vec<Member>> {
    let (mut members, mut at) = (Vec::new(), 0);
    while let Some(member) = next(file, at)? {
        at = member.place.end;
        members.push(member);
        if members.len() > MOST_MEMBERS {
            return Err(malformed(format!("it is an archive of more than {MOST_MEMBERS} files")));
        }
    }
    file.seek(SeekFrom::Start(at))?;
    let mut directory = BufReader::new(file);
    for member in &members {
        check_entry(&mut directory, member)?;
    }
    let mut mark = [0; 4];
    match directory.read_exact(&mut mark) {
        Ok(()) if END_MARKS.contains(&mark) => Ok(members),
        _ => Err(malformed(DAMAGED_DIRECTORY)),
    }
}

/// What is said of an archive whose directory is not there, or not that of its members.
const DAMAGED_DIRECTORY: &str = "it is a damaged archive: it was cut, or the list of its arrays at its end is not that of the arrays in it; copy the \
                                 file again";

/// Checks that the next entry of the directory is that of a member.
fn check_entry(directory: &mut impl Read, member: &Member) -> io::Result<()> {
    let damaged = |_| malformed(DAMAGED_DIRECTORY);
    let mut head = [0; ENTRY_HEAD];
    directory.read_exact(&mut head).map_err(damaged)?;
    let [name, extra, comment] = [28, 30, 32].map(|at| number(&head[at..at + 2]));
    let mut rest = Vec::new();
    directory.take(name + extra + comment).read_to_end(&mut rest)?;
    let is_or_long = |at: usize, value: u64| [value, LONG].contains(&number(&head[at..at + 4]));
    let is_same = head.starts_with(&ENTRY_MARK)
        && rest.len() as u64 == name + extra + comment
        && rest[..name as usize] == member.name
        && number(&head[16..20]) == u64::from(member.sum)
        && is_or_long(20, member.place.end - member.place.start)
        && is_or_long(42, member.at);
    if is_same { Ok(()) } else { Err(malformed(DAMAGED_DIRECTORY)) }
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
    let mut name = vec![0; number(&head[26..28]) as usize];
    let mut extra = vec![0; number(&head[28..30]) as usize];
    file.read_exact(&mut name).and_then(|()| file.read_exact(&mut extra)).map_err(cut_short)?;
    let start = at + (HEAD + name.len() + extra.len()) as u64;
    let size = match number(&head[18..22]) {
        LONG => long_size(&extra),
        size => Some(size),
    };
    let end = size.and_then(|size| start.checked_add(size)).filter(|&end| end <= bytes);
    let is_plain = head[6] & 0b1001 == 0;
    let cut = || malformed("it is an archive that is incomplete, encrypted or streamed");
    let end = end.filter(|_| is_plain).ok_or_else(cut)?;
    let (is_stored, sum) = (number(&head[8..10]) == 0, number(&head[14..18]) as u32);
    Ok(Some(Member { name, at, place: start..end, is_stored, sum }))
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
