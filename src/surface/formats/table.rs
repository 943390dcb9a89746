//! Numbers in rows of a text.

use super::format::malformed;
use std::io;

/// Characters of a line that a sentence shows.
const SHOWN: usize = 40;

/// Words for a value that was not measured, besides `NaN`, in small letters.
const VOIDS: [&str; 10] = ["bad", "--", "---", "n/a", "#n/a", "#nv", "null", "none", "*", "?"];
/// What C libraries of Windows write for numbers that are none, in small letters; digits may follow.
const NO_NUMBERS: [&str; 4] = ["1.#qnan", "1.#snan", "1.#ind", "1.#inf"];
/// Rows in sequence that are a table, whatever stands above them. Fewer of them above a line of text may belong to the head.
const ROWS: usize = 4;
/// Lines of the head that may be repeated among the rows.
const REPEATED: usize = 64;

/// Rows of equally many numbers, and the lines above them.
///
/// Numbers are separated by white space, semicolons or commas. If they are separated by something else, a comma is a
/// decimal comma. The rows begin with the first lines of numbers that no line of text breaks up, and single numbers above rows of several numbers
/// belong to the head; a whole number right above them counts them. Empty lines, those that begin with `#` or `%`, and lines of the head that
/// are repeated among the rows are no rows.
pub(super) struct TextTable {
    /// The lines before the first number, and those that begin with `#` or `%`.
    pub head: Vec<String>,
    /// Numbers of a row.
    pub columns: usize,
    /// The numbers row by row, NaN where none was measured.
    pub values: Vec<f64>,
    /// The number of rows that a line above them says.
    pub rows: Option<usize>,
    /// Rows like those of the table among the lines of the head.
    pub passed: usize,
}

/// A line that is neither empty nor a remark, and its place from 0 on.
type TextLine<'a> = (usize, &'a str);

