//! The stress below the contact that a solve has found, in a file.

use super::command_style::remark;
use super::exit_status::{Usage, usage};
use anyhow::Result;
use asperity::Grid;
use asperity::contact::{Contact, archive_of_stress};
use asperity::elastic::stress::USUAL_POISSON;
use asperity::files::write_beside;
use asperity::setup::Setup;
use std::io::{self, Write};
use std::path::Path;

/// Refuses a row that a grid does not have.
pub(crate) fn check(grid: &Grid, row: Option<usize>) -> Result<()> {
    let ny = grid.shape()[0];
    match row {
        Some(_) if grid.is_line() => usage("--stress-row chooses a row of a surface, but this is a line: leave it out"),
        Some(row) if row >= ny => Err(Usage(format!("--stress-row is {row}: give 0 to {}", ny - 1)).into()),
        _ => Ok(()),
    }
}

/// Writes the stress below a row, or below that of the largest pressure.
pub(crate) fn write(path: &Path, setup: &Setup, contact: &Contact, row: Option<usize>) -> Result<()> {
    let row = row.unwrap_or_else(|| contact.highest_row());
    let stress = contact.stress(row, setup.poisson().unwrap_or(USUAL_POISSON), &contact.usual_depths())?;
    let bytes = archive_of_stress((contact, row), &stress, setup.poisson().is_none(), &setup.to_saved_toml());
    write_beside(path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?;
    let (confined, highest) = (contact.confined_stress(stress.poisson), contact.max_pressure());
    if confined != 0.0 {
        remark(format!(
            "note: This stress is without lateral strain under the mean pressure. If the body is free to expand \
             along x, subtract sigma_confined = \
             {confined:.3e} ({:.1} % of the largest pressure) from sigma_xx.",
            100.0 * confined.abs() / highest
        ));
    }
    Ok(())
}
