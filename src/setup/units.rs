//! Units that are given for some quantities and not for others.

use super::SetupTable;
use crate::error::SetupError;
use toml::Value;

/// The keys of all pressures, and of all lengths, of which numbers alone mean the same unit.
const KINDS: [(&str, &[&str]); 2] = [
    ("pressure", &["solid.contact-modulus", "solid.young", "law.hardness", "load.mean-pressure"]),
    (
        "length",
        &[
            "surface.indenter.radius",
            "surface.indenter.amplitude",
            "surface.indenter.half-width",
            "surface.indenter.depth",
            "surface.spectrum.rolloff-wavelength",
            "surface.spectrum.short-cutoff",
            "surface.spectrum.rms-height",
            "grid.size",
            "solid.layer",
            "load.mean-gap",
            "load.approach",
            "adhesion.range",
        ],
    ),
];

/// The keys of values that are electrical or thermal, and the letter of the unit that only thermal ones have.
const CONDUCTION: [&str; 2] = ["flow.resistivity", "flow.conductivity"];
const KELVIN: char = 'K';

impl SetupTable {
    /// Refuses a setup in which some pressures, or some lengths, have a unit and others have none: a number alone would be in pascals or
    /// metres there, which is seldom what is meant.
    ///
    /// # Errors
    /// [`SetupError::MixedUnits`], and [`SetupError::ElectricalAndThermal`].
    pub fn check_units(&self) -> Result<(), SetupError> {
        for (kind, keys) in KINDS {
            let given = keys.iter().flat_map(|key| words(self.find(key)).into_iter().map(move |word| (*key, word)));
            let (with, without): (Vec<_>, Vec<_>) = given.partition(|(_, word)| has_unit(word));
            if let (Some(with), Some(without)) = (with.first(), without.first()) {
                let named = |(key, word): &(&str, String)| {
                    format!("{} {word}", key.rsplit('.').next().unwrap_or(key).replace('-', " "))
                };
                return Err(SetupError::MixedUnits { kind, without: named(without), with: named(with) });
            }
        }
        self.check_conduction()
    }

    /// Refuses bodies of which one conducts electricity and the other one heat.
    fn check_conduction(&self) -> Result<(), SetupError> {
        for key in CONDUCTION {
            let words = words(self.find(key));
            let (thermal, electrical): (Vec<_>, Vec<_>) =
                words.into_iter().filter(|word| has_unit(word)).partition(|word| word.contains(KELVIN));
            if let (Some(electrical), Some(thermal)) = (electrical.first(), thermal.first()) {
                let [electrical, thermal] = [electrical, thermal].map(String::clone);
                return Err(SetupError::ElectricalAndThermal { electrical, thermal });
            }
        }
        Ok(())
    }
}

/// The numbers and quantities of a value, as they are written; zero needs no unit.
fn words(value: Option<&Value>) -> Vec<String> {
    match value {
        Some(Value::Array(values)) => values.iter().flat_map(|value| words(Some(value))).collect(),
        Some(Value::String(text)) => vec![text.clone()],
        Some(Value::Integer(_) | Value::Float(_)) if value.and_then(number) != Some(0.0) => {
            value.map(Value::to_string).into_iter().collect()
        }
        _ => Vec::new(),
    }
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// Whether a quantity, or a range of them such as `1e5..1e6:4`, ends in a unit.
fn has_unit(word: &str) -> bool {
    let last = word.split(':').next().and_then(|ends| ends.rsplit("..").next()).unwrap_or(word).trim();
    last.contains(char::is_alphabetic) && last.parse::<f64>().is_err()
}
