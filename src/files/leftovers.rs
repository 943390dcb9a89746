//! Hidden drafts that killed processes have left.
//!
//! A process locks each hidden draft as long as it has it, and the system releases the locks of a process that ends in any way. A hidden draft that
//! another process can lock is a leftover. On Windows a lock keeps even its own process from writing, so that nothing is locked and nothing is removed
//! there.

use std::collections::BTreeSet;
use std::fs::{File, TryLockError, read_dir, remove_dir_all, remove_file};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// What the names of hidden drafts begin with.
pub(super) const HIDDEN: &str = ".asperity-";

/// Letters and digits at the end of the name of a hidden draft.
const RANDOM: usize = 6;

/// The folders in which this process has looked.
static SEEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// The lock of a hidden draft that was just created; none where the system has no locks.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`] where another process has taken it for a leftover, so that another name is needed.
pub(super) fn hold(path: &Path) -> io::Result<Option<File>> {
    let file = match File::open(path) {
        Ok(file) if cfg!(unix) => file,
        _ => return Ok(None),
    };
    let is_held = match file.try_lock() {
        Ok(()) => true,
        Err(TryLockError::WouldBlock) => return Err(io::ErrorKind::AlreadyExists.into()),
        Err(TryLockError::Error(_)) => false,
    };
    match path.exists() {
        true => Ok(is_held.then_some(file)),
        false => Err(io::ErrorKind::AlreadyExists.into()),
    }
}

/// Removes the leftovers in a folder, when it is looked at for the first time.
pub(super) fn remove_leftovers(folder: &Path) {
    if !cfg!(unix) || !SEEN.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.to_owned()) {
        return;
    }
    let Ok(entries) = read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let random = name.to_str().and_then(|name| name.strip_prefix(HIDDEN));
        let is_hidden =
            random.is_some_and(|it| it.len() == RANDOM && it.bytes().all(|byte| byte.is_ascii_alphanumeric()));
        // links are not followed: nobody but a stranger makes one of this name
        let is_link = entry.file_type().map_or(true, |kind| kind.is_symlink());
        if is_hidden && !is_link {
            remove_if_left(&entry.path());
        }
    }
}

/// Removes a hidden draft whose process is gone. What cannot be removed stays.
fn remove_if_left(path: &Path) {
    let Ok(file) = File::open(path) else { return };
    if file.try_lock().is_ok() {
        let _ = if path.is_dir() { remove_dir_all(path) } else { remove_file(path) };
    }
}
