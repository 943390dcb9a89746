//! A table of points on disk, which grows while a study runs.

use super::check::Checksum;
use super::point::{Point, further};
use crate::contact::Quantity;
use crate::error::FileError;
use crate::files::{check_target, read_if_there, write_beside, write_csv};
use csv::StringRecord;
use serde::{Deserialize, Serialize};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The points of a study in files.
///
/// | file                 | what it holds                                                                  |
/// |----------------------|--------------------------------------------------------------------------------|
/// | `NAME.csv`           | all points of a finished study, in its order: the same to the last bit whenever it is run |
/// | `NAME.seconds.csv`   | the seconds that each of them took, row by row                                 |
/// | `NAME.unfinished`    | the points of a study that runs, or was killed, in the order of their coming    |
///
/// The last column of a row of points is its check sum, which covers the names of the columns: a row that was changed after it was written is
/// treated as missing, and is solved again, and so are all rows if names were changed.
///
/// The unfinished table has a fixed name, so that the next run finds it, and belongs to one process at a time. A file of that name that is something
/// else is refused.
#[derive(Debug, Clone)]
pub struct Table {
    path: PathBuf,
    /// The unfinished table, once this process adds to it.
    unfinished: Arc<Mutex<Option<File>>>,
}

/// First line of an unfinished table.
const HEAD: &str = "# Points of a study that is not finished, as asperity writes them\n";

/// A row of the seconds.
#[derive(Serialize, Deserialize)]
struct Seconds {
    name: String,
    ny: usize,
    nx: usize,
    hurst: Option<f64>,
    seed: Option<u64>,
    reduced_pressure: f64,
    seconds: f64,
}

impl Seconds {
    fn from_point(point: &Point) -> Self {
        let Point { name, ny, nx, hurst, seed, seconds, observables, .. } = point.clone();
        Self { name, ny, nx, hurst, seed, reduced_pressure: observables.reduced_pressure, seconds }
    }
}

