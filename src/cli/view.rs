//! `asperity view`: a recording in the viewer that is built in.

use super::explore::PageArgs;
use super::outcome::{Outcome, usage};
use anyhow::Result;
use asperity::explore::Viewing;
use asperity::record::is_recording;
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub struct View {
    /// The recording
    #[arg(value_name = "FILE.rrd")]
    file: PathBuf,
    #[command(flatten)]
    page: PageArgs,
}

impl View {
    pub fn run(&self) -> Result<Outcome> {
        if !is_recording(&self.file)? {
            let file = self.file.display();
            return usage(format!("{file} is no recording: give a file that `asperity solve --record` wrote"));
        }
        let viewing = Viewing::new(self.file.clone())?;
        self.page.open()?.run(viewing)?;
        Ok(Outcome::Done)
    }
}
