//! What the page may not have.

use crate::error::{FileError, ProblemError, SetupError, SurfaceError};

/// An order that stands for nothing, in one sentence.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct Refusal(pub String);

impl From<SetupError> for Refusal {
    fn from(error: SetupError) -> Self {
        Self(error.to_string())
    }
}

impl From<FileError> for Refusal {
    fn from(error: FileError) -> Self {
        Self(error.to_string())
    }
}

impl From<ProblemError> for Refusal {
    fn from(error: ProblemError) -> Self {
        Self(error.to_string())
    }
}

impl From<SurfaceError> for Refusal {
    fn from(error: SurfaceError) -> Self {
        Self(error.to_string())
    }
}