impl Table {
    /// The table `path`, which ends in `.csv` and need not exist.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), unfinished: Arc::default() }
    }

    /// The path of the finished table.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// All points that are there, those of the finished table first, as far as their rows are whole and as they were written.
    ///
    /// # Errors
    /// [`FileError::Read`] for files that are there and cannot be read, [`FileError::Target`] for a finished table that holds
    /// anything else than points: it is not ours to replace.
    pub fn read(&self) -> Result<Vec<Point>, FileError> {
        let seconds = finished(&self.seconds_path(), "seconds", |record, names| record.deserialize(Some(names)))?;
        let mut seconds = seconds.into_iter().map(|Seconds { seconds, .. }| seconds);
        let points = finished(&self.path, "setup", |record, names| {
            let seconds = seconds.next().unwrap_or(f64::NAN);
            Ok(Point::from_named(record, names)?.map(|point| Point { seconds, ..point }))
        })?;
        let mut points: Vec<Point> = points.into_iter().flatten().collect();
        points.extend(self.read_unfinished()?);
        Ok(points)
    }

    /// The first row of the finished table, from 1, that is not as it was written, if there is one.
    ///
    /// # Errors
    /// The errors of [`Table::read`].
    pub(super) fn damaged(&self) -> Result<Option<usize>, FileError> {
        let are_whole = finished(&self.path, "setup", |record, names| Ok(Point::from_named(record, names)?.is_some()))?;
        Ok(are_whole.iter().position(|is_whole| !is_whole).map(|i| i + 1))
    }

    /// Adds the points of realisations to the unfinished table, so that an interrupted run need not repeat them. If the
    /// machine loses power, the last points may be lost.
    ///
    /// # Errors
    /// [`FileError::Target`] or [`FileError::Write`].
    pub fn append<'a>(&self, points: impl IntoIterator<Item = &'a Point>) -> Result<(), FileError> {
        let failed = |source| FileError::Write { path: self.unfinished_path(), source };
        let mut unfinished = self.unfinished.lock().unwrap_or_else(PoisonError::into_inner);
        let file = match &mut *unfinished {
            Some(file) => file,
            none => none.insert(self.open_unfinished()?),
        };
        let head = if file.metadata().map_err(failed)?.len() == 0 { HEAD } else { "" };
        file.write_all(format!("{head}{}", Point::to_lines(points)).as_bytes()).map_err(failed)
    }

    /// The points of the unfinished table.
    fn read_unfinished(&self) -> Result<Vec<Point>, FileError> {
        let path = self.unfinished_path();
        let (text, is_link) = (read_if_there(&path)?, path.is_symlink());
        let points = Point::from_lines(&text);
        let is_own = text.starts_with(HEAD.as_bytes()) || HEAD.as_bytes().starts_with(&text) || !points.is_empty();
        match is_own && !is_link {
            true => Ok(points),
            false => Err(not_ours(&path)),
        }
    }

    /// Opens the unfinished table, which belongs to this process until it is closed.
    fn open_unfinished(&self) -> Result<File, FileError> {
        self.read_unfinished()?;
        let path = self.unfinished_path();
        check_target(&path)?;
        let opened = OpenOptions::new().create(true).append(true).open(&path);
        let file = opened.map_err(|source| FileError::Write { path: path.clone(), source })?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => {
                let reason = "another run fills it: wait until that one ends, or give another table".into();
                Err(FileError::Target { path, reason })
            }
            // a file system without locks is used as it is
            Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
        }
    }

    /// Writes the finished table and removes the unfinished one.
    ///
    /// # Errors
    /// [`FileError::Target`] or [`FileError::Write`].
    pub fn finish(&self, points: &[Point]) -> Result<(), FileError> {
        let has_observables = !points.iter().any(Point::has_adhesion);
        let told: Vec<Quantity> = further().filter(|it| points.iter().any(|point| point.get(*it).is_some())).collect();
        write_beside(&self.path, |file| {
            let mut csv = csv::Writer::from_writer(file);
            for (number, point) in points.iter().enumerate() {
                let (mut names, mut words) = point.words(has_observables, told.iter().copied(), false);
                words.push(Checksum::from_words(&names, &words));
                names.push(Checksum::NAME.into());
                if number == 0 {
                    csv.write_record(names)?;
                }
                csv.write_record(words)?;
            }
            csv.flush()
        })?;
        self.settle(points)
    }

    /// Writes the seconds of the points of the finished table, and removes the unfinished one.
    ///
    /// # Errors
    /// [`FileError::Target`] or [`FileError::Write`].
    pub(super) fn settle(&self, points: &[Point]) -> Result<(), FileError> {
        write_csv(&self.seconds_path(), points.iter().map(Seconds::from_point))?;
        self.close_unfinished();
        remove(self.unfinished_path())
    }

    /// Removes all files of the table, and what was drawn or written of it beside it: `NAME.parquet`, `NAME.svg` and `NAME.png`.
    ///
    /// # Errors
    /// [`FileError::Write`]; [`FileError::Target`] for a table that another process fills.
    pub fn clear(&self) -> Result<(), FileError> {
        self.close_unfinished();
        if self.unfinished_path().exists() {
            self.open_unfinished()?;
        }
        let views = self.views().into_iter();
        self.files().into_iter().chain(views).try_for_each(remove)
    }

    /// Leaves the unfinished table to others.
    fn close_unfinished(&self) {
        self.unfinished.lock().unwrap_or_else(PoisonError::into_inner).take();
    }

    /// The paths of the files beside the table of a whole study.
    pub fn views(&self) -> [PathBuf; 3] {
        ["parquet", "svg", "png"].map(|ending| self.path.with_extension(ending))
    }

    /// The paths of all files that it is read from.
    pub fn files(&self) -> [PathBuf; 3] {
        [self.path.clone(), self.seconds_path(), self.unfinished_path()]
    }

    fn seconds_path(&self) -> PathBuf {
        self.path.with_extension("seconds.csv")
    }

    /// The path of the points of a study that runs, or was stopped.
    pub fn unfinished_path(&self) -> PathBuf {
        self.path.with_extension("unfinished")
    }
}

/// Removes a file, if it is there.
fn remove(path: PathBuf) -> Result<(), FileError> {
    match std::fs::remove_file(&path) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => Err(FileError::Write { path, source }),
        _ => Ok(()),
    }
}

/// The records of a table that is whole, each read by `read` under the names of the columns, one of which is `column`.
fn finished<T>(
    path: &Path,
    column: &str,
    mut read: impl FnMut(&StringRecord, &StringRecord) -> csv::Result<T>,
) -> Result<Vec<T>, FileError> {
    let text = read_if_there(path)?;
    let mut csv = csv::Reader::from_reader(text.as_slice());
    let names = csv.headers().map_err(|_| not_ours(path))?.clone();
    if !(text.is_empty() || names.iter().any(|name| name == column)) {
        return Err(not_ours(path));
    }
    csv.records().map(|record| read(&record?, &names)).collect::<csv::Result<_>>().map_err(|_| not_ours(path))
}

fn not_ours(path: &Path) -> FileError {
    let reason = "it is not a table of a study: give another name, or remove it";
    FileError::Target { path: path.into(), reason: reason.into() }
}
