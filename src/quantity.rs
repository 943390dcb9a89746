//! Quantities as users write and read them.
//!
//! Lengths, pressures, forces, times, speeds, resistivities and conductivities in scenes are numbers in any consistent set of units or, with the
//! feature `units`, texts such as `"160 um"`, `"1 GPa"`, `"5 N"`, `"9 ms"` and `"58 MS/m"`, which are turned into SI units.

use serde::Deserialize;
use serde::de::{self, Deserializer, Visitor};
use std::fmt;

/// Reads a length.
///
/// # Errors
/// For anything that is neither a number nor a length with a unit.
pub fn length<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    from.deserialize_any(QuantityVisitor { kind: "a length", example: "\"160 um\"", parse: units::length })
}

/// Reads an optional length.
///
/// # Errors
/// The errors of [`length`].
pub fn some_length<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    length(from).map(Some)
}

/// Reads a pressure.
///
/// # Errors
/// For anything that is neither a number nor a pressure with a unit.
pub fn pressure<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    from.deserialize_any(QuantityVisitor { kind: "a pressure", example: "\"1 GPa\"", parse: units::pressure })
}

/// Reads a force, or a force per length.
///
/// # Errors
/// For anything that is neither a number nor a force with a unit.
pub fn force<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    from.deserialize_any(QuantityVisitor { kind: "a force", example: "\"1 N\" or \"1 N/m\"", parse: units::force })
}

/// Reads an optional angle in degrees.
///
/// # Errors
/// For anything that is neither a number nor an angle with a unit.
pub fn some_angle<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    from.deserialize_any(QuantityVisitor { kind: "an angle", example: "\"30 deg\"", parse: degrees }).map(Some)
}

/// Reads a slope: a length per length, or the angle of the flank.
///
/// # Errors
/// For anything that is neither a number nor an angle with a unit below 90 degrees.
pub fn slope<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    let parse = |text: &str| degrees(text).filter(|angle| angle.abs() < 90.0).map(|angle| angle.to_radians().tan());
    from.deserialize_any(QuantityVisitor { kind: "a slope", example: "\"5 deg\"", parse })
}

/// The degrees of an angle with its unit, such as `30 deg`.
///
/// ```
/// use asperity::quantity::degrees;
/// assert_eq!(["30deg", "-5 °", "30", "3 m"].map(degrees), [Some(30.0), Some(-5.0), None, None]);
/// assert!((degrees("0.5 rad").unwrap() - 28.64789).abs() < 1e-5);
/// ```
pub fn degrees(text: &str) -> Option<f64> {
    let number = |unit: &str| text.trim().strip_suffix(unit)?.trim().parse::<f64>().ok();
    number("deg").or_else(|| number("°")).or_else(|| number("rad").map(f64::to_degrees))
}

/// Reads a time.
///
/// # Errors
/// For anything that is neither a number nor a time with a unit.
pub fn time<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    from.deserialize_any(QuantityVisitor { kind: "a time", example: "\"9 ms\"", parse: units::time })
}

/// Reads a speed.
///
/// # Errors
/// For anything that is neither a number nor a speed with a unit.
pub fn speed<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    from.deserialize_any(QuantityVisitor { kind: "a speed", example: "\"1 m/s\"", parse: units::speed })
}

/// Reads an optional energy per area.
///
/// # Errors
/// For anything that is neither a number nor an energy per area with a unit.
pub fn some_energy_per_area<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    let visitor =
        QuantityVisitor { kind: "an energy per area", example: "\"50 mJ/m^2\"", parse: units::energy_per_area };
    from.deserialize_any(visitor).map(Some)
}

/// Reads a resistivity, electrical or thermal.
///
/// # Errors
/// For anything that is neither a number nor a resistivity with a unit.
pub fn resistivity<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    let example = "\"17 nohm*m\" or \"0.01 m K/W\"";
    from.deserialize_any(QuantityVisitor { kind: "a resistivity", example, parse: units::resistivity })
}

/// Reads a conductivity, electrical or thermal.
///
/// # Errors
/// For anything that is neither a number nor a conductivity with a unit.
pub fn conductivity<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    let example = "\"58 MS/m\" or \"400 W/(m K)\"";
    from.deserialize_any(QuantityVisitor { kind: "a conductivity", example, parse: units::conductivity })
}

/// The unit of a conductance per area between bodies whose resistivity or conductivity a text gives with its unit.
pub fn conductance_unit(text: &str) -> Option<&'static str> {
    units::conductance(text)
}

/// The length that a text with a unit means.
pub fn length_of(text: &str) -> Option<f64> {
    units::length(text)
}

/// The pressure that a text with a unit means.
pub fn pressure_of(text: &str) -> Option<f64> {
    units::pressure(text)
}

