//! What the head of a text of numbers says of them.

use super::unit::metres;

/// Name, size and units in the lines above a table, in the words of Gwyddion's text export, or as units in brackets after the names
/// of columns.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Remarks {
    pub channel: Option<String>,
    /// Length along x, in metres.
    pub width: Option<f64>,
    /// Length along y, in metres.
    pub height: Option<f64>,
    /// Metres in a unit of heights.
    pub value_unit: Option<f64>,
    /// Metres in a unit of each column.
    pub column_units: Vec<Option<f64>>,
    /// All that is said by name.
    pub said: Vec<(String, String)>,
}

impl Remarks {
    pub fn of(head: &[String]) -> Self {
        let lines = head.iter().map(|line| line.trim_start_matches(['#', '%']).trim());
        let pairs = lines.filter_map(|line| line.split_once(':').or_else(|| line.split_once('=')));
        let said: Vec<_> = pairs.map(|(name, value)| (name.trim().to_owned(), value.trim().to_owned())).collect();
        let find = |names: &[&str]| {
            said.iter().find(|it| names.iter().any(|name| it.0.eq_ignore_ascii_case(name))).map(|it| it.1.as_str())
        };
        Self {
            channel: find(&["Channel", "Kanal"]).map(str::to_owned),
            width: find(&["Width", "Breite"]).and_then(length),
            height: find(&["Height", "Höhe"]).and_then(length),
            value_unit: find(&["Value units", "Werteinheiten"]).and_then(metres),
            column_units: head.last().map(|line| column_units(line)).unwrap_or_default(),
            said,
        }
    }
}

/// The metres of a number with a unit.
fn length(text: &str) -> Option<f64> {
    let (number, unit) = text.trim().split_once(char::is_whitespace)?;
    Some(number.replacen(',', ".", 1).parse::<f64>().ok()? * metres(unit)?)
}

/// Metres in the units in round or square brackets after the names of columns.
fn column_units(line: &str) -> Vec<Option<f64>> {
    let line = line.trim_start_matches(['#', '%']);
    let in_brackets = |name: &str| {
        let start = name.rfind(['(', '['])?;
        let end = start + name[start..].find([')', ']'])?;
        metres(&name[start + 1..end])
    };
    line.split([',', ';', '\t']).map(in_brackets).collect()
}
