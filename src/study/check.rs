//! The check sum of a row, which shows whether a row, or the names of its columns, were changed after it was written.

use crate::digest::fnv1a;
use crate::files::TextColumn;
use csv::{StringRecord, WriterBuilder};

/// What check sums begin with that cover the names of the columns. Older ones have no such mark, and cover the fields of the row alone.
const NAMED: &str = "named-";

/// The last column `check` of a row: the hash FNV-1a of the names of the other columns and of their fields, as lines of comma-separated values, in
/// hexadecimal digits.
pub(crate) struct Checksum;

impl Checksum {
    /// The name of the column.
    pub(crate) const NAME: &str = "check";

    /// The check sum of a row of words under the names of their columns.
    pub(crate) fn from_words<T: AsRef<[u8]>>(
        names: impl IntoIterator<Item = T>,
        words: impl IntoIterator<Item = T>,
    ) -> String {
        let mut csv = WriterBuilder::new().flexible(true).from_writer(Vec::new());
        let written = csv.write_record(names).and_then(|()| csv.write_record(words));
        written.expect("words have a form in lines");
        format!("{NAMED}{:016x}", fnv1a([csv.into_inner().expect("lines fit in memory").as_slice()]))
    }

    /// Whether a row and the names of its columns, with that of the check sum as the last, have not changed since they were written.
    pub(crate) fn holds(names: &StringRecord, record: &StringRecord) -> bool {
        let (mut names, mut fields): (Vec<&str>, Vec<&str>) = (names.iter().collect(), record.iter().collect());
        names.pop();
        fields.pop().is_some_and(|last| match last.starts_with(NAMED) {
            true => last == Self::from_words(names, fields),
            false => last == of_fields(fields),
        })
    }
}

/// The line of the first row of a table that is not as it was written; none for a table without check sums.
pub fn first_changed_row(columns: &[TextColumn]) -> Option<u64> {
    let (check, _) = columns.split_last().filter(|(last, _)| last.name == Checksum::NAME)?;
    let names: StringRecord = columns.iter().map(|column| column.name.as_str()).collect();
    let is_changed = |row: &usize| {
        let words: StringRecord = columns.iter().map(|column| column.words[*row].text.as_str()).collect();
        !Checksum::holds(&names, &words)
    };
    (0..check.words.len()).find(is_changed).map(|row| check.words[row].row)
}

/// The check sum of tables that were written before check sums covered the names of the columns.
fn of_fields(fields: Vec<&str>) -> String {
    let mut csv = WriterBuilder::new().has_headers(false).from_writer(Vec::new());
    csv.write_record(fields).expect("words have a form in lines");
    format!("{:016x}", fnv1a([csv.into_inner().expect("a line fits in memory").as_slice()]))
}
