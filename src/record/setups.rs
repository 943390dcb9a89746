//! Setups out of recordings.

use super::stores;
use crate::error::FileError;
use crate::files::open_regular;
use rerun::{StoreKind, TextDocument};
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

/// First bytes of a recording.
const MAGIC: &[u8] = b"RRF";

/// Name of the entities that hold the setups, below the roots of the scenes.
pub(super) const SETUP: &str = "setup";

/// The setups that a recording carries, as TOML, one for each scene that has one; `None` for a file that is no recording.
///
/// # Errors
/// [`FileError::Read`] for a file that is missing or unreadable, or a recording that is damaged.
pub fn setups(path: &Path) -> Result<Option<Vec<String>>, FileError> {
    if !is_recording(path)? {
        return Ok(None);
    }
    let stores = stores::read(path)?;
    let component = TextDocument::descriptor_text().component;
    let mut setups = Vec::new();
    for (_, store) in stores.iter().filter(|(id, _)| id.kind() == StoreKind::Recording) {
        let is_setup = |entity: String| entity.rsplit('/').next() == Some(SETUP);
        for chunk in store.iter_physical_chunks().filter(|chunk| is_setup(chunk.entity_path().to_string())) {
            setups.extend(chunk.iter_slices::<String>(component).flatten().map(|text| text.to_string()));
        }
    }
    Ok(Some(setups))
}

/// Whether a file begins like a recording.
///
/// # Errors
/// [`FileError::Read`] for a file that is missing or unreadable.
pub fn is_recording(path: &Path) -> Result<bool, FileError> {
    let unreadable = |source| FileError::Read { path: path.into(), source };
    let mut first = Vec::new();
    let file = open_regular(path).map_err(unreadable)?;
    file.take(MAGIC.len() as u64).read_to_end(&mut first).map_err(unreadable)?;
    Ok(first == MAGIC)
}

/// Whether a recording was cut off: it has no end, since its program was killed, its disk was full, or it is still written. What is in it
/// up to there can be read.
///
/// # Errors
/// [`FileError::Read`] for a file that is missing or unreadable.
pub fn is_cut_off(path: &Path) -> Result<bool, FileError> {
    let end = || -> std::io::Result<Vec<u8>> {
        let mut file = open_regular(path)?;
        let length = file.seek(SeekFrom::End(0))?;
        file.seek(SeekFrom::Start(length.saturating_sub(stores::END_BYTES)))?;
        let mut end = Vec::new();
        file.read_to_end(&mut end).map(|_| end)
    };
    let end = end().map_err(|source| FileError::Read { path: path.into(), source })?;
    Ok(is_recording(path)? && !stores::has_end(&end))
}
