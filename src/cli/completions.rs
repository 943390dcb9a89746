//! `asperity completions`: shell completions.

use super::exit_status::ExitStatus;
use super::terminal::stdout;
use anyhow::Result;
use clap::{Args, Command};
use clap_complete::{Shell, generate};
use std::io::Write;

const EXAMPLES: &str = "\
Examples:
  asperity completions bash > ~/.local/share/bash-completion/completions/asperity
  asperity completions zsh > ~/.zfunc/_asperity
  asperity completions fish > ~/.config/fish/completions/asperity.fish";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

impl Completions {
    pub(crate) fn run(&self, mut command: Command) -> Result<ExitStatus> {
        let mut script = Vec::new();
        generate(self.shell, &mut command, "asperity", &mut script);
        stdout().write_all(&script)?;
        Ok(ExitStatus::Done)
    }
}
