//! Random roughness that cannot be made.

use super::{FileError, SetupError, SurfaceError};
use crate::sentence::worded;

worded! {
    /// Random roughness that cannot be made: by its values, or by one of its files.
    #[derive(Debug)]
    pub enum RoughnessError {
        /// Its values cannot be, or not on this grid.
        #[error(transparent)]
        Surface(#[from] SurfaceError),
        /// The file of a spectrum or of heights cannot be read.
        #[error(transparent)]
        File(#[from] FileError),
    }
}

impl From<RoughnessError> for SetupError {
    fn from(error: RoughnessError) -> Self {
        match error {
            RoughnessError::Surface(error) => error.into(),
            RoughnessError::File(error) => error.into(),
        }
    }
}
