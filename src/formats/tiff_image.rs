//! Heights as grey values of TIFF images.

use super::channel::{Channel, listed};
use super::instrument::Instrument;
use super::tiff::{is_tiff, pages};
use std::io;

/// A TIFF file that is of no instrument which is known: each page of numbers, whole or with a decimal point, is a channel, row by row from the top.
/// Heights are these numbers, without a unit or a size. Pages that are compressed or have colours are refused.
///
/// # Source
/// "TIFF Revision 6.0", Adobe, 1992.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "TIFF image", is_it: is_tiff, channels };

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let mut found = Vec::new();
    for (at, page) in pages(bytes)?.into_iter().enumerate() {
        let name = format!("page {}", at + 1);
        let image = page.image().map(|image| Channel::map(name.clone(), image.shape, move || image.numbers()));
        found.push((name, image));
    }
    listed(found)
}
