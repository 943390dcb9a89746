//! Heights as measured by an instrument.

use super::channel::{Channel, choose};
use super::format::EMPTY;
use super::format::{ReadSeek, malformed};
use super::instrument::Instrument;
use super::layout::{FileUnits, Layout, doubt_of_spacing};
use super::limits::check_points;
use super::scan::overflowing;
use super::{HEIGHTS, INSTRUMENTS, npy, npz, profile_of, shape_of};
use crate::error::FileError;
use crate::files::{open_regular, read_whole};
use crate::warning::Warning;
use ndarray::{Array2, Axis};
use std::io::{self, Cursor};
use std::path::Path;

/// The heights in a file of an instrument, without any preparation.
///
/// Lengths in units that the file states are converted to metres, and `is_in_metres` is true if all are. The numbers of lengths
/// without a unit are kept: `units` says which these are. The first row of `height` is that at `y = 0`.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// The format, such as "ISO 25178-71 (SDF)".
    pub format: &'static str,
    /// The names of all channels of heights in the file.
    pub channels: Vec<String>,
    /// The one that was read.
    pub channel: String,
    /// The names of the channels that cannot be read, and why.
    pub unreadable: Vec<(String, String)>,
    /// Heights, shape `(ny, nx)` (a profile has one row); NaN if not measured.
    pub height: Array2<f64>,
    /// Whether it is a profile, not a map of one row.
    pub is_profile: bool,
    /// Spacing along y and x (the mean for uneven positions); none if the file has none.
    pub spacing: Option<[f64; 2]>,
    /// Positions along x of a profile that is not evenly spaced.
    pub positions: Option<Vec<f64>>,
    /// Whether all lengths that the file has are in metres: heights, and distances if it has some.
    pub is_in_metres: bool,
    /// The units that the file states.
    pub units: FileUnits,
    /// Other metadata: names and values.
    pub header: Vec<(String, String)>,
    /// Inconsistencies in the file, such as a wrong count of points.
    pub warnings: Vec<Warning>,
}

impl Measurement {
    /// Reads a file. Its format is recognised from the content. If there are several channels, `channel` is a name or a
    /// number (1, 2, ...); the default is the first channel of heights.
    ///
    /// # Errors
    /// [`FileError::Read`] for a file that is missing or unreadable; [`FileError::Format`] with the reason for one of no known format,
    /// one that is cut short or contradicts itself, and a channel that is not there.
    pub fn read(path: impl AsRef<Path>, channel: Option<&str>) -> Result<Self, FileError> {
        let path = path.as_ref();
        let read = || {
            let mut file = open_regular(path)?;
            if is_array(&mut file) {
                Self::from_arrays(&mut file, channel)
            } else {
                Self::from_instrument(&read_whole(&mut file)?, channel)
            }
        };
        read().map_err(|error| super::explained(path, "height", error))
    }

    /// Reads the bytes of a file like [`Measurement::read`].
    ///
    /// # Errors
    /// Of the kind [`io::ErrorKind::InvalidData`], with what is wrong with them.
    pub fn from_bytes(bytes: &[u8], channel: Option<&str>) -> io::Result<Self> {
        let mut source = Cursor::new(bytes);
        if is_array(&mut source) {
            Self::from_arrays(&mut source, channel)
        } else {
            Self::from_instrument(bytes, channel)
        }
    }

    /// Shape and spacing of the heights that [`Measurement::read`] reads. For most formats only the header is read.
    ///
    /// # Errors
    /// The errors of [`Measurement::read`].
    pub fn read_layout(path: impl AsRef<Path>, channel: Option<&str>) -> Result<Layout, FileError> {
        let path = path.as_ref();
        let read = || {
            let mut file = open_regular(path)?;
            if is_array(&mut file) {
                layout_of_arrays(&mut file, channel)
            } else {
                layout_of_instrument(&read_whole(&mut file)?, channel)
            }
        };
        read().map_err(|error| super::explained(path, "height", error))
    }

    /// Shape and spacing of what [`Measurement::from_bytes`] reads.
    ///
    /// # Errors
    /// The errors of [`Measurement::from_bytes`].
    pub(super) fn layout_of(bytes: &[u8], channel: Option<&str>) -> io::Result<Layout> {
        let mut source = Cursor::new(bytes);
        if is_array(&mut source) {
            layout_of_arrays(&mut source, channel)
        } else {
            layout_of_instrument(bytes, channel)
        }
    }

    /// The measurement in a file of an instrument.
    fn from_instrument(bytes: &[u8], channel: Option<&str>) -> io::Result<Self> {
        let instrument = instrument(bytes)?;
        let all = (instrument.channels)(bytes)?;
        let channels = all.iter().filter(|it| it.is_height).map(|it| it.name.clone()).collect();
        let unreadable = all.iter().filter_map(|it| Some((it.name.clone(), it.fault.clone()?))).collect();
        Ok(Self { unreadable, ..Self::new(instrument.name, channels, choose(all, channel)?)? })
    }

    /// The heights of an array of a file, and the positions beside them if there are any.
    fn from_arrays(source: &mut dyn ReadSeek, channel: Option<&str>) -> io::Result<Self> {
        let (channels, name) = array_names(source, channel)?;
        check_points(&shape_of(source, &name)?)?;
        let (array, positions) = profile_of(source, &name)?;
        let is_profile = array.ndim() == 1;
        let array = if is_profile { array.insert_axis(Axis(0)) } else { array };
        let height: Array2<f64> = array.into_dimensionality().map_err(|error| malformed(error.to_string()))?;
        let shape = height.dim().into();
        let values = move || Ok(height.into_iter().collect());
        let positions = positions.map(|it| it.to_vec());
        let channel = Channel { is_profile, positions, ..Channel::map(name, shape, values) };
        Self::new("NumPy", channels, channel)
    }

