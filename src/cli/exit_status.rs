//! How commands end.

use anyhow::{Result, anyhow};
use asperity::contact::Contact;
use asperity::error::{
    ClaimError, Failure, FileError, FlowError, GridError, ProblemError, SealError, SettingError, SetupError, SlipError,
    SolidError, SolveError, StepsError, StudyError, SurfaceError,
};
use std::io::{Write, stderr};

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExitStatus {
    /// All is well.
    Done,
    /// All is written, but a solver did not converge.
    NotConverged,
    /// Ctrl-C ended the work; finished results were written.
    Interrupted,
}

impl ExitStatus {
    /// 0 if all is well, 3 if a solver did not converge, 130 after Ctrl-C.
    pub fn exit_code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::NotConverged => 3,
            Self::Interrupted => 130,
        }
    }
}

/// The exit status of a solve. If it has not converged, a warning is printed; the failure of an observer is an error.
pub fn settle(contact: &Contact) -> Result<ExitStatus> {
    match contact.fault() {
        None => Ok(ExitStatus::Done),
        Some(fault) if contact.failure.is_some() => Err(fault.into()),
        Some(fault) => {
            writeln!(stderr(), "warning: {fault}").ok();
            Ok(ExitStatus::NotConverged)
        }
    }
}

/// A failure as an error. A file error keeps its type, since it decides the exit code.
pub fn with_file_error(failure: Failure) -> anyhow::Error {
    failure.downcast::<FileError>().map_or_else(|other| anyhow!(other), |file| anyhow::Error::new(*file))
}

/// Ctrl-C came before the first of several loads was solved.
#[derive(Debug, thiserror::Error)]
#[error("interrupted before the first load was solved: no result was written")]
pub struct Interrupted;

/// Options that do not go together, in one sentence.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Usage(pub String);

/// A [`Usage`] error.
pub fn usage<T>(sentence: impl Into<String>) -> Result<T> {
    Err(Usage(sentence.into()).into())
}

/// The flags that give a missing value, to be added to the sentence of an error.
pub fn remedy(error: &anyhow::Error) -> &'static str {
    if let Some(ClaimError::NoLoad) = error.downcast_ref() {
        return " (--mean-pressure, --reduced-pressure, --mean-gap)";
    }
    match error.downcast_ref() {
        Some(SetupError::NoSurface) => " (--height, --indenter, --hurst)",
        Some(SetupError::NoLoad) => " (--pressure, --reduced-pressure, --mean-gap)",
        Some(SetupError::NoModulus { .. }) => " (--modulus, or --young and --poisson)",
        Some(SetupError::NoTangential { .. }) => " (--tangential, --path-tangential, --rolling, --creepage)",
        Some(SetupError::NoPoints) => " (--points)",
        Some(SetupError::NoSize) => " (--size)",
        Some(SetupError::Uneven { .. }) => " (--resample linear)",
        Some(SetupError::Voids { .. }) => " (--fill harmonic, --crop, or --prepare auto)",
        _ => "",
    }
}

/// 2 for wrong input, 130 for Ctrl-C, 1 for other failures.
pub fn exit_code(error: &anyhow::Error) -> u8 {
    if error.is::<Interrupted>() {
        return ExitStatus::Interrupted.exit_code();
    }
    let is_input = error.is::<Usage>()
        || error.is::<GridError>()
        || error.is::<SurfaceError>()
        || error.is::<ProblemError>()
        || error.is::<SettingError>()
        || error.is::<SolidError>()
        || error.is::<ClaimError>()
        || error.downcast_ref().is_some_and(SetupError::is_input)
        || error.downcast_ref().is_some_and(SlipError::is_input)
        || error.downcast_ref().is_some_and(SolveError::is_input)
        || error.downcast_ref().is_some_and(FileError::is_input)
        || error.downcast_ref().is_some_and(FlowError::is_input)
        || error.downcast_ref().is_some_and(SealError::is_input)
        || error.downcast_ref().is_some_and(StepsError::is_input)
        || error.downcast_ref().is_some_and(StudyError::is_input);
    if is_input { 2 } else { 1 }
}