impl TextTable {
    /// The table in a text.
    ///
    /// # Errors
    /// For a text without numbers, for rows that are not equally long, and where a comma may be a decimal one or part two numbers.
    pub fn from_text(text: &str) -> io::Result<Self> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let all = || text.lines().map(str::trim).enumerate();
        let lines = || all().filter(|(_, line)| !is_remark(line));
        let first = first_row(lines()).ok_or_else(|| no_numbers(text))?;
        let (start, count) = below_single_numbers(lines().skip_while(|it| it.0 < first));
        let rows = || lines().skip_while(|it| it.0 < start);
        refuse_doubtful(rows().map(|(_, line)| line))?;
        let head = all().filter(|(at, line)| !line.is_empty() && (*at < start || is_remark(line)));
        let head: Vec<String> = head.map(|(_, line)| line.to_owned()).collect();
        let read = |comma| {
            let mut table = Self { head: head.clone(), columns: 0, values: Vec::new(), rows: count, passed: 0 };
            rows().try_for_each(|(at, line)| table.add(at + 1, line, comma))?;
            lines().take_while(|it| it.0 < start).try_for_each(|(at, line)| table.pass(at + 1, line, comma))?;
            Ok(table)
        };
        let [parts, decimal] = Comma::KINDS;
        read(parts).or_else(|error| read(decimal).map_err(|_| error))
    }

    /// Passes over a line of the head. One with as many words as a row, most of them numbers and no name in front, is a row with an error in it.
    fn pass(&mut self, place: usize, line: &str, comma: Comma) -> io::Result<()> {
        let words: Vec<Result<f64, &str>> = comma.numbers(line).collect();
        let wrong = words.iter().find_map(|word| word.err());
        let numbers = words.iter().filter(|word| word.is_ok()).count();
        let is_named = words.first().is_some_and(|word| word.is_err_and(is_name));
        match wrong {
            Some(word) if words.len() == self.columns && 2 * numbers >= words.len() && !is_named => {
                Err(malformed(format!("line {place} has {word:?}, which is not a number")))
            }
            _ => {
                self.passed += usize::from(wrong.is_none() && words.len() == self.columns);
                Ok(())
            }
        }
    }

    /// Adds the numbers of the line at some place, which must be as many as those before, unless it repeats a line of the head.
    fn add(&mut self, place: usize, line: &str, comma: Comma) -> io::Result<()> {
        let before = self.values.len();
        for number in comma.numbers(line) {
            match number {
                Ok(number) => self.values.push(number),
                Err(_) if self.head.iter().take(REPEATED).any(|it| it == line) => {
                    self.values.truncate(before);
                    return Ok(());
                }
                Err(word) => return Err(malformed(format!("line {place} has {word:?}, which is not a number"))),
            }
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

    /// The same table without a column.
    pub fn without(mut self, column: usize) -> Self {
        let columns = self.columns;
        let mut place = 0;
        self.values.retain(|_| {
            place += 1;
            (place - 1) % columns != column
        });
        self.columns -= 1;
        self
    }

    /// Rows and columns.
    pub fn shape(&self) -> [usize; 2] {
        [self.values.len() / self.columns, self.columns]
    }

    /// Whether all numbers of a column are the same.
    pub fn is_constant(&self, column: usize) -> bool {
        self.column(column).all(|number| number == self.values[column])
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
        let number = match self {
            Self::Parts => word.parse().ok(),
            Self::Decimal => word.replacen(',', ".", 1).parse().ok(),
        };
        number.or_else(|| is_void(word).then_some(f64::NAN))
    }
}

/// Whether a word stands for a value that was not measured.
fn is_void(word: &str) -> bool {
    let small = word.to_ascii_lowercase().replacen(',', ".", 1);
    let rest = small.trim_start_matches(['-', '+']);
    let is_none = |name: &&str| rest.strip_prefix(*name).is_some_and(|rest| rest.bytes().all(|it| it.is_ascii_digit()));
    VOIDS.contains(&small.as_str()) || NO_NUMBERS.iter().any(is_none)
}

/// Whether a word names what follows: it ends in a colon or an equals sign, or begins with two letters.
fn is_name(word: &str) -> bool {
    let is_word = word.chars().take(2).filter(|letter| letter.is_alphabetic()).count() == 2;
    is_word || (word.len() > 1 && word.ends_with([':', '=']))
}

/// Whether a line is empty or begins with `#` or `%`, and not with a word for a void such as `#NV`.
fn is_remark(line: &str) -> bool {
    let first = || line.split([' ', '\t', ';', ',']).next().unwrap_or_default();
    line.is_empty() || (line.starts_with(['#', '%']) && !is_void(first()))
}

/// Whether a line holds numbers and nothing else.
fn is_row(line: &str) -> bool {
    Comma::KINDS.iter().any(|comma| comma.reads(line))
}

/// The place where the table begins: with the first rows that are enough for one, or else with most rows in sequence.
fn first_row<'a>(lines: impl Iterator<Item = TextLine<'a>>) -> Option<usize> {
    // numbers of rows, and places of the first
    let [mut best, mut run] = [None::<(usize, usize)>; 2];
    for (at, line) in lines {
        run = is_row(line).then(|| run.map_or((1, at), |(rows, first)| (rows + 1, first)));
        best = match (best, run) {
            (Some((most, _)), Some((rows, _))) if rows <= most => best,
            (_, Some(_)) => run,
            (_, None) => best,
        };
        if best.is_some_and(|(rows, _)| rows >= ROWS) {
            break;
        }
    }
    best.map(|it| it.1)
}

/// Where rows of several numbers begin below single numbers or voids, and the whole number right above them, if there are some.
fn below_single_numbers<'a>(lines: impl Iterator<Item = TextLine<'a>> + Clone) -> (usize, Option<usize>) {
    let first = lines.clone().next().map_or(0, |it| it.0);
    let singles = lines.clone().take(ROWS - 1).take_while(|(_, line)| words(line) == 1 && is_row(line));
    let Some((place, (_, last))) = singles.enumerate().last() else { return (first, None) };
    match lines.clone().nth(place + 1) {
        Some((at, line)) if words(line) > 1 && is_row(line) => (at, last.parse().ok()),
        _ => (first, None),
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
    match text.trim().is_empty() {
        true => malformed("it is empty: it contains nothing but white space"),
        false => malformed(format!("it is neither a .npy file nor a text of numbers: it begins with {start:?}")),
    }
}
