//! What a run found, and what becomes of it: files, a summary and warnings, in one order for one contact, a list of loads and a history.

use super::output::write_json;
use super::outputs::Outputs;
use super::terminal::stdout;
use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::files::write_beside;
use asperity::plot::{Figure, write_figure};
use asperity::setup::Setup;
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

/// What a run found, for files, for people and, as JSON, for scripts.
pub(crate) trait SolveReport: Serialize {
    /// The setup that repeats it.
    fn setup(&self) -> &Setup;
    /// Reasons to doubt it, in the words of the command line.
    fn warnings(&self) -> &[String];
    /// Whether its recording is not whole, since it could not be written to the end.
    fn has_lost_recording(&self) -> bool;
    /// The bytes of its archive.
    fn archive(&self) -> io::Result<Vec<u8>>;
    /// Writes its numbers as a table.
    fn write_table(&self, path: &Path) -> Result<()>;
    /// Its picture.
    fn figure(&self) -> Figure;
    /// Writes the files that only such a run has.
    fn write_further_files(&self, outputs: &Outputs) -> Result<()>;
    /// Writes it for reading; all of its numbers, where that is asked for.
    fn write_text(&self, is_verbose: bool, out: &mut dyn Write) -> io::Result<()>;
}

/// Writes all files that were asked for, then prints the summary and the warnings, and names the files. Files come first, so that nobody reads numbers
/// whose files then turn out not to be there.
pub(crate) fn deliver(report: &impl SolveReport, outputs: &Outputs) -> Result<()> {
    if let Some(path) = outputs.archive() {
        write_beside(path, |file| file.write_all(&report.archive()?))?;
    }
    if let Some(path) = outputs.table() {
        report.write_table(path)?;
    }
    if let Some(path) = outputs.picture() {
        write_figure(path, &report.figure(), &outputs.style()?)?;
    }
    report.write_further_files(outputs)?;
    if let Some(path) = &outputs.save_setup {
        report.setup().write(path)?;
    }
    match outputs.json {
        true => write_json(report, &mut stdout())?,
        false => report.write_text(outputs.verbose, &mut stdout())?,
    }
    warnings::print(report.warnings());
    let is_whole = |path: &&Path| !report.has_lost_recording() || Some(*path) != outputs.recording();
    outputs.files().filter(is_whole).for_each(wrote);
    Ok(())
}
