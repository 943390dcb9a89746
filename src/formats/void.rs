//! Words that stand for heights that were not measured.

/// Words for a value that was not measured, in small letters; `NaN` and infinities are numbers.
const WORDS: [&str; 42] = [
    "bad",
    "n/a",
    "na",
    "n.a.",
    "<na>",
    "null",
    "(null)",
    "nil",
    "none",
    "nodata",
    "no_data",
    "no-data",
    "nd",
    "n.d.",
    "void",
    "invalid",
    "missing",
    "masked",
    "undefined",
    "undef",
    "empty",
    "blank",
    "unmeasured",
    "out",
    "oor",
    "outofrange",
    "over",
    "ovr",
    "ovf",
    "ovrflw",
    "overflow",
    "overrange",
    "under",
    "underflow",
    "underrange",
    "lost",
    "dropout",
    "sat",
    "saturated",
    "err",
    "error",
    "fail",
];
/// Words of spreadsheets that do not end in a mark of their own.
const OF_SPREADSHEETS: [&str; 3] = ["#n/a", "#nv", "#na"];
/// Letters of which a word for a void may consist: `-`, `--.--`, `***`, `?`, `.`.
const MARKS: [char; 9] = ['-', '*', '?', '.', '~', '_', '\u{2013}', '\u{2014}', '\u{2212}'];

/// Whether a word stands for a value that was not measured.
pub(super) fn is_void(word: &str) -> bool {
    if word.is_empty() {
        return false;
    }
    let only = |marks: &[char]| word.chars().all(|letter| marks.contains(&letter));
    if only(&MARKS) || (word.len() > 1 && only(&['#'])) {
        return true;
    }
    let small = word.to_ascii_lowercase().replacen(',', ".", 1);
    WORDS.contains(&small.as_str()) || is_error_of_spreadsheet(&small) || is_no_number(&small)
}

/// Whether a word in small letters is an error of a spreadsheet, such as `#DIV/0!`.
pub(super) fn is_error_of_spreadsheet(word: &str) -> bool {
    let word = word.to_ascii_lowercase();
    OF_SPREADSHEETS.contains(&word.as_str()) || (word.len() > 2 && word.starts_with('#') && word.ends_with(['!', '?']))
}

/// Whether a word in small letters is what libraries of C write for a number that is none: `-nan(ind)`, `1.#QNAN`, and `1.#J` where the
/// latter is rounded to few digits.
fn is_no_number(small: &str) -> bool {
    let rest = small.trim_start_matches(['-', '+']);
    let behind_nan =
        rest.strip_prefix("nan").or_else(|| rest.strip_prefix("snan")).or_else(|| rest.strip_prefix("qnan"));
    let is_nan =
        behind_nan.is_some_and(|it| it.is_empty() || (it.starts_with('(') && it.ends_with(')')) || is_digits(it));
    is_nan || rest.starts_with("1.#")
}

fn is_digits(text: &str) -> bool {
    text.bytes().all(|it| it.is_ascii_digit())
}
