//! The recording of what another code has found.

use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::{Contact, Observer, Problem, Solver};
use asperity::diagnosis::Reference;
use asperity::error::FileError;
use asperity::files::check_named;
use asperity::record::{Options, Parts, Recording, Scene};
use asperity::setup::Setup;
use clap::{ArgGroup, Args};
use std::path::PathBuf;
use std::sync::Arc;

#[derive(Args)]
#[command(next_help_heading = "Output")]
#[cfg_attr(feature = "record", command(group = ArgGroup::new("recorded").args(["record", "live"]).multiple(true)))]
pub struct Shown {
    /// Record it for the Rerun viewer, as the steps of a solver are recorded
    #[arg(long, value_name = "FILE.rrd")]
    pub record: Option<PathBuf>,
    /// Show it in the installed Rerun viewer
    #[arg(long)]
    pub live: bool,
}

impl Shown {
    /// Refuses a place where no recording can be written.
    pub fn check(&self) -> Result<(), FileError> {
        self.record.as_ref().map_or(Ok(()), |path| check_named(path, &["rrd"]))
    }

    /// Says that the recording was written, if one was.
    pub fn tell(&self) {
        self.record.iter().for_each(|path| wrote(path));
    }

    /// Has `solver` go through its steps, shown to `observer` and recorded under `title` if that is asked for, held against the
    /// reference if there is one.
    pub fn watch(
        &self,
        title: &str,
        setup: &Setup,
        problem: &Problem,
        (solver, reference): (&dyn Solver, Option<Arc<Reference>>),
        observer: &mut dyn Observer,
    ) -> Result<Contact> {
        let path = self.record.as_deref();
        if path.is_none() && !self.live {
            return Ok(solver.solve(problem, &setup.stop, observer)?);
        }
        let mut options = Options::from(&setup.record);
        if setup.record.what.is_empty() {
            options.what = Parts::OF_OTHERS;
        }
        // no setup: it would name a solver that has not made this
        let scenes = [Scene { title: title.into(), reference, ..Scene::new("contact", problem) }];
        let recording = match path {
            Some(path) if !self.live => Recording::create(path, &scenes, options)?,
            _ => Recording::shown(path, &scenes, options)?,
        };
        let mut recorder = recording.recorder(0);
        let mut contact = solver.solve(problem, &setup.stop, &mut (&mut recorder, observer))?;
        drop(recorder);
        if let Err(failure) = recording.finish() {
            contact.fail(failure);
        }
        Ok(contact)
    }
}
