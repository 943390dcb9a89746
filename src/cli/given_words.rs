//! Numbers in sentences, in the words in which they were given.

use asperity::error::sentence_of;
use asperity::quantity::{length_of, pressure_of, time_of};
use asperity::sentence::Value;
use std::error::Error;
use std::ffi::OsString;

/// What an error says, where a number has the word of the command line that gave it: `-1MPa` in place of `-1000000.0`. A number that was also
/// given without a unit stays, since that may be meant.
pub(crate) fn in_given_words(error: &(dyn Error + 'static), words: &[OsString]) -> String {
    let words = || words.iter().filter_map(|word| word.to_str());
    let values = || words().map(|word| word.split_once('=').map_or(word, |(_, value)| value));
    let is_plain = |number: f64| values().flat_map(|word| word.split(',')).any(|word| word.parse() == Ok(number));
    let given = |number: f64| values().find(|value| number_of(value) == Some(number)).map(str::to_owned);
    sentence_of(error).in_words(|value| match value {
        Value::Number(number) | Value::Length(number) if !is_plain(*number) => given(*number),
        _ => None,
    })
}

/// The number of a value with a unit.
fn number_of(value: &str) -> Option<f64> {
    let has_unit = value.parse::<f64>().is_err();
    has_unit.then(|| length_of(value).or_else(|| pressure_of(value)).or_else(|| time_of(value)))?
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::error::{GridError, ProblemError, SetupError, SurfaceError};

    #[test]
    fn numbers_are_named_as_they_were_given() {
        let words = ["solve", "--pressure=-1MPa", "--size", "4mm", "--points", "256"].map(OsString::from);
        let said = |error: SetupError| in_given_words(&error, &words);
        let pressure = ProblemError::Negative { name: "mean pressure", value: -1e6 };
        assert_eq!(said(pressure.into()), "the mean pressure is -1MPa: give a finite value that is not negative");
        let length = GridError::Length { axis: "x", length: 0.004 };
        assert_eq!(said(length.into()), "the length along x is 4mm: give a positive, finite length");
        let few = GridError::TooFewPoints { axis: "x", points: 2 };
        assert_eq!(said(few.into()), "2 points along x are too few: give at least 4");
        let words = ["solve", "--size=1m", "--hurst", "1.0,0.5"].map(OsString::from);
        let hurst = SurfaceError::Hurst { value: 1.0 };
        assert_eq!(in_given_words(&hurst, &words), hurst.to_string());
    }
}
