//! Drafts: what is written under a name of its own, before it has its final name.

use super::leftovers::{HIDDEN, hold, remove_leftovers};
use crate::error::{FileError, reason};
use std::ffi::{OsStr, OsString};
use std::fs::{File, create_dir, metadata, remove_dir_all, remove_file, rename, set_permissions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::Builder;

/// The drafts of this process. They are global, as a request to end the process can come at any time.
static DRAFTS: Mutex<Vec<DraftName>> = Mutex::new(Vec::new());

/// A file or folder that was created new, under a name of its own, in the folder of the one that it stands for. No file of that name is opened or
/// followed, and no other process has it. Where the name that it stands for is a link, it stands for the file that the link points to. It has the
/// permissions of an older file that it takes the place of.
///
/// A hidden draft, `.asperity-XXXXXX`, is removed when it is dropped; one that a killed process has left is removed by the next process that writes in
/// its folder. A draft that grows, such as `run.part-XXXXXX.rrd` for `run.rrd`, stays: it holds what a run that is killed has reached.
///
/// ```
/// use asperity::files::Draft;
/// use std::io::Write;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("run.rrd");
/// let (draft, mut file) = Draft::growing(&path)?;
/// file.write_all(b"some states")?;
/// assert!(draft.path().to_string_lossy().contains("run.part-") && !path.exists());
/// draft.finish()?;
/// assert_eq!(std::fs::read(&path)?, b"some states");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Draft {
    name: DraftName,
    stands_for: PathBuf,
    /// What tells other processes that this one has it, where it is hidden.
    held: Option<File>,
}

#[derive(Debug, Clone, PartialEq)]
struct DraftName {
    path: PathBuf,
    grows: bool,
}

impl Draft {
    /// A hidden draft of the file `path`.
    ///
    /// # Errors
    /// [`FileError::Target`] if `path` is a directory or a device, or nothing can be created in its folder.
    pub(super) fn hidden(path: &Path) -> Result<(Self, File), FileError> {
        check_place(path)?;
        Self::make(path, [HIDDEN.into(), OsString::new()], |path| File::create_new(path))
    }

    /// A hidden draft of the folder `path`.
    ///
    /// # Errors
    /// [`FileError::Target`] if nothing can be created beside it.
    pub(super) fn hidden_folder(path: &Path) -> Result<Self, FileError> {
        Ok(Self::make(path, [HIDDEN.into(), OsString::new()], |path| create_dir(path))?.0)
    }

    /// A file that grows until it is finished: `NAME.part-XXXXXX.ENDING` for `NAME.ENDING`.
    ///
    /// # Errors
    /// [`FileError::Target`] if `path` is a directory or a device, or nothing can be created in its folder.
    pub fn growing(path: &Path) -> Result<(Self, File), FileError> {
        check_place(path)?;
        let mut ending = OsString::from(if path.extension().is_some() { "." } else { "" });
        ending.push(path.extension().unwrap_or_default());
        Self::make(path, [part_of(path), ending], |path| File::create_new(path))
    }

    /// A folder that grows in place of the file `path`: `NAME.part-XXXXXX` for `NAME.ENDING`.
    ///
    /// # Errors
    /// [`FileError::Target`] if nothing can be created in the folder of `path`.
    pub fn growing_folder(path: &Path) -> Result<Self, FileError> {
        Ok(Self::make(path, [part_of(path), OsString::new()], |path| create_dir(path))?.0)
    }

