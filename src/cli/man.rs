//! `asperity man`: the manual.

use super::exit_status::{ExitStatus, with_file_error};
use super::terminal::stdout;
use super::wrote::wrote;
use anyhow::Result;
use asperity::files::fill_folder;
use clap::{Args, Command};
use clap_mangen::{Man as Page, generate_to};
use std::io::Write;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  asperity man | man -l -
  asperity man --out man1";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Man {
    /// New folder for the pages, one per command [default: all pages go to standard output]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Man {
    pub(crate) fn run(&self, command: Command) -> Result<ExitStatus> {
        match &self.out {
            Some(folder) => {
                let filled = fill_folder(folder, |draft| Ok(generate_to(command, draft)?));
                filled.map_err(with_file_error)?;
                wrote(folder);
            }
            None => stdout().write_all(&pages(command)?)?,
        }
        Ok(ExitStatus::Done)
    }
}

/// The pages of all commands, one after the other.
fn pages(command: Command) -> Result<Vec<u8>> {
    let mut command = command.disable_help_subcommand(true);
    command.build();
    let mut pages = Vec::new();
    for command in std::iter::once(&command).chain(command.get_subcommands()) {
        Page::new(command.clone()).render(&mut pages)?;
    }
    Ok(pages)
}
