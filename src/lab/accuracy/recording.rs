//! The solvers side by side in one recording.

use super::experiment::Experiment;
use crate::contact::{Multilevel, Solver};
use crate::diagnosis::Reference;
use crate::error::SetupError;
use crate::lab::{Rival, Watch};
use crate::record::{Options, Recording, Scene};
use crate::setup::{Part, Record, Setup};
use std::path::Path;
use std::sync::Arc;

/// Records one run of each solver on the finest grid of an experiment: certificates along seconds and transforms, next to the
/// fields. Of `what` is recorded the usual parts are taken if it is empty; errors by wavelength are held against the solution that the errors
/// of the experiment are held against.
///
/// # Errors
/// The errors of [`Experiment::check`], and for a file that cannot be written.
pub fn record(path: &Path, experiment: &Experiment, what: &[Part], watch: Watch) -> Result<(), SetupError> {
    let stop = experiment.stop;
    let record = Record { what: what.into(), length_unit: "L".into(), ..Record::default() };
    let options = Options::from(&record);
    let setup = Setup { stop, record, ..experiment.realised()?.setup(experiment.finest())? };
    let problem = setup.problem()?;
    let reference = if what.contains(&Part::Waterfall) {
        let end = Multilevel.solve(&problem, &experiment.reference, &mut watch("solving for the end"))?;
        Some(Arc::new(Reference::of(&end)))
    } else {
        None
    };
    let setups = Rival::ALL.map(|rival| Setup { solver: rival.method, ..setup.clone() });
    let scene = |(rival, setup): (&Rival, _)| {
        let [name, title] = [rival.title; 2].map(String::from);
        Scene { name, title, exact: None, reference: reference.clone(), ..Scene::of(setup, &problem) }
    };
    let scenes: Vec<Scene<'_>> = Rival::ALL.iter().zip(&setups).map(scene).collect();
    let recording = Recording::create(path, &scenes, options)?;
    for (i, rival) in Rival::ALL.iter().enumerate() {
        let observer = &mut (recording.recorder(i), watch(&format!("recording {}", rival.title)));
        let contact = rival.method.solver().solve(&problem, &stop, observer)?;
        if let Some(fault) = contact.fault().filter(|_| contact.failure.is_some()) {
            return Err(fault.into());
        }
    }
    Ok(recording.finish()?)
}
