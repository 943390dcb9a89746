//! The types of numbers in binary data.

use super::bytes::ByteReader;
use std::io;

/// The type of a stored number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum NumberType {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F32,
    F64,
}

impl NumberType {
    /// Bytes of a number.
    pub(crate) fn size(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 => 8,
        }
    }

    /// The next number.
    pub(crate) fn read(self, at: &mut ByteReader) -> io::Result<f64> {
        Ok(match self {
            Self::U8 => at.u8()?.into(),
            Self::I8 => at.i8()?.into(),
            Self::U16 => at.u16()?.into(),
            Self::I16 => at.i16()?.into(),
            Self::U32 => at.u32()?.into(),
            Self::I32 => at.i32()?.into(),
            Self::U64 => at.u64()? as f64,
            Self::I64 => at.i64()? as f64,
            Self::F32 => at.f32()?.into(),
            Self::F64 => at.f64()?,
        })
    }
}