    fn make<T>(
        path: &Path,
        [before, behind]: [OsString; 2],
        create: impl FnMut(&Path) -> io::Result<T>,
    ) -> Result<(Self, T), FileError> {
        let stands_for = followed(path);
        let folder = folder_of(&stands_for);
        let is_hidden = before == OsStr::new(HIDDEN);
        if is_hidden {
            remove_leftovers(folder);
        }
        let mut drafts = drafts();
        let mut create = create;
        let mut held = None;
        let create_held = |path: &Path| {
            let content = create(path)?;
            // another process may have taken a new draft for one that was left, and removed it: the next name is tried
            if is_hidden {
                held = hold(path)?;
            }
            Ok(content)
        };
        // files that tempfile creates by itself can be read by their owner alone
        let made = Builder::new().prefix(&before).suffix(&behind).disable_cleanup(true).make_in(folder, create_held);
        let (content, made) = made.map_err(|error| nothing_in(folder, path, &error))?.into_parts();
        let own = stands_for.with_file_name(made.file_name().unwrap_or_default());
        let name = DraftName { path: own, grows: !is_hidden };
        drafts.push(name.clone());
        if let Ok(older) = metadata(&stands_for)
            && older.is_file()
            && !name.path.is_dir()
        {
            set_permissions(&name.path, older.permissions()).ok(); // a file system without permissions has nothing to keep
        }
        Ok((Self { name, stands_for, held }, content))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.name.path
    }

    /// Gives it its final name, in place of an older file there.
    ///
    /// # Errors
    /// Errors of the system, with the place of the draft, which stays: it holds all that was to be written.
    pub fn finish(mut self) -> io::Result<()> {
        self.held = None; // Windows renames no file that is open
        rename(&self.name.path, &self.stands_for).map_err(|error| {
            drafts().retain(|name| *name != self.name);
            self.name.grows = true;
            let reason = format!("{}; what was to be written is in {}", reason(&error), self.name.path.display());
            io::Error::new(error.kind(), reason)
        })
    }

    /// Removes it.
    pub fn discard(self) {
        remove(&self.name.path);
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        if !self.name.grows {
            remove(&self.name.path);
        }
        drafts().retain(|name| *name != self.name);
    }
}

/// Removes all hidden drafts of this process, which has to end, and begins no more. Returns those that grow, which stay.
pub fn abandon_drafts() -> Vec<PathBuf> {
    let drafts = drafts();
    drafts.iter().filter(|name| !name.grows).for_each(|name| remove(&name.path));
    let left = drafts.iter().filter(|name| name.grows && name.path.exists()).map(|name| name.path.clone()).collect();
    std::mem::forget(drafts); // whoever would begin one waits until the process ends
    left
}

fn drafts() -> MutexGuard<'static, Vec<DraftName>> {
    DRAFTS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes a file or a folder. What cannot be removed is of no use to anybody.
fn remove(path: &Path) {
    let _ = if path.is_dir() { remove_dir_all(path) } else { remove_file(path) };
}

/// The beginning of the names of drafts that grow.
fn part_of(path: &Path) -> OsString {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(".part-");
    name
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The file that a link points to, through any number of links up to [`MOST_LINKS`]; the path itself, where it is no link. The file need not exist.
fn followed(path: &Path) -> PathBuf {
    let mut place = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(target) = place.read_link() else { break };
        place = folder_of(&place).join(target); // an absolute target takes the place of the folder
    }
    place
}

/// The most links in a row: systems follow 40.
const MOST_LINKS: usize = 40;

/// Refuses a place where there can be no file.
fn check_place(path: &Path) -> Result<(), FileError> {
    let unfit = |reason: String| Err(FileError::Target { path: path.into(), reason });
    if path.file_name().is_none() || path.as_os_str().as_encoded_bytes().ends_with(b"/") || path.is_dir() {
        return unfit("it is a directory: give the name of a file".into());
    }
    if path.exists() && !path.is_file() {
        return unfit("it is not a regular file: give another name".into());
    }
    if metadata(path).is_ok_and(|older| older.permissions().readonly()) {
        return unfit("it is write-protected: allow writing to it, or give another name".into());
    }
    let place = followed(path);
    let folder = folder_of(&place);
    match folder.is_dir() {
        true => Ok(()),
        false => unfit(format!("the folder {} does not exist: create it first", folder.display())),
    }
}

fn nothing_in(folder: &Path, path: &Path, error: &io::Error) -> FileError {
    let reason = format!("nothing can be created in {}: {}", folder.display(), reason(error));
    FileError::Target { path: path.into(), reason }
}
