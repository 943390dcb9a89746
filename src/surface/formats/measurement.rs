//! Heights as an instrument has measured them.

use super::channel::{Channel, choose};
use super::format::malformed;
use super::instrument::Instrument;
use super::layout::Layout;
use super::{INSTRUMENTS, npy, npz, open, read_profile, read_shape};
use crate::error::FileError;
use crate::surface::Field;
use ndarray::{Array1, ArrayD, Axis};
use std::io::{self, Read};
use std::path::Path;

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
        let bytes = bytes(path)?;
        Self::of(&bytes, channel).map_err(|error| super::explained(path, "height", error))
    }

    /// Reads the bytes of a file like [`Measurement::read`].
    ///
    /// # Errors
    /// Of the kind [`io::ErrorKind::InvalidData`], with what is wrong with them.
    pub fn of(bytes: &[u8], channel: Option<&str>) -> io::Result<Self> {
        let instrument = instrument(bytes)?;
        let all = (instrument.channels)(bytes)?;
        let channels = all.iter().filter(|it| it.is_height).map(|it| it.name.clone()).collect();
        Self::new(instrument.name, channels, choose(all, channel)?)
    }

    /// Shape and spacing of what [`Measurement::read`] reads, of most formats by their header alone.
    ///
    /// # Errors
    /// The errors of [`Measurement::read`].
    pub fn read_layout(path: impl AsRef<Path>, channel: Option<&str>) -> Result<Layout, FileError> {
        let path = path.as_ref();
        if is_array(path) {
            return match *read_shape(path)? {
                [ny, nx] => Ok(Layout::map([ny, nx])),
                _ => Ok(Self::read(path, channel)?.layout()),
            };
        }
        let bytes = bytes(path)?;
        let layout = || Ok(Layout::of(&choose((instrument(&bytes)?.channels)(&bytes)?, channel)?)?.0);
        layout().map_err(|error| super::explained(path, "height", error))
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
        let (layout, positions) = Layout::of(&channel)?;
        let Channel { name, unit, header, values, .. } = channel;
        let Layout { shape, is_profile, spacing, is_in_metres, is_even } = layout;
        let values = values()?;
        let found = values.len();
        let height = Field::from_shape_vec(shape, values).map_err(|_| {
            malformed(format!("it holds {found} heights, which are not {} rows of {}", shape[0], shape[1]))
        })?;
        let unit = unit.filter(|_| is_in_metres).unwrap_or(1.0);
        let height = height.mapv_into(|h| if h.is_finite() { h * unit } else { f64::NAN });
        let height = match &positions {
            Some(positions) => height.select(Axis(1), &positions.order),
            None => height,
        };
        let positions = positions.filter(|_| !is_even).map(|it| it.x);
        Ok(Self { format, channels, channel: name, height, is_profile, spacing, positions, is_in_metres, header })
    }
}

/// All bytes of a file.
fn bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    let mut bytes = Vec::new();
    let read = open(path).and_then(|mut file| file.read_to_end(&mut bytes));
    read.map(|_| bytes).map_err(|error| super::explained(path, "height", error))
}

/// The format of the bytes of a file.
fn instrument(bytes: &[u8]) -> io::Result<&'static Instrument> {
    let found = INSTRUMENTS.iter().find(|it| (it.is_it)(bytes));
    found.ok_or_else(|| malformed("it is in no format that is known here"))
}

/// Whether a file is a NumPy array or an archive of such.
fn is_array(path: &Path) -> bool {
    open(path).is_ok_and(|mut file| npz::holds_arrays(&mut file) || npy::is_array(&mut file))
}