/// The time that a text with a unit means.
pub fn time_of(text: &str) -> Option<f64> {
    units::time(text)
}

/// A length in a list of them, read as [`length`] reads one.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct Length(#[serde(deserialize_with = "length")] pub f64);

/// A number of bytes, for reading.
pub fn bytes_in_words(bytes: f64) -> String {
    let (unit, name) = match bytes {
        ..1e6 => (1e3, "kB"),
        ..1e9 => (1e6, "MB"),
        ..1e12 => (1e9, "GB"),
        _ => (1e12, "TB"),
    };
    let value = bytes / unit;
    if value < 10.0 { format!("{value:.1} {name}") } else { format!("{value:.0} {name}") }
}

/// A whole number with spaces between groups of three digits, for reading.
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let place = |(i, digit): (usize, char)| match i > 0 && (digits.len() - i).is_multiple_of(3) {
        true => format!(" {digit}"),
        false => digit.to_string(),
    };
    digits.chars().enumerate().map(place).collect()
}

/// Units of lengths in texts, the longest first, in metres.
pub const LENGTHS: [(&str, f64); 4] = [("m", 1.0), ("mm", 1e-3), ("µm", 1e-6), ("nm", 1e-9)];

/// Units of areas, the largest first, in square metres.
const AREAS: [(&str, f64); 4] = [("m²", 1.0), ("mm²", 1e-6), ("µm²", 1e-12), ("nm²", 1e-18)];

/// Units of pressures, the largest first, in pascals.
pub const PRESSURES: [(&str, f64); 4] = [("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3), ("Pa", 1.0)];

/// A length in metres with the unit that makes it a number of one to three digits before its point, for reading.
pub fn length_in_words(metres: f64) -> String {
    in_words(metres, &LENGTHS, "m")
}

/// An area in square metres with the unit that fits it, for reading.
pub fn area_in_words(square_metres: f64) -> String {
    in_words(square_metres, &AREAS, "m²")
}

/// A pressure in pascals with the unit that fits it, for reading.
pub fn pressure_in_words(pascals: f64) -> String {
    in_words(pascals, &PRESSURES, "Pa")
}

/// A value in the largest of the units that is not larger than it, or else in the smallest one; 0 in the unit `base`.
fn in_words(value: f64, units: &[(&str, f64); 4], base: &str) -> String {
    if value == 0.0 {
        return format!("0 {base}");
    }
    let fits = |unit: &&(&str, f64)| value.abs() >= 0.9995 * unit.1;
    let (name, unit) = units.iter().find(fits).unwrap_or(&units[3]);
    format!("{} {name}", number_in_words(value / unit))
}

/// What a force with a unit acts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceUnit {
    /// A surface: newtons.
    Surface,
    /// A line: newtons per metre across it.
    Line,
}

/// What the force in a text with a unit acts on, if it is a force.
pub fn force_unit(text: &str) -> Option<ForceUnit> {
    match units::force_per_length(text) {
        Some(_) => Some(ForceUnit::Line),
        None => units::force(text).map(|_| ForceUnit::Surface),
    }
}

/// Whether a text is a length with its unit, such as `160 um`.
pub fn has_length_unit(text: &str) -> bool {
    units::length(text).is_some()
}

/// Whether a text is a pressure with its unit, such as `1 GPa`.
pub fn has_pressure_unit(text: &str) -> bool {
    units::pressure(text).is_some()
}

/// A number to four digits, for reading.
pub fn number_in_words(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        return "0".into();
    }
    let without_zeros = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    if !(1e-3..1e6).contains(&size) {
        let text = format!("{value:.3e}");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", without_zeros(digits));
    }
    let digits = (3.0 - size.log10().floor()).clamp(0.0, 6.0) as usize;
    without_zeros(&format!("{value:.digits$}"))
}

/// Reads a number or a text of one kind.
struct QuantityVisitor {
    kind: &'static str,
    example: &'static str,
    parse: fn(&str) -> Option<f64>,
}

impl Visitor<'_> for QuantityVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: a number, or one with a unit such as {}", self.kind, self.example)
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<f64, E> {
        Ok(value)
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<f64, E> {
        let number = text.trim().parse().ok();
        number.or_else(|| (self.parse)(text)).ok_or_else(|| match self.meant(text) {
            Some(meant) => E::custom(format_args!("`{text}` is not {}: did you mean `{meant}`?", self.kind)),
            None => E::invalid_value(de::Unexpected::Str(text), &self),
        })
    }
}

