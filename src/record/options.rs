//! Options of recordings.

use super::draw::Ghost;
use super::parts::Parts;
use super::units::RecordUnits;
use crate::setup::{Record, Setup, Theme};
use std::sync::Arc;

/// The window of a viewer on a common screen.
pub(super) const WINDOW: [f64; 2] = [1600.0, 1000.0];

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
    /// Unit of the pressures of the problems, for titles and tables; empty if it is not known. Pascals (`Pa`) are shown as kPa, MPa or GPa.
    pub pressure_unit: String,
    /// Row and column of a surface along which the raster runs; those of its highest peak if none are given.
    pub raster_at: Option<[usize; 2]>,
    /// Ground of the pictures, and with it all their colours.
    pub theme: Theme,
    /// Width and height, in points, of the window of the viewer that the pictures are drawn for: each fills its pane there, and about
    /// fills it in windows of other sizes.
    pub window: [f64; 2],
    /// Curves of an earlier solve, drawn beside those of each scene.
    pub ghost: Option<Arc<Ghost>>,
}

impl Options {
    /// Height of the bars of a viewer above and below its panes, in points.
    pub const BARS: f64 = 57.0;

    /// The units of the problems.
    pub fn units(&self) -> RecordUnits {
        RecordUnits { length: self.length_unit.clone(), pressure: self.pressure_unit.clone() }
    }
}

impl Default for Options {
    /// The usual parts, the automatic schedule, lengths in metres, pressures without a unit, a dark ground, a window of 1600 x 1000 points, no earlier solve.
    fn default() -> Self {
        Self {
            what: Parts::USUAL,
            every: None,
            length_unit: "m".into(),
            pressure_unit: String::new(),
            raster_at: None,
            theme: Theme::Dark,
            window: WINDOW,
            ghost: None,
        }
    }
}

impl From<&Setup> for Options {
    /// The options of the recording of a setup.
    fn from(setup: &Setup) -> Self {
        Self { what: setup.recorded_parts().into_iter().collect(), ..Self::from(&setup.record) }
    }
}

impl From<&Record> for Options {
    fn from(Record { what, every, length_unit, pressure_unit, raster_at, theme, .. }: &Record) -> Self {
        let what = if what.is_empty() { Parts::USUAL } else { what.iter().copied().collect() };
        Self {
            what,
            every: *every,
            length_unit: length_unit.clone(),
            pressure_unit: pressure_unit.clone(),
            raster_at: *raster_at,
            theme: *theme,
            window: WINDOW,
            ghost: None,
        }
    }
}
