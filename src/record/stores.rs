//! The content of recordings that are read from files, which may be damaged in any way.

use super::{digest, lengths};
use crate::error::FileError;
use crate::files::read_bytes;
use rerun::external::arrow::array::Array;
use rerun::log::Chunk;
use rerun::{ChunkStore, ChunkStoreConfig, StoreId};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::path::Path;
use std::sync::Once;

/// The mark at the end of a recording that is whole, and the bytes that follow it: the number of its indices.
///
/// # Source
/// `StreamFooter` of the crate `re_log_encoding`.
const END: &[u8] = b"RRF2FOOT";
const AFTER_END: usize = 4;

/// Bytes that hold the end of a recording.
pub(crate) const END_BYTES: u64 = (END.len() + AFTER_END) as u64;

/// Whether the last bytes of a file, [`END_BYTES`] or more, are the end of a recording.
pub(crate) fn has_end(last: &[u8]) -> bool {
    last[last.len().saturating_sub(END_BYTES as usize)..].starts_with(END)
}

thread_local! {
    /// Whether this thread reads a recording, so that a panic is no fault of the program.
    static IS_READING: Cell<bool> = const { Cell::new(false) };
}

/// Reads all stores of a recording. Every array in them is whole.
///
/// # Errors
/// [`FileError::Read`] for a file that is missing, unreadable or damaged.
pub(crate) fn read(path: &Path) -> Result<BTreeMap<StoreId, ChunkStore>, FileError> {
    let unreadable = |source| FileError::Read { path: path.into(), source };
    let bytes = read_bytes(path)?;
    let decoded = caught(|| {
        let frames = lengths::frames(&bytes, has_end(&bytes))?;
        let stores = ChunkStore::from_rrd_reader(&ChunkStoreConfig::ALL_DISABLED, &mut &bytes[..frames.end]);
        let stores = stores.map_err(|error| reason(&error.to_string()))?;
        digest::check(&bytes, &frames.before_last, &stores.values().collect::<Vec<_>>())?;
        let mut chunks = stores.values().flat_map(ChunkStore::iter_physical_chunks);
        chunks.try_for_each(|chunk| check(chunk))?;
        drop(chunks);
        Ok(stores)
    });
    decoded.map_err(|reason| unreadable(io::Error::other(format!("the recording is damaged: {reason}"))))
}

/// Why the decoder refuses a recording. It writes the identity of a store as a structure of its own language.
fn reason(error: &str) -> String {
    match error.contains("StoreId(") {
        true => "one of its messages belongs to no recording that the file begins".into(),
        false => error.into(),
    }
}

/// Refuses a chunk with arrays that are not valid.
fn check(chunk: &Chunk) -> Result<(), String> {
    let batch = chunk.to_record_batch().map_err(|error| error.to_string())?;
    let mut columns = batch.columns().iter();
    columns.try_for_each(|column| column.to_data().validate_full().map_err(|error| error.to_string()))
}

/// What `read` returns, or an error where it panics: the decoder takes some numbers in a file for granted. Nothing is printed then.
fn caught<T>(read: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let others = take_hook();
        set_hook(Box::new(move |panic| {
            if !IS_READING.get() {
                others(panic);
            }
        }));
    });
    IS_READING.set(true);
    let result = catch_unwind(AssertUnwindSafe(read));
    IS_READING.set(false);
    result.unwrap_or_else(|_| Err("its arrays do not fit together".into()))
}
