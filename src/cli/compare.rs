//! `asperity compare`: the traces of several recordings over each other.

use super::outcome::{Outcome, usage};
use anyhow::Result;
use asperity::record;
use clap::Args;
use std::fs::canonicalize;
use std::io::{Write, stdout};
use std::path::PathBuf;

#[derive(Args)]
pub struct Compare {
    /// The recordings, two or more
    #[arg(value_name = "FILE.rrd", required = true)]
    recordings: Vec<PathBuf>,
    /// The recording that is made of them
    #[arg(long, value_name = "FILE.rrd", default_value = "comparison.rrd")]
    out: PathBuf,
}

impl Compare {
    pub fn run(&self) -> Result<Outcome> {
        let Self { recordings, out } = self;
        if let [only] = recordings.as_slice() {
            return usage(format!("{} alone cannot be compared: give two recordings or more", only.display()));
        }
        let place = canonicalize(out).ok();
        if place.is_some() && recordings.iter().any(|recording| canonicalize(recording).ok() == place) {
            return usage(format!("--out {} is one of the recordings: give another name", out.display()));
        }
        record::compare(recordings, out)?;
        writeln!(stdout(), "wrote {0}: asperity view {0}", out.display())?;
        Ok(Outcome::Done)
    }
}
