//! The real numbers that filters compute with.

use rustfft::FftNum;
use rustfft::num_traits::Zero;

/// A real number of a filter: double precision, or single precision for inner steps, whose results are corrected by others in
/// double precision.
pub(crate) trait Real: FftNum + Zero {
    /// The nearest number.
    fn from_double(value: f64) -> Self;

    /// This number in double precision.
    fn to_double(self) -> f64;
}

impl Real for f64 {
    fn from_double(value: f64) -> Self {
        value
    }

    fn to_double(self) -> f64 {
        self
    }
}

impl Real for f32 {
    fn from_double(value: f64) -> Self {
        value as f32
    }

    fn to_double(self) -> f64 {
        f64::from(self)
    }
}
