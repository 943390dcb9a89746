//! The interface of formats of instruments.

use super::channel::Channel;
use std::io;

/// A format of files that instruments write. Errors are of the kind [`io::ErrorKind::InvalidData`] and say what is wrong with a file.
pub(super) struct Instrument {
    /// Its name, as text.
    pub name: &'static str,
    /// Whether the bytes of a file are of this format, by what they begin with.
    pub is_it: fn(&[u8]) -> bool,
    /// All channels, none of whose values is read. What is allocated before is bounded by the length of the file.
    pub channels: fn(&[u8]) -> io::Result<Vec<Channel<'_>>>,
}
