//! One run of a setup, written once for all front ends: what it costs, its first pass, the solve, its recording, its diagnosis, and what
//! is doubtful about what comes out.
//!
//! ```text
//! Setup --> Job --prepare--> Ready --run--> Outcome { contacts, slip, diagnosis, warnings }
//!            |                 |
//!            cost              warnings about the surface, before anything is solved
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

#[cfg(feature = "record")]
mod curve;
mod outcome;
mod ready;
mod run;
mod watch;

#[cfg(feature = "record")]
pub use curve::CurveRecording;
pub use outcome::{Outcome, Solved};
pub use ready::Ready;
pub use run::JobRun;
pub use watch::{Pass, ShowSteps, Watcher};

#[cfg(feature = "record")]
use crate::error::FileError;
use crate::error::SetupError;
#[cfg(feature = "record")]
use crate::record::{Options, Recording, Scene};
use crate::setup::{Auto, Cost, Extras, Part, Setup};
use crate::study::Refinement;
use crate::surface::Field;

/// A function that begins a recording of scenes: in a file, in a viewer, or elsewhere.
#[cfg(feature = "record")]
pub type OpenRecording<'a> = Box<dyn FnOnce(&[Scene<'_>], Options) -> Result<Recording, FileError> + 'a>;

/// One run of a setup, and of other setups beside it in the same recording.
pub struct Job<'a> {
    runs: Vec<JobRun<'a>>,
    refinement: Option<Refinement>,
    start: Option<&'a Field>,
    is_diagnosed: bool,
    extras: Extras,
    #[cfg(feature = "record")]
    recorded: Option<(OpenRecording<'a>, Options)>,
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
            #[cfg(feature = "record")]
            recorded: None,
        }
    }

    /// The job with one more run, solved after the others and recorded beside them.
    pub fn beside(mut self, run: JobRun<'a>) -> Self {
        self.runs.push(run);
        self
    }

    /// The job on a grid that is found first: on ever finer grids until area and `kappa_r` have settled.
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

    /// The job with a diagnosis of what held its first run up. A first pass finds the final state that the steps are compared with.
    pub fn diagnosed(self, is_diagnosed: bool) -> Self {
        Self { is_diagnosed, ..self }
    }

    /// The job with the memory counted of what the caller does with the contact of the first run, such as its stiffness or an archive. A
    /// recording and a diagnosis are counted by the job itself.
    pub fn with_extras(self, extras: Extras) -> Self {
        Self { extras, ..self }
    }

    /// The job with every step recorded, with the parts that the setup of the first run names, by the recording that `open` begins.
    #[cfg(feature = "record")]
    pub fn recorded(self, open: impl FnOnce(&[Scene<'_>], Options) -> Result<Recording, FileError> + 'a) -> Self {
        let options = self.runs[0].options();
        self.recorded_with(options, open)
    }

    /// The job with every step recorded with some options, by the recording that `open` begins.
    #[cfg(feature = "record")]
    pub fn recorded_with(
        self,
        options: Options,
        open: impl FnOnce(&[Scene<'_>], Options) -> Result<Recording, FileError> + 'a,
    ) -> Self {
        Self { recorded: Some((Box::new(open), options)), ..self }
    }

    /// The setup of the first run, on the coarsest grid if a grid is to be found.
    pub fn setup(&self) -> &Setup {
        &self.runs[0].setup
    }

    /// The grids that are tried, if a grid is to be found.
    pub fn refinement(&self) -> Option<&Refinement> {
        self.refinement.as_ref()
    }

    /// Whether a first pass finds the final state that the steps of a run are compared with.
    pub fn is_passed_twice(&self) -> bool {
        self.runs.iter().any(|run| self.needs_reference(run))
    }

    /// What the first run takes of memory.
    ///
    /// # Errors
    /// The errors of [`Setup::cost`].
    pub fn cost(&self) -> Result<Cost, SetupError> {
        self.setup().cost(&self.extras())
    }

    /// What is done besides solving.
    fn extras(&self) -> Extras {
        Extras { is_recorded: self.is_recorded(), is_diagnosed: self.is_passed_twice(), ..self.extras }
    }

    fn is_recorded(&self) -> bool {
        #[cfg(feature = "record")]
        return self.recorded.is_some();
        #[cfg(not(feature = "record"))]
        false
    }

    /// Whether the final state of a run must be found before its steps are watched.
    fn needs_reference(&self, run: &JobRun<'_>) -> bool {
        let has_waterfall = self.is_recorded() && run.setup.record.what.contains(&Part::Waterfall);
        run.is_repeatable() && run.reference.is_none() && (self.is_diagnosed || has_waterfall)
    }
}
