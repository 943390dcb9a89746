//! Numbers in rows of a text.

use super::format::malformed;
use std::io;

/// Characters of a line that a sentence shows.
const SHOWN: usize = 40;

/// Words for a value that was not measured, besides `NaN`.
const VOIDS: [&str; 4] = ["BAD", "---", "N/A", "#N/A"];

/// Rows of equally many numbers, and the lines above them.
///
/// Numbers are separated by white space, semicolons or commas. If they are separated by something else, a comma is a
/// decimal comma. Lines before the first row are the head, and so is a whole number on a line of its own above rows of
/// several numbers, which counts them; empty lines and those that begin with `#` or `%` are no rows anywhere.
pub(super) struct TextTable {
    /// The lines before the first number, and those that begin with `#` or `%`.
    pub head: Vec<String>,
    /// Numbers of a row.
    pub columns: usize,
    /// The numbers row by row, NaN where none was measured.
    pub values: Vec<f64>,
    /// The number of rows that a line above them says.
    pub rows: Option<usize>,
}

impl TextTable {
    /// The table in a text.
    ///
    /// # Errors
    /// For a text without numbers, for rows that are not equally long, and where a comma may be a decimal one or part two numbers.
    pub fn from_text(text: &str) -> io::Result<Self> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let is_remark = |line: &str| line.is_empty() || line.starts_with(['#', '%']);
        let lines = || text.lines().map(str::trim).enumerate();
        let is_row = |line: &str| !is_remark(line) && Comma::KINDS.iter().any(|comma| comma.reads(line));
        let Some((first, _)) = lines().find(|(_, line)| is_row(line)) else { return Err(no_numbers(text)) };
        let mut rows = lines().skip(first).filter(|(_, line)| !is_remark(line));
        let count = rows.next().and_then(|(_, line)| line.parse::<usize>().ok());
        let next = rows.next().filter(|(_, line)| words(line) > 1 && is_row(line)).map(|(at, _)| at);
        let (start, count) = count.zip(next).map_or((first, None), |(count, next)| (next, Some(count)));
        let rows = || lines().skip(start).filter(|(_, line)| !is_remark(line));
        refuse_doubtful(rows().map(|(_, line)| line))?;
        let head = || lines().filter(|(at, line)| !line.is_empty() && (*at < start || is_remark(line)));
        let read = |comma| {
            let head = head().map(|(_, line)| line.to_owned()).collect();
            let mut table = Self { head, columns: 0, values: Vec::new(), rows: count };
            rows().try_for_each(|(at, line)| table.add(at + 1, line, comma))?;
            lines()
                .take(first)
                .filter(|(_, line)| !is_remark(line))
                .try_for_each(|(at, line)| table.refuse_row(at + 1, line, comma))?;
            Ok(table)
        };
        let [parts, decimal] = Comma::KINDS;
        read(parts).or_else(|error| read(decimal).map_err(|_| error))
    }

    /// Refuses a line of the head that has as many words as a row, most of them numbers: it is a row with an error in it.
    fn refuse_row(&self, place: usize, line: &str, comma: Comma) -> io::Result<()> {
        let words: Vec<Result<f64, &str>> = comma.numbers(line).collect();
        let wrong = words.iter().find_map(|word| word.err());
        let numbers = words.iter().filter(|word| word.is_ok()).count();
        match wrong {
            Some(word) if words.len() == self.columns && 2 * numbers >= words.len() => {
                Err(malformed(format!("line {place} has {word:?}, which is not a number")))
            }
            _ => Ok(()),
        }
    }

    /// Adds the numbers of the line at some place, which must be as many as those before.
    fn add(&mut self, place: usize, line: &str, comma: Comma) -> io::Result<()> {
        let before = self.values.len();
        for number in comma.numbers(line) {
            let wrong = |word| malformed(format!("line {place} has {word:?}, which is not a number"));
            self.values.push(number.map_err(wrong)?);
        }
        let found = self.values.len() - before;
        if before == 0 {
            self.columns = found;
        }
        if found == self.columns {
            return Ok(());
        }
        Err(malformed(format!("line {place} has {found} numbers, but the lines before it have {}", self.columns)))
    }

    /// Rows and columns.
    pub fn shape(&self) -> [usize; 2] {
        [self.values.len() / self.columns, self.columns]
    }

    /// The numbers of a column.
    pub fn column(&self, column: usize) -> impl Iterator<Item = f64> + '_ {
        self.values.iter().copied().skip(column).step_by(self.columns)
    }
}

/// What a comma means.
#[derive(Clone, Copy)]
enum Comma {
    /// It parts numbers.
    Parts,
    /// It is a decimal point.
    Decimal,
}

impl Comma {
    const KINDS: [Self; 2] = [Self::Parts, Self::Decimal];

    /// Whether a line holds numbers and nothing else.
    fn reads(self, line: &str) -> bool {
        let mut numbers = self.numbers(line).peekable();
        numbers.peek().is_some() && numbers.all(|it| it.is_ok())
    }

    /// The numbers of a line, words that are none as errors.
    fn numbers(self, line: &str) -> impl Iterator<Item = Result<f64, &str>> {
        let is_gap = |c: char| c.is_whitespace() || c == ';';
        let is_one = line.split(is_gap).filter(|word| !word.is_empty()).nth(1).is_none();
        let splits = move |c: char| is_gap(c) || (is_one && c == ',' && matches!(self, Self::Parts));
        let words = line.split(splits).filter(|word| !word.is_empty());
        words.map(move |word| self.number(word.strip_suffix(',').unwrap_or(word)).ok_or(word))
    }

    fn number(self, word: &str) -> Option<f64> {
        let word = word.trim_matches('"');
        if VOIDS.contains(&word) {
            return Some(f64::NAN);
        }
        match self {
            Self::Parts => word.parse().ok(),
            Self::Decimal => word.replacen(',', ".", 1).parse().ok(),
        }
    }
}

/// Refuses a text in which every line may be one number with a decimal comma or two whole ones.
fn refuse_doubtful<'a>(mut lines: impl Iterator<Item = &'a str> + Clone) -> io::Result<()> {
    let first = lines.clone().next().unwrap_or_default();
    if !lines.all(is_doubtful) {
        return Ok(());
    }
    let reason =
        "may be one number with a decimal comma or two whole ones: write decimal points, or spaces between the numbers";
    Err(malformed(format!("{first:?} {reason}")))
}

/// Whether a line such as `1,5` may be one number with a decimal comma or two whole ones.
fn is_doubtful(line: &str) -> bool {
    line.split_once(',').is_some_and(|(a, b)| {
        [a, b].iter().all(|part| part.trim_start_matches(['-', '+']).bytes().all(|c| c.is_ascii_digit()))
    })
}

/// Words of a line.
fn words(line: &str) -> usize {
    line.split([' ', '\t', ';', ',']).filter(|word| !word.is_empty()).count()
}

fn no_numbers(text: &str) -> io::Error {
    let start: String = text.trim_start().lines().next().unwrap_or_default().chars().take(SHOWN).collect();
    malformed(format!("it is neither a .npy file nor a text of numbers: it begins with {start:?}"))
}
