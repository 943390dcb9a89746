//! Letters as the lines that fill them. Each letter is filled once in a process.

use super::fill;
use crate::plot::{letters, width};
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

/// Distance of the lines that fill a letter, over its size. Every letter has two of them at least: those of a minus are together as high as a pixel
/// in the smallest windows, so that it is never left out.
const PITCH: f64 = 0.052;
/// Radius of the lines, over the size of the letters.
pub(crate) const RADIUS: f32 = 0.036;
/// The size in which letters are filled.
const SIZE: f64 = 100.0;
/// The step to which ends of lines are rounded, over their distance: the same numbers take less room in a file.
const FINE: f64 = 0.125;

/// The lines of a letter of the size [`SIZE`] from where it starts, and from there to where the next one starts.
struct FilledLetter {
    lines: Vec<[[f64; 2]; 2]>,
    advance: f64,
}

/// The letters that were filled so far.
static FILLED: LazyLock<Mutex<HashMap<char, Arc<FilledLetter>>>> = LazyLock::new(Mutex::default);

/// The lines that fill the letters of words of a size: right and down from the start of the words, half-way up the letters.
pub(crate) fn letter_lines(words: &str, size: f64) -> Vec<[[f32; 2]; 2]> {
    let (scale, step) = (size / SIZE, FINE * PITCH * size);
    let rounded = |place: f64| ((place / step).round() * step) as f32;
    let mut start = 0.0;
    let mut lines = Vec::new();
    for letter in words.chars() {
        let place = |[x, y]: [f64; 2]| [rounded(start + scale * x), rounded(scale * y)];
        let filled = filled(letter);
        lines.extend(filled.lines.iter().map(|line| line.map(place)));
        start += scale * filled.advance;
    }
    lines
}

fn filled(letter: char) -> Arc<FilledLetter> {
    let mut all = FILLED.lock().unwrap_or_else(PoisonError::into_inner);
    let fill = || {
        let (buffer, pitch) = (&mut [0; 4], PITCH * SIZE);
        let letter = &*letter.encode_utf8(buffer);
        let lines = letters(letter, SIZE).iter().flat_map(|shape| fill::spans(shape, pitch)).collect();
        Arc::new(FilledLetter { lines, advance: width(letter, SIZE) })
    };
    Arc::clone(all.entry(letter).or_insert_with(fill))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_words_stand_one_behind_the_other() {
        let words = letter_lines("AA", 10.0);
        let one = letter_lines("A", 10.0);
        // ends are rounded to steps of 0.065
        let (advance, step) = (width("A", 10.0) as f32, (FINE * PITCH * 10.0) as f32);
        assert_eq!(words.len(), 2 * one.len());
        for (first, second) in one.iter().zip(&words[one.len()..]) {
            for (from, to) in first.iter().zip(second) {
                assert!((to[0] - from[0] - advance).abs() <= 1.01 * step && to[1] == from[1], "{first:?} {second:?}");
            }
        }
        assert!(letter_lines(" ", 10.0).is_empty());
    }
}
