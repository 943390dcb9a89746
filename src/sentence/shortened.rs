//! Sentences that are short enough to be read, whatever a file quotes in them.

use std::borrow::Cow;

/// The longest word, without spaces, that a sentence shows whole: paths and keys are shorter.
const LONGEST_WORD: usize = 512;
/// Letters that are shown of a longer word.
const SHOWN_OF_WORD: usize = 60;
/// The longest sentence that is shown whole, and the letters at its end, which say what to do, that are shown of a longer one.
const LONGEST: usize = 2000;
const SHOWN_OF_END: usize = 300;

/// A sentence whose long words are cut, and whose middle is left out if there are too many words. A damaged file may hold a word of any length, which an
/// error quotes.
pub(crate) fn shortened(sentence: &str) -> Cow<'_, str> {
    let has_long_word = sentence.split(' ').any(|word| word.len() > LONGEST_WORD);
    let words = if has_long_word {
        sentence.split(' ').map(cut).collect::<Vec<_>>().join(" ").into()
    } else {
        Cow::from(sentence)
    };
    let count = words.chars().count();
    if count <= LONGEST {
        return words;
    }
    let (begin, end): (String, String) =
        (words.chars().take(LONGEST - SHOWN_OF_END).collect(), words.chars().skip(count - SHOWN_OF_END).collect());
    format!("{begin} [...] {end}").into()
}

/// The beginning of a word that is too long, and how long it is.
fn cut(word: &str) -> Cow<'_, str> {
    let count = word.chars().count();
    if count <= LONGEST_WORD {
        return word.into();
    }
    let begin: String = word.chars().take(SHOWN_OF_WORD).collect();
    format!("{begin}... ({count} letters)").into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_that_can_be_read_stay_as_they_are() {
        let sentence = format!("cannot read /{}: no such file", "folder/".repeat(60));
        assert_eq!(shortened(&sentence), sentence);
    }

    #[test]
    fn long_words_and_long_sentences_are_cut_and_the_advice_stays() {
        let word = format!("row 2: `{}` is no number: give one", "µ".repeat(100_000));
        let said = shortened(&word);
        assert!(
            said.chars().count() < 150 && said.contains("(100002 letters)") && said.ends_with("give one"),
            "{said}"
        );
        let sentence = format!("row 2 has the words {} and more: separate them", "`a`, ".repeat(10_000));
        let said = shortened(&sentence);
        assert!(
            said.chars().count() < 2100 && said.starts_with("row 2 has") && said.ends_with("separate them"),
            "{said}"
        );
    }
}
