//! `asperity patches`: the contact patches of a result or a scene, from state to state.

use super::exit_status::{ExitStatus, settle, usage};
use super::flags::{OfPatches, SceneArgs};
use super::interrupt::interrupted;
use super::output::{write_json, write_rows};
use super::patch_report::PatchReport;
use super::problem_summary::ProblemSummary;
use super::progress::Bars;
use super::solve::refuse_study;
use super::terminal::stdout;
use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::{Contact, PatchEvent, PatchHistory, PatchSizes, PatchState, Problem};
use asperity::error::HistoryError;
use asperity::files::{check_apart, check_named, write_csv};
use asperity::job::{Job, JobRun, SavedResult};
use asperity::setup::Setup;
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  asperity patches run.npz
  asperity patches scene.toml --reduced-pressure 1e-3..1e-1:25 --out patches.csv";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct PatchesCommand {
    #[command(flatten)]
    scene: SceneArgs<OfPatches>,
    /// Write a table with a row for each patch in each state
    #[arg(long, value_name = "FILE.csv", help_heading = "Output")]
    out: Option<PathBuf>,
    /// Print one JSON object instead of a summary
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// The patches that were found, and in what.
struct FoundPatches {
    setup: Setup,
    problem: Problem,
    patches: PatchHistory,
    status: ExitStatus,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct PatchSummary<'a> {
    #[serde(flatten)]
    subject: ProblemSummary,
    states: Vec<PatchStateSummary<'a>>,
    events: &'a [PatchEvent],
    warnings: Vec<String>,
    #[serde(serialize_with = "Setup::serialize_saved")]
    setup: Setup,
}

#[derive(Serialize)]
struct PatchStateSummary<'a> {
    #[serde(flatten)]
    state: &'a PatchState,
    sizes: Vec<PatchSizes>,
}

impl PatchesCommand {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        if let Some(out) = &self.out {
            check_named(out, &["csv"])?;
        }
        let FoundPatches { setup, problem, patches, status, warnings } = match self.scene.result() {
            Some(path) => {
                check_apart(&self.out, [path])?;
                FoundPatches::from_result(SavedResult::read(path)?)?
            }
            None => self.solve()?,
        };
        if let Some(out) = &self.out {
            write_csv(out, patches.rows())?;
        }
        let (subject, units) = (ProblemSummary::new(&setup, &problem)?, self.scene.units());
        if self.json {
            let states = patches.states.iter().map(|state| PatchStateSummary { state, sizes: state.sizes() }).collect();
            let events = patches.events.as_slice();
            write_json(&PatchSummary { subject, states, events, warnings: warnings.clone(), setup }, &mut stdout())?;
        } else {
            let images = if setup.surface.prepare.mirror.is_some() { ", without mirror images" } else { "" };
            writeln!(stdout(), "{}: contact patches{images}", subject.line())?;
            write_rows(subject.rows(units, false), &mut stdout())?;
            PatchReport { patches: &patches, units, is_line: subject.rank == 1 }.write(&mut stdout())?;
        }
        warnings::print(&warnings);
        self.out.iter().for_each(|path| wrote(path));
        Ok(status)
    }

    /// Solves the contact, or one after the other.
    fn solve(&self) -> Result<FoundPatches> {
        let mut table = self.scene.table()?;
        check_apart(&self.out, self.scene.files(&table))?;
        refuse_study(&table)?;
        if table.take_auto()?.is_some() {
            return usage("patches are counted on one grid: give a number for --refine or --points instead of auto");
        }
        let setup = table.setup()?;
        let run = JobRun::new(setup);
        let is_list = run.drive()?.is_some_and(|drive| drive.is_list);
        let own = run.setup.surface.own_shape(run.setup.surface.grid(&run.setup.grid)?.shape());
        let mut patches = PatchHistory::new(own);
        let job = Job::from_run(run).keeping_last(is_list).with_sink(&mut patches);
        job.cost()?.check(job.setup().solver.name())?;
        let ready = job.prepare()?;
        let (setup, problem) = (ready.setup().clone(), ready.problem().clone());
        let solved = ready.run(&mut Bars::until(interrupted()?))?.solved.swap_remove(0);
        let mut warnings = warnings::in_flags(&solved.warnings());
        let status = match &solved.history {
            None => {
                patches.add(&solved.contact);
                settle(&solved.contact)?
            }
            Some(history) => {
                let count = history.states.len().max(patches.states.len());
                warnings.extend(history.ended.as_ref().map(|why| format!("it ended after {count} states: {why}")));
                match &history.ended {
                    Some(HistoryError::Stopped) => ExitStatus::Interrupted,
                    Some(_) => ExitStatus::NotConverged,
                    None => status_of(history.states.iter().map(|state| &state.contact)),
                }
            }
        };
        Ok(FoundPatches { setup, problem, patches, status, warnings })
    }
}

impl FoundPatches {
    fn from_result(result: SavedResult) -> Result<Self> {
        let (patches, problem) = (result.patches(), result.setup.problem_of(result.surface.clone())?);
        let status = if result.doubts.is_empty() { ExitStatus::Done } else { ExitStatus::NotConverged };
        Ok(Self { setup: result.setup, problem, patches, status, warnings: result.doubts })
    }
}

/// How some solves ended.
fn status_of<'a>(mut contacts: impl Iterator<Item = &'a Contact>) -> ExitStatus {
    if contacts.all(Contact::is_converged) { ExitStatus::Done } else { ExitStatus::NotConverged }
}
