//! The parts of a recording.

use super::Theme;
use crate::error::{ConflictRule, SetupError};
use crate::grid::Grid;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, EnumString, IntoStaticStr};

/// A part of a recording. Lines have no mesh and no flow, surfaces no profile.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, EnumString, IntoStaticStr,
)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Part {
    /// Numbers of every step.
    Traces,
    /// Indenter and solid of a line.
    Profile,
    /// Pressure and gap: curves of a line, images of a surface.
    Fields,
    /// Contact: segments of a line, an image of a surface.
    Mask,
    /// Relief of a surface.
    Mesh,
    /// Power spectra of displacement and heights; this part and those below are recorded only if you name them.
    Spectrum,
    /// Where the error is: the density of the energy error; recorded by default for results of other codes.
    Error,
    /// Largest shear stress below a line, or in a vertical cut through the highest peak of a surface.
    Stress,
    /// The largest shear stress as photoelastic fringes: dark where 2 tau_max is a whole number of fringe orders.
    Fringes,
    /// Flux and pressure of a fluid that leaks through the gap of a surface along x and along y, for the last state.
    Flow,
    /// Contact by step and position: for how many steps each node has kept its state; of a surface along a row and a column.
    Raster,
    /// Error by step and wavelength, compared with the final state; solves twice.
    Waterfall,
    /// Elastic energy by step and wavelength.
    Energy,
    /// Grid level, kind of step, nodes that enter and leave the contact, and the end, as lanes.
    Decisions,
    /// Extreme Ritz values of conjugate gradients, whose ratio is their condition number.
    Ritz,
}

impl Part {
    /// The parts that show all steps of a run in one picture; for a solve under one load only.
    pub const OF_A_RUN: [Self; 5] = [Self::Raster, Self::Waterfall, Self::Energy, Self::Decisions, Self::Ritz];

    /// Whether a line or a surface has it.
    pub fn is_on(self, grid: &Grid) -> bool {
        match self {
            Self::Mesh | Self::Flow => !grid.is_line(),
            Self::Profile => grid.is_line(),
            _ => true,
        }
    }

    /// Whether it is recorded where no parts are named: it takes no work of its own.
    pub fn is_usual(self) -> bool {
        (self as u16) < Self::Spectrum as u16
    }

    /// Whether it shows the stress of an elastic solid.
    pub fn is_stress(self) -> bool {
        matches!(self, Self::Stress | Self::Fringes)
    }

    /// Its name in scenes.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// The recording of a solve, if one is made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Record {
    /// Parts; if empty, the usual parts of a line or a surface.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub what: Vec<Part>,
    /// Interval of steps whose fields are recorded. The default is all early steps, later ones less often.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub every: Option<usize>,
    /// Unit of lengths in the recording; metres are shown as mm, um or nm.
    pub length_unit: String,
    /// Unit of pressures in the recording, empty if it is not known; pascals are shown as kPa, MPa or GPa. A setup that is read from a text in
    /// which a pressure has a unit is in pascals.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub pressure_unit: String,
    /// Row and column of a surface that the raster shows, counted from 0; if it is left out, those of the highest peak.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub raster_at: Option<[usize; 2]>,
    /// Background of the pictures.
    #[serde(skip_serializing_if = "Theme::is_dark")]
    pub theme: Theme,
    /// Whether each iteration of flow of a body that yields below its surface is a state as well.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub iterations: bool,
}

impl Default for Record {
    /// All usual parts, all early steps, later ones less often, lengths in metres, pressures without a unit, a dark background.
    fn default() -> Self {
        Self {
            what: Vec::new(),
            every: None,
            length_unit: "m".into(),
            pressure_unit: String::new(),
            raster_at: None,
            theme: Theme::Dark,
            iterations: false,
        }
    }
}

impl Record {
    /// Checks that a scene on `grid` can be recorded so.
    ///
    /// # Errors
    /// For a mesh or a flow of a line, a profile of a surface, a raster along rows that are not there, and every 0th step.
    pub fn check(&self, grid: &Grid) -> Result<(), SetupError> {
        if self.every == Some(0) {
            return Err(ConflictRule::NoInterval.into());
        }
        if let Some([row, column]) = self.raster_at {
            let shape = grid.shape();
            if grid.is_line() || row >= shape[0] || column >= shape[1] {
                return Err(SetupError::NoSuchNode { row, column, shape });
            }
        }
        let of = if grid.is_line() { "line" } else { "surface" };
        match self.what.iter().find(|part| !part.is_on(grid)) {
            Some(part) => Err(SetupError::NoSuchPart { part: part.name(), of }),
            None => Ok(()),
        }
    }
}
