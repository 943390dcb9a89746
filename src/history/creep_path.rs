//! Loads along a path in time.

use crate::contact::Load;
use crate::error::CreepError;

/// A load that changes linearly in time between points. Two points at one time are a jump of the load.
///
/// ```
/// use asperity::contact::Load;
/// use asperity::history::CreepPath;
/// // pressed in one second, held for nine
/// let path = CreepPath::new(vec![
///     (0.0, Load::MeanPressure(0.0)),
///     (1.0, Load::MeanPressure(2.0)),
///     (10.0, Load::MeanPressure(2.0)),
/// ])?;
/// assert_eq!(path.load(1, 0.25), Load::MeanPressure(0.5));
/// // a mean gap cannot become a pressure in the course of time
/// assert!(CreepPath::new(vec![(0.0, Load::MeanGap(0.1)), (1.0, Load::MeanPressure(2.0))]).is_err());
/// # Ok::<(), asperity::error::CreepError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct CreepPath {
    points: Vec<(f64, Load)>,
}

/// A change of the rate of the load at a point of a path. The Kelvin elements answer it with a transient: an element with the ratio `f` and the
/// time `tau` lags behind the load by `f tau P'`, and after the point it goes from the lag of the rate before to that of the rate after.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RateChange {
    /// The change of the rate over the larger one of the rates before and after: 1 at both ends of a hold, 2 where the load goes back as
    /// fast as it came, 0 where nothing changes.
    pub change: f64,
    /// The shorter one of the times from the point before and to the point after.
    pub time: f64,
}

impl CreepPath {
    /// The path through points of a time and a load. The load of the first point is applied at its time, without delay.
    ///
    /// # Errors
    /// [`CreepError::NoPoints`] for no points, [`CreepError::Order`] for times that fall or are not finite, and
    /// [`CreepError::Kinds`] for loads of two kinds with time between them.
    pub fn new(points: Vec<(f64, Load)>) -> Result<Self, CreepError> {
        let Some(&(first, _)) = points.first() else { return Err(CreepError::NoPoints) };
        if !first.is_finite() {
            return Err(CreepError::Order { before: f64::NEG_INFINITY, time: first });
        }
        for pair in points.windows(2) {
            let [(before, from), (time, to)] = [pair[0], pair[1]];
            if !(time.is_finite() && time >= before) {
                return Err(CreepError::Order { before, time });
            }
            if time > before && from.name() != to.name() {
                return Err(CreepError::Kinds { from: from.to_string(), to: to.to_string() });
            }
        }
        Ok(Self { points })
    }

    /// A load that is held from time 0 on for a duration.
    ///
    /// # Errors
    /// [`CreepError::Order`] for a duration that is negative or not finite.
    pub fn held(load: Load, duration: f64) -> Result<Self, CreepError> {
        Self::new(vec![(0.0, load), (duration, load)])
    }

    /// The path with one more point: at a time, or at that of the last point.
    ///
    /// # Errors
    /// The errors of [`CreepPath::new`].
    pub fn extended(&self, time: Option<f64>, load: Load) -> Result<Self, CreepError> {
        let last = self.points.last().map_or(0.0, |(time, _)| *time);
        Self::new(self.points.iter().copied().chain([(time.unwrap_or(last), load)]).collect())
    }

    /// The points, a time and a load each.
    pub fn points(&self) -> &[(f64, Load)] {
        &self.points
    }

    /// The load at a time between the point before and this `point`. Points are counted from 0.
    ///
    /// # Panics
    /// If there is no such point.
    pub fn load(&self, point: usize, time: f64) -> Load {
        let (end, to) = self.points[point];
        let (begin, from) = self.points[point.saturating_sub(1)];
        if time >= end || end == begin {
            return to;
        }
        let share = (time - begin) / (end - begin);
        to.with_value(from.value() + share * (to.value() - from.value()))
    }

    /// How the rate of the load changes at a point; none at the ends of the path, where the load jumps, and where its rate stays.
    pub(super) fn turn(&self, point: usize) -> Option<RateChange> {
        let (time, load) = *self.points.get(point)?;
        let is_jump = self.points.iter().any(|(other, it)| *other == time && *it != load);
        let before = self.points.iter().rev().find(|(other, _)| *other < time)?;
        let after = self.points.iter().find(|(other, _)| *other > time)?;
        let rate = |(other, it): &(f64, Load)| (it.value() - load.value()) / (other - time);
        let [before_rate, after_rate] = [before, after].map(rate);
        let change = (after_rate - before_rate).abs() / before_rate.abs().max(after_rate.abs());
        let turn = RateChange { change, time: (time - before.0).min(after.0 - time) };
        (!is_jump && change > 0.0).then_some(turn)
    }
}
