//! `asperity inspect`: the iterations of another solver, recorded.

use super::choice::choice;
use super::exit_status::{ExitStatus, settle, usage};
use super::fields::{check_elastic, check_one_load, rows};
use super::finding::Finding;
use super::flags::{OfProblem, SceneArgs};
use super::interrupt::interrupted;
use super::iteration::Iteration;
use super::output::write_json;
use super::progress::Progress;
use super::recording_args::RecordingArgs;
use super::terminal::stdout;
use super::warnings;
use anyhow::Result;
use asperity::contact::{Contact, ContactModulus, Multilevel, Observer, Problem, Solver, Stop};
use asperity::diagnosis::{Diagnosis, Reference};
use asperity::error::{ClaimError, StepsError};
use asperity::files::check_apart;
use asperity::foreign::{Claim, Distances, Follow, Frame, GivenField, Replay, Steps, step_files};
use asperity::formats::{read_field, read_fields, read_fields_shape};
use asperity::record::is_recording;
use asperity::setup::{Cost, Setup, SetupTable};
use clap::Args;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// The certificate of the reference.
const REFERENCE_TOLERANCE: f64 = 1e-12;
/// Fields in memory at the same time: those of a step, a half-space, a recorder and the reference.
const FIELDS_IN_MEMORY: f64 = 16.0;

const EXAMPLES: &str = "\
Examples:
  asperity inspect --height h.npy --size 1 --modulus 1 --mean-pressure 0.01 --record run.rrd steps
  asperity inspect --setup scene.toml --record run.rrd pressures.npz --times seconds.npy
  asperity inspect --setup scene.toml --record run.rrd --follow steps --idle 10";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Inspect {
    /// Files of steps, or folders of such files, in natural order (step2 before step10): .npy, .npz or text; one step
    /// per file, or several along the first axis
    #[arg(value_name = "STEPS", required_unless_present = "follow", conflicts_with = "follow")]
    steps: Vec<PathBuf>,
    /// Folder in which the other solver writes its steps; new steps are read until Ctrl-C
    #[arg(long, value_name = "FOLDER", help_heading = "Steps")]
    follow: Option<PathBuf>,
    /// With --follow: stop after this time without a new step, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = seconds, requires = "follow", help_heading = "Steps")]
    idle: Option<Duration>,
    /// GivenField in the steps, which is also the name of the array in a .npz
    #[arg(long, value_name = "QUANTITY", default_value = "pressure", help_heading = "Steps",
        value_parser = choice::<GivenField>())]
    kind: GivenField,
    /// File of the time of each step in seconds, from the start; a .npz may contain it as `seconds` or `time`
    #[arg(long, value_name = "FILE", conflicts_with = "follow", help_heading = "Steps")]
    times: Option<PathBuf>,
    /// File of the pressure to compare with [default: the solution by multilevel, with a tolerance of 1e-12]
    #[arg(long, value_name = "FILE", help_heading = "Steps")]
    reference: Option<PathBuf>,
    #[command(flatten)]
    scene: SceneArgs<OfProblem>,
    #[command(flatten)]
    shown: RecordingArgs,
    /// Explain why the iteration was slow: slow wavelengths, nodes that change their state often, plateaus, contact
    /// sets that recur
    #[arg(long, help_heading = "Output")]
    diagnose: bool,
    /// Print one JSON object instead of a summary
    #[arg(long, help_heading = "Output")]
    json: bool,
}

