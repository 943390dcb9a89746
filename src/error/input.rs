//! Whether an error is caused by the input, or by the machine or the method.

use super::{
    AdhesionError, FileError, FlowError, HistoryError, MotionError, SealError, SetupError, SlipError, SolveError,
    StepsError, StudyError,
};

impl FileError {
    /// Whether another file or place can help.
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::Write { .. })
    }
}

impl SolveError {
    /// Whether another solver or load can help.
    pub fn is_input(&self) -> bool {
        match self {
            Self::NeedsPressure { .. }
            | Self::NeedsWaves { .. }
            | Self::NeedsHardWall { .. }
            | Self::NeedsRest { .. } => true,
            Self::NotConverged { .. } => false,
            Self::Observer(failure) => {
                failure.downcast_ref().is_some_and(FileError::is_input)
                    || failure.downcast_ref().is_some_and(StepsError::is_input)
            }
        }
    }
}

impl SlipError {
    /// Whether another load or solver can help.
    pub fn is_input(&self) -> bool {
        match self {
            Self::Solve(error) => error.is_input(),
            _ => true,
        }
    }
}

impl HistoryError {
    /// Whether another setup can help.
    pub fn is_input(&self) -> bool {
        match self {
            Self::Solve(error) => error.is_input(),
            Self::Slip(error) => error.is_input(),
            Self::Creep(error) => error.is_input(),
            Self::Motion(error) => error.is_input(),
            Self::Adhesion(error) => error.is_input(),
            Self::Stopped => false,
            _ => true,
        }
    }
}

impl AdhesionError {
    /// Whether another attraction, load or grid can help.
    pub fn is_input(&self) -> bool {
        match self {
            Self::Solve(error) => error.is_input(),
            Self::NotFound { .. } | Self::Stopped => false,
            _ => true,
        }
    }
}

impl MotionError {
    /// Whether another motion can help.
    pub fn is_input(&self) -> bool {
        match self {
            Self::Solve(error) => error.is_input(),
            _ => true,
        }
    }
}

impl FlowError {
    /// Whether other values can help.
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::NotConverged { .. })
    }
}

impl SealError {
    /// Whether another surface or another solver can help.
    pub fn is_input(&self) -> bool {
        match self {
            Self::Solve(error) => error.is_input(),
            _ => true,
        }
    }
}

impl StepsError {
    /// Whether other steps can help.
    pub fn is_input(&self) -> bool {
        match self {
            Self::File(error) => error.is_input(),
            _ => true,
        }
    }
}

impl SetupError {
    /// Whether another setup can help.
    pub fn is_input(&self) -> bool {
        match self {
            Self::File(error) => error.is_input(),
            Self::Slip(error) => error.is_input(),
            Self::Flow(error) => error.is_input(),
            Self::History(error) => error.is_input(),
            Self::Creep(error) => error.is_input(),
            Self::Solve(error) => error.is_input(),
            _ => true,
        }
    }
}

impl StudyError {
    /// Whether another study can help.
    pub fn is_input(&self) -> bool {
        match self {
            Self::Setup(error) | Self::Row { source: error, .. } => error.is_input(),
            Self::Solve(error) => error.is_input(),
            Self::File(error) => error.is_input(),
            _ => true,
        }
    }
}
