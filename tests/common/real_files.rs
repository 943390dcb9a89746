//! Files of instruments, which are not part of this project. Tests that need them are ignored: give the folder with them as `SURFACES`, and
//! `-- --ignored`.

use std::path::PathBuf;

/// The folder with such files, beside what a peer's reader makes of them in `truth.json`.
pub fn real_files() -> PathBuf {
    PathBuf::from(std::env::var_os("SURFACES").expect("SURFACES names the folder with files of instruments"))
}
