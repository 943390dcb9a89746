//! Lists of loads in setups.

use super::Setup;
use super::range::Range;
use super::text::{SetupTable, wrong_load};
use crate::contact::Load;
use crate::error::{ProblemError, SetupError, TextFault, TextPlace};
use serde::Deserialize;

/// What is said where a list ends without a load.
const UNLOADING: &str = "a list of loads cannot hold 0: to unload a body that yields, give the loads as a path (`path.load`), which may go down to 0";

impl SetupTable {
    /// Removes a list of loads from the section `load` and keeps the first load. Returns none if there is a single load
    /// or no load. A list such as `[1e5, "1 MPa"]` may contain ranges such as `"1e-3..1e-1:13"`, which means 13 loads
    /// with equal ratios.
    ///
    /// A solid that yields below its surface remembers its loads: there the list becomes the path of the history, and none is returned.
    ///
    /// # Errors
    /// For an empty list, and for what is no load or range.
    pub fn take_loads(&mut self) -> Result<Option<Vec<Load>>, SetupError> {
        let section = self.find("load").and_then(toml::Value::as_table).filter(|section| section.len() == 1);
        let Some((kind, value)) = section.and_then(|section| section.iter().next()) else { return Ok(None) };
        let words = match value {
            toml::Value::Array(words) => words.clone(),
            toml::Value::String(text) if text.contains("..") => vec![value.clone()],
            _ => return Ok(None),
        };
        let kind = kind.clone();
        if self.find("solid.yield-stress").is_some() && words.iter().skip(1).any(is_zero) {
            let fault = TextFault::Other { reason: UNLOADING.into(), flags: vec!["unload", "path-load"] };
            return Err(SetupError::Text { place: TextPlace::keys("load"), fault: fault.into() });
        }
        let loads = words.iter().map(|word| expanded(&kind, word)).collect::<Result<Vec<_>, _>>()?.concat();
        let Some(first) = loads.first() else {
            return Err(wrong_load("the list is empty: give at least one load".into()));
        };
        self.lay(&format!("load.{kind}"), first.value().into());
        if self.find("solid.yield-stress").is_some() && self.find("path.load").is_none() {
            let values: Vec<toml::Value> = loads.iter().map(|load| load.value().into()).collect();
            self.lay("path.load", values.into());
            return Ok(None);
        }
        Ok(Some(loads))
    }

    /// The table with a list of loads, all of the same kind, in the section `load`; as it is without loads.
    pub(super) fn with_loads(mut self, loads: &[Load]) -> Self {
        let Some(first) = loads.first() else { return self };
        let named = toml::Table::try_from(first).expect("a load has a form in TOML");
        let values: Vec<toml::Value> = loads.iter().map(|load| load.value().into()).collect();
        self.remove("load");
        named.keys().for_each(|kind| self.lay(&format!("load.{kind}"), values.clone().into()));
        self
    }
}

impl Setup {
    /// The setup with a list of loads, all of the same kind, which are applied one after the other.
    ///
    /// ```
    /// use asperity::contact::{Load, Quantity};
    /// use asperity::job::Job;
    /// use asperity::setup::{Cell, Recipe, Setup};
    /// use asperity::Indenter;
    ///
    /// let cylinder = Recipe::indenter(Indenter::Cylinder { radius: 1.0 });
    /// let loads = [0.001, 0.002, 0.004].map(Load::ReducedPressure);
    /// let setup = Setup::new(cylinder, Cell::line(1024, 4.0), loads[0]).under_loads(loads.into()).unloaded();
    /// let outcome = Job::new(setup).run(&mut ())?;
    /// let areas = outcome.solved[0].history.as_ref().expect("several states").values(Quantity::RelativeAreaCounted);
    /// assert!(areas[0] < areas[1] && areas[1] < areas[2]);
    /// // without friction and adhesion there is no hysteresis
    /// assert_eq!(areas[..2], [areas[4], areas[3]]);
    /// # Ok::<(), asperity::error::SetupError>(())
    /// ```
    pub fn under_loads(self, loads: Vec<Load>) -> Self {
        Self { load: loads.first().copied().unwrap_or(self.load), loads, ..self }
    }