impl Inspect {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        self.shown.check()?;
        if let Some(recording) = self.steps.iter().find(|path| is_recording(path).unwrap_or(false)) {
            return usage(format!(
                "{} is a recording, but the steps of another solver are read: open it with asperity view or in the Rerun viewer",
                recording.display()
            ));
        }
        let mut table = self.scene.table()?;
        check_one_load(&mut table)?;
        if !table.has_load() {
            return Err(ClaimError::NoLoad.into());
        }
        check_apart(self.shown.record.as_deref(), self.read(&table)?)?;
        let setup = table.setup()?;
        check_elastic(&setup)?;
        Cost::from_fields(&setup.check()?, FIELDS_IN_MEMORY).check("an iteration")?;
        let problem = setup.problem()?;
        match &self.follow {
            Some(folder) => self.follow(folder, &setup, &problem),
            None => self.replay(&setup, &problem),
        }
    }

    /// The files that are read.
    fn read(&self, table: &SetupTable) -> Result<Vec<PathBuf>> {
        let steps = step_files(&self.steps)?.into_iter().chain(self.times.clone()).chain(self.reference.clone());
        Ok(self.scene.files(table).into_iter().chain(steps).collect())
    }

    /// Replays steps that are all there.
    fn replay(&self, setup: &Setup, problem: &Problem) -> Result<ExitStatus> {
        let files = step_files(&self.steps)?;
        let seconds = self.times.as_ref().map(|path| read_fields(path, "seconds")).transpose()?;
        let seconds: Option<Vec<f64>> = seconds.map(|seconds| seconds.into_iter().collect());
        let steps = || {
            let steps = Steps::new(self.kind, problem.surface().grid(), files.clone().into_iter());
            match &seconds {
                Some(seconds) => steps.with_seconds(seconds.clone()),
                None => steps,
            }
        };
        steps().check()?;
        let name = match self.steps.as_slice() {
            [one] => one.display().to_string(),
            more => format!("{} files", more.len()),
        };
        self.inspect(&name, setup, problem, steps())
    }

    /// Replays steps as they are written into a folder.
    fn follow(&self, folder: &Path, setup: &Setup, problem: &Problem) -> Result<ExitStatus> {
        let interrupted = interrupted()?;
        let is_over = || interrupted.load(Ordering::Relaxed);
        let files = Follow::new(folder, self.kind.name(), self.idle, &is_over)?;
        let steps = Steps::new(self.kind, problem.surface().grid(), files);
        let outcome = self.inspect(&folder.display().to_string(), setup, problem, steps)?;
        let broken = |path: PathBuf| read_fields_shape(&path, self.kind.name()).err();
        let left_out = step_files(&[folder.into()])?.into_iter().filter_map(broken);
        warnings::print(&left_out.map(|error| format!("{error}; the file is ignored")).collect::<Vec<_>>());
        Ok(outcome)
    }

    /// Replays the steps of another code, and computes their distance from the reference.
    fn inspect(
        &self,
        name: &str,
        setup: &Setup,
        problem: &Problem,
        steps: Steps<impl Iterator<Item = PathBuf>>,
    ) -> Result<ExitStatus> {
        let reference = self.reference(problem)?;
        let mut distances = Distances::new(&reference);
        let replay = Replay::new(name, self.kind, steps);
        let end = Arc::new(Reference::from_contact(&reference));
        let mut diagnosis = self.diagnose.then(|| Diagnosis::new(problem, Some(end.clone())));
        let contact = self.watch(setup, problem, (&replay, end), &mut (&mut distances, &mut diagnosis))?;
        if distances.steps.is_empty() && contact.failure.is_none() {
            return Err(StepsError::Nothing.into());
        }
        let iteration = Iteration {
            steps_of: name.into(),
            quantity: self.kind,
            steps: distances.steps,
            reference_of: reference.solver.clone(),
            reference_certificate: reference.certificate.eta,
            last: Finding::new(setup, &contact),
            diagnosis: diagnosis.map(|diagnosis| diagnosis.findings()),
            setup: setup.clone(),
            grid: *problem.surface().grid(),
            units: self.scene.units(),
        };
        if contact.failure.is_none() {
            if self.json { write_json(&iteration, &mut stdout())? } else { iteration.write_text(&mut stdout())? }
        }
        self.shown.report();
        settle(&contact)
    }

    /// The state to compare with.
    fn reference(&self, problem: &Problem) -> Result<Contact> {
        let stop = Stop::new(REFERENCE_TOLERANCE, Stop::default().max_iterations())?;
        let Some(path) = &self.reference else {
            return Ok(Multilevel.solve(problem, &stop, &mut Progress::new("the reference"))?);
        };
        let field = rows(read_field(path, GivenField::Pressure.name())?)?;
        let (surface, modulus) = (problem.surface().clone(), ContactModulus(problem.contact_modulus()));
        let claim = Claim::new(surface, modulus, Some(problem.load()), GivenField::Pressure, &field)?;
        let frame = Frame { values: claim.values().to_vec(), seconds: None };
        let replay = Replay::new(&path.display().to_string(), GivenField::Pressure, [Ok(frame)].into_iter());
        Ok(replay.solve(problem, &stop, &mut ())?)
    }

    /// Shows the steps to the recording, if there is one, and to who watches.
    fn watch(
        &self,
        setup: &Setup,
        problem: &Problem,
        (replay, end): (&dyn Solver, Arc<Reference>),
        observer: &mut dyn Observer,
    ) -> Result<Contact> {
        let mut watching = (observer, Progress::new(replay.name()));
        let title = format!("{}, {}", setup.surface.title(problem.surface().grid()), replay.name());
        self.shown.watch(&title, setup, problem, (replay, Some(end)), &mut watching)
    }
}

/// A number of seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let wrong = || "give a number of seconds, 0 or more".to_owned();
    text.parse().ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok()).ok_or_else(wrong)
}
