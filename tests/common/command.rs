//! What the tests of the command line share: a folder for each test, and the binary run in it.

use assert_cmd::Command;
use std::path::PathBuf;
use std::process::Output;
use std::time::Duration;
use tempfile::TempDir;

/// After which a command counts as hung.
const PATIENCE: Duration = Duration::from_secs(60);

/// An empty folder that is deleted in the end.
pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// The path of the file `name` in it.
    pub fn join(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Runs `asperity` in it, with the words of `line` as arguments.
    pub fn run(&self, line: &str) -> Output {
        self.finish(Command::new(env!("CARGO_BIN_EXE_asperity")).args(line.split_whitespace()))
    }

    /// Runs any command in it.
    pub fn finish(&self, command: &mut Command) -> Output {
        command.current_dir(self.0.path()).timeout(PATIENCE).output().unwrap()
    }
}

pub fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}