impl QuantityVisitor {
    /// The same text with the unit that differs from its own in capital letters only.
    fn meant(&self, text: &str) -> Option<String> {
        let at = text.rfind(|c: char| c.is_ascii_digit() || c == '.' || c.is_whitespace())? + 1;
        let (number, unit) = text.split_at_checked(at)?;
        let names = PRESSURES.iter().chain(&LENGTHS).map(|(name, _)| *name).chain(["N", "kN", "N/m", "kN/m"]);
        let meant = |name: &str| format!("{} {name}", number.trim());
        names.filter(|name| name.eq_ignore_ascii_case(unit)).map(meant).find(|text| (self.parse)(text).is_some())
    }
}

#[cfg(feature = "units")]
mod units {
    use uom::si::f64::{Force, Length, Pressure, SurfaceTension, Time, Velocity};
    use uom::si::force::newton;
    use uom::si::length::meter;
    use uom::si::pressure::pascal;
    use uom::si::surface_tension::newton_per_meter;
    use uom::si::time::second;
    use uom::si::velocity::meter_per_second;

    /// Units of engineers that are others with a prefix.
    const PER_MILLIMETRE: [(&str, &str); 4] = [("N/mm", "kN/m"), ("N/mm2", "MPa"), ("N/mm²", "MPa"), ("N/mm^2", "MPa")];

    /// A unit that no contact needs, which is probably a mistake for the megapascal.
    const MILLIPASCAL: &str = "mPa";

    pub(crate) fn length(text: &str) -> Option<f64> {
        read(text, |unit| unit.parse::<Length>().ok().map(|one| one.get::<meter>()))
    }

    pub(crate) fn pressure(text: &str) -> Option<f64> {
        read(text, |unit| unit.parse::<Pressure>().ok().map(|one| one.get::<pascal>()))
    }

    pub(crate) fn force(text: &str) -> Option<f64> {
        let force = read(text, |unit| unit.parse::<Force>().ok().map(|one| one.get::<newton>()));
        force.or_else(|| force_per_length(text))
    }

    pub(crate) fn force_per_length(text: &str) -> Option<f64> {
        read(text, |unit| unit.parse::<SurfaceTension>().ok().map(|one| one.get::<newton_per_meter>()))
    }

    /// A joule per square metre is a newton per metre.
    pub(crate) fn energy_per_area(text: &str) -> Option<f64> {
        read(text, |unit| {
            let squares = ["J/m²", "J/m^2", "J/m2"];
            let same = squares.iter().find_map(|square| unit.strip_suffix(square)).map(|prefix| format!("{prefix}N/m"));
            same.as_deref().unwrap_or(unit).parse::<SurfaceTension>().ok().map(|one| one.get::<newton_per_meter>())
        })
    }

    pub(crate) fn time(text: &str) -> Option<f64> {
        read(text, |unit| unit.parse::<Time>().ok().map(|one| one.get::<second>()))
    }

    pub(crate) fn speed(text: &str) -> Option<f64> {
        read(text, |unit| unit.parse::<Velocity>().ok().map(|one| one.get::<meter_per_second>()))
    }

    /// Units of conduction without their spaces and dots: resistivities and conductivities, electrical and thermal.
    const RESISTIVITIES: [(&str, f64); 8] = [
        ("Ωm", 1.0),
        ("mΩm", 1e-3),
        ("µΩm", 1e-6),
        ("nΩm", 1e-9),
        ("Ωcm", 1e-2),
        ("mΩcm", 1e-5),
        ("µΩcm", 1e-8),
        ("nΩcm", 1e-11),
    ];
    const CONDUCTIVITIES: [(&str, f64); 4] = [("S/m", 1.0), ("kS/m", 1e3), ("MS/m", 1e6), ("S/cm", 1e2)];
    const THERMAL_RESISTIVITIES: [(&str, f64); 2] = [("mK/W", 1.0), ("cmK/W", 1e-2)];
    const THERMAL_CONDUCTIVITIES: [(&str, f64); 6] =
        [("W/(mK)", 1.0), ("W/mK", 1.0), ("W/m/K", 1.0), ("kW/(mK)", 1e3), ("mW/(mK)", 1e-3), ("W/(cmK)", 1e2)];

    pub(crate) fn resistivity(text: &str) -> Option<f64> {
        of_conduction(text, &[&RESISTIVITIES, &THERMAL_RESISTIVITIES])
    }

    pub(crate) fn conductivity(text: &str) -> Option<f64> {
        of_conduction(text, &[&CONDUCTIVITIES, &THERMAL_CONDUCTIVITIES])
    }

