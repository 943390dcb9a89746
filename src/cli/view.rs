//! `asperity view`: a recording in the viewer that is built in.

use super::Outcome;
use super::explore::PageArgs;
use anyhow::Result;
use asperity::error::FileError;
use asperity::explore::Viewing;
use clap::Args;
use std::fs::File;
use std::io::Read;
use std::path::PathBuf;

/// First bytes of a recording.
const MAGIC: [u8; 3] = *b"RRF";

/// Opens a recording in the browser, with nothing to install.
#[derive(Args)]
pub struct View {
    /// The recording
    #[arg(value_name = "FILE.rrd")]
    file: PathBuf,
    #[command(flatten)]
    page: PageArgs,
}

impl View {
    /// Runs the command.
    pub fn run(&self) -> Result<Outcome> {
        self.check()?;
        let viewing = Viewing::new(self.file.clone())?;
        self.page.open()?.run(viewing)?;
        Ok(Outcome::Done)
    }

    /// Refuses what is no recording.
    fn check(&self) -> Result<(), FileError> {
        let unreadable = |source| FileError::Read { path: self.file.clone(), source };
        let mut first = [0; 3];
        let read = File::open(&self.file).and_then(|file| file.take(3).read(&mut first)).map_err(unreadable)?;
        if read == 3 && first == MAGIC {
            return Ok(());
        }
        let reason = "it is not a recording: give a file that `asperity solve --record` wrote".into();
        Err(FileError::Read { path: self.file.clone(), source: std::io::Error::other::<String>(reason) })
    }
}
