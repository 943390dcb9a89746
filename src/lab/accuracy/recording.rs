//! The solvers side by side in one recording.

use super::experiment::Experiment;
use crate::contact::{Contact, Multilevel, Observer, Solver};
use crate::diagnosis::Reference;
use crate::error::SetupError;
use crate::job::{self, Job, JobRun, Pass};
use crate::lab::{ObserverMaker, Rival};
use crate::record::Target;
use crate::setup::{Part, Record, Setup};
use std::path::Path;
use std::sync::Arc;

/// Records one run of each solver on the finest grid of an experiment: certificates along seconds and transforms, next to the
/// fields. Of `what` is recorded the usual parts are taken if it is empty; errors by wavelength are held against the solution that the errors
/// of the experiment are held against.
///
/// # Errors
/// The errors of [`Experiment::check`], and for a file that cannot be written.
pub fn record(path: &Path, experiment: &Experiment, what: &[Part], watch: ObserverMaker) -> Result<(), SetupError> {
    let record = Record { what: what.into(), length_unit: "L".into(), ..Record::default() };
    let setup = Setup { stop: experiment.stop, record, ..experiment.realised()?.setup(experiment.finest())? };
    let problem = setup.problem()?;
    let reference = if what.contains(&Part::Waterfall) {
        let end = Multilevel.solve(&problem, &experiment.reference, &mut watch("solving for the end"))?;
        Some(Arc::new(Reference::from_contact(&end)))
    } else {
        None
    };
    let [first, rest @ ..] = Rival::ALL.map(|rival| JobRun {
        name: rival.title.into(),
        title: Some(rival.title.into()),
        problem: Some(problem.clone()),
        reference: reference.clone(),
        shows_exact: false,
        ..JobRun::new(Setup { solver: rival.method, ..setup.clone() })
    });
    let job = rest.into_iter().fold(Job::from_run(first), Job::beside);
    let job = job.recorded(Target::File(path.into()));
    let outcome = job.run(&mut Titled(watch))?;
    let failed = outcome.solved.iter().map(|it| &it.contact).find(|contact| contact.failure.is_some());
    failed.and_then(Contact::fault).map_or(Ok(()), |fault| Err(fault.into()))
}

/// Watches each run of a job under its title.
struct Titled(ObserverMaker);

impl job::Watcher for Titled {
    fn observer(&mut self, pass: Pass<'_>) -> Box<dyn Observer + '_> {
        match pass {
            Pass::Solve(run, _) => (self.0)(&format!("recording {}", run.label())),
            Pass::Grid(_) | Pass::Reference(_) | Pass::State(..) | Pass::Stick(_) => Box::new(()),
        }
    }
}
