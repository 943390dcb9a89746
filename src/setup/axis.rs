//! Lists of values in setups, which describe studies.

use super::key_checks::{is_list_of_section, list_of_section};
use super::text::SetupTable;
use super::words::plain;
use super::{FlagValue, Key};
use crate::error::SetupError;
use std::collections::BTreeSet;

/// Keys of whole numbers that may be ranges, such as `"1-100"`.
const RANGES: [&str; 3] = [ParameterAxis::SEED, "grid.refine", "stop.max-iterations"];

/// A list in a setup: its keys, and the values for them.
///
/// ```
/// use asperity::setup::SetupTable;
/// let mut table = SetupTable::from_toml("surface = { seed = ['1-100', 200], spectrum.hurst = [0.2, 0.5] }")?;
/// let axes = table.take_axes()?;
/// let of = |i: usize| (axes[i].path(), axes[i].len());
/// assert_eq!([of(0), of(1)], [("surface.spectrum.hurst", 2), ("surface.seed", 101)]);
/// assert_eq!(axes[1].word(100), "200");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterAxis {
    path: String,
    items: Vec<ListItem>,
}

/// An item of a list.
#[derive(Debug, Clone, PartialEq)]
enum ListItem {
    One(toml::Value),
    /// Whole numbers from the first to the last.
    Range(u64, u64),
}

impl ListItem {
    fn len(&self) -> u64 {
        match self {
            Self::One(_) => 1,
            Self::Range(first, last) => (last - first).saturating_add(1),
        }
    }
}

impl ParameterAxis {
    /// The keys of the seed of random surfaces.
    pub const SEED: &str = "surface.seed";

    /// The keys of the list, such as `surface.spectrum.hurst`.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The name of the quantity: that of its flag, or its keys where it has none.
    pub fn name(&self) -> &str {
        Key::find(&self.path).map(|key| key.flag).filter(|flag| !flag.is_empty()).unwrap_or(&self.path)
    }

    /// The number of values, at least one.
    #[allow(clippy::len_without_is_empty, reason = "a list that is empty is none")]
    pub fn len(&self) -> u64 {
        self.items.iter().fold(0, |sum: u64, item| sum.saturating_add(item.len()))
    }

    /// Value number `i`, from 0, as a user writes it.
    pub fn word(&self, i: u64) -> String {
        self.value(i).as_ref().map_or(String::new(), plain)
    }

    /// Value number `i`, from 0.
    fn value(&self, mut i: u64) -> Option<toml::Value> {
        for item in &self.items {
            match item {
                ListItem::One(value) if i == 0 => return Some(value.clone()),
                ListItem::Range(first, last) if i <= last - first => return Some(whole(first + i)),
                item => i -= item.len(),
            }
        }
        None
    }

    /// Refuses a list whose values do not give different contacts: one that has a value twice, or that is in a section
    /// without influence on the numbers. It checks all values.
    ///
    /// # Errors
    /// [`SetupError::Text`].
    pub fn check_varied(&self) -> Result<(), SetupError> {
        if ["friction", "record"].iter().any(|section| self.path.split('.').next() == Some(section)) {
            return Err(wrong(&self.path, "it does not change the numbers of a study: give one value".into()));
        }
        let mut seen = BTreeSet::new();
        match (0..self.len()).map(|i| self.word(i)).find(|word| !seen.insert(word.clone())) {
            Some(word) => Err(wrong(&self.path, format!("{word} occurs twice: give each value once"))),
            None => Ok(()),
        }
    }
}

/// A whole number as a value; as a text where it is too long for one.
fn whole(number: u64) -> toml::Value {
    i64::try_from(number).map_or_else(|_| number.to_string().into(), toml::Value::Integer)
}

fn wrong(path: &str, reason: String) -> SetupError {
    SetupError::text(path, reason)
}

