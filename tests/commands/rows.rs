//! Tables that commands write, and refusals.

use crate::command::{Folder, text};
use std::collections::HashMap;
use std::process::Output;

/// A row of a table, by the names of its columns.
pub type Row = HashMap<String, String>;

/// The rows of the CSV file `name`.
pub fn rows(folder: &Folder, name: &str) -> Vec<Row> {
    csv::Reader::from_path(folder.join(name)).unwrap().deserialize().map(Result::unwrap).collect()
}

/// The command ended with bad input, said so in all these words, and ran nothing.
pub fn assert_refused(output: &Output, words: &[&str]) {
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(output.stdout.is_empty(), "something ran: {}", text(&output.stdout));
    assert!(words.iter().all(|word| error.contains(word)), "{error}");
}
