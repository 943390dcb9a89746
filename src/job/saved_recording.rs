//! Recordings of results that are read again.

use super::posed::Posed;
use super::saved::{SavedFound, SavedResult};
use super::sink::StateSink;
use super::state_recording::StateRecording;
use super::{Job, JobRun};
use crate::contact::{Contact, State};
use crate::error::{Failure, SetupError};
use crate::foreign::{Frame, GivenField, Replay};
use crate::record::{Options, Target};
use crate::setup::LOADS;
use std::path::Path;
use std::sync::Arc;

impl SavedResult {
    /// Writes a recording of the result: of a contact its last step, of loads and histories one frame for each state.
    ///
    /// # Errors
    /// For a file that cannot be written, and for a setup that cannot be.
    pub fn record(&self, path: &Path) -> Result<(), SetupError> {
        match &self.found {
            SavedFound::Contact(state, _) => self.record_contact(&state.contact, path),
            SavedFound::States(outcome) if outcome.drive.is_list => self.record_loads(&outcome.states, path),
            SavedFound::States(outcome) => {
                let problem = self.setup.problem_of(self.surface.clone())?;
                Ok(outcome.record(path, &self.setup, &problem)?)
            }
        }
    }

    fn record_contact(&self, contact: &Contact, path: &Path) -> Result<(), SetupError> {
        let values = contact.pressure.iter().copied().collect();
        let frames = [Ok::<_, Failure>(Frame { values, seconds: None })].into_iter();
        let steps = Replay::new(&contact.solver, GivenField::Pressure, frames);
        let title = self.setup.surface.title(self.surface.grid());
        let run = JobRun::from_other(&title, self.setup.clone(), contact.problem.clone(), &steps);
        Job::from_run(run).recorded(Target::File(path.into())).run(&mut ()).map(drop)
    }

    fn record_loads(&self, states: &[Arc<State>], path: &Path) -> Result<(), SetupError> {
        let contacts = || states.iter().map(|state| &state.contact);
        let heaviest = contacts().max_by(|one, two| one.mean_pressure().total_cmp(&two.mean_pressure()));
        let Some(heaviest) = heaviest else { return Ok(()) };
        let setup = self.setup.clone().under_loads(contacts().map(|contact| contact.problem.load()).collect());
        let problem = self.setup.problem_of(self.surface.clone())?.with_load(heaviest.problem.load())?;
        let posed = Posed { run: 0, setup: &setup, problem: &problem, drive: &LOADS };
        let mut recording = StateRecording::open(Target::File(path.into()), Options::from(&self.setup))?;
        for (number, state) in states.iter().enumerate() {
            recording.state(&posed, number, state)?;
        }
        Ok(recording.finish()?)
    }
}
