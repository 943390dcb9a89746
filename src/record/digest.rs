//! The digest of a recording: the number and the check sum of its bytes, which its last message holds.
//!
//! The file format has no check sums, and one wrong bit may change a value without a trace. A program that writes a recording anew, such as the
//! viewer, changes the bytes: the digest is then found at another place than it says, and says nothing. It holds for a file that is as it was written.

use rerun::components::Scalar;
use rerun::log::Chunk;
use rerun::{AnyValues, ChunkStore, RecordingStream, RecordingStreamResult};
use std::fs::File;
use std::io::{self, Write};
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// The property that holds a digest, and its values.
const PROPERTY: &str = "digest";
const ENTITY: &str = "/__properties/digest";
const BYTES: &str = "bytes";
const CRC: &str = "crc32";

/// The number and the CRC-32 of the bytes of a recording before the message with its digest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Digest {
    bytes: u64,
    crc: u32,
}

impl Digest {
    /// The digest of some bytes.
    fn from_bytes(bytes: &[u8]) -> Self {
        Self { bytes: bytes.len() as u64, crc: crc32fast::hash(bytes) }
    }

    /// The digests in the stores of a recording: one for each file that it was joined from.
    fn all(stores: &[&ChunkStore]) -> Vec<Self> {
        let chunks = stores.iter().flat_map(|store| store.iter_physical_chunks());
        let digests = chunks.filter(|chunk| chunk.entity_path().to_string() == ENTITY);
        digests.filter_map(|chunk| Self::read(chunk)).collect()
    }

    fn read(chunk: &Chunk) -> Option<Self> {
        let value = |name: &str| {
            let component = chunk.components_identifiers().find(|it| it.as_str().rsplit(':').next() == Some(name))?;
            Some(*chunk.iter_slices::<f64>(component).next()?.first()?)
        };
        Some(Self { bytes: value(BYTES)? as u64, crc: value(CRC)? as u32 })
    }

    /// Sends it as a property.
    pub(crate) fn send(self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let values = AnyValues::default()
            .with_component::<Scalar>(BYTES, [self.bytes as f64])
            .with_component::<Scalar>(CRC, [f64::from(self.crc)]);
        to.send_property(PROPERTY, &values)
    }
}

/// Compares the bytes of a recording with the digests in its stores. `summed` are the bytes before the last message of each file that it
/// was joined from. A digest that is found at another place than it says is that of a file that another program has written anew.
///
/// # Errors
/// A reason, for bytes that are not those that were written.
pub(crate) fn check(bytes: &[u8], summed: &[Range<usize>], stores: &[&ChunkStore]) -> Result<(), String> {
    let digests = Digest::all(stores);
    for piece in summed {
        let is_of_piece = |it: &&Digest| it.bytes == piece.len() as u64;
        let mut found = digests.iter().filter(is_of_piece).peekable();
        if found.peek().is_some() && !found.any(|it| *it == Digest::from_bytes(&bytes[piece.clone()])) {
            return Err(
                "its bytes are not those that were written: they fail their check sum; copy or record it again".into(),
            );
        }
    }
    Ok(())
}

/// A file with a running digest of what was written into it.
pub(crate) struct SummedFile {
    file: File,
    sum: RunningDigest,
}

/// The digest so far, which the writer of the file and others share.
#[derive(Clone, Default)]
pub(crate) struct RunningDigest(Arc<Mutex<crc32fast::Hasher>>);

impl RunningDigest {
    /// The digest of the bytes so far.
    pub(crate) fn now(&self) -> Digest {
        let sum = self.0.lock().unwrap_or_else(PoisonError::into_inner).clone();
        Digest { bytes: sum.total_len(), crc: sum.finalize() }
    }
}

impl SummedFile {
    /// A file, empty yet.
    pub(crate) fn new(file: File, sum: RunningDigest) -> Self {
        Self { file, sum }
    }
}

impl Write for SummedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.sum.0.lock().unwrap_or_else(PoisonError::into_inner).update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
