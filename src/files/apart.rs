//! Files that are written, apart from those that are read.

use crate::error::FileError;
use std::path::{Path, PathBuf};

/// Checks that all output files are different, and that none of them is an input file, even under another name: another way to write its path, a
/// symbolic link, or a hard link.
///
/// # Errors
/// [`FileError::Target`] for the first file that would be lost.
///
/// ```
/// use asperity::files::check_apart;
/// let [result, same, heights] = ["a.npz", "./a.npz", "h.npy"];
/// assert!(check_apart([result], [heights]).is_ok());
/// let refused = check_apart([result, same], [heights]).unwrap_err();
/// assert_eq!(refused.to_string(), "cannot write ./a.npz: two outputs have this name: give each its own name");
/// ```
pub fn check_apart<W: AsRef<Path>, R: AsRef<Path>>(
    written: impl IntoIterator<Item = W>,
    read: impl IntoIterator<Item = R>,
) -> Result<(), FileError> {
    let read: Vec<FilePlace> = read.into_iter().map(|path| FilePlace::new(path.as_ref())).collect();
    let mut taken: Vec<FilePlace> = Vec::new();
    for path in written {
        let path = path.as_ref();
        let place = FilePlace::new(path);
        let refuse = |reason: &str| Err(FileError::Target { path: path.into(), reason: reason.into() });
        if read.iter().any(|it| it.is_same_as(&place)) {
            return refuse("it is also an input file and would be lost: give another name");
        }
        if taken.iter().any(|it| it.path == place.path) {
            return refuse("two outputs have this name: give each its own name");
        }
        taken.push(place);
    }
    Ok(())
}

/// Where a file is, which need not exist yet.
struct FilePlace {
    /// Its path without links.
    path: PathBuf,
    /// Device and number of the content, which hard links share.
    #[cfg(unix)]
    content: Option<[u64; 2]>,
}

impl FilePlace {
    fn new(path: &Path) -> Self {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let beside = || Some(folder.canonicalize().ok()?.join(path.file_name()?));
        Self {
            path: path.canonicalize().ok().or_else(beside).unwrap_or_else(|| path.into()),
            #[cfg(unix)]
            content: content(path),
        }
    }

    fn is_same_as(&self, other: &Self) -> bool {
        #[cfg(unix)]
        if self.content.is_some() && self.content == other.content {
            return true;
        }
        self.path == other.path
    }
}

#[cfg(unix)]
fn content(path: &Path) -> Option<[u64; 2]> {
    use std::os::unix::fs::MetadataExt;
    std::fs::metadata(path).ok().map(|file| [file.dev(), file.ino()])
}
