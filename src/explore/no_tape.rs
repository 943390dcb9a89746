//! A session without recordings, as in a browser: the same functions as those of `tape.rs`, which record nothing.

use super::report::{SweepPoint, SweepReport};
use crate::contact::{Contact, Failure, Problem};
use crate::error::FileError;
use crate::job::Job;
use crate::setup::{Record, Setup};
use std::sync::Arc;

/// No bytes.
pub(crate) type TapeBytes = ();
/// No curves.
pub(crate) type TapeCurves = ();
/// What a recording would be drawn for.
pub(crate) type TapeView = (Option<[f64; 2]>, Option<Arc<TapeCurves>>);

/// No curves of a run that begins.
pub(crate) fn curves(_: &str) -> TapeCurves {}

/// The job as it is.
pub(crate) fn recorded<'a>(
    job: Job<'a>,
    _: &'a str,
    _: &Record,
    _: TapeView,
    begun: impl FnOnce(TapeBytes) + 'a,
) -> Job<'a> {
    begun(());
    job
}

/// No recording of a sweep.
pub(crate) struct SweepTape;

impl SweepTape {
    /// Begins nothing.
    ///
    /// # Errors
    /// None.
    pub(crate) fn begin(
        _: (&SweepReport, &Setup, &Problem),
        _: &[f64],
        _: [bool; 2],
        _: TapeView,
    ) -> Result<(Self, TapeBytes), Failure> {
        Ok((Self, ()))
    }

    /// Records nothing.
    ///
    /// # Errors
    /// None.
    pub(crate) fn contact(&self, _: usize, _: &Contact) -> Result<(), FileError> {
        Ok(())
    }

    /// Records nothing.
    ///
    /// # Errors
    /// None.
    pub(crate) fn point(&self, _: &SweepPoint) -> Result<(), FileError> {
        Ok(())
    }

    /// Ends nothing.
    ///
    /// # Errors
    /// None.
    pub(crate) fn finish(self) -> Result<(), FileError> {
        Ok(())
    }
}
