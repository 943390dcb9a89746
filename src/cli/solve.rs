//! `asperity solve`: a contact under one load, or under one after the other.

use super::choice::bytes;
use super::contact_report::ContactReport;
use super::exit_status::{ExitStatus, Interrupted, shortfall, status_of, usage};
use super::finding::Finding;
use super::flags::{OfSetup, SceneArgs};
use super::flow::FlowFinding;
use super::imprint;
use super::outputs::{GrowingOutputs, Outputs};
use super::problem_summary::ProblemSummary;
use super::progress::Bars;
use super::recording_args::{say_left_out, target};
use super::report;
use super::slip::SlipFinding;
use super::solve_plan::{self, SolvePlan};
use super::state_watch::StateWatch;
use super::states;
use super::stress;
use super::terminal::stdout;
use super::warnings;
use anyhow::Result;
use asperity::contact::State;
use asperity::diagnosis::Findings;
use asperity::error::{FileError, HistoryError, SetupError};
use asperity::files::check_apart;
use asperity::flow::Leakage;
use asperity::job::{Job, JobRun, Solved};
use asperity::quantity::bytes_in_words;
use asperity::setup::{Auto, Cost, Drive, Setup, SetupTable, warning_of_leakage};
use clap::Args;
use std::io::Write;

const EXAMPLES: &str = "\
Examples:
  asperity solve --height profile.npy --size 160um --young 210GPa --poisson 0.3 --pressure 1MPa
  asperity solve scene.toml --solver gfmd --record run.rrd --out run.npz
  asperity solve scene.toml --reduced-pressure 1e-3..1e-1:13 --unload --out curve.csv";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Solve {
    #[command(flatten)]
    scene: SceneArgs<OfSetup>,
    /// After the last load, also solve the loads in reverse order; a body that yields below its surface is unloaded to 0 then
    #[arg(long, help_heading = super::flags::LOAD)]
    unload: bool,
    #[command(flatten)]
    outputs: Outputs,
    /// Solve twice, and explain why the solver was slow: slow wavelengths, nodes that change their state often,
    /// plateaus
    #[arg(long)]
    diagnose: bool,
    /// Print the estimated memory, number of transforms and size of the recording, and do not solve
    #[arg(long, conflicts_with = "json")]
    dry_run: bool,
    /// Refuse a solve that is estimated to need more memory, such as 8GB [default: what is free]
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    memory: Option<f64>,
}

