//! `asperity compare`: the traces of several recordings over each other.

use super::exit_status::{ExitStatus, usage};
use super::warnings::print_if_cut_off;
use super::wrote::wrote;
use anyhow::Result;
use asperity::files::{check_apart, check_named};
use asperity::record;
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  asperity compare gfmd.rrd multilevel.rrd
  asperity compare damping-1.rrd damping-0.5.rrd damping-0.1.rrd --out damping.rrd";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Compare {
    /// The recordings, two or more
    #[arg(value_name = "FILE.rrd", required = true)]
    recordings: Vec<PathBuf>,
    /// The recording to write
    #[arg(long, value_name = "FILE.rrd", default_value = "comparison.rrd", help_heading = "Output")]
    out: PathBuf,
}

impl Compare {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let Self { recordings, out } = self;
        if let [only] = recordings.as_slice() {
            return usage(format!("{} is the only recording: give at least two", only.display()));
        }
        check_named(out, &["rrd"])?;
        check_apart([out.as_path()], recordings.iter().map(PathBuf::as_path))?;
        record::compare(recordings, out)?;
        recordings.iter().try_for_each(|path| print_if_cut_off(path))?;
        wrote(out);
        Ok(ExitStatus::Done)
    }
}
