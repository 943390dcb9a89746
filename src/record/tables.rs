//! The tables in a message of a recording, each with the lengths that it tells. The decoder makes room for them, so that they are
//! checked before.
//!
//! # Source
//! The message `ArrowMsg` of the protocol of Rerun; the streaming format of Arrow.

use crate::memory::check_room;
use rerun::external::arrow::ipc::root_as_message;
use rerun::external::re_log_encoding::external::lz4_flex::block::decompress_into;
use std::borrow::Cow;

/// The most bytes that one byte can be unpacked to.
const MOST_UNPACKED: u64 = 255;

/// The mark before the length of a table.
const MARK: [u8; 4] = [0xff; 4];

/// Bytes for which there is always memory.
const FEW: u64 = 1 << 24;

/// Refuses a message whose fields cannot be read, one whose tables tell lengths that it has no bytes for, and one that does not fit in memory beside
/// the `others` bytes of those before it. Whatever else is wrong with it, the decoder finds. Returns the bytes of its tables.
///
/// # Errors
/// A reason, for a length that cannot be.
pub(crate) fn check(message: &[u8], others: u64) -> Result<u64, String> {
    let data = Data::read(message).ok_or("the fields of a message cannot be read")?;
    if data.unpacked > MOST_UNPACKED.saturating_mul(message.len() as u64) {
        return Err("a message would unpack to more than there is in it".into());
    }
    if data.unpacked > FEW {
        // the decoder holds the tables of all messages, and those of this one packed, unpacked, and as arrays
        let needed = others.saturating_add(data.unpacked.saturating_mul(2));
        check_room(needed as f64).map_err(|room| format!("its data do not fit in memory: they need {room}"))?;
    }
    data.tables().map_or(Ok(()), |tables| check_tables(&tables))?;
    Ok(data.unpacked)
}

/// The fields of a message that its tables depend on.
#[derive(Default)]
struct Data<'a> {
    /// How the tables are packed.
    packing: u64,
    /// The number of bytes when they are unpacked.
    unpacked: u64,
    packed: &'a [u8],
}

impl<'a> Data<'a> {
    /// The number that says that tables are packed, of which the decoder takes the lower 32 bits.
    const LZ4: u32 = 2;

    /// Numbers of the fields.
    const PACKING: u64 = 2;
    const UNPACKED: u64 = 3;
    const PACKED: u64 = 5;

    /// Reads the fields of a message, each of which has its number and its kind, and then a number or bytes.
    fn read(mut message: &'a [u8]) -> Option<Self> {
        let mut data = Self::default();
        while !message.is_empty() {
            let key = number(&mut message)?;
            match (key >> 3, key & 7) {
                (Self::PACKING, 0) => data.packing = number(&mut message)?,
                (Self::UNPACKED, 0) => data.unpacked = number(&mut message)?,
                (_, 0) => drop(number(&mut message)?),
                (_, 1) => drop(taken(&mut message, 8)?),
                (field, 2) => {
                    let length = number(&mut message)?;
                    let bytes = taken(&mut message, length)?;
                    if field == Self::PACKED {
                        data.packed = bytes;
                    }
                }
                (_, 5) => drop(taken(&mut message, 4)?),
                _ => return None,
            }
        }
        Some(data)
    }

    /// The tables, unpacked, unless they cannot be.
    fn tables(&self) -> Option<Cow<'a, [u8]>> {
        if self.packing as u32 != Self::LZ4 {
            return Some(self.packed.into());
        }
        let mut tables = vec![0; usize::try_from(self.unpacked).ok()?];
        decompress_into(self.packed, &mut tables).ok()?;
        Some(tables.into())
    }
}

/// Refuses tables that say that they are longer than their bytes.
fn check_tables(mut rest: &[u8]) -> Result<(), String> {
    let longer = || String::from("a table is longer than its message");
    while let Some(length) = head_length(&mut rest) {
        let head = taken(&mut rest, length).ok_or_else(longer)?;
        let Ok(table) = root_as_message(head) else { return Ok(()) };
        taken(&mut rest, table.bodyLength() as u64).ok_or_else(longer)?;
    }
    Ok(())
}

