//! The parts of a recording to choose from.

use super::usage;
use anyhow::Result;
use asperity::Grid;
use asperity::record::{Part, Parts};
use clap::ValueEnum;

/// A part of a recording.
#[derive(Clone, Copy, ValueEnum)]
pub enum PartArg {
    /// Numbers of every step
    Traces,
    /// Indenter and solid of a line
    Profile,
    /// Pressure and gap: curves of a line, images of a surface
    Fields,
    /// Contact: segments of a line, an image of a surface
    Mask,
    /// Relief of a surface
    Mesh,
    /// Power spectra of displacement and heights; only if asked for
    Spectrum,
}

impl PartArg {
    /// The set of those `asked` for, or the usual ones that a scene on `grid` can show.
    pub fn parts(asked: &[Self], grid: &Grid) -> Result<Parts> {
        let shown = Parts::on(grid);
        if asked.is_empty() {
            return Ok(shown.and(Parts::USUAL));
        }
        let parts: Parts = asked.iter().map(|part| part.part()).collect();
        let is_missing = |part: Part| parts.has(part) && !shown.has(part);
        if is_missing(Part::Mesh) {
            return usage("--record-what asks for the mesh, which a line does not have: leave it out");
        }
        if is_missing(Part::Profile) {
            return usage("--record-what asks for the profile, which a surface does not have: leave it out");
        }
        Ok(parts)
    }

    fn part(self) -> Part {
        match self {
            Self::Traces => Part::Traces,
            Self::Profile => Part::Profile,
            Self::Fields => Part::Fields,
            Self::Mask => Part::Mask,
            Self::Mesh => Part::Mesh,
            Self::Spectrum => Part::Spectrum,
        }
    }
}
