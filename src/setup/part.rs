//! The parts of a recording.

use super::Theme;
use crate::error::SetupError;
use crate::grid::Grid;
use serde::{Deserialize, Serialize};

/// A part of a recording. Lines have no mesh, surfaces no profile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// Numbers of every step, as curves.
    Traces,
    /// Indenter and solid of a line.
    Profile,
    /// Pressure and gap: curves of a line, images of a surface.
    Fields,
    /// The contact: segments of a line, an image of a surface.
    Mask,
    /// The relief of a surface.
    Mesh,
    /// Power spectra of displacement and heights.
    Spectrum,
    /// Where the error sits: the density of the error in energy.
    Error,
}

impl Part {
    /// The parts by their names in scenes, in a few words.
    pub const PARTS: [(&str, &str); 7] = [
        ("traces", "Numbers of every step"),
        ("profile", "Indenter and solid of a line"),
        ("fields", "Pressure and gap: curves of a line, images of a surface"),
        ("mask", "Contact: segments of a line, an image of a surface"),
        ("mesh", "Relief of a surface"),
        ("spectrum", "Power spectra of displacement and heights; only if asked for"),
        ("error", "Where the error sits, the density of the error in energy: only if asked for, or of other codes"),
    ];
}

/// The recording of a solve, should one be made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Record {
    /// Parts, instead of all that a line or a surface usually has.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub what: Vec<Part>,
    /// Fields of every n-th step, instead of all early steps and then ever fewer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub every: Option<usize>,
    /// Unit of lengths in the recording; metres are shown as mm, um or nm.
    pub length_unit: String,
    /// Ground of the pictures.
    #[serde(skip_serializing_if = "Theme::is_dark")]
    pub theme: Theme,
}

impl Default for Record {
    /// All usual parts, all early steps and then ever fewer, lengths in metres, on a dark ground.
    fn default() -> Self {
        Self { what: Vec::new(), every: None, length_unit: "m".into(), theme: Theme::Dark }
    }
}

impl Record {
    /// Checks that a scene on `grid` can be recorded so.
    ///
    /// # Errors
    /// For a mesh of a line, a profile of a surface, and every 0th step.
    pub fn check(&self, grid: &Grid) -> Result<(), SetupError> {
        if self.every == Some(0) {
            return Err(SetupError::EveryNone);
        }
        let (missing, name, of) =
            if grid.is_line() { (Part::Mesh, "mesh", "line") } else { (Part::Profile, "profile", "surface") };
        if self.what.contains(&missing) { Err(SetupError::NoSuchPart { part: name, of }) } else { Ok(()) }
    }
}
