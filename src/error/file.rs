//! Files that cannot be read or written.

use crate::sentence::{Sentence, shortened, worded};
use std::path::PathBuf;

worded! {
    /// A file that cannot be read or written.
    #[derive(Debug)]
    pub enum FileError {
        /// The file is missing or unreadable.
        #[error("cannot read {file}: {words}", file = path.display(), words = reason(source))]
        Read { path: PathBuf, source: std::io::Error },
        /// The file has the wrong content.
        #[error("{file} is not a valid {what} file: {reason}", file = path.display())]
        Format { path: PathBuf, what: &'static str, reason: Sentence },
        /// The file is not a recording, or it contains nothing to compare.
        #[error("{file} cannot be compared: {words}", file = path.display(), words = shortened(reason))]
        Incomparable { path: PathBuf, reason: String },
        /// The output cannot be created at this place.
        #[error("cannot write {file}: {reason}", file = path.display())]
        Target { path: PathBuf, reason: String },
        /// Writing failed.
        #[error("writing {file} failed: {words}", file = path.display(), words = reason(source))]
        Write { path: PathBuf, source: std::io::Error },
        /// No suitable viewer is installed.
        #[error(
            "no Rerun viewer can be started: install one with `pip install rerun-sdk`, {version} or newer, or write a file"
        )]
        NoViewer { version: String },
    }
}

/// The sentence that an error of reading or writing holds, or else the reason of the system, without its error number.
pub(crate) fn reason(error: &std::io::Error) -> Sentence {
    let held = error.get_ref().and_then(|it| it.downcast_ref::<Sentence>());
    held.cloned().unwrap_or_else(|| {
        let words = error.to_string();
        words.split(" (os error").next().unwrap_or_default().into()
    })
}
