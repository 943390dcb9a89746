//! `asperity solve`: a contact under one load, or under one after the other.

use super::finding::Finding;
use super::flags::{Scene, Whole};
use super::load_curve;
use super::nodes::write_nodes;
use super::outcome::{Outcome, settle, usage};
use super::output::{Summary, write_json};
use super::outputs::Outputs;
use super::picture;
use super::plan::{self, Plan};
use super::progress::Progress;
use super::slip::{self, SlipFinding};
use super::stress;
use super::subject::Subject;
use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::{
    Contact, Observer, PartialSlip, Problem, archive, archive_of_slip, warning_of_rim, warnings_of,
};
use asperity::diagnosis::{Diagnosis, Findings, Reference};
use asperity::files::{check_apart, write_beside};
#[cfg(feature = "record")]
use asperity::record;
use asperity::setup::{Auto, Setup, Table};
use asperity::study::{LoadCurve, Refinement, Settled};
use clap::Args;
use std::io::{self, Write, stdout};
use std::path::Path;
use std::sync::Arc;

const EXAMPLES: &str = "\
Examples:
  asperity solve --height profile.npy --size 160um --young 210GPa --poisson 0.3 --pressure 1MPa
  asperity solve scene.toml --solver gfmd --record run.rrd --out run.npz
  asperity solve scene.toml --reduced-pressure 1e-3..1e-1:13 --unload --out curve.csv";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Solve {
    #[command(flatten)]
    scene: Scene<Whole>,
    /// Go back through several loads after the last one
    #[arg(long, help_heading = super::flags::LOAD)]
    unload: bool,
    #[command(flatten)]
    outputs: Outputs,
    /// Solve twice, and say what held the solve up the second time: slow wavelengths, nodes that flip, plateaus
    #[arg(long)]
    diagnose: bool,
    /// Say what the solve would take in memory, transforms and recording, and do none of it
    #[arg(long, conflicts_with = "json")]
    dry_run: bool,
}

impl Solve {
    pub fn run(&self) -> Result<Outcome> {
        let mut table = self.scene.table()?;
        refuse_study(&table)?;
        let (loads, auto) = (table.take_loads()?, table.take_auto()?);
        let setup = table.setup()?;
        check_apart(self.outputs.files(), self.scene.files(&setup.surface))?;
        let units = self.scene.units(&setup.surface);
        match loads {
            Some(_) if auto.is_some() => {
                usage("a grid is found under one load, but several are given: give one, or a number for --refine")
            }
            Some(_) if self.diagnose => {
                usage("--diagnose looks at the steps under one load, but several are given: give one")
            }
            Some(_) if setup.friction.is_some() => {
                usage("a tangential load follows one normal load, but several are given: give one")
            }
            Some(_) if self.outputs.stress.is_some() => {
                usage("--stress is that under one load, but several are given: give one")
            }
            Some(loads) if self.unload => {
                load_curve::run(&LoadCurve { setup, loads }.and_back(), &self.outputs, units, self.dry_run)
            }
            Some(loads) => load_curve::run(&LoadCurve { setup, loads }, &self.outputs, units, self.dry_run),
            None if self.unload => {
                usage("--unload goes back through several loads, but there is one: give more, such as 1e-3..1e-1:13")
            }
            None => self.solve(&setup, auto),
        }
    }

    /// Solves a setup under its one load, on a grid that is found first if it is not given.
    fn solve(&self, setup: &Setup, auto: Option<Auto>) -> Result<Outcome> {
        let Self { outputs, .. } = self;
        let refinement = auto.map(|auto| Refinement::new(setup.clone(), auto));
        let first = refinement.iter().flat_map(Refinement::setups).next();
        let setup = first.as_ref().unwrap_or(setup);
        let cost = setup.cost(outputs.recording().is_some(), outputs.archive().iter().count())?;
        outputs.check()?;
        if let Some(path) = outputs.table().filter(|_| !cost.grid.is_line()) {
            return usage(format!("{} can hold the nodes of a line only: give a .npz for a surface", path.display()));
        }
        if outputs.stress.is_some() {
            setup.check_stress(&cost.grid)?;
            stress::check(&cost.grid, outputs.stress_row)?;
        }
        if self.dry_run {
            let is_recorded = outputs.recording().is_some();
            let plan =
                Plan { setup, cost: &cost, loads: None, is_recorded, is_passed_twice: self.is_passed_twice(setup) };
            plan::write(&plan, &mut stdout())?;
            refinement.iter().try_for_each(|refinement| plan::write_grids(refinement, &mut stdout()))?;
            return Ok(Outcome::Done);
        }
        cost.check(setup.solver.name())?;
        match refinement {
            Some(refinement) => self.settle(&refinement),
            None => {
                let problem = setup.problem()?;
                self.heed(setup, &problem)?;
                let (contact, diagnosis) = self.watch(setup, &problem)?;
                outputs.complete(&contact);
                self.write(setup, &contact, diagnosis, false)
            }
        }
    }

