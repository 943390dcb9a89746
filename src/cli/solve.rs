//! `asperity solve`: a contact under one load, or under one after the other.

use super::exit_status::{ExitStatus, settle, usage};
use super::finding::Finding;
use super::flags::{OfSetup, SceneArgs};
use super::flow::FlowFinding;
use super::history;
use super::load_curve;
use super::output::{Summary, write_json};
use super::outputs::Outputs;
use super::picture;
use super::problem_summary::ProblemSummary;
use super::progress::Bars;
use super::recording_args::open;
use super::slip::SlipFinding;
use super::solve_plan::{self, SolvePlan};
use super::stress;
use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::{PartialSlip, State, archive_of_slip, archive_of_state};
use asperity::diagnosis::Findings;
use asperity::files::{check_apart, write_beside};
use asperity::job::{Job, Solved, write_nodes};
use asperity::setup::{Auto, Setup, SetupTable};
use asperity::study::LoadCurve;
use clap::Args;
use std::io::{self, Write, stdout};
use std::path::Path;

const EXAMPLES: &str = "\
Examples:
  asperity solve --height profile.npy --size 160um --young 210GPa --poisson 0.3 --pressure 1MPa
  asperity solve scene.toml --solver gfmd --record run.rrd --out run.npz
  asperity solve scene.toml --reduced-pressure 1e-3..1e-1:13 --unload --out curve.csv";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Solve {
    #[command(flatten)]
    scene: SceneArgs<OfSetup>,
    /// After the last load, also solve the loads in reverse order
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
}

impl Solve {
    pub fn run(&self) -> Result<ExitStatus> {
        let mut table = self.scene.table()?;
        check_apart(self.outputs.files(), self.scene.files(&table))?;
        refuse_study(&table)?;
        let (loads, auto) = (table.take_loads()?, table.take_auto()?);
        let setup = table.setup()?;
        let units = self.scene.units(&setup.surface);
        if setup.is_history()? {
            return match loads {
                Some(_) => usage("a history needs one load, but several are given: give one, and a path of loads"),
                None if auto.is_some() || self.diagnose || self.unload => {
                    usage("--refine auto, --diagnose and --unload do not go with a history: leave them out")
                }
                None => history::run(&setup, &self.outputs, units, self.dry_run),
            };
        }
        match loads {
            Some(_) if auto.is_some() => {
                usage("--refine auto needs one load, but several are given: give one load, or a number for --refine")
            }
            Some(_) if self.diagnose => usage("--diagnose needs one load, but several are given: give one"),
            Some(_) if setup.friction.is_some() => {
                usage("a tangential load needs one normal load, but several are given: give one")
            }
            Some(_) if self.outputs.stress.is_some() => {
                usage("--stress needs one load, but several are given: give one")
            }
            Some(loads) if self.unload => {
                load_curve::run(&LoadCurve { setup, loads }.and_back(), &self.outputs, units, self.dry_run)
            }
            Some(loads) => load_curve::run(&LoadCurve { setup, loads }, &self.outputs, units, self.dry_run),
            None if self.unload => {
                usage("--unload needs several loads, but one is given: give more, such as 1e-3..1e-1:13")
            }
            None => self.solve(setup, auto),
        }
    }

    /// Solves a setup under its one load, on a grid that is found first if it is not given.
    fn solve(&self, setup: Setup, auto: Option<Auto>) -> Result<ExitStatus> {
        let Self { outputs, .. } = self;
        let job = self.job(setup, auto).with_extras(outputs.extras(1));
        let cost = job.cost()?;
        outputs.check()?;
        if let Some(path) = outputs.table().filter(|_| !cost.grid.is_line()) {
            return usage(format!("{}: a .csv of nodes is for lines only; for a surface give a .npz", path.display()));
        }
        if outputs.stress.is_some() {
            job.setup().check_stress(&cost.grid)?;
            stress::check(&cost.grid, outputs.stress_row)?;
        }
        if self.dry_run {
            let (setup, is_passed_twice) = (job.setup(), job.is_passed_twice());
            let is_recorded = outputs.recording().is_some();
            solve_plan::write(
                &SolvePlan { setup, cost: &cost, loads: None, is_recorded, is_passed_twice },
                &mut stdout(),
            )?;
            job.refinement().map_or(Ok(()), |refinement| solve_plan::write_grids(refinement, &mut stdout()))?;
            cost.check(setup.solver.name())?;
            return Ok(ExitStatus::Done);
        }
        let ready = job.prepare()?;
        if outputs.strict {
            warnings::refuse_if_strict(&warnings::in_flags(&ready.warnings()), true)?;
        }
        let mut outcome = ready.run(&mut Bars)?;
        let solved = outcome.solved.swap_remove(0);
        outputs.complete(&solved.contact);
        self.write(solved, outcome.diagnosis)
    }

