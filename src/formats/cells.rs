//! The cells of a line of a text, and the numbers in them.

use super::void::is_void;

/// What a comma between two letters means.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Comma {
    /// It parts numbers.
    Parts,
    /// It is a decimal point.
    Decimal,
}

/// What a cell holds.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum TextCell<'a> {
    /// A number, or NaN for a word that stands for a void.
    Number(f64),
    /// Nothing, between two separators.
    Blank,
    /// Any other word.
    Word(&'a str),
}

impl<'a> TextCell<'a> {
    /// The word in a cell that holds neither a number nor nothing.
    pub(crate) fn word(&self) -> Option<&'a str> {
        match self {
            Self::Word(word) => Some(word),
            _ => None,
        }
    }
}

impl Comma {
    pub(crate) const KINDS: [Self; 2] = [Self::Parts, Self::Decimal];

    /// Whether a line holds numbers and blank cells and nothing else, and at least one number.
    pub(crate) fn reads(self, line: &str) -> bool {
        let cells = self.cells(line);
        let has_number = cells.iter().any(|cell| matches!(cell, TextCell::Number(_)));
        has_number && !cells.iter().any(|cell| matches!(cell, TextCell::Word(_)))
    }

    /// The cells of a line.
    pub(crate) fn cells(self, line: &str) -> Vec<TextCell<'_>> {
        self.words(line).into_iter().map(|word| self.cell(word)).collect()
    }

    /// The words of a line without quotes, empty ones where nothing stands between two separators. Semicolons, commas or tabs part them, the
    /// first of these that the line has; and white space does, which leaves no cell empty.
    pub(crate) fn words(self, line: &str) -> Vec<&str> {
        // a comma inside of a word parts numbers only where no white space does so
        let is_one = self == Self::Parts && !has_gap(line.trim());
        let parts = |at: usize| is_one || is_beside_gap(line, at);
        let Some(separator) = separator(line, parts) else { return joined(line.split_whitespace().collect()) };
        let mut words = Vec::new();
        let [mut start, mut is_quoted] = [0, 0];
        for (at, letter) in line.bytes().enumerate() {
            is_quoted ^= usize::from(letter == b'"');
            let is_end = letter == separator && is_quoted == 0 && (letter != b',' || parts(at));
            if is_end {
                add_words(&line[start..at], &mut words);
                start = at + 1;
            }
        }
        add_words(&line[start..], &mut words);
        words
    }

    fn cell(self, word: &str) -> TextCell<'_> {
        match self.number(word) {
            _ if word.is_empty() => TextCell::Blank,
            Some(number) => TextCell::Number(number),
            None => TextCell::Word(word),
        }
    }

    /// The number that a word is, NaN for one that stands for a void.
    fn number(self, word: &str) -> Option<f64> {
        let number = match self {
            Self::Parts => word.parse().ok(),
            Self::Decimal => word.replacen(',', ".", 1).parse().ok(),
        };
        number.or_else(|| is_void(word).then_some(f64::NAN)).or_else(|| self.foreign(word))
    }

    /// A number as Fortran writes it, `1.5D-03`, or with the minus sign of typesetters.
    fn foreign(self, word: &str) -> Option<f64> {
        let plain = word.replacen('\u{2212}', "-", 2).replacen(['d', 'D'], "e", 1);
        (plain != word).then(|| self.number(&plain)).flatten()
    }
}

/// Whether white space stands in a line other than between two letters, as it does in `no data`.
fn has_gap(line: &str) -> bool {
    let mut before = ' ';
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        let is_between_letters = before.is_alphabetic() && letters.peek().is_some_and(|it| it.is_alphabetic());
        if letter.is_whitespace() && !is_between_letters {
            return true;
        }
        before = letter;
    }
    false
}

/// The letter that parts the cells of a line, none for white space, if so does a comma at some places.
fn separator(line: &str, parts: impl Fn(usize) -> bool) -> Option<u8> {
    let [mut has_comma, mut has_tab, mut is_quoted] = [false; 3];
    for (at, letter) in line.bytes().enumerate() {
        match letter {
            b'"' => is_quoted = !is_quoted,
            _ if is_quoted => {}
            b';' => return Some(b';'),
            b',' => has_comma = has_comma || parts(at),
            b'\t' => has_tab = true,
            _ => {}
        }
    }
    if has_comma { Some(b',') } else { has_tab.then_some(b'\t') }
}

/// Whether a comma stands beside white space, a quote, another comma or an end of the line, where no number has its decimal comma.
fn is_beside_gap(line: &str, at: usize) -> bool {
    let bytes = line.as_bytes();
    let is_gap = |letter: Option<&u8>| letter.is_none_or(|it| it.is_ascii_whitespace() || [b'"', b','].contains(it));
    is_gap(bytes.get(at + 1)) || is_gap(at.checked_sub(1).and_then(|before| bytes.get(before)))
}

/// Adds the words of a cell: none but itself if it is in quotes or empty.
fn add_words<'a>(cell: &'a str, words: &mut Vec<&'a str>) {
    let cell = cell.trim();
    let bare = cell.trim_matches('"').trim();
    if bare.is_empty() || bare.len() < cell.len() {
        return words.push(bare);
    }
    words.extend(joined(cell.split_whitespace().map(|word| word.trim_matches('"')).collect()));
}

/// The same words, `no data` and `out of range` taken for one word.
fn joined(mut words: Vec<&str>) -> Vec<&str> {
    for (phrase, word) in [(&["no", "data"][..], "nodata"), (&["out", "of", "range"], "outofrange")] {
        let is_phrase = |part: &[&str]| part.iter().zip(phrase).all(|(one, other)| one.eq_ignore_ascii_case(other));
        while let Some(at) = words.windows(phrase.len()).position(is_phrase) {
            words.splice(at..at + phrase.len(), [word]);
        }
    }
    words.iter_mut().for_each(|word| *word = word.trim_matches('"'));
    words
}
