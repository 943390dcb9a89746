//! Sets of parts of a recording.

use crate::grid::Grid;
use crate::setup::Part;
use strum::IntoEnumIterator;

/// A set of parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parts(u16);

impl Parts {
    /// Every part but those that take work of their own: the spectrum, the density of the error, the stress, the flow and the instruments.
    pub const USUAL: Self = Self((1 << Part::Spectrum as u16) - 1);
    /// The usual parts and the density of the error, for what other codes have found.
    pub const OF_OTHERS: Self = Self(Self::USUAL.0 | 1 << Part::Error as u16);
    /// The parts that are drawn from the fields of a step.
    pub(super) const PICTURES: Self = Self((1 << Part::Raster as u16) - (1 << Part::Traces as u16) - 1);

    /// The parts that a scene on `grid` can show.
    pub fn on(grid: &Grid) -> Self {
        Part::iter().filter(|part| part.is_on(grid)).collect()
    }

    /// The parts in both sets.
    pub fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Whether `part` is in the set.
    pub fn has(self, part: Part) -> bool {
        self.has_any([part])
    }

    /// Whether any of `parts` is in the set.
    pub fn has_any(self, parts: impl IntoIterator<Item = Part>) -> bool {
        self.and(parts.into_iter().collect()).0 != 0
    }

    /// Whether a picture in the plane is in the set.
    pub(super) fn has_planes(self) -> bool {
        self.has_any([Part::Profile, Part::Fields, Part::Mask, Part::Flow])
    }

    /// Whether anything that shows the gap is in the set.
    pub(super) fn has_gap(self) -> bool {
        let without_gap = Self::from_iter([Part::Traces, Part::Mask, Part::Stress, Part::Fringes, Part::Flow]);
        self.has_any(Part::iter().filter(|part| !without_gap.has(*part) && !Part::OF_A_RUN.contains(part)))
    }

    /// Whether the contact has a picture of its own, for want of others to lie in.
    pub(super) fn has_mask_alone(self) -> bool {
        self.has(Part::Mask) && !self.has_any([Part::Profile, Part::Fields])
    }

    /// Whether an instrument is in the set.
    pub fn has_instruments(self) -> bool {
        self.has_any(Part::OF_A_RUN)
    }

    /// Whether anything drawn from the fields of a step is in the set.
    pub(super) fn has_pictures(self) -> bool {
        self.has_any(Part::iter().filter(|part| *part != Part::Traces && !Part::OF_A_RUN.contains(part)))
    }
}

impl FromIterator<Part> for Parts {
    fn from_iter<I: IntoIterator<Item = Part>>(parts: I) -> Self {
        Self(parts.into_iter().fold(0, |bits, part| bits | 1 << part as u16))
    }
}
