//! `asperity study --record-row`: the recording of one row.

use super::outcome::{Outcome, settle};
use super::progress::Progress;
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::Contact;
use asperity::files::check_named;
use asperity::record::{Options, Recording, Scene};
use asperity::setup::Extras;
use asperity::study::{LoadCurve, Plan};
use std::path::Path;

/// Solves a realisation up to a row, as the study does, and records the steps under the load of the row.
pub fn record(plan: &Plan, number: usize, path: &Path) -> Result<Outcome> {
    let row = plan.row(number)?;
    check_named(path, &["rrd"])?;
    let setup = plan.setup(row)?;
    setup.cost(&Extras { is_recorded: true, ..Extras::default() })?.check(setup.solver.name())?;
    let curve = LoadCurve { setup: plan.realisation(row.realisation)?.setup, loads: plan.loads()[..=row.load].into() };
    let problem = setup.problem()?;
    curve.problem()?;
    let scenes = [Scene::of(&setup, &problem)];
    let recording = Recording::create(path, &scenes, Options::from(&setup.record))?;
    let mut outcome = Outcome::Done;
    curve.press(
        &problem,
        |load| ((load == row.load).then(|| recording.recorder(0)), Progress::new(&format!("load {}", load + 1))),
        |load, contact: &Contact| -> Result<()> {
            if load == row.load {
                outcome = settle(contact)?;
            }
            Ok(())
        },
    )?;
    recording.finish()?;
    wrote(path);
    Ok(outcome)
}
