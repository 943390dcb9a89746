//! Names and values in the head of a text.

use super::cells::{Comma, TextCell};
use super::unit::metres;

/// Units that a name may end in, as in `pixel_size_um`.
const ENDINGS: [&str; 5] = ["um", "nm", "mm", "µm", "μm"];

/// What a head says by name, in these ways: `name: value`, `name = value`, cells `name, value, unit`, words `name 0.5`, and a line of names
/// above a line of as many numbers.
pub(super) fn said(head: &[String]) -> Vec<(String, String)> {
    let lines: Vec<&str> = head.iter().map(|line| line.trim_start_matches(['#', '%']).trim()).collect();
    let mut said: Vec<(String, String)> = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        match lines.get(at + 1).map(|below| columns(line, below)) {
            Some(columns) if !columns.is_empty() => said.extend(columns),
            _ => said.extend(pair(line)),
        }
    }
    said
}

/// The name and the value of a line.
fn pair(line: &str) -> Option<(String, String)> {
    let owned = |name: &str, value: &str| (name.trim().to_owned(), value.trim().to_owned());
    if let Some((name, value)) = line.split_once(':').or_else(|| line.split_once('=')) {
        return Some(owned(name.trim_matches('"'), value));
    }
    let words: Vec<&str> = Comma::Parts.words(line);
    let cells = cells(line);
    if let [name, rest @ ..] = &cells[..]
        && (1..=2).contains(&rest.len())
        && begins_with_letter(name)
        // the comma of `step 0,5` is a decimal one
        && !name.contains(|letter: char| letter.is_ascii_digit())
    {
        let value = rest.join(" ");
        return (!value.trim().is_empty()).then(|| owned(name, &value));
    }
    let place = words.iter().position(|word| matches!(Comma::Decimal.cells(word)[..], [TextCell::Number(_)]))?;
    let (name, value) = (words[..place].join(" "), words[place..].join(" "));
    (begins_with_letter(&name) && words.len() <= place + 2).then(|| owned(&name, &value))
}

/// The cells of a line in the head: parted by tabs, semicolons or commas, the first of these that it has, or, if some are in quotes, as in rows.
fn cells(line: &str) -> Vec<&str> {
    if line.contains('"') {
        return Comma::Parts.words(line);
    }
    let separator = ['\t', ';', ','].into_iter().find(|it| line.contains(*it));
    separator.map_or(vec![line], |separator| line.split(separator).map(str::trim).collect())
}

/// The names of a line and the numbers below them, none if they are not as many.
fn columns(names: &str, numbers: &str) -> Vec<(String, String)> {
    let parted = |line: &str| -> Vec<String> {
        let words = Comma::Decimal.words(line).into_iter();
        words.map(str::to_owned).collect()
    };
    let by_tabs: Vec<String> = names.split('\t').map(|name| name.trim().to_owned()).collect();
    let values = parted(numbers);
    let names = if by_tabs.len() == values.len() { by_tabs } else { parted(names) };
    let is_table = values.len() > 1
        && names.len() == values.len()
        && names.iter().all(|name| begins_with_letter(name))
        && Comma::Decimal.reads(numbers);
    if is_table { names.into_iter().zip(values).collect() } else { Vec::new() }
}

fn begins_with_letter(name: &str) -> bool {
    name.trim().starts_with(char::is_alphabetic)
}

/// A name in small letters without its unit, white space and marks: `pixelsize` for `Pixel size (um)` and `pixel_size_um`.
pub(super) fn plain(name: &str) -> String {
    let bare = name.split(['(', '[', '{']).next().unwrap_or_default().trim();
    let bare = bare.split_once(" in ").map_or(bare, |it| it.0);
    let bare = ENDINGS.iter().find_map(|unit| bare.strip_suffix(unit)?.strip_suffix(['_', ' ', '/'])).unwrap_or(bare);
    bare.chars().filter(|letter| letter.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Metres in the unit of a name: in brackets, behind `in`, or at its end.
pub(super) fn unit_of(name: &str) -> Option<f64> {
    let in_brackets = || metres(name.split(['(', '[', '{']).nth(1)?.split([')', ']', '}']).next()?);
    let behind_in = || metres(name.rsplit_once(" in ")?.1);
    let at_end = || {
        let unit = ENDINGS
            .iter()
            .find(|unit| name.trim().ends_with(&format!("_{unit}")) || name.trim().ends_with(&format!("/{unit}")));
        unit.and_then(|unit| metres(unit))
    };
    in_brackets().or_else(behind_in).or_else(at_end)
}

/// One number or two, such as `0.5 x 0.25`, and the metres in the unit behind them.
pub(super) fn numbers(text: &str) -> Option<(Vec<f64>, Option<f64>)> {
    let text = text.replace(['(', ')', '[', ']', '{', '}', '×', '*', '"'], " ");
    let mut numbers = Vec::new();
    let mut unit = None;
    for word in text.split_whitespace() {
        let word = word.trim_end_matches([',', ';']);
        let end = word.find(|letter: char| letter.is_alphabetic() && !"eE".contains(letter)).unwrap_or(word.len());
        let number = word[..end].replacen(',', ".", 1).parse::<f64>().ok();
        match (number, &word[end..]) {
            (Some(number), "") => numbers.push(number),
            (Some(number), letters) => {
                unit = Some(metres(letters)?);
                numbers.push(number);
            }
            (None, _) if word == "x" => {}
            // words behind the unit say something else, such as a date
            (None, _) => {
                unit = Some(metres(word)?);
            }
        }
    }
    (1..=2).contains(&numbers.len()).then_some((numbers, unit))
}
