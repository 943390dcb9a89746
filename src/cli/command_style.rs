//! Options of all commands: output and threads.

use super::exit_status::usage;
use super::terminal::stderr;
use anyhow::Result;
use clap::Args;
use rayon::ThreadPoolBuilder;
use std::fmt::Display;
use std::io::Write;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};

/// Largest number of threads: more than any machine has, and few enough for any system.
const MOST_THREADS: usize = 1024;

/// Whether only results, warnings and errors are printed. This is global for the process, since progress bars are drawn
/// at many places.
static IS_QUIET: AtomicBool = AtomicBool::new(false);

#[derive(Args)]
#[command(next_help_heading = "All commands")]
pub(crate) struct CommandStyle {
    /// Suppress progress and notes: only results, warnings and errors are written
    #[arg(long, short, global = true)]
    quiet: bool,
    /// Number of threads, which does not change the results [default: that of the machine]
    #[arg(long, value_name = "N", global = true, value_parser = threads)]
    threads: Option<NonZeroUsize>,
}

impl CommandStyle {
    /// Applies them to the whole process.
    pub(crate) fn apply(&self) -> Result<()> {
        IS_QUIET.store(self.quiet, Ordering::Relaxed);
        let Some(threads) = self.threads else { return Ok(()) };
        match ThreadPoolBuilder::new().num_threads(threads.get()).build_global() {
            Ok(()) => Ok(()),
            Err(error) => usage(format!("cannot start {threads} threads: give fewer ({error})")),
        }
    }
}

/// Whether only results, warnings and errors are printed.
pub(crate) fn is_quiet() -> bool {
    IS_QUIET.load(Ordering::Relaxed)
}

/// Prints a note on standard error, unless the program is quiet.
pub(crate) fn remark(words: impl Display) {
    if !is_quiet() {
        writeln!(stderr(), "{words}").ok();
    }
}

/// A number of threads that can be started.
fn threads(text: &str) -> Result<NonZeroUsize, String> {
    let threads = text.parse().ok().filter(|threads: &NonZeroUsize| threads.get() <= MOST_THREADS);
    threads.ok_or_else(|| format!("give a whole number from 1 to {MOST_THREADS}"))
}
