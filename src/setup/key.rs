//! A key of a scene, and the flag of the command line that sets it.

use super::idle::Idle;
use strum::{EnumMessage, IntoEnumIterator};

/// A key of a scene.
pub struct Key {
    /// Its sections and its name, separated by dots.
    pub path: &'static str,
    /// The name of the flag that sets it, without the dashes; empty where a scene alone can.
    pub flag: &'static str,
    /// The form of the value of the flag.
    pub value: FlagValue,
    /// The dimension of its numbers, or the kind of a value that is no number.
    pub dimension: Dimension,
    /// The placeholder of its value in the help.
    pub placeholder: &'static str,
    /// One sentence.
    pub help: &'static str,
    /// The name of its quantity in sentences, where that is not the last word of the path.
    quantity: Option<&'static str>,
    /// Whether its numbers are divided by the contact modulus in a setup that gives no modulus.
    pub(super) is_over_modulus: bool,
    /// Where it would have no effect.
    pub(super) idle: &'static [Idle],
}

/// What the value of a key is: the units that its numbers take follow from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// A number without a unit.
    One,
    /// A length.
    Length,
    /// A pressure, a modulus or a stress.
    Pressure,
    /// A force; on a line, a force per length.
    Force,
    /// An energy per area.
    EnergyPerArea,
    /// A time.
    Time,
    /// A speed.
    Speed,
    /// A load of the same kind as the normal load.
    Load,
    /// An electrical or thermal resistivity or conductivity.
    Conduction,
    /// A slope or an angle.
    Slope,
    /// The coefficient A of a power law A r^n, whose unit depends on n.
    PowerLaw,
    /// A unit.
    Unit,
    /// A name.
    Word,
    /// A file that is read.
    File,
    /// Yes or no.
    Switch,
}

impl Dimension {
    /// The dimensions of which numbers alone are in the same unit throughout a scene: either all of them have a unit, or none has.
    pub(super) const WITH_UNITS: [Self; 7] =
        [Self::Pressure, Self::Length, Self::Force, Self::EnergyPerArea, Self::Time, Self::Speed, Self::Load];

    /// Its name in sentences.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::One => "number",
            Self::Length => "length",
            Self::Pressure => "pressure",
            Self::Force => "force",
            Self::EnergyPerArea => "energy per area",
            Self::Time => "time",
            Self::Speed => "speed",
            Self::Load => "load of a path",
            Self::Conduction => "resistivity or conductivity",
            Self::Slope => "slope",
            Self::PowerLaw => "coefficient",
            Self::Unit => "unit",
            Self::Word => "name",
            Self::File => "file",
            Self::Switch => "choice",
        }
    }
}

/// The value of a flag.
#[derive(Clone, Copy)]
pub enum FlagValue {
    /// A number, a quantity with a unit, or a name.
    One,
    /// One of them, or several separated by commas.
    List,
    /// One of some names, with a short description each.
    Choice(Choices),
    /// One of some names that each have their own keys: it replaces all keys of its section or table.
    Variant(Choices),
    /// Several of some names.
    Choices(Choices),
    /// Nothing: the flag alone means yes.
    Switch,
}

/// Names to choose from, with a short description each.
pub type Choices = fn() -> Vec<(&'static str, &'static str)>;

/// The names of the variants of an enum, with a short description each: its message, or the first line of its documentation.
///
/// ```
/// use asperity::setup::{Theme, choices};
/// assert_eq!(choices::<Theme>()[0], ("dark", "Light lines on a dark background"));
/// ```
pub fn choices<T: IntoEnumIterator + EnumMessage + Into<&'static str>>() -> Vec<(&'static str, &'static str)> {
    let choice = |it: T| {
        let line = it.get_documentation().and_then(|text| text.lines().next()).unwrap_or_default();
        let words = it.get_message().unwrap_or(line.trim_end_matches('.'));
        (it.into(), words)
    };
    T::iter().map(choice).collect()
}

/// A key that a flag sets.
pub(super) const fn key(
    path: &'static str,
    flag: &'static str,
    value: FlagValue,
    dimension: Dimension,
    placeholder: &'static str,
    help: &'static str,
) -> Key {
    Key { path, flag, value, dimension, placeholder, help, quantity: None, is_over_modulus: false, idle: &[] }
}

/// A key that no flag sets.
pub(super) const fn without_flag(path: &'static str, dimension: Dimension) -> Key {
    key(path, "", FlagValue::One, dimension, "", "")
}

impl Key {
    pub(super) const fn named(self, quantity: &'static str) -> Self {
        Self { quantity: Some(quantity), ..self }
    }

    pub(super) const fn over_modulus(self) -> Self {
        Self { is_over_modulus: true, ..self }
    }

    pub(super) const fn idle_where(self, idle: &'static [Idle]) -> Self {
        Self { idle, ..self }
    }

    /// The section of the setup that it belongs to.
    pub fn section(&self) -> &'static str {
        self.path.split('.').next().unwrap_or_default()
    }

    /// The name of its quantity in sentences, with an article where it has one.
    pub(super) fn quantity(&self) -> String {
        let last = || self.path.rsplit('.').next().unwrap_or_default().replace('-', " ");
        let name = self.quantity.map_or_else(last, str::to_owned);
        if name.starts_with(char::is_uppercase) { name } else { format!("the {name}") }
    }
}
