//! Numbers in rows of a text.

use super::cells::{Comma, TextCell};
use super::format::malformed;
use super::void::{is_error_of_spreadsheet, is_void};
use crate::sentence::sentence;
use std::io;

/// Characters of a line that a sentence shows.
const SHOWN: usize = 40;

/// Rows in sequence that are a table, whatever stands above them. Fewer of them above a line of text may belong to the head.
const ROWS: usize = 4;
/// Lines of the head that may be repeated among the rows.
const REPEATED: usize = 64;
/// The most columns of a table of positions and heights of a line or of points: where all cells of a row of it are empty, there is no point.
pub(super) const COLUMNS_OF_POINTS: usize = 3;

/// Rows of equally many numbers, and the lines above them.
///
/// Numbers are separated by white space, semicolons, commas or tabs. If they are separated by something else, a comma is a decimal comma. A cell
/// that is empty between two separators is void; an empty last one in every row follows a separator at the end of the lines and is none. The
/// rows begin with the first lines of numbers that no line of text breaks up, and single numbers above rows of several numbers
/// belong to the head; a whole number right above them counts them. Empty lines, those that begin with `#` or `%`, and lines of the head that
/// are repeated among the rows are no rows.
#[derive(Clone)]
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
    /// Whether a column has nothing but empty cells.
    pub is_blank: Vec<bool>,
    /// Whether tabs part the cells.
    pub is_tabbed: bool,
    /// The row with the fewest cells, if they are fewer than the columns: its line and its cells.
    shortest: Option<(usize, usize)>,
}

/// A line that is neither empty nor a remark, and its place from 0 on.
type TextLine<'a> = (usize, &'a str);

impl TextTable {
    /// The table in a text.
    ///
    /// # Errors
    /// For a text without numbers, for rows that are not equally long, and where a comma may be a decimal one or part two numbers.
    pub(crate) fn from_text(text: &str) -> io::Result<Self> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        // tabs at the ends of a line part cells that may be empty
        let all = || text.lines().map(|line| line.trim_matches([' ', '\r', '\u{a0}'])).enumerate();
        let lines = || all().filter(|(_, line)| !is_remark(line));
        let first = first_row(lines()).ok_or_else(|| no_numbers(text))?;
        let first = with_void_rows(lines(), first);
        let (start, count) = below_single_numbers(lines().skip_while(|it| it.0 < first));
        let rows = || lines().skip_while(|it| it.0 < start);
        refuse_doubtful(rows().map(|(_, line)| line))?;
        let head = all().map(|(at, line)| (at, line.trim()));
        let head = head.filter(|(at, line)| !line.is_empty() && (*at < start || is_remark(line)));
        let head: Vec<String> = head.map(|(_, line)| line.to_owned()).collect();
        let read = |comma| {
            let mut table = Self::new(head.clone(), count);
            rows().try_for_each(|(at, line)| table.add(at + 1, line, comma))?;
            table.trim();
            lines().take_while(|it| it.0 < start).try_for_each(|(at, line)| table.pass(at + 1, line, comma))?;
            Ok(table)
        };
        let [parts, decimal] = Comma::KINDS;
        read(parts).or_else(|error| read(decimal).map_err(|_| error))
    }

    /// A table without rows below a head that may say their number.
    fn new(head: Vec<String>, rows: Option<usize>) -> Self {
        let (columns, values, passed, is_blank, is_tabbed, shortest) = (0, Vec::new(), 0, Vec::new(), false, None);
        Self { head, columns, values, rows, passed, is_blank, is_tabbed, shortest }
    }

    /// Passes over a line of the head. One with as many words as a row, most of them numbers and no name in front, is a row with an error in it.
    fn pass(&mut self, place: usize, line: &str, comma: Comma) -> io::Result<()> {
        let cells = comma.cells(line);
        let wrong = cells.iter().find_map(TextCell::word);
        let numbers = cells.iter().filter(|cell| matches!(cell, TextCell::Number(_))).count();
        let is_named = cells.first().and_then(TextCell::word).is_some_and(is_name);
        match wrong {
            Some(word) if cells.len() == self.columns && 2 * numbers >= cells.len() && !is_named => {
                Err(malformed(sentence!("line {place} has {word:?}, which is not a number", place, word)))
            }
            _ => {
                self.passed +=
                    usize::from(wrong.is_none() && numbers > 0 && cells.len() == self.columns && !is_rule(line));
                Ok(())
            }
        }
    }

    /// Adds the numbers of the line at some place, which must be as many as those before, unless it repeats a line of the head. Cells at the end
    /// of a line may be missing where all rows before it have empty ones.
    fn add(&mut self, place: usize, line: &str, comma: Comma) -> io::Result<()> {
        let mut cells = comma.cells(line);
        if let Some(word) = cells.iter().find_map(TextCell::word) {
            if self.head.iter().take(REPEATED).any(|it| it == line.trim()) {
                return Ok(());
            }
            return Err(malformed(sentence!("line {place} has {word:?}, which is not a number", place, word)));
        }
        if self.values.is_empty() {
            self.columns = cells.len();
            self.is_blank = vec![true; cells.len()];
            self.is_tabbed = line.contains('\t') && !line.contains([';', ',']);
        }
        let is_void = cells.iter().all(|cell| *cell == TextCell::Blank);
        if is_void && (self.columns <= COLUMNS_OF_POINTS || cells.len() != self.columns) {
            return Ok(());
        }
        let found = cells.len();
        while cells.len() > self.columns && cells.last() == Some(&TextCell::Blank) {
            cells.pop();
        }
        let is_short = found < self.columns && self.is_blank[found..].iter().all(|it| *it);
        if is_short && self.shortest.is_none_or(|(_, least)| found < least) {
            self.shortest = Some((place, found));
        }
        cells.resize(if is_short { self.columns } else { cells.len() }, TextCell::Blank);
        if cells.len() != self.columns {
            return Err(malformed(sentence!(
                "line {place} has {found} numbers, but the lines before it have {columns}",
                place,
                found,
                columns = self.columns
            )));
        }
        for (column, cell) in cells.into_iter().enumerate() {
            self.is_blank[column] &= cell == TextCell::Blank;
            self.values.push(if let TextCell::Number(number) = cell { number } else { f64::NAN });
        }
        match self.shortest {
            Some((line, cells)) if !self.is_blank[cells..].iter().all(|it| *it) => {
                Err(malformed(format!("line {line} has {cells} numbers, but line {place} has {}", self.columns)))
            }
            _ => Ok(()),
        }
    }

    /// Removes an empty column at the end, which only a separator at the end of each line makes, and one in front, which a tab does.
    fn trim(&mut self) {
        let is_alone = |table: &Self, at: usize| table.columns > 1 && table.is_blank[at];
        if is_alone(self, self.columns - 1) {
            self.remove(self.columns - 1);
        }
        if self.is_tabbed && is_alone(self, 0) {
            self.remove(0);
        }
    }

    /// Removes a column.
    pub(crate) fn remove(&mut self, column: usize) {
        let columns = self.columns;
        let mut place = 0;
        self.values.retain(|_| {
            place += 1;
            (place - 1) % columns != column
        });
        self.columns -= 1;
        self.is_blank.remove(column);
    }

    /// Rows and columns.
    pub(crate) fn shape(&self) -> [usize; 2] {
        [self.values.len() / self.columns, self.columns]
    }

    /// Whether all numbers of a column are the same.
    pub(crate) fn is_constant(&self, column: usize) -> bool {
        self.column(column).all(|number| number == self.values[column])
    }

    /// The numbers of a column.
    pub(crate) fn column(&self, column: usize) -> impl Iterator<Item = f64> + '_ {
        self.values.iter().copied().skip(column).step_by(self.columns)
    }
}

