//! Units that are given for some quantities and not for others.

use super::range::has_unit;
use super::{Dimension, Key, SetupTable};
use crate::error::SetupError;
use crate::quantity::{ForceUnit, force_unit, has_length_unit, has_pressure_unit};
use toml::Value;

/// The keys of a contact modulus. Each of them alone says which modulus pressures are compared with.
const MODULI: [&str; 3] = ["solid.contact-modulus", "solid.young", "solid.stiffness"];

/// The section whose lists are pairs of a ratio, which has no unit, and a time.
const OF_PAIRS: &str = "viscoelastic.";

/// The key of the force.
const FORCE: &str = "load.force";

/// The letter of units that only thermal resistivities and conductivities have.
const KELVIN: char = 'K';

/// The keys of the units of lengths and pressures in a recording, and the unit of pressures that are given with theirs.
const LENGTH_UNIT: &str = "record.length-unit";
const PRESSURE_UNIT: &str = "record.pressure-unit";
const PASCAL: &str = "Pa";

impl SetupTable {
    /// States that pressures are in pascals, where one is given with its unit and the recording has none; and that lengths have no unit, where
    /// they are numbers alone beside such pressures. So the setup of a result says which of its numbers have units.
    pub(super) fn complete_units(&mut self) {
        if self.find(PRESSURE_UNIT).is_some() || !self.is_in_pascals() {
            return;
        }
        if self.find(LENGTH_UNIT).is_none() && !self.is_in_metres() {
            self.lay(LENGTH_UNIT, "".into());
        }
        self.lay(PRESSURE_UNIT, PASCAL.into());
    }

    /// Whether pressures are in pascals: one is given with its unit, or this is the setup of a result, which says so.
    pub fn is_in_pascals(&self) -> bool {
        self.has_told_pascals() || self.texts().iter().any(|text| has_pressure_unit(text))
    }

    /// Whether lengths are in metres: one is given with its unit, a height file has metres, or this is the setup of a result in pascals that does
    /// not say that its lengths have no unit.
    pub fn is_in_metres(&self) -> bool {
        let is_told = || self.has_told_pascals() && self.find(LENGTH_UNIT).and_then(Value::as_str) != Some("");
        self.texts().iter().any(|text| has_length_unit(text)) || is_told() || self.is_file_in_metres()
    }

    fn has_told_pascals(&self) -> bool {
        self.find(PRESSURE_UNIT).and_then(Value::as_str) == Some(PASCAL)
    }

    /// Whether one of the height files of the surface has heights in metres.
    fn is_file_in_metres(&self) -> bool {
        let Ok(surface) = self.recipe() else { return false };
        let mut files = surface.files().map(|file| file.layout(surface.channel.as_deref()));
        files.any(|layout| layout.is_ok_and(|it| it.is_in_metres))
    }

    /// Refuses a setup in which some quantities of a kind have a unit and others have none: a number alone would be in pascals or
    /// metres there, which is seldom what is meant. Beside a force with a unit all pressures and lengths need one.
    ///
    /// # Errors
    /// [`SetupError::MixedUnits`], [`SetupError::ForceWithoutUnit`] and [`SetupError::ElectricalAndThermal`].
    pub fn check_units(&self) -> Result<(), SetupError> {
        self.check_numbers()?;
        self.check_force_numbers()?;
        self.check_conduction()
    }

    /// Refuses a number alone beside a quantity of its kind with a unit, and beside a force with one.
    ///
    /// # Errors
    /// [`SetupError::MixedUnits`].
    pub fn check_numbers(&self) -> Result<(), SetupError> {
        for dimension in Dimension::WITH_UNITS {
            self.check_dimension(dimension)?;
        }
        // a force belongs to a pressure times an area
        let force = self.given(Dimension::Force).into_iter().find(|(_, word)| is_with_unit(word));
        let number = self.pressures_and_lengths().into_iter().find(|(_, word)| !is_with_unit(word));
        match (force, number) {
            (Some(force), Some(number)) => {
                let kind = number.0.dimension.name();
                Err(SetupError::MixedUnits { kind, without: named(&number), with: named(&force) })
            }
            _ => Ok(()),
        }
    }

    /// The pressures and lengths that are given, each with its key.
    fn pressures_and_lengths(&self) -> Vec<(&'static Key, String)> {
        [self.given(Dimension::Pressure), self.given(Dimension::Length)].concat()
    }

    /// Refuses a hardness, a yield stress or a work of adhesion with a unit where no modulus is given: the modulus would be 1 Pa.
    ///
    /// # Errors
    /// [`SetupError::UnitWithoutModulus`].
    pub(super) fn check_modulus(&self) -> Result<(), SetupError> {
        if MODULI.iter().any(|key| self.find(key).is_some()) {
            return Ok(());
        }
        // Without a modulus these are numbers over it, which a unit contradicts. Mean pressures and forces are refused without a modulus in any case.
        for key in Key::all().filter(|key| key.is_over_modulus) {
            if let Some(word) = self.words_of(key.path).into_iter().find(|word| is_with_unit(word)) {
                return Err(SetupError::UnitWithoutModulus { given: named(&(key, word)) });
            }
        }
        Ok(())
    }

