//! The recording of results of another code.

use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::{Contact, Observer, Problem, Solver};
use asperity::diagnosis::Reference;
use asperity::error::FileError;
use asperity::files::check_named;
use asperity::job::{self, Job, JobRun};
use asperity::record::{LeftOut, Target};
use asperity::setup::Setup;
use clap::{ArgGroup, Args};
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[derive(Args)]
#[command(next_help_heading = "Output")]
#[command(group = ArgGroup::new("recorded").args(["record", "live"]).multiple(true))]
pub(crate) struct RecordingArgs {
    /// Record the result for the Rerun viewer, like the steps of a solver
    #[arg(long, value_name = "FILE.rrd")]
    pub record: Option<PathBuf>,
    /// Show it in the installed Rerun viewer
    #[arg(long)]
    pub live: bool,
    /// The number of pictures that the viewer of `--live` was too slow to get.
    #[arg(skip)]
    left_out: LeftOut,
}

impl RecordingArgs {
    /// Refuses a place where no recording can be written.
    pub(crate) fn check(&self) -> Result<(), FileError> {
        self.record.as_ref().map_or(Ok(()), |path| check_named(path, &["rrd"]))
    }

    /// Says that the recording was written, if one was.
    pub(crate) fn report(&self) {
        self.record.iter().for_each(|path| wrote(path));
        say_left_out(&self.left_out);
    }

    /// Goes through the steps of another code, shown to `observer` and recorded under `title` on request, compared with
    /// the reference if there is one.
    pub(crate) fn watch(
        &self,
        title: &str,
        setup: &Setup,
        problem: &Problem,
        (steps, reference): (&dyn Solver, Option<Arc<Reference>>),
        observer: &mut dyn Observer,
    ) -> Result<Contact> {
        let run = JobRun { reference, ..JobRun::from_other(title, setup.clone(), problem.clone(), steps) };
        let job = Job::from_run(run);
        let job = match target(self.record.as_deref(), self.live, &self.left_out) {
            None => job,
            Some(target) => job.recorded(target),
        };
        Ok(job.run(&mut job::ShowSteps(observer))?.solved.swap_remove(0).contact)
    }
}

/// The installed viewer if the recording is live, else a file; none if nothing is recorded.
pub(crate) fn target(path: Option<&Path>, is_live: bool, left_out: &LeftOut) -> Option<Target<'static>> {
    let path = path.map(PathBuf::from);
    if is_live { Some(Target::Viewer(path, left_out.clone())) } else { path.map(Target::File) }
}

/// Says how many pictures the viewer was too slow to get, if there are any.
pub(crate) fn say_left_out(left_out: &LeftOut) {
    if let Some(warning) = left_out.warning("--record-every N") {
        warnings::print(&[warning]);
    }
}
