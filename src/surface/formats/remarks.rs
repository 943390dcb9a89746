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
    /// The names of the columns in small letters, if a line has one for each.
    pub column_names: Vec<String>,
    /// All that is said by name.
    pub said: Vec<(String, String)>,
}

impl Remarks {
    /// What a head says of a table with so many columns.
    pub fn new(head: &[String], columns: usize) -> Self {
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
                .map(|line| column_units(line, columns))
                .find(|it| !it.is_empty())
                .unwrap_or_default(),
            column_names: head.iter().rev().find_map(|line| column_names(line, columns)).unwrap_or_default(),
            said,
        }
    }
}

/// The metres of a number with a unit.
fn length(text: &str) -> Option<f64> {
    let (number, unit) = text.trim().split_once(char::is_whitespace)?;
    Some(number.replacen(',', ".", 1).parse::<f64>().ok()? * metres(unit)?)
}

/// Metres in the units of columns: in round or square brackets after their names, as the last words of their names, as in `x in µm`, or alone on
/// a line, such as `µm nm`; none where there are no units.
fn column_units(line: &str, columns: usize) -> Vec<Option<f64>> {
    let line = line.trim_start_matches(['#', '%']).trim();
    let names: Vec<&str> = line.split([',', ';', '\t']).collect();
    let each: Vec<_> = names.iter().map(|name| in_brackets(name).pop().flatten()).collect();
    if names.len() > 1 && each.iter().any(Option::is_some) {
        return each;
    }
    let all = [in_brackets(line), last_words(&names), behind_names(line)];
    if let Some(units) = all.into_iter().find(|it| it.len() == columns) {
        return units;
    }
    let alone: Vec<_> = line.split([' ', ',', ';', '\t']).filter(|word| !word.is_empty()).map(metres).collect();
    if alone.iter().all(Option::is_some) { alone } else { each.into_iter().filter(Option::is_some).collect() }
}

/// Metres in a word that is a unit, and hardly another word.
fn unit_word(word: &str) -> Option<f64> {
    metres(word).filter(|_| !["A", "in"].contains(&word))
}

/// Metres in the units in all brackets of a text; nothing if none of them is a unit of length.
fn in_brackets(text: &str) -> Vec<Option<f64>> {
    let parts = text.split(['(', '[']).skip(1).filter_map(|part| part.split_once([')', ']']));
    let units: Vec<_> = parts.map(|it| metres(it.0)).collect();
    if units.iter().any(Option::is_some) { units } else { Vec::new() }
}

/// Metres in the units that all names of several words end in, such as `Lateral um`; nothing if one ends otherwise, or none has several words.
fn last_words(names: &[&str]) -> Vec<Option<f64>> {
    let unit = |name: &&str| name.trim().trim_matches('"').rsplit_once(char::is_whitespace).map(|it| unit_word(it.1));
    let units: Vec<_> = names.iter().map(unit).collect();
    let is_known = units.iter().flatten().all(Option::is_some) && units.iter().any(Option::is_some);
    if is_known { units.into_iter().map(Option::flatten).collect() } else { Vec::new() }
}

/// Metres in the units among the words of a line, each behind a name, as in `x in µm z in nm`.
fn behind_names(line: &str) -> Vec<Option<f64>> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let is_behind = |pair: &&[&str]| unit_word(pair[0]).is_none() && unit_word(pair[1]).is_some();
    words.windows(2).filter(is_behind).map(|pair| metres(pair[1])).collect()
}

/// The names of so many columns in small letters, if a line has them: parted by commas, semicolons and tabs, or by white space.
fn column_names(line: &str, columns: usize) -> Option<Vec<String>> {
    let line = line.trim_start_matches(['#', '%']).trim();
    let plain = |name: &str| name.trim().trim_matches('"').to_lowercase();
    let parted: Vec<String> = line.split([',', ';', '\t']).map(plain).collect();
    let words = || line.split_whitespace().map(plain).collect::<Vec<_>>();
    let names = if parted.len() == columns { parted } else { words() };
    let is_name = |name: &String| name.starts_with(char::is_alphabetic);
    (names.len() == columns && names.iter().all(is_name)).then_some(names)
}
