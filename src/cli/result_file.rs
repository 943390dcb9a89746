//! Saved results of which curves and maps are drawn.

use super::exit_status::usage;
use anyhow::Result;
use asperity::contact::{ArchiveReader, ArchiveSeal};
use std::path::Path;

/// Opens a result, whose arrays are those that were written. One without a digest, or of other numerics, is drawn as it is.
pub(crate) fn open(path: &Path) -> Result<ArchiveReader> {
    let reader = ArchiveReader::open(path)?;
    match reader.seal()? {
        ArchiveSeal::Broken => usage(format!(
            "{} is not as it was written: its arrays or its setup were changed. Solve it again, or take its array `digest` out to draw what is there",
            path.display()
        )),
        ArchiveSeal::Whole | ArchiveSeal::Missing | ArchiveSeal::OfOther(_) => Ok(reader),
    }
}
