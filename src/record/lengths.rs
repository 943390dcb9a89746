//! Lengths in the file of a recording. The decoder makes room for whatever they say, so that they are checked before.
//!
//! # Source
//! `frames.rs` of the crate `re_log_encoding`.

use super::tables;
use std::ops::Range;

/// The mark at the beginning of a file. Pieces of a stream that are joined have one each.
const MARK: &[u8] = b"RRF2";

/// Bytes of the head of a file, and of that of a message: two numbers of 8 bytes, its kind and its length.
const FILE_HEAD: usize = 12;
const MESSAGE_HEAD: usize = 16;

/// Kinds of messages: the last one, and one with data.
const LAST: u64 = 0;
const DATA: u64 = 2;
/// The largest number of a kind. The decoder takes a message of another kind for the end of the file, and leaves out all that follows.
const LARGEST_KIND: u64 = 3;

/// Bytes between the last message and the mark of a piece that follows it.
const FOOT: usize = 32;

/// Where the messages of a file are.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Frames {
    /// The end of the last whole message.
    pub end: usize,
    /// The bytes before the last message of each piece that has an end.
    pub before_last: Vec<Range<usize>>,
}

/// Where the messages of a file are. A file with an end has only whole messages; one without was cut off.
///
/// # Errors
/// A reason, for a length that cannot be.
pub(crate) fn frames(bytes: &[u8], has_end: bool) -> Result<Frames, String> {
    let mut at = FILE_HEAD.min(bytes.len());
    let (mut piece, mut last) = (0, at);
    let (mut before_last, mut unpacked) = (Vec::new(), 0_u64);
    let end = loop {
        if bytes[at..].starts_with(MARK) {
            piece = at;
            at = bytes.len().min(at + FILE_HEAD);
            last = at;
        }
        let Some((kind, length)) = head(&bytes[at..]) else { break at };
        if kind > LARGEST_KIND && has_end {
            return Err("a message is of no known kind".into());
        }
        let message = usize::try_from(length).ok().and_then(|it| bytes[at + MESSAGE_HEAD..].get(..it));
        match (message, kind) {
            (Some(message), LAST) => {
                before_last.push(piece..last);
                at += MESSAGE_HEAD + message.len() + FOOT;
                if !bytes.get(at..).is_some_and(|rest| rest.starts_with(MARK)) {
                    if has_end && at < bytes.len() {
                        return Err("it ends before its last message".into());
                    }
                    break bytes.len();
                }
            }
            (Some(message), _) => {
                if kind == DATA {
                    unpacked += tables::check(message, unpacked)?;
                }
                last = at;
                at += MESSAGE_HEAD + message.len();
            }
            (None, _) if has_end => return Err("a message is longer than the file".into()),
            (None, _) => break at,
        }
    };
    Ok(Frames { end, before_last })
}

/// The kind and the length of the message at the beginning of some bytes.
fn head(bytes: &[u8]) -> Option<(u64, u64)> {
    let (kind, rest) = bytes.split_first_chunk()?;
    Some((u64::from_le_bytes(*kind), u64::from_le_bytes(*rest.first_chunk()?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(bytes: &[u8], has_end: bool) -> Result<usize, String> {
        frames(bytes, has_end).map(|frames| frames.end)
    }

    /// A file with one message with data, which unpacks to a number of bytes.
    fn file(unpacked: &[u8]) -> Vec<u8> {
        let data = [&[0x0a, 1, 7, 0x18][..], unpacked, &[0x2a, 2, 9, 9]].concat();
        let heads = [&[0; FILE_HEAD][..], &DATA.to_le_bytes(), &(data.len() as u64).to_le_bytes()].concat();
        [&heads, &data[..], &[0; MESSAGE_HEAD]].concat()
    }

    #[test]
    fn joined_pieces_are_whole() {
        let mut piece = file(&[0x80, 4]);
        piece.truncate(piece.len() - MESSAGE_HEAD);
        piece[..MARK.len()].copy_from_slice(MARK);
        let joined = [&piece[..], &piece].concat();
        assert_eq!(whole(&joined, false), Ok(joined.len()));
        assert_eq!(whole(&joined[..joined.len() - 1], false), Ok(piece.len() + FILE_HEAD));
    }

    #[test]
    fn joined_files_are_checked_to_their_end() {
        let mut part = [file(&[0x80, 4]), vec![0; FOOT]].concat();
        part[..MARK.len()].copy_from_slice(MARK);
        let mut bad = file(&[0xff, 0xff, 0xff, 0xff, 0x7f]);
        bad[..MARK.len()].copy_from_slice(MARK);
        assert_eq!(whole(&[&part[..], &part].concat(), true), Ok(2 * part.len()));
        assert!(whole(&[part, bad].concat(), true).is_err());
    }

    #[test]
    fn lengths_that_cannot_be_are_found() {
        let good = file(&[0x80, 4]);
        assert_eq!(whole(&good, true), Ok(good.len()));
        for cut in 0..good.len() {
            let end = if cut < good.len() - MESSAGE_HEAD { cut.min(FILE_HEAD) } else { good.len() - MESSAGE_HEAD };
            assert_eq!(whole(&good[..cut], false), Ok(end), "cut at {cut}");
        }
        assert!(whole(&file(&[0xff, 0xff, 0xff, 0xff, 0x7f]), true).is_err());
        let mut long = good;
        long[FILE_HEAD + 14] = 4;
        assert!(whole(&long, true).is_err());
        assert_eq!(whole(&long, false), Ok(FILE_HEAD));
    }
}
