//! One run of a setup, the same for all front ends: cost, first pass, solve, recording, diagnosis and warnings.
//!
//! ```text
//! Setup --> Job --prepare--> Ready --run--> Outcome { solved: contact or states, diagnosis }
//!            |                 |      |
//!            cost              |      states, each as soon as it is solved --> sinks: recording, table, archive
//!                              warnings about the surface, before anything is solved
//! ```
//!
//! ```
//! use asperity::Indenter;
//! use asperity::contact::Load;
//! use asperity::job::Job;
//! use asperity::setup::{Cell, Recipe, Setup};
//! let cylinder = Recipe::indenter(Indenter::Cylinder { radius: 1.0 });
//! let setup = Setup::new(cylinder, Cell::line(4096, 4.0), Load::ReducedPressure(0.01));
//! let outcome = Job::new(setup).run(&mut ())?;
//! assert!(outcome.solved[0].contact.is_converged() && outcome.warnings().is_empty());
//! # Ok::<(), asperity::error::SetupError>(())
//! ```

mod follow;
mod history;
mod outcome;
mod patches;
mod ready;
#[cfg(feature = "record")]
mod recording;
mod run;
mod saved;
mod saved_states;
mod state_archive;
mod state_table;
mod tables;
mod watch;

pub use history::{AdhesionOutcome, HistoryOutcome};
pub use outcome::{Outcome, Solved, warnings_of_contacts};
pub use ready::Ready;
pub use run::JobRun;
pub use saved::{SavedFound, SavedResult};
pub use state_archive::StateArchive;
pub use state_table::StateTable;
pub use tables::write_nodes;
pub use watch::{Pass, ShowSteps, Watcher};

use crate::error::SetupError;
#[cfg(feature = "record")]
use crate::record::{Options, Target};
use crate::setup::{Auto, Cost, Extras, Part, Setup, StateSink};
use crate::study::Refinement;
use crate::surface::Field;

/// One run of a setup, and of other setups beside it in the same recording.
pub struct Job<'a> {
    runs: Vec<JobRun<'a>>,
    refinement: Option<Refinement>,
    start: Option<&'a Field>,
    is_diagnosed: bool,
    extras: Extras,
    keeps_last: bool,
    sinks: Vec<Box<dyn StateSink + 'a>>,
    #[cfg(feature = "record")]
    recorded: Option<(Target<'a>, Options)>,
}

impl<'a> Job<'a> {
    /// The run of a setup.
    pub fn new(setup: Setup) -> Self {
        Self::from_run(JobRun::new(setup))
    }

    /// A job of one run, such as that of another code's steps.
    pub fn from_run(run: JobRun<'a>) -> Self {
        Self {
            runs: vec![run],
            refinement: None,
            start: None,
            is_diagnosed: false,
            extras: Extras::default(),
            keeps_last: false,
            sinks: Vec::new(),
            #[cfg(feature = "record")]
            recorded: None,
        }
    }

    /// The job with one more run, solved after the others and recorded beside them.
    pub fn beside(mut self, run: JobRun<'a>) -> Self {
        self.runs.push(run);
        self
    }

    /// The job on a grid that is found first: it solves on successively finer grids until area and `kappa_r` have
    /// settled.
    pub fn refined(mut self, auto: Auto) -> Self {
        let refinement = Refinement::new(self.runs[0].setup.clone(), auto);
        if let Some(setup) = refinement.setups().next() {
            self.runs[0].setup = setup;
        }
        self.refinement = Some(refinement);
        self
    }

    /// The job with its first solve started from a pressure, shape `(ny, nx)`.
    pub fn started_from(self, start: Option<&'a Field>) -> Self {
        Self { start, ..self }
    }

    /// The job with a diagnosis of why its first run was slow. A first pass finds the final state, with which the steps
    /// are compared.
    pub fn diagnosed(self, is_diagnosed: bool) -> Self {
        Self { is_diagnosed, ..self }
    }

    /// The job with additional memory for what the caller does with the contact of the first run, such as its stiffness
    /// or an archive. The job itself counts the memory of a recording and a diagnosis.
    pub fn with_extras(self, extras: Extras) -> Self {
        Self { extras, ..self }
    }

    /// The job with a recording that goes to a target: of every step of one contact, or of every state of several. Its parts are those of the
    /// setup of the first run.
    #[cfg(feature = "record")]
    pub fn recorded(self, target: Target<'a>) -> Self {
        let options = self.runs[0].options();
        self.recorded_with(options, target)
    }

    /// The same with these options.
    #[cfg(feature = "record")]
    pub fn recorded_with(self, options: Options, target: Target<'a>) -> Self {
        Self { recorded: Some((target, options)), ..self }
    }

    /// The job that keeps only the last of several states. A watcher and the sinks see all of them.
    pub fn keeping_last(self, keeps_last: bool) -> Self {
        Self { keeps_last, ..self }
    }

    /// The job with something else that receives the states of its runs, one after the other, if they have several.
    pub fn with_sink(mut self, sink: impl StateSink + 'a) -> Self {
        self.sinks.push(Box::new(sink));
        self
    }

    /// The setup of the first run, on the coarsest grid if the grid is automatic.
    pub fn setup(&self) -> &Setup {
        &self.runs[0].setup
    }

    /// The grids that are tried, if the grid is automatic.
    pub fn refinement(&self) -> Option<&Refinement> {
        self.refinement.as_ref()
    }

    /// Whether a first pass finds the final state, with which the steps of a run are compared.
    pub fn is_passed_twice(&self) -> bool {
        self.runs.iter().any(|run| self.needs_reference(run))
    }

    /// The memory of the first run.
    ///
    /// # Errors
    /// The errors of [`Setup::cost`].
    pub fn cost(&self) -> Result<Cost, SetupError> {
        self.runs[0].setup.cost(&self.extras())
    }

    /// The work in addition to the solve.
    fn extras(&self) -> Extras {
        Extras { is_recorded: self.is_recorded(), is_diagnosed: self.is_passed_twice(), ..self.extras }
    }

    fn is_recorded(&self) -> bool {
        #[cfg(feature = "record")]
        return self.recorded.is_some();
        #[cfg(not(feature = "record"))]
        false
    }

    /// Whether the final state of a run is needed before its steps are observed.
    fn needs_reference(&self, run: &JobRun<'_>) -> bool {
        let has_waterfall = self.is_recorded() && run.setup.record.what.contains(&Part::Waterfall);
        run.is_repeatable() && run.reference.is_none() && (self.is_diagnosed || has_waterfall)
    }
}