    /// The job that the flags ask for.
    fn job(&self, setup: Setup, auto: Option<Auto>) -> Job<'_> {
        let job = Job::new(setup).diagnosed(self.diagnose);
        let job = match auto {
            Some(auto) => job.refined(auto),
            None => job,
        };
        if self.outputs.record.is_some() || self.outputs.live {
            return job.recorded(open(self.outputs.record.as_deref(), self.outputs.live));
        }
        job
    }

    /// Writes and prints what came out.
    fn write(&self, solved: Solved, diagnosis: Option<Findings>) -> Result<ExitStatus> {
        let (outputs, full) = (&self.outputs, solved.setup.clone().with_full_path());
        let mut warnings = solved.warnings();
        let Solved { setup, contact, slip, .. } = solved;
        let (subject, finding) = (ProblemSummary::new(&setup, &contact.problem)?, Finding::new(&setup, &contact));
        let flow = FlowFinding::new(&contact, &setup.flow, outputs.archive().is_some())?;
        let finding = Finding { flow, ..finding };
        warnings.extend(outputs.stress.as_ref().and_then(|_| setup.warning_of_stress()));
        let warnings = warnings::in_flags(&warnings);
        warnings::refuse_if_strict(&warnings, outputs.strict)?;
        if let Some(path) = outputs.archive() {
            let text = full.to_toml();
            let bytes = match &slip {
                Some(slip) => archive_of_slip(slip, subject.rank, Some(&text)),
                None => {
                    let fields = finding.flow.iter().flat_map(|it| it.fields.iter().cloned()).collect();
                    let state = State { fields, ..State::from_contact(contact.clone(), None) };
                    archive_of_state(&state, subject.rank, Some(&text))
                }
            };
            write_beside(path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?;
        }
        if let Some(path) = outputs.table() {
            write_nodes(path, &contact)?;
        }
        let units = self.scene.units(&setup.surface);
        if let Some(path) = outputs.picture() {
            picture::write(path, &picture::of_contact(&subject.title, &contact, units))?;
        }
        if let Some(path) = &outputs.stress {
            stress::write(path, &full, &contact, outputs.stress_row)?;
        }
        if let Some(path) = &outputs.save_setup {
            setup.write(path)?;
        }
        let summary = Summary {
            subject,
            finding,
            slip: slip.as_ref().map(SlipFinding::from),
            diagnosis,
            warnings,
            setup: full,
            units,
        };
        if outputs.json {
            write_json(&summary, &mut stdout())?
        } else {
            summary.write_text(&mut stdout())?
        }
        warnings::print(&summary.warnings);
        let is_whole = |path: &&Path| contact.failure.is_none() || Some(*path) != outputs.recording();
        outputs.files().filter(is_whole).for_each(wrote);
        let stuck = slip.map_or(Ok(ExitStatus::Done), |PartialSlip { stuck, .. }| settle(&stuck))?;
        Ok(settle(&contact)?.max(stuck))
    }
}

/// Refuses a setup with lists of values, which is a study.
fn refuse_study(table: &SetupTable) -> Result<()> {
    match table.clone().take_axes()?.first() {
        Some(axis) => usage(format!(
            "`{}` has {} values, so this scene is a study: run `asperity study`, or give one value",
            axis.path(),
            axis.len()
        )),
        None => Ok(()),
    }
}
