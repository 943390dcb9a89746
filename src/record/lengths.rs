//! Lengths in the file of a recording. The decoder makes room for whatever they say, so that they are checked before.
//!
//! # Source
//! `frames.rs` of the crate `re_log_encoding`, and the message `ArrowMsg` of its protocol.

/// The mark at the beginning of a file. Pieces of a stream that are joined have one each.
const MARK: &[u8] = b"RRF2";

/// Bytes of the head of a file, and of that of a message: two numbers of 8 bytes, its kind and its length.
const FILE_HEAD: usize = 12;
const MESSAGE_HEAD: usize = 16;

/// Kinds of messages: the last one, and one with data.
const LAST: u64 = 0;
const DATA: u64 = 2;

/// The field of a message with data that holds the number of bytes when it is unpacked.
const UNPACKED: u64 = 3;

/// The most bytes that one byte can be unpacked to.
const MOST_UNPACKED: u64 = 255;

/// The number of bytes up to the end of the last whole message. A file with an end has only whole messages; one without was cut off.
///
/// # Errors
/// A reason, for a length that cannot be.
pub fn whole(bytes: &[u8], has_end: bool) -> Result<usize, String> {
    let mut at = FILE_HEAD.min(bytes.len());
    loop {
        if bytes[at..].starts_with(MARK) {
            at = bytes.len().min(at + FILE_HEAD);
        }
        let Some((kind, length)) = head(&bytes[at..]) else { return Ok(at) };
        let message = usize::try_from(length).ok().and_then(|it| bytes[at + MESSAGE_HEAD..].get(..it));
        match (message, kind) {
            (Some(_), LAST) => return Ok(bytes.len()),
            (Some(message), DATA) if unpacks_to_too_much(message) => {
                return Err("a message would unpack to more than there is in it".into());
            }
            (Some(message), _) => at += MESSAGE_HEAD + message.len(),
            (None, _) if has_end => return Err("a message is longer than the file".into()),
            (None, _) => return Ok(at),
        }
    }
}

/// The kind and the length of the message at the beginning of some bytes.
fn head(bytes: &[u8]) -> Option<(u64, u64)> {
    let (kind, rest) = bytes.split_first_chunk()?;
    Some((u64::from_le_bytes(*kind), u64::from_le_bytes(*rest.first_chunk()?)))
}

/// Whether a message with data says that it unpacks to more bytes than it can. Whatever else is wrong with it, the decoder finds.
fn unpacks_to_too_much(message: &[u8]) -> bool {
    let most = MOST_UNPACKED.saturating_mul(message.len() as u64);
    let mut rest = message;
    while let Some(key) = number(&mut rest) {
        let skipped = match key & 7 {
            0 => match number(&mut rest) {
                Some(value) if key >> 3 == UNPACKED && value > most => return true,
                _ => 0,
            },
            1 => 8,
            2 => number(&mut rest).unwrap_or(u64::MAX),
            5 => 4,
            _ => return false,
        };
        let Some(left) = usize::try_from(skipped).ok().and_then(|it| rest.get(it..)) else { return false };
        rest = left;
    }
    false
}

/// Takes a number of variable length: seven bits in each byte, the lowest first, and a bit that says whether more follow.
fn number(bytes: &mut &[u8]) -> Option<u64> {
    let mut number = 0;
    for place in 0..10 {
        let (byte, rest) = bytes.split_first()?;
        *bytes = rest;
        number |= u64::from(byte & 0x7f) << (7 * place);
        if byte & 0x80 == 0 {
            return Some(number);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

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
