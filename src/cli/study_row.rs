//! `asperity study --record-row`: the recording of one row.

use super::exit_status::{ExitStatus, settle, usage};
use super::progress::{Bars, Progress};
use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::files::check_named;
use asperity::history::{Loading, PathPoint, Process};
use asperity::job::{Job, JobRun};
use asperity::record::Target;
use asperity::setup::Extras;
use asperity::study::Plan;
use std::path::Path;

/// Solves a realisation up to a row, as the study does, and records the steps under the load of the row.
pub fn record(plan: &Plan, number: usize, path: &Path) -> Result<ExitStatus> {
    let row = plan.row(number)?;
    check_named(path, &["rrd"])?;
    let setup = plan.setup(row)?;
    if setup.is_history()? {
        return usage(format!(
            "row {number} is a history: save its `scene` as a file, and record it with asperity solve"
        ));
    }
    setup.cost(&Extras { is_recorded: true, ..Extras::default() })?.check(setup.solver.name())?;
    let mut loading = Loading::new(setup.problem()?, setup.solver(), setup.stop);
    for (number, &load) in plan.loads()[..row.load].iter().enumerate() {
        let mut progress = Progress::new(&format!("load {}", number + 1));
        loading.move_to(PathPoint::under(load), &mut progress)?;
    }
    let (problem, start) = (loading.problem(setup.load)?, loading.start().cloned());
    let job =
        Job::from_run(JobRun { problem: Some(problem), ..JobRun::new(setup.clone()) }).started_from(start.as_ref());
    let job = job.recorded(Target::File(path.into()));
    let solved = job.run(&mut Bars::default())?.solved.swap_remove(0);
    warnings::print(&warnings::in_flags(&solved.warnings()));
    if solved.contact.failure.is_none() {
        wrote(path);
    }
    settle(&solved.contact)
}
