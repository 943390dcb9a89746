//! Heights in the classic formats of NetCDF.

use super::cdf::{File, ValueType, Variable};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use super::unit::{lateral, metres, ratio};
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
/// Relative deviation of coordinates that are called evenly spaced.
const TOLERANCE: f64 = 1e-4;

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
        let [rows, columns] = self.data(variable)?.0;
        let is_profile = variable.dimensions.len() == 1;
        let is_turned = self.names(variable) == ["x", "y"];
        let [y, x] = if is_turned || is_profile { [1, 0] } else { [0, 1] }.map(|place| self.axis(variable, place));
        let [y, x] = [y?, x?];
        if !is_profile && (x.uneven.is_some() || y.uneven.is_some()) {
            return Err(malformed("its map has coordinates that are not evenly spaced"));
        }
        let [ny, nx] = if is_turned { [columns, rows] } else { [rows, columns] };
        let (number, is_back) = (self.numbers(variable)?, [y.is_back(), x.is_back()]);
        let place = move |i: usize| {
            let [iy, ix] = [i / nx, i % nx];
            let [iy, ix] = [if is_back[0] { ny - 1 - iy } else { iy }, if is_back[1] { nx - 1 - ix } else { ix }];
            if is_turned { ix * ny + iy } else { iy * nx + ix }
        };
        let values = move || Ok((0..ny * nx).map(|i| number(place(i))).collect());
        let across = if is_profile { x.step } else { y.step.map(|it| it * ratio(y.unit, x.unit)) };
        let along = if is_profile { x.unit } else { lateral(y.unit, x.unit) };
        let unit = variable.unit();
        Ok(Channel {
            is_height: unit.is_empty() || metres(unit).is_some(),
            is_profile,
            spacing: across.zip(x.step).map(|(y, x)| [y.abs(), x.abs()]),
            positions: x.uneven.filter(|_| is_profile),
            lateral_unit: along,
            unit: metres(unit).or(along.filter(|_| unit.is_empty() && variable.name == HEIGHTS)),
            header: self.header(variable),
            ..Channel::map(&variable.name, [ny, nx], values)
        })
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
        let axis = AxisCoordinates { unit: metres(coordinates.unit()), ..AxisCoordinates::default() };
        if let Some(length) = coordinates.number("length") {
            if length.is_nan() || length <= 0.0 {
                return Err(malformed(format!("its {:?} has the length {length:?}", coordinates.name)));
            }
            return Ok(AxisCoordinates { step: Some(length / count as f64), ..axis });
        }
        let value = coordinates.values();
        let positions: Vec<f64> = (0..count).map(|i| value(data, i).unwrap_or(f64::NAN)).collect();
        Ok(match step(&positions) {
            Some(step) => AxisCoordinates { step: Some(step), ..axis },
            None if count > 1 => AxisCoordinates { uneven: Some(positions), ..axis },
            None => axis,
        })
    }

    /// The attributes of the file and of a variable.
    fn header(&self, variable: &Variable) -> Vec<(String, String)> {
        let attributes = self.attributes.iter().chain(&variable.attributes);
        attributes.map(|it| (it.name.clone(), it.text.clone())).collect()
    }
}

/// The distance of positions that are evenly spaced, at least two.
fn step(positions: &[f64]) -> Option<f64> {
    let (first, last) = (positions.first()?, positions.last()?);
    let step = (last - first) / (positions.len() as f64 - 1.0);
    let is_even = |(i, x): (usize, &f64)| (x - first - step * i as f64).abs() <= TOLERANCE * step.abs();
    positions.iter().enumerate().all(is_even).then_some(step)
}

/// An axis of a map or a profile.
#[derive(Default)]
struct AxisCoordinates {
    /// The distance of points that are evenly spaced, negative where coordinates fall.
    step: Option<f64>,
    /// Metres in its unit.
    unit: Option<f64>,
    /// Coordinates that are not evenly spaced.
    uneven: Option<Vec<f64>>,
}

impl AxisCoordinates {
    /// Whether its coordinates fall from point to point.
    fn is_back(&self) -> bool {
        self.step.is_some_and(|step| step < 0.0)
    }
}
