//! Plain text: a number a line, a matrix, or positions and heights.

use super::format::{Format, Wanted, malformed};
use ndarray::{Array2, ArrayD};
use std::fs::File;
use std::io::{self, Read, Seek};

/// Numbers in rows, told apart by white space, semicolons or commas. Lines before the first number, empty ones and those that
/// begin with `#` or `%` are passed over.
pub(super) const FORMAT: Format =
    Format { is_it: is_text, shape: |file, wanted| Ok(read(file, wanted)?.shape().to_vec()), read };

/// Bytes from the start of a file that tell text from anything else.
const START: u64 = 4096;
/// Characters of a line that a sentence shows.
const SHOWN: usize = 40;

/// Whether a file begins with text, in any encoding of one byte for each letter of ours.
fn is_text(file: &mut File) -> bool {
    let mut start = Vec::new();
    let is_read = file.rewind().is_ok() && file.take(START).read_to_end(&mut start).is_ok();
    is_read && !start.is_empty() && !start.iter().any(is_control)
}

/// Whether a byte stands in no text.
fn is_control(byte: &u8) -> bool {
    *byte < b'\t'
}

/// The numbers: of one column or row a line, else a matrix, row by row.
fn read(file: &mut File, _: &Wanted) -> io::Result<ArrayD<f64>> {
    let mut bytes = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    if bytes.iter().any(is_control) {
        return Err(malformed("it is no .npy file, and not all of it is text"));
    }
    let rows = rows(&String::from_utf8_lossy(&bytes))?;
    let shape = (rows.len(), rows[0].len());
    let matrix = Array2::from_shape_vec(shape, rows.concat()).map_err(|error| malformed(error.to_string()))?;
    Ok(match shape {
        (_, 1) => matrix.column(0).to_owned().into_dyn(),
        (1, _) => matrix.row(0).to_owned().into_dyn(),
        _ => matrix.into_dyn(),
    })
}

/// The numbers, row by row, at least one row and each as long as the first.
fn rows(text: &str) -> io::Result<Vec<Vec<f64>>> {
    let lines: Vec<(usize, &str)> = lines(text).collect();
    let Some((_, first)) = lines.first() else {
        let start: String = text.trim_start().lines().next().unwrap_or_default().chars().take(SHOWN).collect();
        let reason = "it is no .npy file, and no text of numbers with decimal points either: it begins with";
        return Err(malformed(format!("{reason} {start:?}")));
    };
    if lines.iter().all(|(_, line)| is_doubtful(line)) {
        let reason =
            "may be one number with a decimal comma or two whole ones: write points for commas, or spaces between";
        return Err(malformed(format!("{first:?} {reason}")));
    }
    let columns = numbers(first).map_or(0, |numbers| numbers.len());
    lines.into_iter().map(|(place, line)| row(place, line, columns)).collect()
}

/// The lines that may hold numbers and their places, from the first line on that holds nothing else.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
    let lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with(['#', '%']));
    lines.skip_while(|(_, line)| numbers(line).is_err())
}

/// The numbers of the line at some place, which must be so many.
fn row(place: usize, line: &str, columns: usize) -> io::Result<Vec<f64>> {
    let row = numbers(line).map_err(|word| malformed(format!("line {place} holds {word:?}, which is no number")))?;
    if row.len() == columns {
        Ok(row)
    } else {
        Err(malformed(format!("line {place} holds {} numbers, those before it {columns}", row.len())))
    }
}

/// The numbers of a line, or the first word that is none. Commas part words that nothing else does.
fn numbers(line: &str) -> Result<Vec<f64>, &str> {
    let is_gap = |c: char| c.is_whitespace() || c == ';';
    let words = || line.split(is_gap).filter(|word| !word.is_empty());
    let parse = |word| str::parse(word).map_err(|_| word);
    match words().count() {
        1 => line.split(',').map(parse).collect(),
        _ => words().map(|word| parse(word.strip_suffix(',').unwrap_or(word))).collect(),
    }
}

/// Whether a line such as `1,5` may be one number with a decimal comma or two whole ones.
fn is_doubtful(line: &str) -> bool {
    line.split_once(',').is_some_and(|(a, b)| {
        [a, b].iter().all(|part| part.trim_start_matches(['-', '+']).bytes().all(|c| c.is_ascii_digit()))
    })
}
