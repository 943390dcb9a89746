//! Scripts whose value is packed: a page that is opened from a folder may load scripts and nothing else, and a script is text.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::Value;
use std::io::{self, Write};

/// A script that gives a name to a text: bytes that gzip has packed, in base64. `packed.js` reads it.
pub(crate) fn script(name: &str, packed: &[u8]) -> Vec<u8> {
    format!("\"use strict\";\nconst {name} = \"{}\";\n", BASE64_STANDARD.encode(packed)).into_bytes()
}

/// The same script of the JSON of a value, which is packed here.
pub(crate) fn script_of(name: &str, value: &Value) -> io::Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(value.to_string().as_bytes())?;
    Ok(script(name, &encoder.finish()?))
}
