//! `asperity solve`: one contact.

use super::output::{Summary, write_fields};
#[cfg(feature = "record")]
use super::part::PartArg;
use super::plan::{Outputs, Plan};
use super::progress::Progress;
use super::solver::SolverArgs;
use super::source::{Made, Source};
use super::{Outcome, usage};
use anyhow::Result;
#[cfg(feature = "record")]
use asperity::Grid;
use asperity::Surface;
use asperity::contact::{Contact, Load, Problem, Solver, Stop};
use asperity::error::{FileError, SolveError};
use asperity::files::check_target;
#[cfg(feature = "record")]
use asperity::record::Options;
use asperity::theory::Exact;
#[cfg(feature = "record")]
use clap::ArgGroup;
use clap::Args;
use std::io::{Write, stderr, stdout};
use std::path::PathBuf;

/// Presses one surface on the solid and reports the contact.
#[derive(Args)]
pub struct Solve {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    load: LoadArgs,
    #[command(flatten)]
    solver: SolverArgs,
    #[command(flatten)]
    output: Output,
    /// Say what the solve would take in memory, transforms and recording, and do none of it
    #[arg(long, conflicts_with = "json")]
    dry_run: bool,
}

#[derive(Args)]
#[command(next_help_heading = "Load (one of --pressure, --reduced-pressure, --mean-gap)")]
struct LoadArgs {
    /// Mean pressure, in the units of the modulus
    #[arg(long, value_name = "P", allow_negative_numbers = true)]
    pressure: Option<f64>,
    /// Reduced pressure p* = p / (rms gradient x modulus)
    #[arg(long, value_name = "P*", allow_negative_numbers = true)]
    reduced_pressure: Option<f64>,
    /// Mean gap between the mean planes of both surfaces, below the highest peak; not with --solver gfmd
    #[arg(long, value_name = "G", allow_negative_numbers = true)]
    mean_gap: Option<f64>,
    /// Contact modulus E* = E / (1 - nu^2)
    #[arg(long, value_name = "E*", default_value_t = 1.0, allow_negative_numbers = true)]
    modulus: f64,
}

#[derive(Args)]
#[command(next_help_heading = "Output")]
#[cfg_attr(feature = "record", command(group = ArgGroup::new("recorded").args(["record", "live"]).multiple(true)))]
struct Output {
    /// Record every relaxation step for the Rerun viewer
    #[cfg(feature = "record")]
    #[arg(long, value_name = "FILE.rrd")]
    record: Option<PathBuf>,
    /// Show the steps in the installed Rerun viewer while they are made
    #[cfg(feature = "record")]
    #[arg(long)]
    live: bool,
    /// Record the fields of every N-th step, instead of all early steps and then ever fewer
    #[cfg(feature = "record")]
    #[arg(long, value_name = "N", requires = "recorded")]
    record_every: Option<usize>,
    /// Parts to record, instead of all that a line or a surface has
    #[cfg(feature = "record")]
    #[arg(long, value_enum, value_name = "PART[,PART]", value_delimiter = ',', requires = "recorded")]
    record_what: Vec<PartArg>,
    /// Unit of lengths in the recording; metres are shown as mm, um or nm
    #[cfg(feature = "record")]
    #[arg(long, value_name = "UNIT", default_value = "m")]
    length_unit: String,
    /// Write height, pressure, gap, displacement and contact, shaped as the input
    #[arg(long, value_name = "FILE.npz")]
    out: Option<PathBuf>,
    /// Print one JSON object instead of a summary
    #[arg(long)]
    json: bool,
}

impl Solve {
    /// Runs the command.
    pub fn run(&self) -> Result<Outcome> {
        let solver = self.solver.solver()?;
        let stop = self.solver.stop()?;
        if self.load.mean_gap.is_some() && self.solver.needs_pressure() {
            return Err(SolveError::NeedsPressure { solver: solver.name() }.into());
        }
        let plan = self.plan()?;
        self.load.given()?;
        if let Some(path) = &self.output.out {
            check_target(path)?;
        }
        if self.dry_run {
            return self.announce(&plan);
        }
        plan.check()?;
        let (surface, made) = self.source.surface()?;
        let problem = self.load.problem(surface)?;
        let Watched { contact, outcome, recorded } = self.watch(&problem, &made, solver.as_ref(), &stop)?;
        if let Some(path) = &self.output.out {
            write_fields(path, &problem, &contact, made.rank)?;
        }
        let exact = exact(&made, &problem, contact.pressure.mean().unwrap_or(0.0));
        let summary = Summary::of(&problem, &contact, made.rank, exact.as_ref());
        if self.output.json {
            summary.write_json(&mut stdout())?;
        } else {
            summary.write_text(&made.title, &mut stdout())?;
        }
        recorded?;
        Ok(outcome)
    }

    /// What the solve will take.
    fn plan(&self) -> Result<Plan> {
        let grid = self.source.check()?;
        let reduced_pressure = self.load.reduced_pressure.filter(|_| self.source.is_random());
        #[cfg(feature = "record")]
        let recording = self.output.record.is_some();
        #[cfg(not(feature = "record"))]
        let recording = false;
        let outputs = Outputs { recording, fields: self.output.out.is_some() };
        Ok(Plan::new(grid, self.solver.method(), reduced_pressure, outputs))
    }

