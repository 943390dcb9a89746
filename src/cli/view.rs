//! `asperity view`: a recording, or a saved result, in the viewer that is built in.

use super::exit_status::{ExitStatus, usage};
use super::explore::PageArgs;
use super::warnings::{self, print_if_cut_off};
use anyhow::Result;
use asperity::job::SavedResult;
use asperity::record::{compare, is_recording};
use asperity::serve::Viewing;
use clap::Args;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(crate) struct View {
    /// The recording, or several to lay over each other; or saved results (.npz), or the folder of a run that was killed
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    page: PageArgs,
}

impl View {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let folder = tempfile::tempdir()?;
        let files: Vec<PathBuf> =
            self.files.iter().map(|file| recording_of(file, folder.path())).collect::<Result<_>>()?;
        match files.as_slice() {
            [only] => self.show(only),
            several => {
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

/// The recording in a file, or one in a folder that is made of a saved result.
fn recording_of(file: &Path, folder: &Path) -> Result<PathBuf> {
    if file.is_dir() || file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npz")) {
        let result = SavedResult::read(file)?;
        warnings::print(&result.doubts);
        let recording = folder.join(file.file_stem().unwrap_or(OsStr::new("result"))).with_extension("rrd");
        result.record(&recording)?;
        return Ok(recording);
    }
    if !is_recording(file)? {
        let file = file.display();
        return usage(format!(
            "{file} is neither a recording nor a result: give a file written by `asperity solve --record`, or by `--out result.npz`"
        ));
    }
    print_if_cut_off(file)?;
    Ok(file.into())
}
