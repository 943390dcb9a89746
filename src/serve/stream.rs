//! A recording that is sent to the browser while it is being written.

use crate::record::Output;
use axum::body::{Body, Bytes};
use futures_util::stream;
use std::fs::File;
use std::io::{self, Read};
use std::time::Duration;

/// The most bytes that are read at once.
const PIECE: u64 = 1 << 20;
/// Pause before looking for more bytes.
const PAUSE: Duration = Duration::from_millis(10);

/// The bytes of a recording.
pub enum RecordingBytes {
    /// Being written, or written, by this process.
    Live(Output),
    /// A file that the user named.
    File(File),
}

impl RecordingBytes {
    /// The body of a reply.
    pub fn body(self) -> Body {
        Body::from_stream(stream::try_unfold((self, 0), next))
    }

    /// Number of bytes that can be read; none if that is all until the end of the file.
    fn written(&self) -> Option<u64> {
        match self {
            Self::Live(live) => live.written(),
            Self::File(_) => None,
        }
    }

    /// At most `most` bytes from the byte `from` on, up to which a file was read before.
    fn piece(&mut self, from: u64, most: u64) -> io::Result<Vec<u8>> {
        match self {
            Self::Live(live) => live.read(from, most),
            Self::File(file) => {
                let mut piece = Vec::new();
                file.take(most).read_to_end(&mut piece).map(|_| piece)
            }
        }
    }
}

/// The piece after the first `read` bytes, none at the end.
async fn next((mut bytes, read): (RecordingBytes, u64)) -> io::Result<Option<(Bytes, (RecordingBytes, u64))>> {
    loop {
        let written = bytes.written();
        let most = written.map_or(PIECE, |written| PIECE.min(written - read));
        let reading = move || (bytes.piece(read, most), bytes);
        let (piece, rest) = tokio::task::spawn_blocking(reading).await.map_err(io::Error::other)?;
        let piece = piece?;
        if !piece.is_empty() {
            let read = read + piece.len() as u64;
            return Ok(Some((piece.into(), (rest, read))));
        }
        if written.is_none() {
            return Ok(None);
        }
        tokio::time::sleep(PAUSE).await;
        bytes = rest;
    }
}
