//! `asperity study --record-row` and `--live`: the recordings of one row, and of one realisation after the other.

use super::exit_status::{ExitStatus, settle, usage};
use super::progress::{Bars, Progress};
use super::recording_args::say_left_out;
use super::warnings;
use super::wrote::wrote;
use anyhow::{Context, Result};
use asperity::files::check_named;
use asperity::history::{Loading, PathPoint, Process};
use asperity::job::{Job, JobRun};
use asperity::record::{LeftOut, Target};
use asperity::setup::Extras;
use asperity::study::{Plan, Realisation};
use std::path::Path;

/// Solves a realisation up to a row, as the study does, and records the steps under the load of the row.
pub(crate) fn record(plan: &Plan, number: usize, path: &Path) -> Result<ExitStatus> {
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

/// Solves the realisations of a study one after the other, and shows each in the viewer: the steps under one load, the contacts under several, or
/// the states of a history.
pub(crate) fn show_all(plan: &Plan) -> Result<ExitStatus> {
    plan.check()?;
    let left_out = LeftOut::default();
    let show = |i: usize| show(plan, i, &left_out).with_context(|| format!("row {}", 1 + i * plan.loads().len()));
    let status = (0..plan.realisations()).map(show).try_fold(ExitStatus::Done, |worst, it| Ok(worst.max(it?)));
    say_left_out(&left_out);
    status
}

/// Solves a realisation and shows it in the viewer.
fn show(plan: &Plan, number: usize, left_out: &LeftOut) -> Result<ExitStatus> {
    let Realisation { setup, loads, .. } = plan.realisation(number)?;
    let title = setup.surface.title(&setup.surface.grid(&setup.grid)?);
    let words = plan.words(number);
    let title = if words.is_empty() { title } else { format!("{title}, {words}") };
    let setup = match loads.as_slice() {
        [load] => setup.under(*load),
        _ => setup.under_loads(loads),
    };
    let job = Job::from_run(JobRun { title: Some(title), ..JobRun::new(setup) })
        .recorded(Target::Viewer(None, left_out.clone()));
    job.cost()?.check(job.setup().solver.name())?;
    let solved = job.run(&mut Bars::default())?.solved.swap_remove(0);
    warnings::print(&warnings::in_flags(&solved.warnings()));
    settle(&solved.contact)
}
