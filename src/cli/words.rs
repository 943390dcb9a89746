//! The words of a command line.

use std::ffi::{OsStr, OsString};

/// Beginnings of numbers in words, besides digits and points.
const NUMBER_WORDS: [&str; 2] = ["inf", "nan"];

/// Joins each negative number with the flag before it, such as `--creepage -1e-4` to `--creepage=-1e-4`. The parser would read it as
/// another flag.
pub(crate) fn with_negative_numbers(words: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut joined: Vec<OsString> = Vec::new();
    let mut are_flags_over = false;
    for word in words {
        are_flags_over |= word == "--";
        match joined.last_mut().filter(|last| !are_flags_over && is_flag(last) && is_negative(&word)) {
            Some(flag) => {
                flag.push("=");
                flag.push(word);
            }
            None => joined.push(word),
        }
    }
    joined
}

/// Whether a word is a long flag without its value.
fn is_flag(word: &OsStr) -> bool {
    let name = word.to_str().and_then(|word| word.strip_prefix("--"));
    name.is_some_and(|name| !name.is_empty() && !name.contains('='))
}

/// Whether a word is a negative number, or a list, a range or a quantity that begins with one.
fn is_negative(word: &OsStr) -> bool {
    let rest = word.to_str().and_then(|word| word.strip_prefix('-'));
    rest.is_some_and(|rest| {
        let is_name = |name: &&str| rest.get(..name.len()).is_some_and(|word| word.eq_ignore_ascii_case(name));
        rest.starts_with(|c: char| c.is_ascii_digit() || c == '.') || NUMBER_WORDS.iter().any(is_name)
    })
}
