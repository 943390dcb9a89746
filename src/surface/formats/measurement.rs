//! Heights as an instrument has measured them.

use super::channel::{Channel, choose};
use super::format::malformed;
use super::layout::{Layout, is_array};
use super::{INSTRUMENTS, read_profile};
use crate::error::FileError;
use crate::surface::Field;
use ndarray::{Array1, ArrayD, Axis};
use std::io;
use std::path::Path;

/// The largest deviation from an even spacing, as a share of it: what positions that are rounded to a tenth of it come to.
const UNEVEN: f64 = 0.1;

/// The heights in a file of an instrument, before anything is done to them.
///
/// A file that states its units gives metres, whatever they are; the numbers of one that does not are kept as they are, and
/// `is_in_metres` says so. The first row of `height` is that at `y = 0`.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// The format, such as "ISO 25178-71 (SDF)".
    pub format: &'static str,
    /// The names of all channels of heights in the file.
    pub channels: Vec<String>,
    /// The one that was read.
    pub channel: String,
    /// Heights, shape `(ny, nx)`, a profile one row; NaN where none was measured.
    pub height: Field,
    /// Whether it is a profile, not a map of one row.
    pub is_profile: bool,
    /// Distances of neighbours along y and x, of uneven positions their mean; none where the file does not say.
    pub spacing: Option<[f64; 2]>,
    /// Positions along x of a profile that is not evenly spaced.
    pub positions: Option<Vec<f64>>,
    /// Whether heights and distances are metres: if not, the file does not say its units.
    pub is_in_metres: bool,
    /// What else the file says: names and values.
    pub header: Vec<(String, String)>,
}

impl Measurement {
    /// Reads a file whose format is found by its content, and of several channels the one of a name or a number from 1 on, or else the
    /// first one of heights.
    ///
    /// # Errors
    /// [`FileError::Read`] for a file that is missing or unreadable; [`FileError::Format`] with the reason for one of no known format,
    /// one that is cut short or contradicts itself, and a channel that is not there.
    pub fn read(path: impl AsRef<Path>, channel: Option<&str>) -> Result<Self, FileError> {
        let path = path.as_ref();
        if is_array(path) {
            let (height, positions) = read_profile(path)?;
            return Self::of_array(height, positions).map_err(|error| super::explained(path, "height", error));
        }
        let bytes = std::fs::read(path).map_err(|source| FileError::Read { path: path.into(), source })?;
        Self::of(&bytes, channel).map_err(|error| super::explained(path, "height", error))
    }

    /// Reads the bytes of a file like [`Measurement::read`].
    ///
    /// # Errors
    /// Of the kind [`io::ErrorKind::InvalidData`], with what is wrong with them.
    pub fn of(bytes: &[u8], channel: Option<&str>) -> io::Result<Self> {
        let instrument = INSTRUMENTS.iter().find(|it| (it.is_it)(bytes));
        let instrument = instrument.ok_or_else(|| malformed("it is in no format that is known here"))?;
        let all = (instrument.channels)(bytes)?;
        let channels = all.iter().filter(|it| it.is_height).map(|it| it.name.clone()).collect();
        let chosen = choose(all, channel)?;
        Self::new(instrument.name, channels, chosen)
    }

    /// Heights of an array, and the positions beside them if there are any.
    fn of_array(array: ArrayD<f64>, positions: Option<Array1<f64>>) -> io::Result<Self> {
        let is_profile = array.ndim() == 1;
        let array = if is_profile { array.insert_axis(Axis(0)) } else { array };
        let height: Field = array.into_dimensionality().map_err(|error| malformed(error.to_string()))?;
        let shape = height.dim().into();
        let values = move || Ok(height.into_iter().collect());
        let positions = positions.map(|it| it.to_vec());
        let channel = Channel { is_profile, positions, ..Channel::map("height", shape, values) };
        Self::new("NumPy", vec!["height".into()], channel)
    }

    /// Shape and spacing.
    pub fn layout(&self) -> Layout {
        let Self { height, is_profile, spacing, is_in_metres, positions, .. } = self;
        let (shape, is_even) = (height.dim().into(), positions.is_none());
        Layout { shape, is_profile: *is_profile, spacing: *spacing, is_in_metres: *is_in_metres, is_even }
    }

    /// Positions of the columns along x, the first one at 0, where the file says them.
    pub fn x(&self) -> Option<Vec<f64>> {
        let even = |[_, dx]: [f64; 2]| (0..self.height.ncols()).map(|i| i as f64 * dx).collect();
        self.positions.clone().or_else(|| self.spacing.map(even))
    }

    /// The measurement in a channel.
    fn new(format: &'static str, channels: Vec<String>, channel: Channel) -> io::Result<Self> {
        let Channel { name, shape, is_profile, spacing, positions, lateral_unit, unit, header, values, .. } = channel;
        let is_in_metres = lateral_unit.is_some() && unit.is_some();
        let [lateral, unit] = if is_in_metres { [lateral_unit, unit].map(|it| it.unwrap_or(1.0)) } else { [1.0; 2] };
        let values = values()?;
        let found = values.len();
        let height = Field::from_shape_vec(shape, values).map_err(|_| {
            malformed(format!("it holds {found} heights, which are not {} rows of {}", shape[0], shape[1]))
        })?;
        let height = height.mapv_into(|h| if h.is_finite() { h * unit } else { f64::NAN });
        let spacing = spacing.map(|it| it.map(|it| it * lateral));
        if let Some(wrong) = spacing.into_iter().flatten().find(|it| !(*it > 0.0 && it.is_finite())) {
            return Err(malformed(format!("it says that its points are {wrong:?} apart")));
        }
        let (height, positions) = match positions {
            Some(x) => in_order(height, x.into_iter().map(|x| x * lateral).collect())?,
            None => (height, None),
        };
        let mean = positions.as_deref().and_then(|x| Some(x.last()? / (x.len() - 1) as f64));
        let spacing = spacing.or(mean.map(|dx| [dx; 2]));
        let positions = positions.filter(|x| mean.is_some_and(|dx| !is_even(x, dx)));
        Ok(Self { format, channels, channel: name, height, is_profile, spacing, positions, is_in_metres, header })
    }
}

/// A profile in the order of its positions, the first one at 0.
fn in_order(height: Field, x: Vec<f64>) -> io::Result<(Field, Option<Vec<f64>>)> {
    if let Some(wrong) = x.iter().find(|x| !x.is_finite()) {
        return Err(malformed(format!("it holds the position {wrong:?}")));
    }
    let mut order: Vec<usize> = (0..x.len()).collect();
    order.sort_by(|i, j| x[*i].total_cmp(&x[*j]));
    let first = order.first().map_or(0.0, |i| x[*i]);
    let positions: Vec<f64> = order.iter().map(|i| x[*i] - first).collect();
    if let Some(pair) = positions.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(malformed(format!("it holds two heights at the position {:?}", pair[0] + first)));
    }
    Ok((height.select(Axis(1), &order), Some(positions)))
}

/// Whether positions are evenly spaced but for rounding.
fn is_even(positions: &[f64], spacing: f64) -> bool {
    positions.iter().enumerate().all(|(i, x)| (x - i as f64 * spacing).abs() <= UNEVEN * spacing)
}
