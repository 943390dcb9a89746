//! `asperity solve`: one contact.

use super::flags::Scene;
use super::outcome::{Outcome, usage};
use super::output::Summary;
use super::plan;
use super::progress::Progress;
use anyhow::Result;
use asperity::contact::{Contact, Problem, archive};
use asperity::files::{check_target, write_beside};
#[cfg(feature = "record")]
use asperity::record;
use asperity::setup::Setup;
use clap::Args;
use std::io::{self, Write, stderr, stdout};
use std::path::PathBuf;

#[derive(Args)]
pub struct Solve {
    #[command(flatten)]
    scene: Scene<true>,
    #[command(flatten)]
    output: Output,
    /// Say what the solve would take in memory, transforms and recording, and do none of it
    #[arg(long, conflicts_with = "json")]
    dry_run: bool,
}

#[derive(Args)]
#[command(next_help_heading = "Output")]
#[cfg_attr(feature = "record", command(group = clap::ArgGroup::new("recorded").args(["record", "live"]).multiple(true)))]
struct Output {
    /// Record every relaxation step for the Rerun viewer
    #[cfg(feature = "record")]
    #[arg(long, value_name = "FILE.rrd")]
    record: Option<PathBuf>,
    /// Show the steps in the installed Rerun viewer while they are made
    #[cfg(feature = "record")]
    #[arg(long)]
    live: bool,
    /// Write height, pressure, gap, displacement and contact, shaped as the input, and the setup
    #[arg(long, value_name = "FILE.npz")]
    out: Option<PathBuf>,
    /// Write what was solved as a scene, all numbers to the last bit
    #[arg(long, value_name = "SCENE.toml")]
    save_setup: Option<PathBuf>,
    /// Print one JSON object instead of a summary
    #[arg(long)]
    json: bool,
}

impl Output {
    /// The recording.
    fn recording(&self) -> Option<&PathBuf> {
        #[cfg(feature = "record")]
        {
            self.record.as_ref()
        }
        #[cfg(not(feature = "record"))]
        None
    }

    /// Refuses places where nothing can be written, and one file for two outputs.
    fn check(&self) -> Result<()> {
        let named =
            [("--record", self.recording()), ("--out", self.out.as_ref()), ("--save-setup", self.save_setup.as_ref())];
        let named: Vec<_> = named.into_iter().filter_map(|(flag, path)| Some((flag, path?))).collect();
        for (i, (flag, path)) in named.iter().enumerate() {
            check_target(path)?;
            if let Some((other, _)) = named[..i].iter().find(|(_, earlier)| earlier == path) {
                return usage(format!("{other} and {flag} both name {}: give two files", path.display()));
            }
        }
        Ok(())
    }
}

impl Solve {
    pub fn run(&self) -> Result<Outcome> {
        let setup = self.scene.table()?.setup()?;
        let cost = setup.cost(self.output.recording().is_some(), self.output.out.is_some())?;
        self.output.check()?;
        if self.dry_run {
            plan::write(&setup, &cost, self.output.recording().is_some(), &mut stdout())?;
            return Ok(Outcome::Done);
        }
        cost.check(setup.solver.name())?;
        let contact = self.watch(&setup, &setup.problem()?)?;
        self.write(&setup, &contact)?;
        settle(&contact)
    }

    /// Writes and prints what came out.
    fn write(&self, setup: &Setup, contact: &Contact) -> Result<()> {
        let rank = setup.surface.rank(&setup.grid)?;
        if let Some(path) = &self.output.out {
            let text = setup.clone().with_full_path().to_toml();
            let bytes = archive(contact, rank, Some(&text));
            write_beside(path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?;
        }
        if let Some(path) = &self.output.save_setup {
            setup.write(path)?;
        }
        let summary = Summary::of(setup, contact, rank);
        if self.output.json { summary.write_json(&mut stdout()) } else { Ok(summary.write_text(&mut stdout())?) }
    }

    /// Solves, and shows the steps to whom it concerns.
    fn watch(&self, setup: &Setup, problem: &Problem) -> Result<Contact> {
        let solver = setup.solver.solver();
        let mut progress = Progress::new(solver.name());
        #[cfg(feature = "record")]
        if self.output.record.is_some() || self.output.live {
            let scenes = [record::Scene::of(setup, problem)];
            let options = record::Options::from(&setup.record);
            let path = self.output.record.as_deref();
            let recording = match path {
                Some(path) if !self.output.live => record::Recording::create(path, &scenes, options)?,
                _ => record::Recording::shown(path, &scenes, options)?,
            };
            let mut recorder = recording.recorder(0);
            let mut contact = solver.solve(problem, &setup.stop, &mut (&mut recorder, &mut progress))?;
            drop(recorder);
            if let Err(failure) = recording.finish() {
                contact.fail(failure);
            }
            return Ok(contact);
        }
        Ok(solver.solve(problem, &setup.stop, &mut progress)?)
    }
}

/// How a solve ended. That it has not converged is said on standard error; the failure of an observer is an error.
pub fn settle(contact: &Contact) -> Result<Outcome> {
    match contact.fault() {
        None => Ok(Outcome::Done),
        Some(fault) if contact.failure.is_some() => Err(fault.into()),
        Some(fault) => {
            writeln!(stderr(), "warning: {fault}").ok();
            Ok(Outcome::NotConverged)
        }
    }
}