    /// The setup under one load, in place of its load or its list of loads.
    pub fn under(&self, load: Load) -> Self {
        Self { load, loads: Vec::new(), ..self.clone() }
    }

    /// The setup whose loads go back after the last one: a list through the same loads, and the path of a solid that yields below its surface also to 0.
    /// Mean gaps go back to the first one.
    pub fn unloaded(mut self) -> Self {
        if !self.loads.is_empty() {
            let back: Vec<Load> = self.loads.iter().rev().skip(1).copied().collect();
            self.loads.extend(back);
            return self;
        }
        let mut loads: Vec<f64> = self.path_points().iter().map(|point| point.load.value()).collect();
        let back: Vec<f64> = loads.iter().rev().skip(1).copied().collect();
        loads.extend(back);
        loads.extend((!matches!(self.load, Load::MeanGap(_))).then_some(0.0));
        self.path.get_or_insert_default().load = loads;
        self
    }
}

impl SetupTable {
    /// Reads a tangential load with a unit in the form of the normal load that carries it: a force beside a force, a pressure beside a
    /// pressure.
    ///
    /// # Errors
    /// [`SetupError::Text`] for a unit of another form.
    pub(super) fn read_tangential(&mut self) -> Result<(), SetupError> {
        const PATH: &str = "friction.tangential";
        let text = self.find(PATH).filter(|value| value.is_str()).cloned();
        let (Some(text), Some(kind)) = (text, self.load_kind()) else { return Ok(()) };
        let tangential = read_number(PATH, &kind, &text);
        // if it is wrong, a number replaces it, so that the rest can be read
        self.lay(PATH, tangential.as_ref().map_or(1.0, |value| *value).into());
        tangential.map(drop)
    }

    /// The kind of the load, by its key.
    pub(super) fn load_kind(&self) -> Option<String> {
        self.find("load").and_then(toml::Value::as_table).and_then(|load| load.keys().next().cloned())
    }
}

/// The number of a value at a path of keys that is of the kind of the load, with a unit or without.
pub(super) fn read_number(path: &str, kind: &str, value: &toml::Value) -> Result<f64, SetupError> {
    let wrong = |_| {
        let (kind, text) = (kind.replace('-', " "), super::words::plain(value));
        let reason = format!("{text:?} is not of the same kind as the normal load, which is a {kind}: give a {kind}");
        SetupError::text(path, reason)
    };
    read(kind, value.clone()).map(|load| load.value()).map_err(wrong)
}

/// Whether a load of a list is 0, with a unit or without.
fn is_zero(word: &toml::Value) -> bool {
    let number = |text: &str| text.trim_end_matches(|c: char| !c.is_ascii_digit() && c != '.').parse::<f64>().ok();
    let value = word.as_float().or(word.as_integer().map(|value| value as f64)).or(word.as_str().and_then(number));
    value == Some(0.0)
}

/// The loads of one word of a list.
fn expanded(kind: &str, word: &toml::Value) -> Result<Vec<Load>, SetupError> {
    let Some(range) = word.as_str().and_then(Range::parse) else {
        return Ok(vec![load(kind, word.clone())?]);
    };
    let one = load(kind, 1.0.into())?;
    let end = |end: &str| Ok(load(kind, super::command::value(end))?.value());
    let values = range.map_err(wrong_load)?.values(end, wrong_load);
    values.map(|values| values.into_iter().map(|value| one.with_value(value)).collect())
}

/// The load of a kind and a number, which must be positive.
fn load(kind: &str, value: toml::Value) -> Result<Load, SetupError> {
    let load = read(kind, value)?;
    let value = load.value();
    if value.is_finite() && value > 0.0 {
        Ok(load)
    } else {
        Err(ProblemError::NotPositive { name: load.name(), value }.into())
    }
}

/// The load of a kind and a number, or a text with a unit.
fn read(kind: &str, value: toml::Value) -> Result<Load, SetupError> {
    #[derive(Deserialize)]
    struct LoadSection {
        load: Load,
    }
    let mut table = SetupTable::default();
    table.lay(&format!("load.{kind}"), value);
    table.read_as().map(|LoadSection { load }| load)
}
