//! Streams of zlib in files of instruments.

use super::format::malformed;
use flate2::read::ZlibDecoder;
use std::io::{self, Read};

/// Unpacks a number of bytes of a stream, and reads on after them: check sums are compared at the end.
///
/// # Errors
/// For a stream that is damaged or has more bytes.
pub(super) fn unpack(stream: &[u8], length: u64, bytes: &mut Vec<u8>) -> io::Result<()> {
    let mut stream = ZlibDecoder::new(stream);
    stream.by_ref().take(length).read_to_end(bytes)?;
    match stream.read(&mut [0])? {
        0 => Ok(()),
        _ => Err(malformed(format!("a stream has more than the expected {length} bytes"))),
    }
}
