//! `asperity licences`: the licences of all libraries and fonts in the program.

use super::exit_status::ExitStatus;
use super::terminal::stdout;
use anyhow::Result;
use clap::Args;
use std::io::Write;

/// The texts that these licences ask to hand on with the program. `.ci/licences` makes the file.
const LICENCES: &str = include_str!("../../assets/licences.txt");

const EXAMPLES: &str = "\
Examples:
  asperity licences | less
  asperity licences > licences.txt";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Licences;

impl Licences {
    pub fn run(&self) -> Result<ExitStatus> {
        stdout().write_all(LICENCES.as_bytes())?;
        Ok(ExitStatus::Done)
    }
}
