//! Themes of the pictures of a recording.

use serde::{Deserialize, Serialize};

/// The ground of the pictures of a recording, and with it all their colours.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Theme {
    /// Light lines on a dark ground.
    #[default]
    Dark,
    /// Dark lines on white.
    Light,
}

impl Theme {
    /// The themes and their names in scenes, with a short description.
    pub const THEMES: [(&str, &str); 2] =
        [("dark", "Light lines on a dark background"), ("light", "Dark lines on white, for print and bright rooms")];

    /// Whether it is the dark one, which needs no mention.
    pub fn is_dark(&self) -> bool {
        *self == Self::Dark
    }
}
