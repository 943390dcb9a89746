//! Arrays in files of HDF5, and those of NetCDF-4 with their coordinates.

use super::cdf::FILL;
use super::channel::{Channel, listed};
use super::coordinates::{AxisCoordinates, GridAxes};
use super::format::malformed;
use super::hdf5_file::{HdfFile, MAGIC, NumberArray};
use super::instrument::Instrument;
use super::limits::check_channels;
use super::unit::metres;
use std::io;

/// Each array of integers or of single or double precision along two axes is a map, row by row, and each along one axis is a profile; axes of
/// one point do not count. Its name is its path. The attribute `unit`, `units` or `Unit` is the unit of its values; without one they are taken
/// for heights without a unit. Values of the attributes `_FillValue`, `missing_value` and `No Data` are void; `scale_factor` and `add_offset`
/// turn numbers into values. Maps are listed before profiles, and arrays of a length before those without a unit.
///
/// Distances follow from dimension scales, as NetCDF-4 and h5py write them: arrays of coordinates along one axis to which the attribute
/// `DIMENSION_LIST` refers, or whose attribute `length` is the length of the axis. Maps along x and y in this order are turned. As in
/// [`netcdf`](super::netcdf), points at which an array `mask` of the same axes is not zero are void, and so is what NetCDF fills in where
/// nothing is written. Without scales there are no distances.
///
/// # Source
/// "HDF5 Dimension Scale Specification" (The HDF Group), "NetCDF-4 File Format" (Unidata) and the "NetCDF Climate and Forecast Metadata
/// Conventions". Of `.h5-jpk`, whose layout JPK has not published, arrays are listed as those of any other file.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "HDF5 (NetCDF-4)", is_it, channels };

/// Names in files of NetCDF-4.
const OF_NETCDF4: [&[u8]; 3] = [b"_NCProperties", b"_Netcdf4Dimid", b"_Netcdf4Coordinates"];
/// Names of the attribute of a unit.
const UNITS: [&str; 3] = ["unit", "units", "Unit"];
/// Names of the attribute of a value that marks void points.
const VOIDS: [&str; 3] = ["_FillValue", "missing_value", "No Data"];
/// The array of heights in files of contact.engineering.
const HEIGHTS: &str = "heights";
/// The array that marks void points.
const MASK: &str = "mask";
/// The begin of the attribute `NAME` of a dimension without coordinates.
const NO_COORDINATES: &str = "This is a netCDF dimension but not a netCDF variable";

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let is_netcdf = OF_NETCDF4.iter().any(|name| bytes.windows(name.len()).any(|part| part == *name));
    let mut beside = ArraysBeside { void: is_netcdf.then_some(FILL), ..ArraysBeside::default() };
    let mut found = Vec::new();
    for (path, array) in arrays(&HdfFile::new(bytes)?)? {
        match array {
            Ok(scale) if scale.text("CLASS") == "DIMENSION_SCALE" => beside.scales.push(scale),
            Ok(mask) if mask.name() == MASK => beside.masks.push(mask),
            other => found.push((path, other)),
        }
    }
    if found.is_empty() {
        return Err(malformed("it is an HDF5 file without an array of numbers along one or two axes"));
    }
    found.sort_by_key(|(_, array)| {
        let array = array.as_ref().ok();
        array.map(|it| (it.name() != HEIGHTS, it.is_profile(), metres(unit(it)).is_none()))
    });
    listed(found.into_iter().map(|(path, array)| (path, array.and_then(|it| channel(&it, &beside)))).collect())
}

/// All arrays of numbers by their paths, and what is wrong with those that cannot be read.
///
/// # Errors
/// For more arrays than are read.
pub(super) fn arrays(file: &HdfFile) -> io::Result<Vec<(String, io::Result<NumberArray>)>> {
    let mut found = Vec::new();
    for (path, dataset) in file.datasets()? {
        let array = dataset.and_then(|it| file.array(&path, it)).transpose();
        found.extend(array.map(|it| (path, it)));
    }
    check_channels(found.len())?;
    Ok(found)
}

