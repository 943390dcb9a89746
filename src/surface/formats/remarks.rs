//! What the head of a text of numbers says of them.

use super::unit::metres;

/// Name, size and units in the lines above a table: in the words of Gwyddion's text export, in those of holographic microscopes
/// (`pixel size=3.7e-007 m`, `height conversion factor (-> m)=6.3e-008`, `h=650 w=650`), or as units of columns, in brackets after their
/// names or alone on a line.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Remarks {
    pub channel: Option<String>,
    /// Length along x, in metres.
    pub width: Option<f64>,
    /// Length along y, in metres.
    pub height: Option<f64>,
    /// Distance of neighbours along both axes, in metres.
    pub pixel: Option<f64>,
    /// Rows and columns.
    pub shape: [Option<usize>; 2],
    /// Metres in a unit of heights.
    pub value_unit: Option<f64>,
    /// Metres in a unit of each column.
    pub column_units: Vec<Option<f64>>,
    /// All that is said by name.
    pub said: Vec<(String, String)>,
}

impl Remarks {
    pub fn new(head: &[String]) -> Self {
        let lines = head.iter().map(|line| line.trim_start_matches(['#', '%']).trim());
        let pairs = lines.filter_map(|line| line.split_once(':').or_else(|| line.split_once('=')));
        let said: Vec<_> = pairs.map(|(name, value)| (name.trim().to_owned(), value.trim().to_owned())).collect();
        let find = |names: &[&str]| {
            said.iter().find(|it| names.iter().any(|name| it.0.eq_ignore_ascii_case(name))).map(|it| it.1.as_str())
        };
        let count = |names: &[&str]| {
            let mut words =
                head.iter().flat_map(|line| line.split_whitespace()).filter_map(|word| word.split_once('='));
            words.find(|it| names.contains(&it.0)).and_then(|it| it.1.parse().ok())
        };
        let factor = said.iter().find_map(|(name, value)| {
            let unit = name.strip_prefix("height conversion factor (->")?.strip_suffix(')')?;
            Some(value.parse::<f64>().ok()? * metres(unit)?)
        });
        Self {
            channel: find(&["Channel", "Kanal"]).map(str::to_owned),
            width: find(&["Width", "Breite"]).and_then(length),
            height: find(&["Height", "Höhe"]).and_then(length),
            pixel: find(&["pixel size"]).and_then(length),
            shape: [count(&["h"]), count(&["w"])],
            value_unit: find(&["Value units", "Werteinheiten"]).and_then(metres).or(factor),
            column_units: head
                .iter()
                .rev()
                .map(|line| column_units(line))
                .find(|it| !it.is_empty())
                .unwrap_or_default(),
            said,
        }
    }
}

/// The metres of a number with a unit.
fn length(text: &str) -> Option<f64> {
    let (number, unit) = text.trim().split_once(char::is_whitespace)?;
    Some(number.replacen(',', ".", 1).parse::<f64>().ok()? * metres(unit)?)
}

/// Metres in the units in round or square brackets after the names of columns, or in the units that a line holds alone, such as
/// `µm nm`; none where there are no units.
fn column_units(line: &str) -> Vec<Option<f64>> {
    let line = line.trim_start_matches(['#', '%']).trim();
    let in_brackets = |name: &str| {
        let start = name.rfind(['(', '['])?;
        let end = start + name[start..].find([')', ']'])?;
        metres(&name[start + 1..end])
    };
    let units: Vec<_> = line.split([',', ';', '\t']).map(in_brackets).collect();
    if units.iter().any(Option::is_some) {
        return units;
    }
    let alone: Vec<_> = line.split([' ', ',', ';', '\t']).filter(|word| !word.is_empty()).map(metres).collect();
    if alone.iter().all(Option::is_some) { alone } else { Vec::new() }
}
