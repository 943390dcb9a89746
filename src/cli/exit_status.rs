//! How commands end.

use super::terminal::stderr;
use anyhow::{Result, anyhow};
use asperity::contact::Contact;
use asperity::error::{ClaimError, Failure, FileError, SetupError, StudyError, is_input};
use asperity::setup::Key;
use asperity::warning::Remedy;
use std::io::Write;

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ExitStatus {
    /// All is well.
    Done,
    /// All is written, but a solver did not converge.
    NotConverged,
    /// Ctrl-C ended the work; finished results were written.
    Interrupted,
}

impl ExitStatus {
    /// 0 if all is well, 3 if a solver did not converge, 130 after Ctrl-C.
    pub(crate) fn exit_code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::NotConverged => 3,
            Self::Interrupted => 130,
        }
    }
}

/// The exit status of a solve. If it has not converged, a warning is printed; the failure of an observer is an error.
pub(crate) fn settle(contact: &Contact) -> Result<ExitStatus> {
    shortfall(contact).iter().for_each(|fault| drop(writeln!(stderr(), "warning: {fault}")));
    status_of(contact)
}

/// The exit status of a solve, without a warning: the caller prints that it has not converged. The failure of an observer is an error.
pub(crate) fn status_of(contact: &Contact) -> Result<ExitStatus> {
    match contact.fault() {
        None => Ok(ExitStatus::Done),
        Some(fault) if contact.failure.is_some() => Err(fault.into()),
        Some(_) => Ok(ExitStatus::NotConverged),
    }
}

/// The warning of a contact that has not converged.
pub(crate) fn shortfall(contact: &Contact) -> Option<String> {
    contact.fault().filter(|_| contact.failure.is_none()).map(|fault| fault.to_string())
}

/// A failure as an error. A file error keeps its type, since it decides the exit code.
pub(crate) fn with_file_error(failure: Failure) -> anyhow::Error {
    failure.downcast::<FileError>().map_or_else(|other| anyhow!(other), |file| anyhow::Error::new(*file))
}

/// Ctrl-C came before the first of several loads was solved.
#[derive(Debug, thiserror::Error)]
#[error("interrupted before the first load was solved: no result was written")]
pub(crate) struct Interrupted;

/// Options that do not go together, in one sentence.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub(crate) struct Usage(pub String);

/// A [`Usage`] error.
pub(crate) fn usage<T>(sentence: impl Into<String>) -> Result<T> {
    Err(Usage(sentence.into()).into())
}

/// The flags that give a missing value, to be added to the sentence of an error.
pub(crate) fn remedy(error: &anyhow::Error) -> String {
    if let Some(ClaimError::NoLoad) = error.downcast_ref() {
        return " (--mean-pressure, --reduced-pressure, or --mean-gap)".into();
    }
    if let Some(flag) = flag_of_command(error) {
        return format!(" ({flag})");
    }
    let setup = error.downcast_ref();
    if let Some(SetupError::Text { fault, .. }) = setup
        && !fault.flags().is_empty()
    {
        let flags: Vec<String> = fault.flags().iter().map(|flag| format!("--{flag}")).collect();
        return format!(" ({})", flags.join(" or "));
    }
    let remedies = setup.map(SetupError::remedies).unwrap_or_default();
    let together = |remedies: &Vec<Remedy>| remedies.iter().filter_map(flag).collect::<Vec<_>>().join(" and ");
    let alternatives: Vec<String> = remedies.iter().map(together).collect();
    match alternatives.split_last() {
        None => String::new(),
        Some((one, [])) => format!(" ({one})"),
        Some((last, others)) => format!(" ({}, or {last})", others.join(", ")),
    }
}

/// The flag of this command that helps against an error where no key of a setup does.
fn flag_of_command(error: &anyhow::Error) -> Option<&'static str> {
    let file = match error.downcast_ref() {
        Some(SetupError::File(file)) => Some(file),
        _ => error.downcast_ref(),
    };
    match (file, error.downcast_ref()) {
        (Some(FileError::NoViewer { .. }), _) => Some("--record"),
        (_, Some(StudyError::OtherStudy { .. })) => Some("--fresh"),
        _ => None,
    }
}

/// The flag of a remedy, such as `--resample linear` or `--size`.
fn flag(Remedy { key: path, value }: &Remedy) -> Option<String> {
    let key = Key::with_flags().find(|key| key.path == *path)?;
    Some(value.as_ref().map_or(format!("--{}", key.flag), |value| format!("--{} {value}", key.flag)))
}

/// 2 for wrong input, 130 for Ctrl-C, 1 for other failures.
pub(crate) fn exit_code(error: &anyhow::Error) -> u8 {
    if error.is::<Interrupted>() {
        return ExitStatus::Interrupted.exit_code();
    }
    if error.is::<Usage>() || is_input(error.as_ref()) { 2 } else { 1 }
}
