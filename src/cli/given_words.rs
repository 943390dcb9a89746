//! Numbers in sentences, in the words in which they were given.

use asperity::quantity::{length_of, pressure_of, time_of};
use std::ffi::OsString;

/// Words before a number that is a bound, and not one that was given.
const BEFORE_BOUNDS: [&str; 6] = ["at most ", "at least ", "than ", "from ", "to ", "between "];

/// A sentence about a number, with the word of the command line that gave it: `-1MPa` in place of `-1000000.0`. A bound stays, and so does a
/// number that was also given without a unit, since that may be meant.
pub(crate) fn in_given_words(sentence: String, words: &[OsString]) -> String {
    let values =
        || words.iter().filter_map(|word| word.to_str()).map(|word| word.split_once('=').map_or(word, |it| it.1));
    let is_plain = |number: f64| values().flat_map(|word| word.split(',')).any(|word| word.parse() == Ok(number));
    values().fold(sentence, |sentence, value| match number_of(value).filter(|number| !is_plain(*number)) {
        Some(number) => replaced(&sentence, &format!("{number:?}"), value),
        None => sentence,
    })
}

/// The number of a value with a unit.
fn number_of(value: &str) -> Option<f64> {
    let has_unit = value.parse::<f64>().is_err();
    has_unit.then(|| length_of(value).or_else(|| pressure_of(value)).or_else(|| time_of(value)))?
}

/// A sentence with other words for a number, where it is neither a bound nor a part of another one.
fn replaced(sentence: &str, number: &str, words: &str) -> String {
    let is_part = |letter: Option<char>| letter.is_some_and(|it| it.is_alphanumeric() || matches!(it, '.' | '-'));
    let mut pieces = sentence.split(number);
    let mut whole = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let is_bound = BEFORE_BOUNDS.iter().any(|words| whole.ends_with(words));
        let is_other = is_bound || is_part(whole.chars().last()) || is_part(piece.chars().next());
        whole += if is_other { number } else { words };
        whole += piece;
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_named_as_they_were_given() {
        let words = ["solve", "--pressure=-1MPa", "--size", "4mm", "--points", "256"].map(OsString::from);
        let of = |sentence: &str| in_given_words(sentence.into(), &words);
        assert_eq!(of("the mean pressure is -1000000.0: give more"), "the mean pressure is -1MPa: give more");
        assert_eq!(of("the length is 0.004, of 256"), "the length is 4mm, of 256");
        assert_eq!(of("it is 0.0041, 10.004, -0.004 or 0.004e3"), "it is 0.0041, 10.004, -0.004 or 0.004e3");
        assert_eq!(of("the ratio is 2.0: give at most 0.004"), "the ratio is 2.0: give at most 0.004");
        let words = ["solve", "--size=1m", "--hurst", "1.0,0.5"].map(OsString::from);
        assert_eq!(in_given_words("the Hurst exponent is 1.0".into(), &words), "the Hurst exponent is 1.0");
    }
}
