//! The command line: parse, dispatch, exit code.

mod cli;

use std::io::{Write, stderr};
use std::process::ExitCode;

fn main() -> ExitCode {
    match cli::run() {
        Ok(outcome) => outcome.into(),
        Err(error) => {
            writeln!(stderr(), "error: {error}{}", cli::remedy(&error)).ok();
            cli::exit_code(&error)
        }
    }
}
