//! Units of the numbers in the titles, tables and charts of a recording.

use crate::contact::{Load, Unit};
use crate::quantity::number_in_words;
use crate::setup::Record;

const METRE: &str = "m";
const PASCAL: &str = "Pa";
const ENERGY_PER_AREA: &str = "J/m²";
const FORCE: &str = "N";
const FORCE_PER_LENGTH: &str = "N/m";
const SECOND: &str = "s";
const SPEED: &str = "m/s";

/// Units that take prefixes, each with the largest power of ten that has one.
const WITH_PREFIXES: [(&str, i32); 7] =
    [(METRE, 3), (PASCAL, 9), (ENERGY_PER_AREA, 9), (FORCE, 9), (FORCE_PER_LENGTH, 9), (SECOND, 0), (SPEED, 0)];

/// Powers of ten with their prefixes.
const PREFIXES: [(i32, &str); 8] =
    [(-15, "f"), (-12, "p"), (-9, "n"), (-6, "µ"), (-3, "m"), (3, "k"), (6, "M"), (9, "G")];

/// The units of lengths and of pressures in a recording; empty where they are not known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RecordUnits {
    /// That of lengths.
    pub length: String,
    /// That of pressures.
    pub pressure: String,
}

impl From<&Record> for RecordUnits {
    fn from(record: &Record) -> Self {
        Self { length: record.length_unit.clone(), pressure: record.pressure_unit.clone() }
    }
}

impl RecordUnits {
    /// The unit of a kind of numbers.
    pub fn of_kind(&self, unit: Unit) -> &str {
        match unit {
            Unit::Length => &self.length,
            Unit::Pressure => &self.pressure,
            _ if !self.is_of_metres_and_pascals() => "",
            Unit::EnergyPerArea => ENERGY_PER_AREA,
            // beside metres and pascals, numbers alone are in units of the SI as well
            Unit::Time => SECOND,
            Unit::Speed => SPEED,
            _ => "",
        }
    }

    /// The unit of a load on a line or a surface.
    pub fn of_load(&self, load: Load, is_line: bool) -> &str {
        match load {
            Load::MeanPressure(_) => &self.pressure,
            Load::MeanGap(_) | Load::Approach(_) => &self.length,
            Load::Force(_) if !self.is_of_metres_and_pascals() => "",
            Load::Force(_) if is_line => FORCE_PER_LENGTH,
            Load::Force(_) => FORCE,
            Load::ReducedPressure(_) => "",
        }
    }

    fn is_of_metres_and_pascals(&self) -> bool {
        self.length == METRE && self.pressure == PASCAL
    }
}

/// A unit that fits values: its name, and its size in the unit that they are in.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FittingUnit {
    /// Its name, such as `MPa`; empty for pure numbers.
    pub name: String,
    /// The value at the number 1.
    pub size: f64,
}

impl FittingUnit {
    /// The unit with a prefix that fits a largest value in `unit`; another unit than those of the SI stays as it is.
    pub(crate) fn new(unit: &str, largest: f64) -> Self {
        let power = match largest_power(unit) {
            Some(most) if largest.is_finite() => engineering_exponent(largest, false).min(most),
            _ => 0,
        };
        Self { name: scaled_unit(unit, power), size: 10f64.powi(power) }
    }
}

/// A value with its unit, such as `20 MPa`.
pub fn value_with_unit(value: f64, unit: &str) -> String {
    let FittingUnit { name, size } = FittingUnit::new(unit, value.abs());
    format!("{} {name}", number_in_words(value / size)).trim_end().to_owned()
}

/// The name of an axis or a curve with the unit of its numbers, such as `mean pressure [MPa]`.
pub(crate) fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.into() } else { format!("{name} [{unit}]") }
}

/// A name without the unit that [`with_unit`] has added, and that unit; empty if there is none.
pub(crate) fn split_unit(name: &str) -> (&str, &str) {
    name.strip_suffix(']').and_then(|name| name.rsplit_once(" [")).unwrap_or((name, ""))
}

/// The multiple of three that leaves numbers between 1 and 1000; pure numbers from 0.1 stay as they are.
pub(crate) fn engineering_exponent(largest: f64, is_pure: bool) -> i32 {
    let stays = largest == 0.0 || is_pure && (0.1..1000.0).contains(&largest);
    if stays { 0 } else { (largest.log10() / 3.0).floor() as i32 * 3 }
}

/// The unit times a power of ten: units of the SI take a prefix.
pub(crate) fn scaled_unit(unit: &str, exponent: i32) -> String {
    let prefix = PREFIXES.iter().find(|(power, _)| *power == exponent);
    match prefix {
        _ if exponent == 0 => unit.into(),
        Some((power, prefix)) if largest_power(unit).is_some_and(|most| *power <= most) => format!("{prefix}{unit}"),
        _ => format!("1e{exponent} {unit}").trim_end().into(),
    }
}

/// The largest power of ten with a prefix of a unit, if it takes any.
fn largest_power(unit: &str) -> Option<i32> {
    WITH_PREFIXES.iter().find(|(name, _)| *name == unit).map(|(_, most)| *most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_the_prefix_that_fits_them() {
        let words = [
            (1e9, "Pa"),
            (2e7, "Pa"),
            (113.8e-9, "m"),
            (0.0, "Pa"),
            (2e7, "kPa"),
            (0.05, ""),
            (-3.5e-5, "J/m²"),
            (3600.0, "s"),
        ];
        let words = words.map(|(value, unit)| value_with_unit(value, unit));
        assert_eq!(words, ["1 GPa", "20 MPa", "113.8 nm", "0 Pa", "2e7 kPa", "0.05", "-35 µJ/m²", "3600 s"]);
    }

    #[test]
    fn a_name_and_its_unit_are_told_apart_again() {
        assert_eq!(split_unit(&with_unit("mean pressure", "Pa")), ("mean pressure", "Pa"));
        assert_eq!(split_unit(&with_unit("p*", "")), ("p*", ""));
    }

    #[test]
    fn energies_and_forces_have_units_where_lengths_and_pressures_do() {
        let si = RecordUnits { length: "m".into(), pressure: "Pa".into() };
        let plain = RecordUnits { length: "m".into(), pressure: String::new() };
        assert_eq!([&si, &plain].map(|it| it.of_kind(Unit::EnergyPerArea)), ["J/m²", ""]);
        assert_eq!([&si, &plain].map(|it| it.of_kind(Unit::Time)), ["s", ""]);
        assert_eq!([true, false].map(|is_line| si.of_load(Load::Force(1.0), is_line)), ["N/m", "N"]);
        assert_eq!((plain.of_load(Load::Force(1.0), true), plain.of_load(Load::MeanGap(1.0), true)), ("", "m"));
    }
}