impl SetupTable {
    /// Removes the lists of values and keeps the first value of each, so that a setup remains. Loads are handled by
    /// [`SetupTable::take_loads`]. A quantity that is a list itself, such as the points of a surface, needs a list of
    /// lists. The lists are in the order of [`Key::all`], the seeds last.
    ///
    /// # Errors
    /// [`SetupError::Text`] for an empty list and for an invalid range.
    pub fn take_axes(&mut self) -> Result<Vec<ParameterAxis>, SetupError> {
        let mut axes = Vec::new();
        for (section, value) in self.sections() {
            if section != "load" {
                find(section, value, &mut axes)?;
            }
        }
        axes.sort_by_key(|axis| place(&axis.path));
        axes.iter().for_each(|axis| self.lay_axis(axis, 0));
        Ok(axes)
    }

    /// Sets value number `i` of a list, counted from 0, at its keys.
    pub fn lay_axis(&mut self, axis: &ParameterAxis, i: u64) {
        if let Some(value) = axis.value(i) {
            self.lay(&axis.path, value);
        }
    }
}

/// The position of a list among the others.
fn place(path: &str) -> (bool, usize) {
    let is_at = |key: &Key| key.path.strip_prefix(path).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
    (path == ParameterAxis::SEED, Key::all().position(is_at).unwrap_or(usize::MAX))
}

/// Adds the lists at and below a path.
fn find(path: &str, value: &toml::Value, axes: &mut Vec<ParameterAxis>) -> Result<(), SetupError> {
    match value {
        toml::Value::Table(table) => {
            table.iter().try_for_each(|(key, value)| find(&format!("{path}.{key}"), value, axes))?;
        }
        toml::Value::Array(values) if !is_one(path, values) => {
            if values.is_empty() {
                return Err(wrong(path, "the list is empty: give at least one value".into()));
            }
            if is_list_of_section(path, values) {
                return Err(list_of_section(path));
            }
            let items = values.iter().map(|value| item(path, value)).collect::<Result<_, _>>()?;
            axes.push(ParameterAxis { path: path.into(), items });
        }
        toml::Value::String(_) if RANGES.contains(&path) => match item(path, value)? {
            ListItem::One(_) => {}
            range => axes.push(ParameterAxis { path: path.into(), items: vec![range] }),
        },
        _ => {}
    }
    Ok(())
}

/// Whether an array is a single value of a setup, not a list of values.
fn is_one(path: &str, values: &[toml::Value]) -> bool {
    let takes_list = |key: &Key| key.path == path && matches!(key.value, FlagValue::List | FlagValue::Choices(_));
    Key::with_flags().any(takes_list) && !values.iter().all(toml::Value::is_array)
}

/// A value of a list, or a range of whole numbers.
fn item(path: &str, value: &toml::Value) -> Result<ListItem, SetupError> {
    let Some(text) = value.as_str().filter(|_| RANGES.contains(&path)) else { return Ok(ListItem::One(value.clone())) };
    let Some((first, last)) = text.split_once('-').filter(|(first, _)| !first.trim().is_empty()) else {
        return Ok(ListItem::One(value.clone()));
    };
    let parse = |word: &str| word.trim().parse::<u64>().ok();
    match (parse(first), parse(last)) {
        (Some(first), Some(last)) if first <= last => Ok(ListItem::Range(first, last)),
        _ => Err(wrong(
            path,
            format!("`{text}` is not a range: give the first and the last whole number, such as 1-100"),
        )),
    }
}

/// A value of a setup, as in a column of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Scalar {
    /// A whole number from 0 on.
    Whole(u64),
    /// A number.
    Number(f64),
    /// Anything else, as a user writes it.
    Text(String),
}

impl SetupTable {
    /// The value at a path of keys, if there is one.
    pub fn scalar(&self, path: &str) -> Option<Scalar> {
        let value = self.find(path)?;
        Some(match (value.as_integer().and_then(|whole| u64::try_from(whole).ok()), value.as_float()) {
            (Some(whole), _) => Scalar::Whole(whole),
            (_, Some(number)) => Scalar::Number(number),
            _ => Scalar::Text(plain(value)),
        })
    }
}
