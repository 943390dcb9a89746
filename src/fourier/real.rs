//! The real numbers that filters compute with.

use realfft::RealFftPlanner;
use rustfft::num_traits::Zero;
use rustfft::{FftNum, FftPlanner};
use std::sync::{LazyLock, Mutex};

/// The planners of all transforms of one precision, which keep what they have planned.
pub(crate) struct Planners<T: FftNum> {
    pub rows: RealFftPlanner<T>,
    pub columns: FftPlanner<T>,
}

impl<T: FftNum> Planners<T> {
    pub(crate) fn new() -> Self {
        Self { rows: RealFftPlanner::new(), columns: FftPlanner::new() }
    }
}

/// A real number of a filter: double precision, or single precision for inner steps, whose results are corrected by others in
/// double precision.
pub(crate) trait Real: FftNum + Zero {
    /// The relative rounding of a number.
    const EPSILON: f64;

    /// The nearest number.
    fn from_double(value: f64) -> Self;

    /// This number in double precision.
    fn to_double(self) -> f64;

    /// The planners that the whole process shares.
    fn planners() -> &'static Mutex<Planners<Self>>;
}

impl Real for f64 {
    const EPSILON: f64 = f64::EPSILON;

    fn from_double(value: f64) -> Self {
        value
    }

    fn to_double(self) -> f64 {
        self
    }

    fn planners() -> &'static Mutex<Planners<Self>> {
        static PLANNERS: LazyLock<Mutex<Planners<f64>>> = LazyLock::new(|| Mutex::new(Planners::new()));
        &PLANNERS
    }
}

impl Real for f32 {
    const EPSILON: f64 = f32::EPSILON as f64;

    fn from_double(value: f64) -> Self {
        value as f32
    }

    fn to_double(self) -> f64 {
        f64::from(self)
    }

    fn planners() -> &'static Mutex<Planners<Self>> {
        static PLANNERS: LazyLock<Mutex<Planners<f32>>> = LazyLock::new(|| Mutex::new(Planners::new()));
        &PLANNERS
    }
}