    /// Shape and spacing.
    pub fn layout(&self) -> Layout {
        let &Self { is_profile, spacing, is_in_metres, units, .. } = self;
        let (shape, is_even) = (self.height.dim().into(), self.positions.is_none());
        Layout { shape, is_profile, spacing, is_in_metres, units, is_even }
    }

    /// Positions of the columns along x, the first one at 0, where the file says them.
    pub fn x(&self) -> Option<Vec<f64>> {
        let even = |[_, dx]: [f64; 2]| (0..self.height.ncols()).map(|i| i as f64 * dx).collect();
        self.positions.clone().or_else(|| self.spacing.map(even))
    }

    /// The measurement in a channel.
    fn new(format: &'static str, channels: Vec<String>, channel: Channel) -> io::Result<Self> {
        let (layout, positions) = Layout::from_channel(&channel)?;
        let doubt = doubt_of_spacing(&channel);
        let Channel { name, header, doubts, values, .. } = channel;
        let Layout { shape, is_profile, spacing, is_in_metres, units, is_even } = layout;
        let values = values()?;
        let found = values.len();
        let height = Array2::from_shape_vec(shape, values).map_err(|_| {
            malformed(format!("it contains {found} heights, but {} rows of {} are needed", shape[0], shape[1]))
        })?;
        let unit = units.height.unwrap_or(1.0);
        let height = height.mapv_into(|h| if h.is_finite() { h * unit } else { f64::NAN });
        if let Some([least, most]) = overflowing(height.iter().copied().filter(|h| !h.is_nan())) {
            return Err(malformed(format!(
                "its heights lie between {least:?} and {most:?}, and differences of so large numbers overflow: give them in a larger unit"
            )));
        }
        let height = match &positions {
            Some(positions) if positions.is_reversed => reversed(height),
            _ => height,
        };
        let positions = positions.filter(|_| !is_even).map(|it| it.x);
        let advice =
            "The file may be damaged or incomplete: compare the shape and the heights with those of the instrument";
        let doubts = doubts.into_iter().chain(doubt);
        let warnings = doubts.map(|doubt| Warning::new(format!("In the file, {doubt}"), advice)).collect();
        Ok(Self {
            format,
            channels,
            channel: name,
            unreadable: Vec::new(),
            height,
            is_profile,
            spacing,
            positions,
            is_in_metres,
            units,
            header,
            warnings,
        })
    }
}

/// Heights with the last column first.
fn reversed(mut height: Array2<f64>) -> Array2<f64> {
    height.invert_axis(Axis(1));
    height.as_standard_layout().into_owned()
}

/// The format of the bytes of a file.
fn instrument(bytes: &[u8]) -> io::Result<&'static Instrument> {
    if bytes.is_empty() {
        return Err(malformed(EMPTY));
    }
    let found = INSTRUMENTS.iter().find(|it| (it.is_it)(bytes));
    found.ok_or_else(|| malformed("its format is not known"))
}

/// Whether a file is a NumPy array or an archive of such.
fn is_array(source: &mut dyn ReadSeek) -> bool {
    npz::holds_arrays(source) || npy::is_array(source)
}

fn layout_of_arrays(source: &mut dyn ReadSeek, channel: Option<&str>) -> io::Result<Layout> {
    let (_, name) = array_names(source, channel)?;
    let shape = shape_of(source, &name)?;
    check_points(&shape)?;
    match *shape {
        [ny, nx] => Ok(Layout::map([ny, nx])),
        _ => Ok(Measurement::from_arrays(source, channel)?.layout()),
    }
}

/// The names of the arrays to choose from, and of the one that is chosen by its name or its number from 1 on; by default `height`, or the
/// only one of an archive.
fn array_names(source: &mut dyn ReadSeek, channel: Option<&str>) -> io::Result<(Vec<String>, String)> {
    if !npz::is_archive(source) {
        return match channel {
            Some(name) if ![HEIGHTS.name, "1"].contains(&name) => {
                Err(malformed(format!("it is a single array, without a channel {name:?}: leave the channel out")))
            }
            _ => Ok((vec![HEIGHTS.name.into()], HEIGHTS.name.into())),
        };
    }
    let names = npz::names(source)?;
    let has = |name: &str| names.iter().any(|it| it == name);
    let by_number = |number: usize| number.checked_sub(1).and_then(|i| names.get(i)).cloned();
    let chosen = match channel {
        Some(name) if has(name) => Some(name.to_owned()),
        Some(name) => name.parse().ok().and_then(by_number),
        None if has(HEIGHTS.name) => return Ok((vec![HEIGHTS.name.into()], HEIGHTS.name.into())),
        None => names.first().filter(|_| names.len() == 1).cloned(),
    };
    let missing = || {
        let name = channel.unwrap_or(HEIGHTS.name);
        malformed(format!(
            "it is an archive without the array {name:?}: choose one of its channels {}",
            names.join(", ")
        ))
    };
    let chosen = chosen.ok_or_else(missing)?;
    Ok((names, chosen))
}

fn layout_of_instrument(bytes: &[u8], channel: Option<&str>) -> io::Result<Layout> {
    Ok(Layout::from_channel(&choose((instrument(bytes)?.channels)(bytes)?, channel)?)?.0)
}
