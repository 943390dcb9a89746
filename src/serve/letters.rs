//! Scripts whose value is compressed: a page that is opened from a folder may load scripts and nothing else, and a script is text.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use serde_json::Value;
use std::io::{self, Write};

/// The first of the 32768 letters of which each holds 15 bits. None of them has a meaning in a script.
const FIRST: u16 = 0x3400;
/// Bits of a letter.
const BITS: usize = 15;

/// A script in UTF-16 that gives a name to some letters and the number of bytes in them. These are the JSON of the value, compressed
/// (RFC 1950); a letter has the highest bits first, and the last one is filled with zeros. `letters.js` reads them.
pub fn script_of(name: &str, value: &Value) -> io::Result<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(value.to_string().as_bytes())?;
    let bytes = encoder.finish()?;
    let script = format!("\u{feff}\"use strict\";\nconst {name} = {{ bytes: {}, letters: \"", bytes.len());
    let units = script.encode_utf16().chain(letters(&bytes)).chain("\" };\n".encode_utf16());
    Ok(units.flat_map(u16::to_le_bytes).collect())
}

/// The letters that hold bytes.
fn letters(bytes: &[u8]) -> Vec<u16> {
    let bit = |at: usize| bytes.get(at / 8).map_or(0, |byte| u16::from(byte >> (7 - at % 8) & 1));
    let letter = |start: usize| FIRST + (start..start + BITS).fold(0, |value, at| value << 1 | bit(at));
    (0..bytes.len() * 8).step_by(BITS).map(letter).collect()
}
