//! Input files, and output files that appear completely or not at all.

mod apart;
mod draft;
mod input_file;
mod leftovers;

pub use apart::check_apart;
pub use draft::{Draft, abandon_drafts};
pub use input_file::{
    InputFile, TEXT_BYTES, check_text, open_regular, path_in_text, read_bytes, read_if_there, read_text_bytes,
    read_whole,
};

use crate::error::{Failure, FileError};
use serde::Serialize;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Checks that a file can be created at `path`, so that a long computation is not lost.
///
/// # Errors
/// [`FileError::Target`] if `path` is a directory or a device, or nothing can be created in its folder.
pub fn check_target(path: &Path) -> Result<(), FileError> {
    Draft::hidden(path).map(drop)
}

/// Checks that a file can be created at `path`, and that its name has one of the `endings`, such as `npz`.
///
/// # Errors
/// [`FileError::Target`] as [`check_target`], and for another ending.
///
/// ```
/// use asperity::files::check_named;
/// use std::path::Path;
/// assert!(check_named(Path::new("result.npz"), &["npz", "csv"]).is_ok());
/// let refused = check_named(Path::new("result.txt"), &["npz", "csv"]).unwrap_err();
/// assert_eq!(refused.to_string(), "cannot write result.txt: give a name that ends in .npz or .csv");
/// ```
pub fn check_named(path: &Path, endings: &[&str]) -> Result<(), FileError> {
    check_target(path)?;
    let given = path.extension().unwrap_or_default();
    if endings.iter().any(|ending| given.eq_ignore_ascii_case(ending)) {
        return Ok(());
    }
    let reason = format!("give a name that ends in .{}", endings.join(" or ."));
    Err(FileError::Target { path: path.into(), reason })
}

/// Creates the file `path` completely or not at all: `write` fills a draft in the same folder, which is flushed, synced
/// and then renamed over `path`.
///
/// # Errors
/// [`FileError::Target`] as [`check_target`]; [`FileError::Write`] if anything fails later. Neither leaves a new file
/// behind, nor touches one that was there.
pub fn write_beside(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), FileError> {
    let (draft, mut file) = Draft::hidden(path)?;
    let written = fill(&mut file, write).and_then(|()| draft.finish());
    written.map_err(|source| FileError::Write { path: path.into(), source })
}

/// Writes `rows` as CSV under the names of their fields, numbers in full precision, by [`write_beside`].
///
/// # Errors
/// The errors of [`write_beside`].
///
/// ```
/// #[derive(serde::Serialize)]
/// struct Point {
///     pressure: f64,
///     area: Option<f64>,
/// }
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("points.csv");
/// let points = [Point { pressure: 0.1, area: Some(0.25) }, Point { pressure: 2.0, area: None }];
/// asperity::files::write_csv(&path, &points)?;
/// assert_eq!(std::fs::read_to_string(&path)?, "pressure,area\n0.1,0.25\n2.0,\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_csv<T: Serialize>(path: &Path, rows: impl IntoIterator<Item = T>) -> Result<(), FileError> {
    write_beside(path, |file| {
        let mut csv = csv::Writer::from_writer(file);
        rows.into_iter().try_for_each(|row| csv.serialize(row))?;
        csv.flush()
    })
}

/// Writes rows of words to a file of comma-separated values. The first row has the names of the columns.
///
/// # Errors
/// The errors of [`write_beside`].
pub(crate) fn write_words(path: &Path, rows: impl IntoIterator<Item = Vec<String>>) -> Result<(), FileError> {
    write_beside(path, |file| {
        let mut csv = csv::Writer::from_writer(file);
        rows.into_iter().try_for_each(|row| csv.write_record(row))?;
        csv.flush()
    })
}

/// Checks that a folder can be created at `path`: the path has a name, is free or an empty folder, and its parent is
/// writable.
fn check_folder(path: &Path) -> Result<(), FileError> {
    let unfit = |reason: &str| Err(FileError::Target { path: path.into(), reason: reason.into() });
    if path.file_name().is_none() {
        return unfit("it is not the name of a folder: give a new folder");
    }
    match std::fs::read_dir(path).map(|mut entries| entries.next().is_none()) {
        Ok(true) => Ok(()),
        Ok(false) => unfit("it is not empty: give a new folder"),
        Err(_) if path.exists() => unfit("it is not a readable folder: give a new folder"),
        Err(_) => check_target(path),
    }
}

/// Creates the folder `path` completely or not at all: `fill` fills a draft beside it, which is then renamed.
///
/// # Errors
/// [`FileError::Target`] for a folder that is there and not empty, or cannot be made; the errors of `fill`, and [`FileError::Write`]
/// for the rest. None leaves anything behind.
///
/// ```
/// use asperity::files::fill_folder;
/// let folder = tempfile::tempdir()?;
/// let site = folder.path().join("site");
/// fill_folder(&site, |draft| Ok(std::fs::write(draft.join("index.html"), "")?))?;
/// assert!(site.join("index.html").is_file());
/// assert!(fill_folder(&site, |_| Ok(())).unwrap_err().to_string().contains("it is not empty"));
/// # Ok::<(), Box<dyn std::error::Error + Send + Sync>>(())
/// ```
pub fn fill_folder(path: &Path, fill: impl FnOnce(&Path) -> Result<(), Failure>) -> Result<(), Failure> {
    check_folder(path)?;
    let failed = |source| FileError::Write { path: path.into(), source };
    let draft = Draft::hidden_folder(path)?;
    fill(draft.path())?;
    if path.is_dir() {
        std::fs::remove_dir(path).map_err(failed)?;
    }
    Ok(draft.finish().map_err(failed)?)
}

