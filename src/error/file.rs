//! Files that cannot be read or written.

use super::shortened;
use std::path::PathBuf;

/// A file that cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The file is missing or unreadable.
    #[error("cannot read {}: {}", path.display(), shortened(&reason(source)))]
    Read { path: PathBuf, source: std::io::Error },
    /// The file has the wrong content.
    #[error("{} is not a valid {what} file: {}", path.display(), shortened(reason))]
    Format { path: PathBuf, what: &'static str, reason: String },
    /// The file is not a recording, or it contains nothing to compare.
    #[error("{} cannot be compared: {}", path.display(), shortened(reason))]
    Incomparable { path: PathBuf, reason: String },
    /// The output cannot be created at this place.
    #[error("cannot write {}: {reason}", path.display())]
    Target { path: PathBuf, reason: String },
    /// Writing failed.
    #[error("writing {} failed: {}", path.display(), reason(source))]
    Write { path: PathBuf, source: std::io::Error },
    /// No suitable viewer is installed.
    #[error(
        "no Rerun viewer can be started: install one with `pip install rerun-sdk`, {version} or newer, or write a file with --record"
    )]
    NoViewer { version: String },
}

/// The reason of the system, without its error number.
pub(crate) fn reason(error: &std::io::Error) -> String {
    let words = error.to_string();
    words.split(" (os error").next().unwrap_or_default().to_owned()
}