    /// Refuses a number alone beside a quantity of the same dimension with a unit. Loads of a path are apart from the normal load: numbers alone are in SI
    /// beside one with a unit, since a path is often a table of numbers.
    fn check_dimension(&self, dimension: Dimension) -> Result<(), SetupError> {
        let given = self.given(dimension).into_iter();
        let (with, without): (Vec<_>, Vec<_>) = given.partition(|(_, word)| is_with_unit(word));
        match (with.first(), without.first()) {
            (Some(with), Some(without)) => {
                let kind = dimension.name();
                Err(SetupError::MixedUnits { kind, without: named(without), with: named(with) })
            }
            _ => Ok(()),
        }
    }

    /// The quantities of a dimension, each with its key.
    fn given(&self, dimension: Dimension) -> Vec<(&'static Key, String)> {
        let mut given = Vec::new();
        for key in Key::of_dimension(dimension) {
            given.extend(self.words_of(key.path).into_iter().map(|word| (key, word)));
        }
        given
    }

    /// Refuses a number alone as the force beside pressures or lengths with units.
    ///
    /// # Errors
    /// [`SetupError::ForceWithoutUnit`].
    pub fn check_force_numbers(&self) -> Result<(), SetupError> {
        let Some(force) = self.words_of(FORCE).into_iter().find(|word| !is_with_unit(word)) else { return Ok(()) };
        let given = self.pressures_and_lengths();
        let Some(with) = given.iter().find(|(_, word)| is_with_unit(word)) else { return Ok(()) };
        let example = match self.axes() {
            Some(1) => format!("{force}N/m"),
            Some(_) => format!("{force}N"),
            None => format!("{force}N on a surface or {force}N/m on a line"),
        };
        Err(SetupError::ForceWithoutUnit { force, with: named(with), example })
    }

    /// Refuses a force per length on a surface, and one that is not per length on a line.
    ///
    /// # Errors
    /// [`SetupError::ForceUnit`].
    pub fn check_force_units(&self) -> Result<(), SetupError> {
        let is_force = self.find(FORCE).is_some();
        let words =
            if is_force { [self.given(Dimension::Force), self.given(Dimension::Load)].concat() } else { Vec::new() };
        let ends = words.iter().flat_map(|(_, word)| ends(word));
        let forces: Vec<(&str, ForceUnit)> = ends.filter_map(|word| Some((word, force_unit(word)?))).collect();
        let Some(axes) = forces.first().and_then(|_| self.axes()) else { return Ok(()) };
        let (expected, is_line) = if axes == 1 { (ForceUnit::Line, true) } else { (ForceUnit::Surface, false) };
        let Some((word, _)) = forces.into_iter().find(|(_, unit)| *unit != expected) else { return Ok(()) };
        let (force, of_surface) = (word.to_owned(), word.split('/').next().unwrap_or(word));
        let meant = if is_line { format!("{force}/m") } else { of_surface.to_owned() };
        Err(SetupError::ForceUnit { force, meant, is_line })
    }

    /// The number of axes of the heights: 1 for a line, 2 for a surface; none if that is not known yet.
    fn axes(&self) -> Option<usize> {
        match self.find("grid.points") {
            Some(Value::Array(points)) => Some(points.first()?.as_array().unwrap_or(points).len()),
            Some(_) => Some(1),
            None => self.clone().surface().and_then(|(recipe, cell)| recipe.rank(&cell)).ok().filter(|axes| *axes > 0),
        }
    }

    /// The quantities at some keys, as they are written; of pairs of a ratio and a time, the times. Ratios that have units are refused
    /// where they are read.
    fn words_of(&self, key: &str) -> Vec<String> {
        let Some(Value::Array(pairs)) = self.find(key).filter(|_| key.starts_with(OF_PAIRS)) else {
            return words(self.find(key));
        };
        let every_second = |from: usize| pairs.iter().skip(from).step_by(2).flat_map(|it| words(Some(it)));
        if every_second(0).any(|ratio| is_with_unit(&ratio)) { Vec::new() } else { every_second(1).collect() }
    }

    /// Refuses bodies of which one conducts electricity and the other one heat.
    fn check_conduction(&self) -> Result<(), SetupError> {
        for key in Key::of_dimension(Dimension::Conduction) {
            let words = words(self.find(key.path));
            let (thermal, electrical): (Vec<_>, Vec<_>) =
                words.into_iter().filter(|word| is_with_unit(word)).partition(|word| word.contains(KELVIN));
            if let (Some(electrical), Some(thermal)) = (electrical.first(), thermal.first()) {
                let [electrical, thermal] = [electrical, thermal].map(String::clone);
                return Err(SetupError::ElectricalAndThermal { electrical, thermal });
            }
        }
        Ok(())
    }
}

/// A quantity with its name.
fn named((key, word): &(&Key, String)) -> String {
    format!("{} {word}", key.quantity())
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

/// A quantity, or the ends of a range of them such as `1e5..1e6:4`.
fn ends(word: &str) -> impl Iterator<Item = &str> {
    word.split(':').next().unwrap_or(word).split("..").map(str::trim)
}

/// Whether a quantity, or an end of a range of them, has a unit.
fn is_with_unit(word: &str) -> bool {
    ends(word).any(has_unit)
}
