//! What the table of quantities says of each of them.

use crate::contact::{Readings, Validity};
use serde::Serialize;
use strum::IntoStaticStr;

/// The unit of a quantity, in any consistent set of units.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr, Serialize)]
pub enum Unit {
    /// A pure number.
    #[strum(serialize = "1")]
    #[serde(rename = "1")]
    One,
    /// A time.
    #[strum(serialize = "time")]
    #[serde(rename = "time")]
    Time,
    /// A length.
    #[strum(serialize = "length")]
    #[serde(rename = "length")]
    Length,
    /// A length per time.
    #[strum(serialize = "length/time")]
    #[serde(rename = "length/time")]
    Speed,
    /// A pressure.
    #[strum(serialize = "pressure")]
    #[serde(rename = "pressure")]
    Pressure,
    /// An energy per area: a pressure times a length.
    #[strum(serialize = "pressure length")]
    #[serde(rename = "pressure length")]
    EnergyPerArea,
    /// A length cubed.
    #[strum(serialize = "length^3")]
    #[serde(rename = "length^3")]
    Volume,
    /// One over a length.
    #[strum(serialize = "1/length")]
    #[serde(rename = "1/length")]
    PerLength,
    /// One over a resistivity and a length.
    #[strum(serialize = "1/(resistivity length)")]
    #[serde(rename = "1/(resistivity length)")]
    Conductance,
    /// A pressure per length.
    #[strum(serialize = "pressure/length")]
    #[serde(rename = "pressure/length")]
    Stiffness,
}

/// The kind of the values of a quantity: numbers, bounds, counts or flags.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QuantityKind {
    /// Any numbers.
    Number,
    /// Small numbers that bound or measure an error, written with powers of ten such as 1e-9.
    Bound,
    /// Whole numbers.
    Whole,
    /// 1 where something is true, and 0 where it is not.
    Flag,
}

/// The part of the table of the page in which a number of a contact stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PageTable {
    /// The numbers of the contact.
    Contact,
    /// How it was solved.
    Solving,
}

/// Which curves a quantity has in recordings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Curve {
    /// None.
    None,
    /// One over the steps of a solve.
    Steps,
    /// One over the states of a history.
    States,
    /// Both.
    Both,
}

/// A row of the table of quantities: names, unit, kind and meaning of one quantity.
#[derive(Debug, Serialize)]
pub struct QuantityRow {
    /// Its name in files and tables.
    pub name: &'static str,
    /// Its symbol.
    pub symbol: &'static str,
    /// Its title in charts.
    pub title: &'static str,
    /// Its title above a column of text, of at most 15 letters where it has such a column.
    #[serde(skip)]
    pub short: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// The kind of the values of the quantity.
    #[serde(skip)]
    pub kind: QuantityKind,
    /// Whether it is recorded at each step of a solve.
    pub is_traced: bool,
    /// Whether it has a curve over the states of a history.
    #[serde(skip)]
    pub has_curve: bool,
    /// The states for which it has a meaning.
    #[serde(skip)]
    pub validity: Validity,
    /// Whether `solve` prints it in a row of its own, without further words.
    #[serde(skip)]
    pub is_printed: bool,
    /// The part of the table of the page in which it stands, if it stands there; what is recorded at each step always does.
    pub page: Option<PageTable>,
    /// Whether only the process that makes a state knows the number.
    pub is_known_by_process: bool,
    /// The names of the quantities that estimate its error, the most general one first.
    pub errors: &'static [&'static str],
    /// One sentence.
    pub sentence: &'static str,
    /// How it is computed of a contact or a step; none for a number that only a process knows.
    #[serde(skip)]
    pub(super) read: Option<fn(&dyn Readings) -> f64>,
}

impl QuantityRow {
    /// What causes the error that the quantity estimates, such as "the grid", as its title has it; none of other quantities, and where the
    /// title does not tell the cause.
    pub fn cause(&self) -> Option<&'static str> {
        self.title.strip_prefix("error of ")?.rsplit_once(" by ").map(|(_, cause)| cause)
    }

    /// The part of the table of the page for a number with some curve: that which its row gives, and else that of a contact where it has a curve over
    /// steps.
    pub(super) const fn page(given: Option<PageTable>, curve: Curve) -> Option<PageTable> {
        match (given, curve) {
            (None, Curve::Steps | Curve::Both) => Some(PageTable::Contact),
            (given, _) => given,
        }
    }
}
