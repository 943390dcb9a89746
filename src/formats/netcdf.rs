//! Heights in the classic formats of NetCDF.

use super::cdf::{File, ValueType, Variable};
use super::channel::Channel;
use super::coordinates::{AxisCoordinates, GridAxes};
use super::instrument::Instrument;
use super::unit::metres;
use std::io;

/// A header of dimensions, attributes and variables, and the values of each variable at a place that the header says, the most significant
/// byte first; counts of 4 bytes, in CDF-5 of 8. Variables of numbers along two dimensions are maps, row by row, or column by column if
/// their dimensions are x and y; those along one that are not its coordinates are profiles. Distances follow from the attribute `length` of
/// the coordinates or else from their values, units from the attributes `unit` or `units`. Void are the values `_FillValue` and
/// `missing_value`, what is filled in where nothing is written, and points at which the variable `mask` is not zero; `scale_factor` and
/// `add_offset` turn numbers into values.
///
/// # Source
/// "NetCDF Classic Format Specification" (Unidata), and the layout that contact.engineering describes for the files that it writes. Variables
/// along an unlimited dimension are refused; NetCDF-4 is another format.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "NetCDF (classic)", is_it, channels };

/// The variable of heights in files of contact.engineering.
const HEIGHTS: &str = "heights";
/// The variable that marks void points.
const MASK: &str = "mask";

fn is_it(bytes: &[u8]) -> bool {
    [1, 2, 5].iter().any(|version| bytes.starts_with(&[b'C', b'D', b'F', *version]))
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let file = File::new(bytes)?;
    let mut candidates: Vec<_> = file.variables.iter().filter(|it| file.may_be_heights(it)).collect();
    candidates.sort_by_key(|it| (it.name != HEIGHTS, it.dimensions.len() == 1));
    Ok(candidates.into_iter().map(|it| Channel::or_unreadable(&it.name, file.channel(it))).collect())
}

impl<'a> File<'a> {
    /// Whether a variable holds numbers along one or two dimensions that are not coordinates or marks.
    fn may_be_heights(&self, variable: &Variable) -> bool {
        let name = variable.name.as_str();
        let is_coordinate = ["x", "y", MASK].contains(&name) || self.names(variable).contains(&name);
        (1..=2).contains(&variable.dimensions.len()) && variable.kind != ValueType::Text && !is_coordinate
    }

    /// The variable with the coordinates along a dimension.
    fn coordinates(&self, dimension: &str, along: u64) -> Option<&Variable> {
        let named = |name: &str| self.variables.iter().find(|it| it.name == name && it.dimensions == [along]);
        named(dimension).or_else(|| named("x"))
    }

    /// The channel of a variable.
    fn channel(&self, variable: &Variable) -> io::Result<Channel<'a>> {
        let in_file = self.data(variable)?.0;
        let is_profile = variable.dimensions.len() == 1;
        let axes = match is_profile {
            true => [AxisCoordinates::default(), self.axis(variable, 0)?],
            false => [self.axis(variable, 0)?, self.axis(variable, 1)?],
        };
        let axes = GridAxes::new(axes, is_profile, self.names(variable) == ["x", "y"])?;
        let (number, places) = (self.numbers(variable)?, axes.places(in_file));
        let (unit, along) = (variable.unit(), axes.unit());
        let map = Channel::map(&variable.name, axes.shape(in_file), move || Ok(places.map(number).collect()));
        Ok(axes.spaced(Channel {
            is_height: unit.is_empty() || metres(unit).is_some(),
            is_profile,
            unit: metres(unit).or(along.filter(|_| unit.is_empty() && variable.name == HEIGHTS)),
            header: self.header(variable),
            ..map
        }))
    }

    /// The values of a variable by their places, NaN where they are void or masked.
    fn numbers(&self, variable: &Variable) -> io::Result<impl Fn(usize) -> f64 + use<'a>> {
        let (_, data) = self.data(variable)?;
        let mask = self.variables.iter().find(|it| it.name == MASK && it.dimensions == variable.dimensions);
        let mask = mask.map(|it| Ok::<_, io::Error>((it.kind, self.data(it)?.1))).transpose()?;
        let value = variable.values();
        let is_masked = move |i| mask.is_some_and(|(kind, mask)| kind.at(mask, i) != 0.0);
        Ok(move |i| value(data, i).filter(|_| !is_masked(i)).unwrap_or(f64::NAN))
    }

    /// What the file says of the axis at a place among a variable's dimensions.
    fn axis(&self, variable: &Variable, place: usize) -> io::Result<AxisCoordinates> {
        let name = self.names(variable).get(place).copied();
        let along = name.zip(variable.dimensions.get(place));
        let Some(coordinates) = along.and_then(|(name, along)| self.coordinates(name, *along)) else {
            return Ok(AxisCoordinates::default());
        };
        let ([_, count], data) = self.data(coordinates)?;
        let value = coordinates.values();
        let positions = (0..count).map(|i| value(data, i).unwrap_or(f64::NAN)).collect();
        AxisCoordinates::new(&coordinates.name, positions, metres(coordinates.unit()), coordinates.number("length"))
    }

    /// The attributes of the file and of a variable.
    fn header(&self, variable: &Variable) -> Vec<(String, String)> {
        let attributes = self.attributes.iter().chain(&variable.attributes);
        attributes.map(|it| (it.name.clone(), it.text.clone())).collect()
    }
}
