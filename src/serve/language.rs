//! The languages of the page. The texts of each language are a compressed script of their own. The page begins with the English one; a browser
//! loads another one if its reader wants that language.

use super::packed;
use serde_json::{Value, json};
use std::io;

/// The texts of the page in a language.
struct Language {
    /// Two letters (ISO 639-1).
    code: &'static str,
    /// The constant that its script declares.
    constant: &'static str,
    /// Sentences of the page by their keys.
    texts: &'static str,
    /// Sentences of the program, which are English, and what the page says in their place.
    told: &'static str,
}

macro_rules! language {
    ($code:literal, $constant:literal) => {
        Language {
            code: $code,
            constant: $constant,
            texts: include_str!(concat!("../../assets/explore/texts/", $code, ".json")),
            told: include_str!(concat!("../../assets/explore/texts/told.", $code, ".json")),
        }
    };
}

const LANGUAGES: [Language; 2] = [language!("en", "ENGLISH"), language!("de", "FOREIGN")];

impl Language {
    fn value(&self) -> Value {
        let json = |text| serde_json::from_str::<Value>(text).expect("the texts of the page are JSON");
        json!({ "texts": json(self.texts), "told": json(self.told) })
    }
}

/// The names of all languages by their codes, as a script.
pub(crate) fn script() -> String {
    let names: Value =
        LANGUAGES.iter().map(|it| (it.code.to_owned(), it.value()["texts"]["language"].clone())).collect();
    format!("const LANGUAGES = {names};\n")
}

/// The names and the bytes of the scripts of all languages.
pub(crate) fn files() -> io::Result<Vec<(String, Vec<u8>)>> {
    LANGUAGES.iter().map(|it| Ok((format!("{}.js", it.code), packed::script_of(it.constant, &it.value())?))).collect()
}
