//! What all exports begin with.

use crate::surface::Scan;
use std::fs::File;
use std::io::BufWriter;

/// A file on its way.
pub(super) type Draft<'a> = BufWriter<&'a mut File>;

/// Whether heights are a profile.
pub(super) fn is_profile(scan: &Scan) -> bool {
    scan.shape()[0] == 1
}
