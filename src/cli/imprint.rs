//! The imprint that a body keeps, as a file of heights.

use super::exit_status::usage;
use super::units::Units;
use anyhow::Result;
use asperity::contact::{FieldKind, State};
use asperity::files::check_named;
use asperity::formats::Scan;
use asperity::setup::Setup;
use std::path::Path;

/// The ending of arrays, which have no unit; all other formats are in metres.
const ARRAY_ENDING: &str = "npy";

/// Refuses an imprint of a body that keeps none, and a name that promises another content.
pub(crate) fn check(path: Option<&Path>, setup: &Setup, units: Units) -> Result<()> {
    let Some(path) = path else { return Ok(()) };
    if !setup.feels().eigenstrain {
        return usage("--imprint is for a body that yields below its surface: give --yield-stress, or leave it out");
    }
    check_named(path, &Scan::endings())?;
    let is_array = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(ARRAY_ENDING));
    if is_array || units.metres {
        return Ok(());
    }
    let path = path.display();
    usage(format!(
        "{path}: the format is in metres, but the lengths have no unit: give them with a unit, or a name that ends in .npy"
    ))
}

/// Writes the heights of the surface of the body in a state, as they would be without load: a dent is negative.
pub(crate) fn write(path: &Path, state: &State) -> Result<()> {
    let Some(imprint) = state.field(FieldKind::Imprint) else { return Ok(()) };
    let spacing = state.contact.problem.surface().grid().spacing();
    Ok(Scan { height: -imprint, spacing }.write(path)?)
}
