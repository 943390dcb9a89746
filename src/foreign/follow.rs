//! A folder that another code writes its steps into.

use super::steps::in_folder;
use crate::error::FileError;
use crate::formats::read_fields_shape;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Time between two looks at the folder.
const PAUSE: Duration = Duration::from_millis(100);

/// The files with steps in a folder, as they come. A file counts when it is whole: its header can be read and fits its length, which did not change between two looks.
pub struct Follow<'a> {
    folder: PathBuf,
    /// The name of the array in an archive.
    name: &'static str,
    /// Time without a new file after which there are no more.
    patience: Option<Duration>,
    is_over: &'a dyn Fn() -> bool,
    seen: BTreeSet<PathBuf>,
    /// Files that are not known to be whole, and their lengths.
    lengths: BTreeMap<PathBuf, u64>,
    ready: VecDeque<PathBuf>,
    latest: Instant,
}

impl<'a> Follow<'a> {
    /// Follows a folder until no new step has come for the given time, if any, or until `is_over` returns true.
    ///
    /// # Errors
    /// [`FileError::Read`] for a folder that cannot be read.
    pub fn new(
        folder: &Path,
        name: &'static str,
        patience: Option<Duration>,
        is_over: &'a dyn Fn() -> bool,
    ) -> Result<Self, FileError> {
        in_folder(folder)?;
        let (seen, lengths, ready, latest) = (BTreeSet::new(), BTreeMap::new(), VecDeque::new(), Instant::now());
        Ok(Self { folder: folder.into(), name, patience, is_over, seen, lengths, ready, latest })
    }

    /// Looks for new files. A folder that is gone has none.
    fn look(&mut self) {
        for path in in_folder(&self.folder).unwrap_or_default() {
            let Ok(length) = std::fs::metadata(&path).map(|metadata| metadata.len()) else { continue };
            let is_still = self.lengths.insert(path.clone(), length) == Some(length);
            if is_still && !self.seen.contains(&path) && read_fields_shape(&path, self.name).is_ok() {
                self.seen.insert(path.clone());
                self.ready.push_back(path);
                self.latest = Instant::now();
            }
        }
    }
}

impl Iterator for Follow<'_> {
    type Item = PathBuf;

    fn next(&mut self) -> Option<PathBuf> {
        loop {
            if (self.is_over)() {
                return None;
            }
            if let Some(path) = self.ready.pop_front() {
                return Some(path);
            }
            self.look();
            if self.ready.is_empty() {
                if self.patience.is_some_and(|patience| self.latest.elapsed() > patience) {
                    return None;
                }
                sleep(PAUSE);
            }
        }
    }
}