/// Whether a word names what follows: it ends in a colon or an equals sign, or begins with two letters.
fn is_name(word: &str) -> bool {
    let is_word = word.chars().take(2).filter(|letter| letter.is_alphabetic()).count() == 2;
    is_word || (word.len() > 1 && word.ends_with([':', '=']))
}

/// Whether a line is empty or begins with `#` or `%`, and not with a word for a void such as `#NV` or, before a number, `###`.
fn is_remark(line: &str) -> bool {
    if line.is_empty() || !line.starts_with(['#', '%']) {
        return line.is_empty();
    }
    let first = line.split([' ', '\t', ';', ',']).next().unwrap_or_default();
    let is_cell = is_error_of_spreadsheet(first)
        || (is_void(first) && is_row(line) && line.contains(|letter: char| letter.is_ascii_digit()));
    !is_cell
}

/// Whether a line holds numbers and nothing else.
fn is_row(line: &str) -> bool {
    Comma::KINDS.iter().any(|comma| comma.reads(line))
}

/// Whether a line is drawn below the names of columns: it has nothing but dashes, and such.
fn is_rule(line: &str) -> bool {
    line.chars().all(|letter| "-=_+|, ;\t".contains(letter))
}

/// Whether all cells of a line are empty, of which there are more than in a row of points.
fn is_void_row(line: &str) -> bool {
    let words = Comma::Parts.words(line);
    words.len() > COLUMNS_OF_POINTS && words.iter().all(|word| word.is_empty())
}

/// The place of the first row where those above the first number may have no height at all: they do so if nothing else stands above.
fn with_void_rows<'a>(lines: impl Iterator<Item = TextLine<'a>>, first: usize) -> usize {
    let mut above = lines.take_while(|it| it.0 < first).peekable();
    let start = above.peek().map_or(first, |it| it.0);
    if above.all(|(_, line)| is_void_row(line)) { start } else { first }
}

/// The place where the table begins: with the first rows that are enough for one, or else with most rows in sequence.
fn first_row<'a>(lines: impl Iterator<Item = TextLine<'a>>) -> Option<usize> {
    // numbers of rows, and places of the first
    let [mut best, mut run] = [None::<(usize, usize)>; 2];
    let mut has_head = false;
    for (at, line) in lines {
        let is_rule = has_head && run.is_none() && is_rule(line);
        has_head = has_head || !is_row(line);
        run = (is_row(line) && !is_rule).then(|| run.map_or((1, at), |(rows, first)| (rows + 1, first)));
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
    Err(malformed(sentence!(
        "{first:?} may be one number with a decimal comma or two whole ones: write decimal points, or spaces between the numbers",
        first
    )))
}

/// Whether a line such as `1,5` may be one number with a decimal comma or two whole ones.
fn is_doubtful(line: &str) -> bool {
    let is_whole = |part: &str| {
        let digits = part.trim_start_matches(['-', '+']);
        !digits.is_empty() && digits.bytes().all(|letter| letter.is_ascii_digit())
    };
    line.split_once(',').is_some_and(|(one, other)| is_whole(one) && is_whole(other))
}

/// Cells of a line.
fn words(line: &str) -> usize {
    Comma::Parts.words(line).len()
}

fn no_numbers(text: &str) -> io::Error {
    let start: String = text.trim_start().lines().next().unwrap_or_default().chars().take(SHOWN).collect();
    match text.trim().is_empty() {
        true => malformed("it is empty: it contains nothing but white space"),
        false => {
            malformed(sentence!("it is neither a .npy file nor a text of numbers: it begins with {start:?}", start))
        }
    }
}
