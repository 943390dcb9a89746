//! The steps of other codes, out of files.

use super::claim::check;
use super::given_field::GivenField;
use super::order::natural;
use super::replay::Frame;
use crate::error::{ClaimError, Failure, FileError, StepsError};
use crate::formats::{has_field, read_fields};
use crate::grid::Grid;
use crate::surface::Field;
use ndarray::{ArrayD, Axis};
use std::path::{Path, PathBuf};

/// Names of the array of an archive that holds the seconds of its steps.
const TIMES: [&str; 2] = ["seconds", "time"];
/// Endings of the names of files with steps.
const ENDINGS: [&str; 5] = ["npy", "npz", "txt", "csv", "dat"];

/// Steps of a quantity on a grid, read from one file after the other: one step a file, or several along a first axis. An archive has
/// them under the name of the quantity, and their seconds, if it has any, as `seconds` or `time`.
pub struct Steps<P> {
    quantity: GivenField,
    grid: Grid,
    paths: P,
    /// The seconds of all steps, if they were given beside the files.
    seconds: Option<Vec<f64>>,
    /// The steps of the present file that are still to come.
    frames: std::vec::IntoIter<Frame>,
    /// Steps so far.
    count: usize,
}

/// The files with steps among `paths`, and all such files in the folders among them, in natural order: `step2` before
/// `step10`.
///
/// # Errors
/// [`FileError::Read`] for a folder that cannot be read.
pub fn step_files(paths: &[PathBuf]) -> Result<Vec<PathBuf>, FileError> {
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() { files.extend(in_folder(path)?) } else { files.push(path.clone()) }
    }
    files.sort_by_key(|path| natural(path));
    Ok(files)
}

/// The files with steps in a folder, in natural order.
pub(super) fn in_folder(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
    let unreadable = |source| FileError::Read { path: folder.into(), source };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let is_hidden = path.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(b"."));
        let ending = path.extension().unwrap_or_default();
        if !is_hidden && ENDINGS.iter().any(|it| ending.eq_ignore_ascii_case(it)) && path.is_file() {
            files.push(path);
        }
    }
    files.sort_by_key(|path| natural(path));
    Ok(files)
}

impl<P: Iterator<Item = PathBuf>> Steps<P> {
    /// The steps of a quantity in the files of some paths.
    pub fn new(quantity: GivenField, grid: &Grid, paths: P) -> Self {
        Self { quantity, grid: *grid, paths, seconds: None, frames: Vec::new().into_iter(), count: 0 }
    }

    /// The steps with their seconds from the start, one for each.
    pub fn with_seconds(self, seconds: Vec<f64>) -> Self {
        Self { seconds: Some(seconds), ..self }
    }

    /// Reads all steps and returns how many they are, so that a replay does not end in vain.
    ///
    /// # Errors
    /// [`StepsError`] for the first file that cannot be used, for none at all, and for seconds that are fewer or more.
    pub fn check(mut self) -> Result<usize, StepsError> {
        while let Some(frame) = self.read().transpose()? {
            drop(frame);
        }
        let steps = self.count;
        match self.seconds {
            _ if steps == 0 => Err(StepsError::Nothing),
            Some(seconds) if seconds.len() != steps => Err(StepsError::Seconds { seconds: seconds.len(), steps }),
            _ => Ok(steps),
        }
    }

    /// The next step; none after the last one.
    fn read(&mut self) -> Option<Result<Frame, StepsError>> {
        loop {
            if let Some(frame) = self.frames.next() {
                self.count += 1;
                let seconds = self.seconds.as_ref().and_then(|seconds| seconds.get(self.count - 1).copied());
                return Some(Ok(Frame { seconds: seconds.or(frame.seconds), ..frame }));
            }
            let path = self.paths.next()?;
            match self.read_file(&path) {
                Ok(frames) => self.frames = frames.into_iter(),
                Err(error) => return Some(Err(error)),
            }
        }
    }

    /// Reads the steps in a file.
    fn read_file(&self, path: &Path) -> Result<Vec<Frame>, StepsError> {
        let fields = self.stacked(path, read_fields(path, self.quantity.name())?)?;
        let seconds = seconds_of(path)?;
        let steps = fields.len_of(Axis(0));
        if let Some(seconds) = seconds.as_ref().filter(|seconds| seconds.len() != steps) {
            let (path, seconds) = (path.into(), seconds.len());
            return Err(StepsError::SecondsOfFile { path, seconds, steps });
        }
        let frame = |(i, field): (usize, ndarray::ArrayViewD<'_, f64>)| {
            let field: Field = field.to_shape(self.grid.shape()).map_err(|_| self.misfit(path, &fields))?.into_owned();
            let wrong = |source| StepsError::Step { path: path.into(), step: i, source };
            check(self.quantity, &field, self.grid.shape()).map_err(wrong)?;
            Ok(Frame { values: field.into_iter().collect(), seconds: seconds.as_ref().map(|seconds| seconds[i]) })
        };
        fields.axis_iter(Axis(0)).enumerate().map(frame).collect()
    }

    /// The fields of an array along a first axis, be it one or several.
    fn stacked(&self, path: &Path, array: ArrayD<f64>) -> Result<ArrayD<f64>, StepsError> {
        let [ny, nx] = self.grid.shape();
        match *array.shape() {
            [n] if self.grid.is_line() && n == nx => Ok(array.insert_axis(Axis(0))),
            [_, n] if self.grid.is_line() && n == nx => Ok(array),
            [rows, columns] if [rows, columns] == [ny, nx] => Ok(array.insert_axis(Axis(0))),
            [_, rows, columns] if [rows, columns] == [ny, nx] => Ok(array),
            _ => Err(self.misfit(path, &array)),
        }
    }

    fn misfit(&self, path: &Path, array: &ArrayD<f64>) -> StepsError {
        let (found, [ny, nx]) = (array.shape().to_vec(), self.grid.shape());
        let is_transposed = matches!(*found, [.., rows, columns] if [rows, columns] == [nx, ny]) && ny != nx;
        let source = ClaimError::Shape { quantity: self.quantity.name(), found, expected: [ny, nx], is_transposed };
        StepsError::Step { path: path.into(), step: 0, source }
    }
}

/// The seconds of the steps in an archive, if it has them.
fn seconds_of(path: &Path) -> Result<Option<Vec<f64>>, FileError> {
    for name in TIMES {
        if has_field(path, name)? {
            return Ok(Some(read_fields(path, name)?.iter().copied().collect()));
        }
    }
    Ok(None)
}

impl<P: Iterator<Item = PathBuf>> Iterator for Steps<P> {
    type Item = Result<Frame, Failure>;

    fn next(&mut self) -> Option<Self::Item> {
        self.read().map(|frame| frame.map_err(Failure::from))
    }
}
