//! The DATX files of Zygo Mx.

use super::channel::{Channel, listed};
use super::format::malformed;
use super::hdf5::{ArraysBeside, arrays, channel};
use super::hdf5_file::{AttributeValue, HdfFile, MAGIC, NumberArray};
use super::instrument::Instrument;
use super::unit::metres;
use std::io;

/// A file of HDF5. The rows (Source, Link, Destination) of its dataset `MetaData` lead from `Root` by `Measurement` and `Surface` to the `Path` of
/// the heights; in other files these are `Measurement/Surface` or the datasets in `Data/Surface`. Attributes of theirs:
/// - `X Converter`, `Y Converter`: category (`LateralCat`), unit (`Pixels`) and parameters, of which the second is the distance in metres;
/// - `Z Converter`: category (`HeightCat`), unit, parameters; and `Unit`, the same unit, a length such as `NanoMeters` or `Fringes`;
/// - `Interferometric Scale Factor` S, `Wavelength` W in metres and `Obliquity Factor` O, or else the second, third and fourth parameter of the
///   `Z Converter`: a fringe is S W O metres;
/// - `No Data`: the value of void points.
///
/// Rows are kept in the order of the file. Other arrays, such as those in `Data/Intensity`, are no heights.
///
/// # Source
/// `read_zygo_datx` in `io.py` of prysm for fringes, of which prysm turns the rows upside down; `DATX.py` of SurfaceTopography 1.27 for the
/// converters and `MetaData`. That the parameters of the `Z Converter` are S, W and O is what files show, not published.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Zygo Mx (DATX)", is_it, channels };

/// The attribute that every file has, as text.
const HEIGHTS: &[u8] = b"Z Converter";
/// The dataset of links.
const LINKS: &str = "MetaData";
/// Where heights are if no links lead to them.
const PLACES: [&str; 2] = ["Measurement/Surface", "Data/Surface/"];
/// The unit of heights that are counted in fringes.
const FRINGES: &str = "Fringes";

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC) && bytes.windows(HEIGHTS.len()).any(|it| it == HEIGHTS)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let file = HdfFile::new(bytes)?;
    let (mut found, linked) = (arrays(&file)?, linked(&file)?);
    let is_linked = |path: &str| linked.iter().any(|it| it.trim_matches('/') == path);
    let has_links = found.iter().any(|it| is_linked(&it.0));
    let is_surface = |path: &str| match has_links {
        true => is_linked(path),
        false => PLACES.iter().any(|place| path.starts_with(place)),
    };
    found.sort_by_key(|(path, _)| !is_surface(path));
    let mut all: Vec<(String, io::Result<Channel>)> = Vec::new();
    for (path, array) in found {
        if is_surface(&path) {
            let name = if all.is_empty() { "Surface".to_owned() } else { format!("Surface ({})", all.len() + 1) };
            all.push((name.clone(), array.and_then(|it| surface(&it, name))));
        } else {
            all.push((path, array.and_then(|it| other(&it))));
        }
    }
    if !all.iter().any(|it| it.0 == "Surface") {
        return Err(malformed("it is a .datx file without a surface"));
    }
    listed(all)
}

/// The paths of all surfaces to which links lead.
fn linked(file: &HdfFile) -> io::Result<Vec<String>> {
    let links = file.datasets()?.into_iter().find(|it| it.0 == LINKS);
    let Some((_, Ok(links))) = links else { return Ok(Vec::new()) };
    let rows = HdfFile::records(&links)?;
    let mut places = vec!["Root".to_owned()];
    for link in ["Measurement", "Surface", "Path"] {
        let is_next =
            |row: &&AttributeValue| matches!(&row.texts[..], [from, name, _] if places.contains(from) && name == link);
        places = rows.iter().filter(is_next).map(|row| row.texts[2].clone()).collect();
    }
    Ok(places)
}

/// The channel of what is no surface.
fn other(array: &NumberArray) -> io::Result<Channel<'static>> {
    Ok(Channel { is_height: false, ..channel(array, &ArraysBeside::default())? })
}

/// The channel of a surface.
fn surface(array: &NumberArray, name: String) -> io::Result<Channel<'static>> {
    let converter = array.attribute("Z Converter");
    let category = converter.map_or("HeightCat", |it| it.text());
    let units =
        [converter.and_then(|it| it.texts.get(1)).map(String::as_str), array.attribute("Unit").map(|it| it.text())];
    let unit = match units {
        [Some(one), Some(other)] if one != other => {
            return Err(malformed(format!("its heights are in {one:?} and in {other:?}")));
        }
        [one, other] => one.or(other).unwrap_or_default(),
    };
    let unit = if unit == FRINGES { Some(fringe(array, converter)?) } else { length(unit) };
    let [x, y] = ["X Converter", "Y Converter"].map(|name| distance(array.attribute(name)));
    Ok(Channel {
        name,
        is_height: category == "HeightCat" && unit.is_some(),
        spacing: y.zip(x).map(|(y, x)| [y, x]),
        lateral_unit: Some(1.0),
        unit,
        ..channel(array, &ArraysBeside::default())?
    })
}

/// Metres in a unit as Mx writes it, such as `MicroMeters`.
fn length(unit: &str) -> Option<f64> {
    let unit = unit.to_lowercase();
    metres(unit.strip_suffix('s').unwrap_or(&unit))
}

/// Metres in a fringe.
fn fringe(array: &NumberArray, converter: Option<&AttributeValue>) -> io::Result<f64> {
    let parameter = |name: &str, place: usize| array.number(name).or(converter?.numbers.get(place).copied());
    let scale = parameter("Interferometric Scale Factor", 1);
    let wavelength = parameter("Wavelength", 2);
    let obliquity = parameter("Obliquity Factor", 3).unwrap_or(1.0);
    match scale.zip(wavelength).map(|(scale, wavelength)| scale * wavelength * obliquity) {
        Some(fringe) if fringe.is_finite() && fringe != 0.0 => Ok(fringe),
        Some(fringe) => Err(malformed(format!("it states that a fringe is {fringe:?} metres"))),
        None => Err(malformed("its heights are in fringes, but it has no wavelength")),
    }
}

/// The distance of points that a converter of pixels states.
fn distance(converter: Option<&AttributeValue>) -> Option<f64> {
    let converter = converter?;
    let is_lateral = matches!(&converter.texts[..], [category, unit] if category == "LateralCat" && unit == "Pixels");
    converter.numbers.get(1).copied().filter(|_| is_lateral)
}