    pub(crate) fn conductance(text: &str) -> Option<&'static str> {
        let is_of = |tables: &[&[(&str, f64)]]| of_conduction(text, tables).is_some();
        match () {
            () if is_of(&[&RESISTIVITIES, &CONDUCTIVITIES]) => Some("S/m²"),
            () if is_of(&[&THERMAL_RESISTIVITIES, &THERMAL_CONDUCTIVITIES]) => Some("W/(m² K)"),
            () => None,
        }
    }

    /// A number with one of some units. Ohms may be written out, and spaces, dots and stars between units are left out.
    fn of_conduction(text: &str, tables: &[&[(&str, f64)]]) -> Option<f64> {
        read(text, |one| {
            let unit: String = one.strip_prefix("1 ")?.chars().filter(|c| !" ·⋅*".contains(*c)).collect();
            let unit = ["ohm", "Ohm", "Ω"].iter().fold(unit, |unit, ohm| unit.replace(ohm, "Ω"));
            tables.iter().copied().flatten().find(|(name, _)| *name == unit).map(|(_, size)| *size)
        })
    }

    /// The longest number that the text begins with, in the unit that follows. What is a whole part of the SI unit divides, so
    /// that `40 um` is the same number as `40e-6`.
    fn read(text: &str, one: impl Fn(&str) -> Option<f64>) -> Option<f64> {
        let number = |at: usize| Some((text.get(..at)?.trim().parse::<f64>().ok()?, text.get(at..)?.trim()));
        let (number, unit) = (0..=text.len()).rev().find_map(number)?;
        let unit = unit.strip_prefix(['u', 'μ']).map_or(unit.to_owned(), |rest| format!("µ{rest}"));
        let unit = PER_MILLIMETRE.iter().find(|(name, _)| *name == unit).map_or(unit, |(_, same)| (*same).into());
        if unit == MILLIPASCAL {
            return None;
        }
        let size = one(&format!("1 {unit}"))?;
        let parts = size.recip().round();
        let is_part = parts > 1.0 && (size * parts - 1.0).abs() < 1e-12;
        Some(if is_part { number / parts } else { number * size })
    }
}

#[cfg(not(feature = "units"))]
mod units {
    pub(crate) use {
        length as conductivity, length as energy_per_area, length as force, length as force_per_length,
        length as pressure, length as resistivity, length as speed, length as time,
    };

    pub(crate) fn conductance(_: &str) -> Option<&'static str> {
        None
    }

    pub(crate) fn length(_: &str) -> Option<f64> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_written_in_the_unit_that_fits_them() {
        let words = [1e-5, 9.9996e-7, 2.5e-10, 3.0, 0.0, 1.25e-4, 160e-6].map(length_in_words);
        assert_eq!(words, ["10 µm", "1 µm", "0.25 nm", "3 m", "0 m", "125 µm", "160 µm"]);
        assert_eq!([11.547e6, 2e9, 0.5, 0.0].map(pressure_in_words), ["11.55 MPa", "2 GPa", "0.5 Pa", "0 Pa"]);
        assert_eq!([1.5e-11, 3.0, 2e-20].map(area_in_words), ["15 µm²", "3 m²", "0.02 nm²"]);
        let words = [0.1, 1e9, 0.01471, 2.1e-4, 1500.0, -0.05].map(number_in_words);
        assert_eq!(words, ["0.1", "1e9", "0.01471", "2.1e-4", "1500", "-0.05"]);
        assert_eq!([0, 999, 1000, 100_000_000].map(grouped), ["0", "999", "1 000", "100 000 000"]);
    }

    #[test]
    #[cfg(feature = "units")]
    fn resistivities_and_conductivities_are_electrical_or_thermal() {
        let same = ["17 nohm*m", "17 nΩ m", "1.7 uohm cm", "1.7µΩ·cm", "1.7e-8 ohm m"].map(units::resistivity);
        assert!(same.iter().all(|it| it.is_some_and(|it| (it / 1.7e-8 - 1.0).abs() < 1e-12)), "{same:?}");
        assert_eq!(["58 MS/m", "400 W/(m K)", "400W/mK"].map(units::conductivity), [58e6, 400.0, 400.0].map(Some));
        assert_eq!(["0.01 m K/W", "3 S/m", "3 m"].map(units::resistivity), [Some(0.01), None, None]);
        let units = ["17 nohm m", "58 MS/m", "1 m K/W", "400 W/(m K)", "400 um", "3"].map(conductance_unit);
        assert_eq!(units, [Some("S/m²"), Some("S/m²"), Some("W/(m² K)"), Some("W/(m² K)"), None, None]);
    }

    #[test]
    #[cfg(feature = "units")]
    fn a_unit_with_wrong_capitals_gets_the_right_ones() {
        let read = |text: &'static str| pressure(de::value::StrDeserializer::<de::value::Error>::new(text));
        assert_eq!(read("210 GPa"), Ok(210e9));
        let refused = |text| read(text).unwrap_err().to_string();
        assert_eq!(refused("210GPA"), "`210GPA` is not a pressure: did you mean `210 GPa`?");
        assert_eq!(refused("10mPa"), "`10mPa` is not a pressure: did you mean `10 MPa`?");
        assert!(refused("10 bananas").contains("such as \"1 GPa\""));
    }
}
