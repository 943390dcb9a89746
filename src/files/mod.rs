//! Input files, and output files that appear completely or not at all.

mod apart;
mod input_file;

pub use apart::check_apart;
pub use input_file::{InputFile, open_regular, read_bytes};

use crate::error::{Failure, FileError, reason};
use serde::Serialize;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use tempfile::{Builder, NamedTempFile};

/// Checks that a file can be created at `path`, so that a long computation is not lost.
///
/// # Errors
/// [`FileError::Target`] if `path` is a directory or a device, or nothing can be created in its folder.
pub fn check_target(path: &Path) -> Result<(), FileError> {
    draft_beside(path).map(drop)
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
    let mut draft = draft_beside(path)?;
    let written = fill(draft.as_file_mut(), write).and_then(|()| Ok(draft.persist(path).map(drop)?));
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
/// for the rest. None leaves anything behind. The draft of a process that was killed is removed by the next one that fills the folder.
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
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let draft = path.with_file_name(format!(".{name}.unfinished"));
    if draft.is_dir() {
        std::fs::remove_dir_all(&draft).map_err(failed)?;
    }
    std::fs::create_dir(&draft).map_err(failed)?;
    let filled = fill(&draft).and_then(|()| {
        if path.is_dir() {
            std::fs::remove_dir(path).map_err(failed)?;
        }
        Ok(std::fs::rename(&draft, path).map_err(failed)?)
    });
    if filled.is_err() {
        let _ = std::fs::remove_dir_all(&draft); // what cannot be removed is of no use to anybody
    }
    filled
}

/// A temporary file in the folder of `path`, removed unless it is renamed, if a file can be made there.
fn draft_beside(path: &Path) -> Result<NamedTempFile<File>, FileError> {
    let unfit = |reason: String| FileError::Target { path: path.into(), reason };
    if path.file_name().is_none() || path.as_os_str().as_encoded_bytes().ends_with(b"/") || path.is_dir() {
        return Err(unfit("it is a directory: give the name of a file".into()));
    }
    if path.exists() && !path.is_file() {
        return Err(unfit("it is not a regular file: give another name".into()));
    }
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        return Err(unfit(format!("the folder {} does not exist: create it first", folder.display())));
    }
    // `File::create_new` gives the usual permissions; files that tempfile creates can be read by their owner alone
    let draft = Builder::new().prefix(".asperity-").make_in(folder, |draft| File::create_new(draft));
    draft.map_err(|error| unfit(format!("nothing can be created in {}: {}", folder.display(), reason(&error))))
}

fn fill(file: &mut File, write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::new(&mut *file);
    write(&mut writer)?;
    writer.flush()?;
    drop(writer);
    file.sync_all()
}
/// The columns of a file of comma-separated values, see [`columns_of`].
///
/// # Errors
/// [`FileError::Read`] for a file that cannot be read, [`FileError::Format`] for one that is no such table.
pub fn read_columns(path: &Path) -> Result<Vec<(String, Vec<String>)>, FileError> {
    columns_of(&read_bytes(path)?).map_err(|reason| FileError::Format { path: path.into(), what: "table", reason })
}

/// The columns of comma-separated values whose first row names them, as words: the names, and what is in each column. Lines that begin with
/// `#` are left out.
///
/// # Errors
/// A sentence for what is no such table.
pub fn columns_of(bytes: &[u8]) -> Result<Vec<(String, Vec<String>)>, String> {
    let wrong = |error: csv::Error| format!("it is not a table of comma-separated values: {error}");
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(bytes);
    let headers = reader.headers().map_err(wrong)?;
    let mut columns: Vec<(String, Vec<String>)> = headers.iter().map(|name| (name.to_owned(), Vec::new())).collect();
    for row in reader.records() {
        let row = row.map_err(wrong)?;
        columns.iter_mut().zip(row.iter()).for_each(|((_, words), word)| words.push(word.to_owned()));
    }
    Ok(columns)
}
