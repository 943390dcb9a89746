//! The check sum of a row, which shows whether a row was changed after it was written.

use crate::setup::fnv1a;
use csv::{StringRecord, WriterBuilder};
use serde::Serialize;

/// The last column `check` of a row: the hash FNV-1a of the other fields, as a line of comma-separated values, in hexadecimal digits.
#[derive(Debug, Serialize)]
pub struct Checksum {
    check: String,
}

impl Checksum {
    /// The name of the column.
    pub const NAME: &str = "check";

    /// The check sum of a row that is written with it.
    pub fn from_row(row: impl Serialize) -> Self {
        Self { check: format!("{:016x}", fnv1a([line(row).as_slice()])) }
    }

    /// The words of a row, with its check sum as the last.
    pub fn add_to(mut words: Vec<String>) -> Vec<String> {
        words.push(Self::from_row(&words).check);
        words
    }

    /// Whether a row has not changed since it was written.
    pub fn holds(record: &StringRecord) -> bool {
        let mut fields: Vec<&str> = record.iter().collect();
        fields.pop().is_some_and(|last| last == Self::from_row(fields).check)
    }
}

/// A row as a line of comma-separated values.
fn line(row: impl Serialize) -> Vec<u8> {
    let mut csv = WriterBuilder::new().has_headers(false).from_writer(Vec::new());
    csv.serialize(row).expect("numbers and texts have a form in lines");
    csv.into_inner().expect("a line fits in memory")
}
