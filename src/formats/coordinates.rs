//! Coordinates of the points of maps and profiles, as arrays beside their heights.

use super::channel::Channel;
use super::format::malformed;
use super::unit::{lateral, ratio};
use std::io;

/// Deviations of coordinates from even places, over their step, from which on they are uneven: texts and single precision round by less.
const UNEVEN: f64 = 1e-4;

/// An axis of a map or a profile.
#[derive(Default)]
pub(super) struct AxisCoordinates {
    /// The distance of points that are evenly spaced, negative where coordinates fall.
    step: Option<f64>,
    /// Metres in its unit.
    unit: Option<f64>,
    /// Coordinates that are not evenly spaced.
    uneven: Option<Vec<f64>>,
}

impl AxisCoordinates {
    /// The axis `name` with coordinates in a unit of `unit` metres. A `length` in the same unit is the length of the whole axis, which its points divide evenly.
    ///
    /// # Errors
    /// For a length that is not positive.
    pub(crate) fn new(name: &str, positions: Vec<f64>, unit: Option<f64>, length: Option<f64>) -> io::Result<Self> {
        if let Some(length) = length {
            if length.is_nan() || length <= 0.0 {
                return Err(malformed(format!("its {name:?} has the length {length:?}")));
            }
            return Ok(Self { step: Some(length / positions.len() as f64), unit, uneven: None });
        }
        Ok(match step(&positions) {
            Some(step) => Self { step: Some(step), unit, uneven: None },
            None if positions.len() > 1 => Self { step: None, unit, uneven: Some(positions) },
            None => Self { unit, ..Self::default() },
        })
    }

    /// Whether the coordinates of the axis fall from point to point.
    fn is_back(&self) -> bool {
        self.step.is_some_and(|step| step < 0.0)
    }
}

/// The distance of positions that are evenly spaced, at least two.
fn step(positions: &[f64]) -> Option<f64> {
    let (first, last) = (positions.first()?, positions.last()?);
    let step = (last - first) / (positions.len() as f64 - 1.0);
    let is_even = |(i, x): (usize, &f64)| (x - first - step * i as f64).abs() <= UNEVEN * step.abs();
    positions.iter().enumerate().all(is_even).then_some(step)
}

/// The axes of a map or a profile.
pub(super) struct GridAxes {
    y: AxisCoordinates,
    x: AxisCoordinates,
    is_profile: bool,
    /// Whether the points of a column follow each other in the file, not those of a row.
    is_turned: bool,
}

impl GridAxes {
    /// The axes of a profile, or those of a map in the order of the file.
    ///
    /// # Errors
    /// For a map whose coordinates are not evenly spaced.
    pub(crate) fn new([slow, fast]: [AxisCoordinates; 2], is_profile: bool, is_turned: bool) -> io::Result<Self> {
        let [y, x] = if is_turned { [fast, slow] } else { [slow, fast] };
        if !is_profile && (x.uneven.is_some() || y.uneven.is_some()) {
            return Err(malformed("its map has coordinates that are not evenly spaced"));
        }
        Ok(Self { y, x, is_profile, is_turned })
    }

    /// Rows and columns of a map, from the numbers of points along the slow and the fast axis of its array.
    pub(crate) fn shape(&self, [slow, fast]: [usize; 2]) -> [usize; 2] {
        if self.is_turned { [fast, slow] } else { [slow, fast] }
    }

    /// The places of the values in the file, row by row, so that coordinates rise along both axes.
    pub(crate) fn places(&self, in_file: [usize; 2]) -> impl Iterator<Item = usize> + use<> {
        let ([ny, nx], is_turned, is_back) =
            (self.shape(in_file), self.is_turned, [self.y.is_back(), self.x.is_back()]);
        (0..ny * nx).map(move |i| {
            let [iy, ix] = [i / nx, i % nx];
            let [iy, ix] = [if is_back[0] { ny - 1 - iy } else { iy }, if is_back[1] { nx - 1 - ix } else { ix }];
            if is_turned { ix * ny + iy } else { iy * nx + ix }
        })
    }

    /// Metres in the unit of distances.
    pub(crate) fn unit(&self) -> Option<f64> {
        if self.is_profile { self.x.unit } else { lateral(self.y.unit, self.x.unit) }
    }

    /// The channel with these distances.
    pub(crate) fn spaced<'a>(self, channel: Channel<'a>) -> Channel<'a> {
        let (lateral_unit, Self { y, x, is_profile, .. }) = (self.unit(), self);
        let across = if is_profile { x.step } else { y.step.map(|it| it * ratio(y.unit, x.unit)) };
        Channel {
            spacing: across.zip(x.step).map(|(y, x)| [y.abs(), x.abs()]),
            positions: x.uneven.filter(|_| is_profile),
            lateral_unit,
            ..channel
        }
    }
}
