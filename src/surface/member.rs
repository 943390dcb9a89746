//! Members of `.npz` archives.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::ops::Range;

/// The start of an archive and of each of its members.
const MARK: [u8; 4] = *b"PK\x03\x04";
/// Bytes before the name of a member.
const HEAD: usize = 30;

/// Whether a file is an archive.
pub fn is_archive(file: &mut File) -> bool {
    let mut start = [0; MARK.len()];
    file.rewind().and_then(|()| file.read_exact(&mut start)).is_ok() && start == MARK
}

/// The bytes of a member within an archive. Nothing of a claimed size is allocated.
///
/// # Errors
/// The reason, where there is no such member, or it is compressed, or the archive is cut short.
pub fn find_member(file: &mut File, name: &str) -> Result<Range<u64>, String> {
    let missing = || format!("it is an archive without the array `{name}`");
    let cut_short = |error: std::io::Error| format!("it is a broken archive ({error})");
    let bytes = file.metadata().map_err(cut_short)?.len();
    let mut at = 0;
    loop {
        let mut head = [0; HEAD];
        file.seek(SeekFrom::Start(at)).and_then(|_| file.read_exact(&mut head)).map_err(|_| missing())?;
        if head[..MARK.len()] != MARK {
            return Err(missing());
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
        at = end.filter(|_| is_plain).ok_or("it is an archive that is cut short, encrypted or streamed")?;
        if found.strip_suffix(b".npy") == Some(name.as_bytes()) {
            let is_stored = number(&head[8..10]) == 0;
            return if is_stored { Ok(start..at) } else { Err("it is compressed: save it by numpy.savez".into()) };
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::FileError;
    use crate::surface::read_heights;
    use ndarray::{arr1, arr2};
    use ndarray_npy::{NpzWriter, WriteNpyExt};
    use std::path::Path;

    fn reason(path: &Path) -> String {
        match read_heights(path) {
            Err(FileError::Format { reason, .. }) => reason,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn heights_are_read_from_archives_and_broken_ones_say_why() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.npz");
        let mut npz = NpzWriter::new(File::create(&path).unwrap());
        let heights = arr2(&[[1.0, 2.5], [3.0, -4.0]]);
        npz.add_array("setup", &arr1(b"text")).unwrap();
        npz.add_array("height", &heights).unwrap();
        npz.finish().unwrap();
        assert_eq!(read_heights(&path).unwrap(), heights.into_dyn());
        let whole = std::fs::read(&path).unwrap();
        let end_of_heights = find_member(&mut File::open(&path).unwrap(), "height").unwrap().end as usize;
        for length in 0..end_of_heights {
            std::fs::write(&path, &whole[..length]).unwrap();
            assert!(!reason(&path).is_empty(), "{length}");
        }
        for place in 0..end_of_heights {
            let mut other = whole.clone();
            other[place] ^= 0xff;
            std::fs::write(&path, &other).unwrap();
            let _ = read_heights(&path);
        }
        let mut npz = NpzWriter::new(File::create(&path).unwrap());
        npz.add_array("pressure", &arr1(&[1.0])).unwrap();
        npz.finish().unwrap();
        assert!(reason(&path).contains("without the array `height`"));
    }

    #[test]
    fn sizes_of_members_may_be_long_as_numpy_writes_them() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.npz");
        let mut array = Vec::new();
        arr1(&[1.0, 2.0]).write_npy(&mut array).unwrap();
        let size = (array.len() as u64).to_le_bytes();
        let extra = [&[9, 0, 1, 0, 7, 1, 0, 16, 0][..], &size, &size].concat();
        let mut head = [MARK.as_slice(), &[0; 14], &[0xff; 8], &[10, 0, extra.len() as u8, 0], b"height.npy"].concat();
        head.extend(extra.iter().chain(&array));
        std::fs::write(&path, &head).unwrap();
        assert_eq!(read_heights(&path).unwrap(), arr1(&[1.0, 2.0]).into_dyn());
        head[8] = 8;
        std::fs::write(&path, &head).unwrap();
        assert!(reason(&path).contains("compressed"));
    }
}