    /// Solves on ever finer grids, and records the last of them if that is wished for.
    fn settle(&self, refinement: &Refinement) -> Result<Outcome> {
        let Settled { setup, mut contact, is_within } = refinement.settle(|setup| -> Result<Contact> {
            let (solver, problem) = (setup.solver.solver(), setup.problem()?);
            self.heed(setup, &problem)?;
            Ok(solver.solve(&problem, &setup.stop, &mut Progress::new(solver.name()))?)
        })?;
        let mut diagnosis = None;
        if self.diagnose || self.outputs.recording().is_some() {
            (contact, diagnosis) = self.watch(&setup, &contact.problem.clone())?;
        }
        self.outputs.complete(&contact);
        self.write(&setup, &contact, diagnosis, !is_within)
    }

    /// Refuses heights that would be warned of.
    fn heed(&self, setup: &Setup, problem: &Problem) -> Result<()> {
        let is_strict = self.outputs.strict;
        let warnings = if is_strict { setup.surface.warnings(problem.surface()) } else { Vec::new() };
        warnings::refuse_if_strict(&warnings::in_flags(&warnings), is_strict)
    }

    /// Writes and prints what came out, on a grid that is not fine enough if it is `unsettled`.
    fn write(&self, setup: &Setup, contact: &Contact, diagnosis: Option<Findings>, unsettled: bool) -> Result<Outcome> {
        let (outputs, full) = (&self.outputs, setup.clone().with_full_path());
        let slip = slip::find(setup, contact)?;
        let (subject, finding) = (Subject::of(setup, &contact.problem)?, Finding::of(setup, contact));
        let mut warnings = setup.surface.warnings(contact.problem.surface());
        warnings.extend(warnings_of(&[&finding.observables], contact.problem.law()));
        warnings.extend(warning_of_rim(contact));
        warnings.extend(setup.warning_of_coupling());
        warnings.extend(unsettled.then(Refinement::warning));
        warnings.extend(outputs.stress.as_ref().and_then(|_| setup.warning_of_stress()));
        let warnings = warnings::in_flags(&warnings);
        warnings::refuse_if_strict(&warnings, outputs.strict)?;
        if let Some(path) = outputs.archive() {
            let text = full.to_toml();
            let bytes = match &slip {
                Some(slip) => archive_of_slip(slip, subject.rank, Some(&text)),
                None => archive(contact, subject.rank, Some(&text)),
            };
            write_beside(path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?;
        }
        if let Some(path) = outputs.table() {
            write_nodes(path, contact)?;
        }
        let units = self.scene.units(&setup.surface);
        if let Some(path) = outputs.picture() {
            picture::write(path, &picture::of_contact(&subject.title, contact, units))?;
        }
        if let Some(path) = &outputs.stress {
            stress::write(path, &full, contact, outputs.stress_row)?;
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
        let stuck = slip.map_or(Ok(Outcome::Done), |PartialSlip { stuck, .. }| settle(&stuck))?;
        Ok(settle(contact)?.max(stuck))
    }

    /// Solves, and shows the steps to whom it concerns. What is held against the final state needs a solve before.
    fn watch(&self, setup: &Setup, problem: &Problem) -> Result<(Contact, Option<Findings>)> {
        let solver = setup.solver.solver();
        let before =
            || solver.solve(problem, &setup.stop, &mut Progress::new(&format!("{}, for its end", solver.name())));
        let end = if self.is_passed_twice(setup) { Some(Arc::new(Reference::of(&before()?))) } else { None };
        let mut diagnosis = self.diagnose.then(|| Diagnosis::new(problem, end.clone()));
        let contact = self.record(setup, problem, end, &mut (&mut diagnosis, Progress::new(solver.name())))?;
        Ok((contact, diagnosis.map(|diagnosis| diagnosis.findings())))
    }

    /// Whether the final state must be known before.
    fn is_passed_twice(&self, setup: &Setup) -> bool {
        self.diagnose || self.outputs.has_waterfall(&setup.record)
    }

    /// Solves, and records the steps if that is wished for.
    fn record(
        &self,
        setup: &Setup,
        problem: &Problem,
        end: Option<Arc<Reference>>,
        watch: &mut dyn Observer,
    ) -> Result<Contact> {
        let solver = setup.solver.solver();
        #[cfg(feature = "record")]
        if self.outputs.record.is_some() || self.outputs.live {
            let scenes = [record::Scene { reference: end, ..record::Scene::of(setup, problem) }];
            let options = record::Options::from(&setup.record);
            let path = self.outputs.record.as_deref();
            let recording = match path {
                Some(path) if !self.outputs.live => record::Recording::create(path, &scenes, options)?,
                _ => record::Recording::shown(path, &scenes, options)?,
            };
            let mut recorder = recording.recorder(0);
            let mut contact = solver.solve(problem, &setup.stop, &mut (&mut recorder, watch))?;
            drop(recorder);
            if let Err(failure) = recording.finish() {
                contact.fail(failure);
            }
            return Ok(contact);
        }
        drop(end);
        Ok(solver.solve(problem, &setup.stop, watch)?)
    }
}

/// Refuses a setup with lists of values, which is a study.
fn refuse_study(table: &Table) -> Result<()> {
    match table.clone().take_axes()?.first() {
        Some(axis) => usage(format!(
            "`{}` has {} values, which make a study of this scene: run it by `asperity study`, or give one value",
            axis.path(),
            axis.len()
        )),
        None => Ok(()),
    }
}
