//! Plain arrays in files of HDF5.

use super::channel::{Channel, listed};
use super::format::malformed;
use super::hdf5_file::{File, MAGIC, NumberArray};
use super::instrument::Instrument;
use super::limits::check_channels;
use super::unit::metres;
use std::io;

/// Each array of integers or of single or double precision along two axes is a map, row by row, and each along one axis is a profile; axes of
/// one point do not count. Its name is its path. The attribute `unit`, `units` or `Unit` is the unit of its values; without one they are taken
/// for heights without a unit. Values of the attributes `_FillValue`, `missing_value` and `No Data` are void; `scale_factor` and `add_offset`
/// turn numbers into values. The file does not say distances in any way that all programs agree on. Maps are listed before profiles.
///
/// # Source
/// Names of attributes follow the "NetCDF Climate and Forecast Metadata Conventions" and what h5py users write. Files of NetCDF-4, whose
/// coordinates would be lost, are refused. Of `.h5-jpk`, whose layout JPK has not published, arrays are listed as those of any other file.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "HDF5", is_it, channels };

/// Names in files of NetCDF-4.
const OF_NETCDF4: [&[u8]; 3] = [b"_NCProperties", b"_Netcdf4Dimid", b"_Netcdf4Coordinates"];
/// Names of the attribute of a unit.
const UNITS: [&str; 3] = ["unit", "units", "Unit"];
/// Names of the attribute of a value that marks void points.
const VOIDS: [&str; 3] = ["_FillValue", "missing_value", "No Data"];

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let is_netcdf = OF_NETCDF4.iter().any(|name| bytes.windows(name.len()).any(|part| part == *name));
    if is_netcdf {
        return Err(malformed("it is a NetCDF-4 file: convert it with `nccopy -k classic OLD.nc NEW.nc`"));
    }
    let mut found = arrays(&File::new(bytes)?)?;
    if found.is_empty() {
        return Err(malformed("it is an HDF5 file without an array of numbers along one or two axes"));
    }
    found.sort_by_key(|(_, array)| array.as_ref().is_ok_and(|it| it.is_profile));
    listed(found.into_iter().map(|(path, array)| (path, array.map(|it| channel(&it)))).collect())
}

/// All arrays of numbers by their paths, and what is wrong with those that cannot be read.
///
/// # Errors
/// For more arrays than are read.
pub(super) fn arrays(file: &File) -> io::Result<Vec<(String, io::Result<NumberArray>)>> {
    let mut found = Vec::new();
    for (path, dataset) in file.datasets()? {
        let array = dataset.and_then(|it| file.array(&path, it)).transpose();
        found.extend(array.map(|it| (path, it)));
    }
    check_channels(found.len())?;
    Ok(found)
}

/// The channel of an array.
pub(super) fn channel(array: &NumberArray) -> Channel<'static> {
    let unit = UNITS.iter().find_map(|name| array.attribute(name)).map_or("", |it| it.text());
    let [scale, offset] =
        [("scale_factor", 1.0), ("add_offset", 0.0)].map(|(name, none)| array.number(name).unwrap_or(none));
    let numbers = array.values(&VOIDS);
    let values = move || Ok(numbers()?.into_iter().map(|number| scale * number + offset).collect());
    Channel {
        is_height: unit.is_empty() || metres(unit).is_some(),
        is_profile: array.is_profile,
        unit: metres(unit),
        header: array.header(),
        ..Channel::map(&array.path, array.shape, values)
    }
}
