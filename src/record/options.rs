//! Options of recordings.

use super::draw::Ghost;
use super::parts::Parts;
use crate::setup::{Record, Theme};
use std::sync::Arc;

/// Parts and amount of what is recorded.
#[derive(Debug, Clone)]
pub struct Options {
    /// Parts of each scene, as far as it can show them; the rest is neither computed nor laid out.
    pub what: Parts,
    /// Fields of every n-th step; `None` records all of the first steps and then ever sparser ones: of 100 000, some 120 for
    /// lines and 60 for surfaces; of each coarser grid a sixth of that. Numbers are recorded at every step.
    pub every: Option<usize>,
    /// Unit of the lengths of the problems, for the axes. Metres (`m`) are shown as mm, µm or nm.
    pub length_unit: String,
    /// Ground of the pictures, and with it all their colours.
    pub theme: Theme,
    /// Curves of an earlier solve, drawn beside those of each scene.
    pub ghost: Option<Arc<Ghost>>,
}

impl Default for Options {
    /// Every part but the spectrum and the density of the error, the automatic schedule, lengths in metres, a dark ground, no earlier solve.
    fn default() -> Self {
        Self { what: Parts::USUAL, every: None, length_unit: "m".into(), theme: Theme::Dark, ghost: None }
    }
}

impl From<&Record> for Options {
    fn from(Record { what, every, length_unit, theme }: &Record) -> Self {
        let what = if what.is_empty() { Parts::USUAL } else { what.iter().copied().collect() };
        Self { what, every: *every, length_unit: length_unit.clone(), theme: *theme, ghost: None }
    }
}
