//! A recording on its way to the browser, while it is still written.

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
    /// A file that a person named.
    File(File),
}

impl RecordingBytes {
    /// The body of a reply.
    pub fn body(self) -> Body {
        Body::from_stream(stream::try_unfold(Reading { bytes: self, read: 0 }, Reading::next))
    }

    /// Number of bytes that can be read; none if that is all until the end of the file.
    fn written(&self) -> Option<u64> {
        match self {
            Self::Live(live) => live.written(),
            Self::File(_) => None,
        }
    }
}

struct Reading {
    bytes: RecordingBytes,
    read: u64,
}

impl Reading {
    /// The next piece, none at the end.
    async fn next(self) -> io::Result<Option<(Bytes, Self)>> {
        let mut reading = self;
        loop {
            let written = reading.bytes.written();
            let ready = written.map_or(PIECE, |written| PIECE.min(written - reading.read));
            let read = move || reading.piece(ready);
            let (piece, rest) = tokio::task::spawn_blocking(read).await.map_err(io::Error::other)??;
            reading = rest;
            if !piece.is_empty() {
                return Ok(Some((piece.into(), reading)));
            }
            if written.is_none() {
                return Ok(None);
            }
            tokio::time::sleep(PAUSE).await;
        }
    }

    fn piece(mut self, most: u64) -> io::Result<(Vec<u8>, Self)> {
        let piece = match &mut self.bytes {
            RecordingBytes::Live(live) => live.read(self.read, most)?,
            RecordingBytes::File(file) => {
                let mut piece = Vec::new();
                file.take(most).read_to_end(&mut piece)?;
                piece
            }
        };
        self.read += piece.len() as u64;
        Ok((piece, self))
    }
}