    /// Says what the solve would take.
    fn announce(&self, plan: &Plan) -> Result<Outcome> {
        let mut said = Vec::new();
        plan.write(&mut said)?;
        #[cfg(feature = "record")]
        if self.output.record.is_some() {
            plan.write_recording(&self.options(plan.grid())?, &self.solver.stop()?, &mut said)?;
        }
        stdout().write_all(&said)?;
        Ok(Outcome::Done)
    }

    /// How the solve is recorded.
    #[cfg(feature = "record")]
    fn options(&self, grid: &Grid) -> Result<Options> {
        if self.output.record_every == Some(0) {
            return usage("--record-every is 0: give a positive number of steps");
        }
        Ok(Options {
            what: PartArg::parts(&self.output.record_what, grid)?,
            every: self.output.record_every,
            length_unit: self.output.length_unit.clone(),
            ..Options::default()
        })
    }

    #[cfg(feature = "record")]
    fn watch(&self, problem: &Problem, made: &Made, solver: &dyn Solver, stop: &Stop) -> Result<Watched> {
        use asperity::record::{Recording, Scene, describe};
        let options = self.options(problem.surface().grid())?;
        if self.output.record.is_none() && !self.output.live {
            return watch_progress(problem, solver, stop);
        }
        if let Some(path) = self.output.record.as_ref().filter(|path| Some(*path) == self.output.out.as_ref()) {
            return usage(format!("--record and --out both name {}: give two files", path.display()));
        }
        let exact = match problem.load() {
            Load::MeanPressure(mean_pressure) => exact(made, problem, mean_pressure),
            Load::MeanGap(_) => None,
        };
        let scene = Scene {
            name: "contact".into(),
            title: made.title.clone(),
            problem,
            description: describe(&made.description, problem, &self.output.length_unit, solver, stop, exact.as_ref()),
            exact,
        };
        let unseen = tempfile::NamedTempFile::new()?;
        let path = self.output.record.as_deref().unwrap_or(unseen.path());
        let begin = if self.output.live { Recording::shown } else { Recording::create };
        let recording = begin(path, &[scene], options)?;
        let mut recorder = recording.recorder(0);
        let mut progress = Progress::new(stop.tolerance(), solver.name());
        let (contact, outcome) = settle(solver.solve(problem, stop, &mut (&mut recorder, &mut progress)))?;
        let recorded = recorder.close(&contact).and_then(|()| recording.finish());
        Ok(Watched { contact, outcome, recorded })
    }

    #[cfg(not(feature = "record"))]
    fn watch(&self, problem: &Problem, _: &Made, solver: &dyn Solver, stop: &Stop) -> Result<Watched> {
        watch_progress(problem, solver, stop)
    }
}

/// A contact, and what became of its recording, which must not stand in the way of the other outputs.
struct Watched {
    contact: Contact,
    outcome: Outcome,
    recorded: Result<(), FileError>,
}

fn watch_progress(problem: &Problem, solver: &dyn Solver, stop: &Stop) -> Result<Watched> {
    let mut progress = Progress::new(stop.tolerance(), solver.name());
    let (contact, outcome) = settle(solver.solve(problem, stop, &mut progress))?;
    Ok(Watched { contact, outcome, recorded: Ok(()) })
}

/// The contact, converged or not; what stands in the way of convergence is said on standard error. An error if there is none.
pub fn settle(solved: Result<Contact, SolveError>) -> Result<(Contact, Outcome), SolveError> {
    match solved {
        Ok(contact) => Ok((contact, Outcome::Done)),
        Err(error) => {
            let warning = format!("warning: {error}");
            let contact = error.into_contact()?;
            writeln!(stderr(), "{warning}").ok();
            Ok((contact, Outcome::NotConverged))
        }
    }
}

/// The exact solution under a mean pressure, where the surface has one.
fn exact(made: &Made, problem: &Problem, mean_pressure: f64) -> Option<Exact> {
    let indenter = made.indenter.as_ref()?;
    Exact::of(indenter, problem.surface().grid(), problem.contact_modulus(), mean_pressure)
}

/// The one load that is given.
enum Given {
    Load(Load),
    ReducedPressure(f64),
}

impl LoadArgs {
    fn given(&self) -> Result<Given> {
        match (self.pressure, self.reduced_pressure, self.mean_gap) {
            (Some(pressure), None, None) => Ok(Given::Load(Load::MeanPressure(pressure))),
            (None, Some(reduced), None) => Ok(Given::ReducedPressure(reduced)),
            (None, None, Some(gap)) => Ok(Given::Load(Load::MeanGap(gap))),
            (None, None, None) => usage("no load is given: use --pressure, --reduced-pressure or --mean-gap"),
            _ => usage("more than one load is given: use only one of --pressure, --reduced-pressure and --mean-gap"),
        }
    }

    fn problem(&self, surface: Surface) -> Result<Problem> {
        Ok(match self.given()? {
            Given::Load(load) => Problem::under(surface, self.modulus, load)?,
            Given::ReducedPressure(reduced) => Problem::at_reduced_pressure(surface, self.modulus, reduced)?,
        })
    }
}