/// The arrays beside heights that say where these are, and which of them are void.
#[derive(Default)]
pub(super) struct ArraysBeside {
    scales: Vec<NumberArray>,
    masks: Vec<NumberArray>,
    /// The number that stands where nothing was written.
    void: Option<f64>,
}

impl ArraysBeside {
    /// The axes of an array.
    fn axes(&self, array: &NumberArray) -> io::Result<GridAxes> {
        let mut axes = [AxisCoordinates::default(), AxisCoordinates::default()];
        let mut names = Vec::new();
        let (addresses, is_profile) = (array.coordinates().unwrap_or_default(), array.is_profile());
        for (place, address) in addresses.into_iter().enumerate() {
            let place = place + usize::from(is_profile);
            if let Some(scale) = self.scales.iter().find(|it| it.address() == address) {
                names.push(scale.name());
                axes[place] = axis(scale, array.shape[place])?;
            }
        }
        GridAxes::new(axes, is_profile, names == ["x", "y"])
    }

    /// The mask of an array.
    fn mask(&self, array: &NumberArray) -> Option<&NumberArray> {
        let is_of = |mask: &&NumberArray| mask.shape == array.shape && mask.coordinates() == array.coordinates();
        self.masks.iter().find(is_of)
    }
}

/// The coordinates that a scale states, for a number of points.
fn axis(scale: &NumberArray, count: usize) -> io::Result<AxisCoordinates> {
    if scale.text("NAME").starts_with(NO_COORDINATES) {
        return Ok(AxisCoordinates::default());
    }
    let positions = values(scale, None)()?;
    if positions.len() != count {
        let (name, found) = (scale.name(), positions.len());
        return Err(malformed(format!("its axis {name:?} has {found} coordinates for {count} points")));
    }
    AxisCoordinates::new(scale.name(), positions, metres(unit(scale)), scale.number("length"))
}

/// The unit of an array, empty if it has none.
fn unit(array: &NumberArray) -> &str {
    UNITS.iter().map(|name| array.text(name)).find(|unit| !unit.is_empty()).unwrap_or_default()
}

/// A function that reads the values of an array, NaN where they are void.
fn values(array: &NumberArray, void: Option<f64>) -> impl FnOnce() -> io::Result<Vec<f64>> + use<> {
    let [scale, offset] = [array.number("scale_factor").unwrap_or(1.0), array.number("add_offset").unwrap_or(0.0)];
    let numbers = array.values(&VOIDS, void);
    move || Ok(numbers()?.into_iter().map(|number| scale * number + offset).collect())
}

/// The channel of an array.
///
/// # Errors
/// For a map whose coordinates are not evenly spaced, and for coordinates that cannot be read.
pub(super) fn channel(array: &NumberArray, beside: &ArraysBeside) -> io::Result<Channel<'static>> {
    let axes = beside.axes(array)?;
    let (unit, along, places) = (unit(array), axes.unit(), axes.places(array.shape));
    let (values, mask) = (values(array, beside.void), beside.mask(array).map(|it| it.values(&[], None)));
    let values = move || {
        let mut values = values()?;
        if let Some(mask) = mask {
            let is_masked = mask()?;
            values.iter_mut().zip(is_masked).filter(|(_, mask)| *mask != 0.0).for_each(|(value, _)| *value = f64::NAN);
        }
        Ok(places.map(|place| values[place]).collect())
    };
    let map = Channel::map(&array.path, axes.shape(array.shape), values);
    Ok(axes.spaced(Channel {
        is_height: unit.is_empty() || metres(unit).is_some(),
        is_profile: array.is_profile(),
        unit: metres(unit).or(along.filter(|_| unit.is_empty() && array.name() == HEIGHTS)),
        header: array.header(),
        ..map
    }))
}