fn fill(file: &mut File, write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::new(&mut *file);
    write(&mut writer)?;
    writer.flush()?;
    drop(writer);
    file.sync_all()
}

/// A column of a table of text: its name and its words.
#[derive(Debug, Clone, PartialEq)]
pub struct TextColumn {
    /// The word in the row of names.
    pub name: String,
    /// The words below it.
    pub words: Vec<TextWord>,
}

/// A word of a table of text.
#[derive(Debug, Clone, PartialEq)]
pub struct TextWord {
    /// The line of the file, from 1 on, as in a spreadsheet.
    pub row: u64,
    /// The word; a decimal comma is a point.
    pub text: String,
}

impl TextColumn {
    /// The finite numbers of its words, which are read by `read` where they are no plain numbers.
    ///
    /// # Errors
    /// A sentence that names row and word.
    pub fn numbers(&self, read: impl Fn(&str) -> Result<f64, String>) -> Result<Vec<f64>, String> {
        let number = |TextWord { row, text }: &TextWord| {
            if text.is_empty() {
                return Err(format!("row {row} has no word in the column {}: give a number", self.name));
            }
            match text.parse::<f64>().map_or_else(|_| read(text), Ok) {
                Ok(number) if number.is_finite() => Ok(number),
                Ok(_) => Err(format!("row {row}: `{text}` in the column {} is not a finite number", self.name)),
                Err(reason) => Err(format!("row {row}: {reason}")),
            }
        };
        self.words.iter().map(number).collect()
    }
}

/// The columns of a file with a table, see [`columns_of`].
///
/// # Errors
/// [`FileError::Read`] for a file that cannot be read, [`FileError::Format`] for one that is no such table.
pub fn read_columns(path: &Path) -> Result<Vec<TextColumn>, FileError> {
    columns_of(&read_text_bytes(path)?).map_err(|reason| FileError::Format {
        path: path.into(),
        what: "table",
        reason: reason.into(),
    })
}

/// The columns of a table whose first row names them. They are separated by semicolons, tabs or commas, of which the first one that the row of
/// names has is taken; where commas do not separate, they are decimal commas. Lines that begin with `#` are left out.
///
/// # Errors
/// A sentence for what is no such table.
///
/// ```
/// use asperity::files::columns_of;
/// let table = columns_of(b"time;load\n0;0,02\n1;0,05\n")?;
/// assert_eq!(table[1].name, "load");
/// assert_eq!(table[1].numbers(|word| Err(word.into()))?, [0.02, 0.05]);
/// # Ok::<(), String>(())
/// ```
pub fn columns_of(bytes: &[u8]) -> Result<Vec<TextColumn>, String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "it is not a text in UTF-8".to_owned())?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let names = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#')).unwrap_or_default();
    let separator = [';', '\t'].into_iter().find(|it| names.contains(*it)).unwrap_or(',');
    let mut reader = csv::ReaderBuilder::new();
    reader.trim(csv::Trim::All).comment(Some(b'#')).flexible(true).delimiter(separator as u8);
    let mut reader = reader.from_reader(text.as_bytes());
    let wrong = |error: csv::Error| format!("it is not a table: {error}");
    let column = |name: &str| TextColumn { name: name.to_owned(), words: Vec::new() };
    let mut columns: Vec<TextColumn> = reader.headers().map_err(wrong)?.iter().map(column).collect();
    for record in reader.records() {
        let record = record.map_err(wrong)?;
        let row = record.position().map_or(0, csv::Position::line);
        if record.len() != columns.len() {
            let [words, names] = [record.iter().collect::<Vec<_>>().join("`, `"), columns.len().to_string()];
            let advice = "separate columns with semicolons if numbers have decimal commas";
            return Err(format!("row {row} has the words `{words}`, but there are {names} columns: {advice}"));
        }
        for (column, word) in columns.iter_mut().zip(&record) {
            let text = if separator == ',' { word.to_owned() } else { with_point(word) };
            column.words.push(TextWord { row, text });
        }
    }
    Ok(columns)
}

/// A word whose only comma, between two digits, is a decimal point.
fn with_point(word: &str) -> String {
    let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let is_decimal = |(whole, part): &(&str, &str)| {
        is_digit(whole.chars().last())
            && is_digit(part.chars().next())
            && ![whole, part].iter().any(|it| it.contains(['.', ',']))
    };
    match word.split_once(',').filter(is_decimal) {
        Some((whole, part)) => format!("{whole}.{part}"),
        None => word.to_owned(),
    }
}
