//! Warnings on standard error, with the flags that help.

use super::manners::remark;
use super::outcome::usage;
use anyhow::Result;
use asperity::setup::FLAGS;
use asperity::warning::{Remedy, Warning};
use std::io::{Write, stderr};

/// Warnings as texts with the flags that help.
pub fn in_flags(warnings: &[Warning]) -> Vec<String> {
    warnings.iter().map(|warning| warning.in_words(flag)).collect()
}

/// The flag of a remedy, such as `--refine auto`.
fn flag(remedy: &Remedy) -> Option<String> {
    let flag = FLAGS.iter().find(|flag| flag.path == remedy.key)?;
    let value = remedy.value.as_deref().unwrap_or(flag.placeholder);
    Some(format!("--{} {value}", flag.name))
}

/// Prints warnings on standard error.
pub fn print(warnings: &[String]) {
    for warning in warnings {
        writeln!(stderr(), "warning: {warning}").ok();
    }
}

/// Makes an error of warnings where `--strict` asks for that.
///
/// # Errors
/// The warnings, as a usage error.
pub fn refuse_if_strict(warnings: &[String], is_strict: bool) -> Result<()> {
    if is_strict && !warnings.is_empty() { usage(warnings.join(" ")) } else { Ok(()) }
}

/// Prints why steps of the preparation were chosen, on standard error.
pub fn print_reasons(reasons: &[String]) {
    for reason in reasons {
        remark(format_args!("chosen: {reason}"));
    }
}
