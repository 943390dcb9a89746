//! Shape and spacing of heights in a file, before they are read.

use super::channel::Channel;
use super::format::malformed;
use std::io;

/// The largest deviation from an even spacing, as a share of it: what positions that are rounded to a tenth of it come to.
const UNEVEN: f64 = 0.1;

/// Shape and spacing of the heights in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Rows and columns; a profile has one row.
    pub shape: [usize; 2],
    /// Whether it is a profile, not a map of one row.
    pub is_profile: bool,
    /// Spacing along y and x (the mean for uneven positions); none if the file has none.
    pub spacing: Option<[f64; 2]>,
    /// Whether all lengths that the file has are in metres: heights, and distances if it has some.
    pub is_in_metres: bool,
    /// The units that the file states; lengths in these are converted to metres.
    pub units: FileUnits,
    /// Whether all positions of a profile are evenly spaced.
    pub is_even: bool,
}

/// Metres in the units that a file states, none where it states no unit.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FileUnits {
    /// Of distances.
    pub distance: Option<f64>,
    /// Of heights.
    pub height: Option<f64>,
}

impl FileUnits {
    /// Whether a unit is one of those that the file states, except for rounding.
    pub(crate) fn has(&self, unit: f64) -> bool {
        let is_same = |own: &f64| (unit / own - 1.0).abs() < 1e-9;
        [self.distance, self.height].iter().flatten().any(is_same)
    }
}

/// Positions in ascending order, the first one at 0.
pub(super) struct AscendingPositions {
    /// Whether they descend in the file.
    pub is_reversed: bool,
    pub x: Vec<f64>,
}

impl Layout {
    /// The layout of a map of no known spacing.
    pub(super) fn map(shape: [usize; 2]) -> Self {
        Self {
            shape,
            is_profile: false,
            spacing: None,
            is_in_metres: false,
            units: FileUnits::default(),
            is_even: true,
        }
    }

    /// The layout of a channel, and the positions in it.
    pub(super) fn from_channel(channel: &Channel) -> io::Result<(Self, Option<AscendingPositions>)> {
        let Channel { shape, is_profile, spacing, ref positions, lateral_unit, unit, .. } = *channel;
        let has_distances = spacing.is_some() || positions.is_some();
        let is_in_metres = unit.is_some() && (lateral_unit.is_some() || !has_distances);
        let units = FileUnits { distance: lateral_unit.filter(|_| has_distances), height: unit };
        let lateral = units.distance.unwrap_or(1.0);
        // instruments write a size of zero where nobody calibrated or set it: the heights can be used with a size that is given
        let spacing = spacing.filter(|_| doubt_of_spacing(channel).is_none()).map(|it| it.map(|it| it * lateral));
        if let Some(wrong) = spacing.into_iter().flatten().find(|it| !(*it > 0.0 && it.is_finite())) {
            return Err(malformed(format!("it states a spacing of {wrong:?}")));
        }
        let positions = positions.as_ref().map(|x| AscendingPositions::new(x, lateral)).transpose()?;
        let mean = positions.as_ref().and_then(|it| Some(it.x.last()? / (it.x.len() - 1) as f64));
        let is_even = positions.as_ref().zip(mean).is_none_or(|(it, dx)| it.is_even(dx));
        let spacing = spacing.or(mean.map(|dx| [dx; 2]));
        Ok((Self { shape, is_profile, spacing, is_in_metres, units, is_even }, positions))
    }
}

/// The doubt that a file states a size of zero, which is none.
pub(super) fn doubt_of_spacing(channel: &Channel) -> Option<String> {
    let [dy, dx] = channel.spacing?;
    let axes: Vec<&str> = [(dx, "x"), (dy, "y")].into_iter().filter(|it| it.0 == 0.0).map(|it| it.1).collect();
    (!axes.is_empty()).then(|| format!("the size along {} is zero, which is none: give it", axes.join(" and ")))
}

impl AscendingPositions {
    /// The positions in a file, times the length of its unit.
    ///
    /// # Errors
    /// For positions that are not finite, that turn back, and that occur twice.
    fn new(x: &[f64], unit: f64) -> io::Result<Self> {
        if let Some(wrong) = x.iter().find(|x| !x.is_finite()) {
            return Err(malformed(format!("it contains the position {wrong:?}")));
        }
        let is_reversed = x.first() > x.last();
        refuse_turn(x)?;
        if let Some(twice) = x.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(malformed(format!("it contains two heights at the position {:?}", twice[0])));
        }
        let mut ascending = x.to_vec();
        if is_reversed {
            ascending.reverse();
        }
        let first = ascending.first().copied().unwrap_or_default();
        ascending.iter_mut().for_each(|x| *x = (*x - first) * unit);
        match ascending.last() {
            Some(last) if !last.is_finite() => Err(malformed(format!("its positions span {last:?}"))),
            _ => Ok(Self { is_reversed, x: ascending }),
        }
    }

    /// Whether they are evenly spaced except for rounding.
    fn is_even(&self, spacing: f64) -> bool {
        self.x.iter().enumerate().all(|(i, x)| (x - i as f64 * spacing).abs() <= UNEVEN * spacing)
    }
}

/// Refuses positions that go forth and back, such as trace and retrace of a line.
fn refuse_turn(x: &[f64]) -> io::Result<()> {
    let mut last = 0.0;
    for (i, pair) in x.windows(2).enumerate() {
        let step = pair[1] - pair[0];
        if step * last < 0.0 {
            return Err(malformed(format!(
                "its positions turn back at point {}, from {:?} to {:?}, and two passes or an overhang are no profile: give one pass",
                i + 2,
                pair[0],
                pair[1]
            )));
        }
        last = if step == 0.0 { last } else { step.signum() };
    }
    Ok(())
}
