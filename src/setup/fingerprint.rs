//! Setups told apart.

use super::{Record, Setup};
use crate::contact::Load;
use crate::error::{FileError, SetupError};

impl Setup {
    /// Sixteen hexadecimal digits that tell setups apart whose contacts differ under the same load: by all that is in them but
    /// the load and the recording, and by the bytes of a height file in place of its name.
    ///
    /// # Errors
    /// For a height file that cannot be read.
    pub fn fingerprint(&self) -> Result<String, SetupError> {
        let mut rest = Self { load: Load::ReducedPressure(1.0), record: Record::default(), ..self.clone() };
        let bytes = match rest.surface.height.take() {
            Some(path) => std::fs::read(&path).map_err(|source| FileError::Read { path, source })?,
            None => Vec::new(),
        };
        Ok(format!("{:016x}", fnv1a([rest.to_toml().as_bytes(), &bytes])))
    }
}

/// The hash FNV-1a of some bytes, the same on every machine.
fn fnv1a<'a>(bytes: impl IntoIterator<Item = &'a [u8]>) -> u64 {
    let next = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    bytes.into_iter().flatten().fold(0xcbf2_9ce4_8422_2325, next)
}
