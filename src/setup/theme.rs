//! Themes of the pictures of a recording.

use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// The background of the pictures of a recording, which all their colours fit.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Theme {
    /// Light lines on a dark background.
    #[default]
    Dark,
    /// Dark lines on white, for print and bright rooms.
    Light,
}

impl Theme {
    /// Whether it is the dark one, which needs no mention.
    pub fn is_dark(&self) -> bool {
        *self == Self::Dark
    }
}
