//! `asperity licences`: the licences of all libraries and fonts in the program.

use super::exit_status::ExitStatus;
use super::terminal::stdout;
use anyhow::Result;
use asperity::serve::LICENCES;
use clap::Args;
use std::io::Write;

const EXAMPLES: &str = "\
Examples:
  asperity licences | less
  asperity licences > licences.txt";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Licences;

impl Licences {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        stdout().write_all(LICENCES.as_bytes())?;
        Ok(ExitStatus::Done)
    }
}