/// Takes the length of the head of a table, unless none follows. One that is negative becomes one that is too long.
fn head_length(rest: &mut &[u8]) -> Option<u64> {
    let mut length = rest.split_off(..4)?.first_chunk()?;
    if *length == MARK {
        length = rest.split_off(..4)?.first_chunk()?;
    }
    Some(i32::from_le_bytes(*length) as u64).filter(|&length| length > 0)
}

/// Takes as many bytes as a length says.
fn taken<'a>(rest: &mut &'a [u8], length: u64) -> Option<&'a [u8]> {
    rest.split_off(..usize::try_from(length).ok()?)
}

/// Takes a number of variable length: seven bits in each byte, the lowest first, and a bit that says whether more follow.
fn number(rest: &mut &[u8]) -> Option<u64> {
    let mut number = 0;
    for place in 0..10 {
        let byte = *rest.split_off_first()?;
        number |= u64::from(byte & 0x7f) << (7 * place);
        if byte & 0x80 == 0 {
            return Some(number);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use rerun::external::arrow::array::{ArrayRef, Float64Array, RecordBatch, StringArray};
    use rerun::external::arrow::ipc::reader::StreamReader;
    use rerun::external::arrow::ipc::writer::StreamWriter;
    use rerun::external::re_log_encoding::external::lz4_flex::block::compress;
    use std::panic::catch_unwind;
    use std::sync::Arc;

    /// A table of two columns.
    fn table() -> Vec<u8> {
        let names: ArrayRef = Arc::new(StringArray::from(vec!["gap", "pressure"]));
        let numbers: ArrayRef = Arc::new(Float64Array::from(vec![1.0, 2.0]));
        let batch = RecordBatch::try_from_iter([("name", names), ("number", numbers)]).unwrap();
        let mut writer = StreamWriter::try_new(Vec::new(), &batch.schema()).unwrap();
        writer.write(&batch).unwrap();
        writer.into_inner().unwrap()
    }

    /// A message with packed tables.
    fn message(tables: &[u8]) -> Vec<u8> {
        let varied = |mut number: usize| {
            let mut bytes = Vec::new();
            while number > 0x7f {
                bytes.push(number as u8 | 0x80);
                number >>= 7;
            }
            bytes.push(number as u8);
            bytes
        };
        let packed = compress(tables);
        [&[0x10, 2, 0x18][..], &varied(tables.len()), &[0x2a], &varied(packed.len()), &packed].concat()
    }

    #[test]
    fn tables_with_any_bit_wrong_are_refused_or_decoded_in_the_room_that_there_is() {
        let table = table();
        assert_eq!(check(&message(&table), 0).map(drop), Ok(()));
        let mut refused = 0;
        for bit in 0..8 * table.len() {
            let mut wrong = table.clone();
            wrong[bit / 8] ^= 1 << (bit % 8);
            if check(&message(&wrong), 0).is_err() {
                refused += 1;
                continue;
            }
            // an attempt to make too much room would end the process, which nothing catches
            let _panics = catch_unwind(|| StreamReader::try_new(&wrong[..], None).map(|it| it.take(4).for_each(drop)));
        }
        assert!((100..2 * table.len()).contains(&refused), "{refused} of {} refused", 8 * table.len());
    }

    #[test]
    fn messages_whose_fields_cannot_be_read_are_refused() {
        let message = message(&table());
        assert!((message.len() - 20..message.len()).all(|end| check(&message[..end], 0).is_err()));
        // groups, in which fields would not be seen
        assert!(check(&[&[0x53, 0x54][..], &message].concat(), 0).is_err());
        // the decoder takes 2^32 + 2 for 2
        let long = [&[0x10, 0x82, 0x80, 0x80, 0x80, 0x10][..], &message[2..]].concat();
        assert_eq!(check(&long, 0).map(drop), Ok(()));
        assert!(Data::read(&long).unwrap().tables().is_some_and(|tables| *tables == *table()));
    }
}
