//! The writer of a file of heights.

use std::fs::File;
use std::io::BufWriter;

/// A file that is renamed when all of it is written.
pub(super) type FileWriter<'a> = BufWriter<&'a mut File>;
