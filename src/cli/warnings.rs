//! Warnings on standard error, with the flags that help.

use super::command_style::remark;
use super::exit_status::usage;
use super::terminal::stderr;
use anyhow::Result;
use asperity::sentence::Sentence;
use asperity::setup::Key;
use asperity::warning::{Remedy, Warning};
use std::io::Write;
use std::path::Path;

/// Warnings as texts with the flags that help.
pub(crate) fn in_flags(warnings: &[Warning]) -> Vec<String> {
    warnings.iter().map(|warning| warning.in_words(flag)).collect()
}

/// The flag of a remedy, such as `--refine auto`.
fn flag(remedy: &Remedy) -> Option<String> {
    let key = Key::with_flags().find(|key| key.path == remedy.key)?;
    let value = remedy.value.as_deref().unwrap_or(key.placeholder);
    Some(format!("--{} {value}", key.flag))
}

/// Prints warnings on standard error.
pub(crate) fn print(warnings: &[String]) {
    for warning in warnings {
        writeln!(stderr(), "warning: {warning}").ok();
    }
}

/// Prints a warning if a recording is incomplete.
///
/// # Errors
/// For a file that cannot be read.
pub(crate) fn print_if_cut_off(path: &Path) -> Result<()> {
    if asperity::record::is_cut_off(path)? {
        let path = path.display();
        print(&[format!(
            "{path} is incomplete: it was cut off or is still being written. It shows what was recorded so far, and \
             the axes are not fitted."
        )]);
    }
    Ok(())
}

/// Makes an error of warnings where `--strict` asks for that.
///
/// # Errors
/// The warnings, as a usage error.
pub(crate) fn refuse_if_strict(warnings: &[String], is_strict: bool) -> Result<()> {
    if is_strict && !warnings.is_empty() { usage(warnings.join(" ")) } else { Ok(()) }
}

/// Prints why steps of the preparation were chosen, on standard error.
pub(crate) fn print_reasons(reasons: &[Sentence]) {
    for reason in reasons {
        remark(format_args!("chosen: {reason}"));
    }
}