impl Solve {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let mut table = self.scene.table()?;
        check_apart(self.outputs.files(), self.scene.files(&table))?;
        refuse_study(&table)?;
        let auto = table.take_auto()?;
        let setup = table.setup()?;
        self.check(&setup, auto.is_some())?;
        let setup = if self.unload { setup.unloaded() } else { setup };
        self.solve(JobRun::new(setup), auto)
    }

    /// Refuses flags that do not go together.
    fn check(&self, setup: &Setup, is_auto: bool) -> Result<()> {
        let (has_loads, is_history) = (!setup.loads.is_empty(), setup.is_history()?);
        match has_loads {
            false if is_history && (is_auto || self.diagnose || self.unload && !setup.yields()) => {
                usage("--refine auto, --diagnose and --unload do not go with a history: leave them out")
            }
            true if is_auto => {
                usage("--refine auto needs one load, but several are given: give one load, or a number for --refine")
            }
            true if self.diagnose => usage("--diagnose needs one load, but several are given: give one"),
            true if self.outputs.stress.is_some() => usage("--stress needs one load, but several are given: give one"),
            false if self.unload && !is_history => {
                usage("--unload needs several loads, but one is given: give more, such as 1e-3..1e-1:13")
            }
            _ => Ok(()),
        }
    }

    /// Solves a run: one contact, on a grid that is found first if it is not given, or several states.
    fn solve(&self, run: JobRun<'static>, auto: Option<Auto>) -> Result<ExitStatus> {
        let Self { outputs, .. } = self;
        let drive = run.drive()?;
        imprint::check(outputs.imprint.as_deref(), &run.setup, self.scene.units())?;
        drive.map_or(Ok(()), |drive| outputs.check_states(drive, &run.setup))?;
        let mut growing = outputs.growing();
        let contacts = run.setup.expected_states()?.max(1);
        let job = self.job(run, drive, auto, &mut growing).with_extras(outputs.extras(contacts));
        let cost = job.cost()?;
        self.check_memory(&cost)?;
        outputs.check()?;
        if drive.is_none() {
            self.check_contact(&job, &cost)?;
        }
        if self.dry_run {
            return self.plan(&job, &cost, drive);
        }
        cost.check(job.setup().solver.name())?;
        let ready = job.prepare()?;
        if outputs.strict {
            warnings::refuse_if_strict(&warnings::in_flags(&ready.warnings()), true)?;
        }
        if drive.is_none() {
            let mut outcome = ready.run(&mut Bars::default())?;
            let solved = outcome.solved.swap_remove(0);
            outputs.complete(&solved.contact);
            say_left_out(&outputs.left_out);
            return self.write(solved, outcome.diagnosis);
        }
        let problem = ready.problem().clone();
        let mut watch = StateWatch::new(outputs)?;
        let solved = ready.run(&mut watch).map_err(before_the_first)?.solved.swap_remove(0);
        say_left_out(&outputs.left_out);
        let written = states::write(solved, &problem, outputs, self.scene.units());
        // where the end cannot be written, what grew beside it is kept
        if !written.as_ref().is_err_and(|error| error.is::<FileError>()) {
            growing.discard();
        }
        written
    }

    /// Refuses a solve that needs more memory than it is given.
    fn check_memory(&self, cost: &Cost) -> Result<()> {
        match self.memory.filter(|given| cost.bytes > *given) {
            Some(given) => usage(format!(
                "the solve needs about {}, but --memory is {}: give more, a smaller grid, or fewer states",
                bytes_in_words(cost.bytes),
                bytes_in_words(given)
            )),
            None => Ok(()),
        }
    }

    /// Refuses outputs that one contact does not have.
    fn check_contact(&self, job: &Job<'_>, cost: &Cost) -> Result<()> {
        let Self { outputs, .. } = self;
        if let Some(path) = outputs.table().filter(|_| !cost.grid.is_line()) {
            return usage(format!("{}: a .csv of nodes is for lines only; for a surface give a .npz", path.display()));
        }
        if outputs.stress.is_some() {
            job.setup().check_stress(&cost.grid)?;
            stress::check(&cost.grid, outputs.stress_row)?;
        }
        Ok(())
    }

    /// Says what the run would cost, and solves nothing.
    fn plan(&self, job: &Job<'_>, cost: &Cost, drive: Option<&Drive>) -> Result<ExitStatus> {
        let (setup, is_passed_twice) = (job.setup(), job.is_passed_twice());
        let is_history = drive.is_some_and(|drive| !drive.is_list);
        let is_recorded = self.outputs.recording().is_some() && !is_history;
        let loads = (!setup.loads.is_empty()).then_some(setup.loads.len());
        solve_plan::write(&SolvePlan { setup, cost, loads, is_recorded, is_passed_twice }, &mut stdout())?;
        if is_history {
            let states = setup.expected_states()?;
            writeln!(
                stdout(),
                "  states      about {states}, each solved from the state before; all are kept in memory"
            )?;
        }
        job.refinement().map_or(Ok(()), |refinement| solve_plan::write_grids(refinement, &mut stdout()))?;
        cost.check(setup.solver.name())?;
        Ok(ExitStatus::Done)
    }

    /// The job that the flags ask for. States go to a table and an archive as they come.
    fn job<'a>(
        &self,
        run: JobRun<'static>,
        drive: Option<&Drive>,
        auto: Option<Auto>,
        growing: &'a mut GrowingOutputs,
    ) -> Job<'a> {
        let Self { outputs, .. } = self;
        let job = Job::from_run(run).diagnosed(self.diagnose);
        let job = match auto {
            Some(auto) => job.refined(auto),
            None => job,
        };
        let job = match target(outputs.recording(), outputs.live, &outputs.left_out) {
            Some(target) => job.recorded(target),
            None => job,
        };
        let Some(drive) = drive else { return job };
        let job = job.keeping_last(drive.is_list && outputs.archive().is_none());
        let job = match &mut growing.table {
            Some(table) => job.with_sink(table),
            None => job,
        };
        match &mut growing.archive {
            Some(archive) => job.with_sink(archive),
            None => job,
        }
    }

    /// Writes and prints what came out.
    fn write(&self, solved: Solved, diagnosis: Option<Findings>) -> Result<ExitStatus> {
        let outputs = &self.outputs;
        let mut warnings = solved.warnings();
        let Solved { setup, contact, slip, .. } = solved;
        let (subject, finding) = (ProblemSummary::new(&setup, &contact.problem)?, Finding::new(&setup, &contact));
        let flow = setup.flow.measure(&contact)?;
        warnings.extend(warning_of_leakage([flow.numbers.as_slice()]));
        let finding = Finding { flow: FlowFinding::from_numbers(&flow.numbers), ..finding };
        let is_archived = outputs.archive().is_some();
        let fields = flow.leakages.into_iter().filter(|_| is_archived).flat_map(Leakage::into_fields).collect();
        warnings.extend(outputs.stress.as_ref().and_then(|_| setup.warning_of_stress()));
        let mut warnings = warnings::in_flags(&warnings);
        warnings::refuse_if_strict(&warnings, outputs.strict)?;
        let contacts = || [&contact].into_iter().chain(slip.as_ref().map(|it| &it.stuck));
        warnings.extend(contacts().filter_map(shortfall));
        let status = contacts().try_fold(ExitStatus::Done, |status, it| Ok(status.max(status_of(it)?)));
        let report = ContactReport {
            subject,
            finding,
            slip: slip.as_ref().map(SlipFinding::from),
            diagnosis,
            warnings,
            setup,
            state: State::from_contact(contact, None).with_fields(fields),
            partial_slip: slip,
            units: self.scene.units(),
        };
        report::deliver(&report, outputs)?;
        status
    }
}

/// Refuses a setup with lists of values, which is a study.
pub(crate) fn refuse_study(table: &SetupTable) -> Result<()> {
    match table.clone().take_axes()?.first() {
        Some(axis) => usage(format!(
            "`{}` has {} values, so this scene is a study: run `asperity study`, or give one value",
            axis.path().escape_debug(),
            axis.len()
        )),
        None => Ok(()),
    }
}

/// The error of a run, which Ctrl-C may have ended before there was a state.
fn before_the_first(error: SetupError) -> anyhow::Error {
    match error {
        SetupError::History(HistoryError::Stopped) => Interrupted.into(),
        error => error.into(),
    }
}
