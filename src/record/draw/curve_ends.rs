//! The ends of axes of curves that settle.

use crate::contact::{Forecast, Reading, Readings, Resolved};

/// `kappa_r` of rough surfaces, where no exact value is known.
const KAPPA_R: f64 = 1.6;
/// The end of the axis of a curve that settles over its last value.
const ROOM: f64 = 1.6;
/// The end of an axis over the last value of a curve from which on the curve is too flat to be read.
const FLAT: f64 = 4.0;
/// The largest ratio of a relative area to its forecast that is common.
const DOUBT: f64 = 1.5;
/// The end of an axis of the relative area of full contact.
const WHOLE: f64 = 1.05;

/// Upper ends of the axes of converging curves. They are set before the solve, so that the first steps do not make the
/// last ones invisible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CurveEnds {
    pub kappa_r: f64,
    pub relative_area: f64,
    /// That of `kappa`, where the reduced pressure is known.
    pub kappa: Option<f64>,
}

impl CurveEnds {
    /// The ends before a solve, for an exact `kappa_r`, if it is known, and an expected relative area.
    pub(crate) fn before(kappa_r: Option<f64>, forecast: Forecast, reduced_pressure: Option<f64>) -> Self {
        Self::new(kappa_r.unwrap_or(KAPPA_R), DOUBT * forecast.relative_area, reduced_pressure)
    }

    /// The ends that suit a contact.
    pub(crate) fn after(contact: &Reading<'_>) -> Self {
        let &Resolved { kappa_r, relative_area, .. } = contact.resolved();
        Self::new(kappa_r, relative_area, Some(contact.counted().reduced_pressure))
    }

    /// The ends for curves that settle at some `kappa_r` and relative area.
    fn new(kappa_r: f64, relative_area: f64, reduced_pressure: Option<f64>) -> Self {
        let area = ROOM * relative_area;
        Self {
            kappa_r: ROOM * kappa_r,
            relative_area: area.min(WHOLE),
            kappa: reduced_pressure.map(|load| area / load),
        }
    }

    /// Whether curves that would have these ends can be read on axes with the ends of `other`.
    pub(crate) fn are_read_on(&self, other: &Self) -> bool {
        let is_read = |own: f64, other: f64| (own / ROOM..=own * FLAT / ROOM).contains(&other);
        is_read(self.kappa_r, other.kappa_r) && is_read(self.relative_area, other.relative_area)
    }
}
