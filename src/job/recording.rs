//! Recordings of results that were found before.

use super::history::HistoryOutcome;
use super::saved::{SavedFound, SavedResult};
use super::{Job, JobRun};
use crate::contact::{Contact, Problem};
use crate::error::{Failure, FileError, SetupError};
use crate::foreign::{Frame, GivenField, Replay};
use crate::record::{Options, StateRecording, Target};
use crate::setup::{Posed, Setup, StateSink};
use std::path::Path;

impl HistoryOutcome {
    /// Writes a recording of all states, on the timelines `step` and, where states have times, the one of [`Timeline::States`](crate::record::Timeline::States).
    ///
    /// # Errors
    /// [`FileError::Target`] and [`FileError::Write`] for a file that cannot be made or written.
    pub fn record(&self, path: &Path, setup: &Setup, problem: &Problem) -> Result<(), FileError> {
        let posed = Posed { run: 0, setup, problem, drive: self.drive };
        let mut recording = StateRecording::open(Target::File(path.into()), Options::from(setup))?;
        for (number, state) in self.states.iter().enumerate() {
            recording.state(&posed, number, state)?;
        }
        recording.end(&posed, &self.states)
    }
}

impl SavedResult {
    /// Writes a recording of the result: of a contact its last step, of loads and histories one frame for each state.
    ///
    /// # Errors
    /// For a file that cannot be written, and for a setup that cannot be.
    pub fn record(&self, path: &Path) -> Result<(), SetupError> {
        match &self.found {
            SavedFound::Contact(state, _) => self.record_contact(&state.contact, path),
            SavedFound::States(outcome) => {
                // a list that was ended early has fewer loads than its setup
                let loads = || outcome.states.iter().map(|state| state.contact.problem.load()).collect();
                let setup =
                    if outcome.drive.is_list { self.setup.clone().under_loads(loads()) } else { self.setup.clone() };
                let problem = setup.problem_of(self.surface.clone())?;
                Ok(outcome.record(path, &setup, &problem)?)
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
}
