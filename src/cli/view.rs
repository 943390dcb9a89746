//! `asperity view`: a recording in the viewer that is built in.

use super::exit_status::{ExitStatus, usage};
use super::explore::PageArgs;
use super::warnings::print_if_cut_off;
use anyhow::Result;
use asperity::record::{compare, is_recording};
use asperity::serve::Viewing;
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub struct View {
    /// The recording, or several to lay over each other
    #[arg(value_name = "FILE.rrd", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    page: PageArgs,
}

impl View {
    pub fn run(&self) -> Result<ExitStatus> {
        for file in &self.files {
            if !is_recording(file)? {
                let file = file.display();
                return usage(format!("{file} is not a recording: give a file written by `asperity solve --record`"));
            }
            print_if_cut_off(file)?;
        }
        match self.files.as_slice() {
            [only] => self.show(only),
            several => {
                let folder = tempfile::tempdir()?;
                let comparison = folder.path().join("comparison.rrd");
                compare(several, &comparison)?;
                self.show(&comparison)
            }
        }
    }

    fn show(&self, file: &Path) -> Result<ExitStatus> {
        let viewing = Viewing::new(file.into())?;
        self.page.open()?.run(viewing)?;
        Ok(ExitStatus::Done)
    }
}
