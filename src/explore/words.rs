//! Texts of lessons, in one language or in several.

use super::refusal::Refusal;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A text that is the same for all readers, or one for each language.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "give a text, or texts by language such as { en = \"Look.\", de = \"Sehen Sie.\" }")]
pub enum Words {
    /// One text for all.
    Same(String),
    /// Texts by languages, such as `en` and `de`.
    Each(BTreeMap<String, String>),
}

impl Words {
    /// Refuses texts without words, and by what is no language.
    ///
    /// # Errors
    /// A sentence with what cannot be.
    pub(super) fn check(&self) -> Result<(), Refusal> {
        let is_language =
            |code: &str| (2..=3).contains(&code.len()) && code.bytes().all(|byte| byte.is_ascii_lowercase());
        let texts: Vec<&String> = match self {
            Self::Same(text) => vec![text],
            Self::Each(texts) => {
                if let Some(code) = texts.keys().find(|code| !is_language(code)) {
                    return Err(format!("{code:?} is not a language: give two letters such as en or de").into());
                }
                texts.values().collect()
            }
        };
        let is_empty = texts.is_empty() || texts.iter().any(|text| text.trim().is_empty());
        if is_empty { Err("a text is empty: give some words, or leave it out".into()) } else { Ok(()) }
    }
}

impl From<&str> for Words {
    fn from(text: &str) -> Self {
        Self::Same(text.into())
    }
}
