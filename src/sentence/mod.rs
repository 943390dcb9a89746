//! Sentences for people: words with values in their places.
//!
//! Errors and warnings are sentences that keep their values, so that each front end says them in its own way without searching for words in a text:
//! the command line shows a value with the unit in which a person gave it, and the page looks the words up in the table of its language.
//!
//! `sentence!` makes one, and `worded!` declares enums of errors each of whose variants is one.

mod shortened;
mod template;
mod to_value;
mod worded;
mod words;

pub(crate) use shortened::shortened;
pub use to_value::{LengthValue, ToValue};
pub use worded::Worded;
pub(crate) use worded::{sentence, sentence_of_places, worded};
pub use words::{Sentence, Value};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_is_what_format_makes_of_its_words() {
        let (small, name, shape) = (1e-7, "a \"b\"", [2usize, 3]);
        let said = sentence!(
            "{small:?} {small} {small:e} {small:.3e} {small:.1} of {name:?} {name} {shape:?} {{x}}",
            small,
            name,
            shape
        );
        assert_eq!(
            said.to_string(),
            format!("{small:?} {small} {small:e} {small:.3e} {small:.1} of {name:?} {name} {shape:?} {{x}}")
        );
    }

    #[test]
    fn numbers_have_other_words_also_in_sentences_within() {
        let inner = sentence!("the length is {length:?} of {count}", length = LengthValue(4e-3), count = 4usize);
        let outer = sentence!("line {line}: {inner}", line = 4usize, inner = &inner);
        let words = |value: &Value| (*value == Value::Length(4e-3)).then(|| "4mm".to_owned());
        assert_eq!(outer.in_words(words), "line 4: the length is 4mm of 4");
        assert_eq!(outer.to_string(), "line 4: the length is 0.004 of 4");
        assert_eq!(
            serde_json::to_string(&outer).unwrap(),
            r#"{"template":"line {line}: {inner}","places":{"inner":{"template":"the length is {length} of {count}","places":{"count":"4","length":{"length":0.004}}},"line":"4"}}"#
        );
    }

    #[test]
    fn a_single_place_is_what_stands_there() {
        let inner = sentence!("{count} points", count = 3usize);
        assert_eq!(sentence!("{inner}", inner = &inner), inner);
        assert_eq!(sentence!("{reason}", reason = "{ x = 1 }"), Sentence::from("{ x = 1 }"));
        assert_eq!(serde_json::to_string(&Sentence::from("{ x = 1 }")).unwrap(), "\"{ x = 1 }\"");
    }
}
