//! The drawings of a recording, grouped by what is drawn, and the scenes that they show.
//!
//! A part of a recording is a [`drawing::Drawing`] in a file of its own, with a row in the table of its group. A new part needs these
//! two and its name and sentence in [`crate::setup::Part`]: layout, size and recorder find it in the table.

mod chart;
mod curve_ends;
mod drawing;
mod field;
mod fields;
mod ink;
mod instrument;
mod parts;
mod patch;
mod plane;
mod profile;
mod run;
mod stage;

pub(crate) use chart::curves::Curves;
pub use chart::curves::{CurveKind, RecordedCurve};
pub(crate) use chart::figure::FigurePicture;
pub use chart::ghost::Ghost;
pub(crate) use chart::ghost::entity_under;
pub use chart::load_axis::LoadAxis;
pub(crate) use chart::load_chart::{Chart, LOAD};
pub(crate) use chart::observable_traces::{COMPARED, SECONDS, STEP, TRANSFORMS, drawn, title, traced};
pub(crate) use chart::survey_figure::figure as survey_figure;
pub(crate) use chart::traces::{PHASE, log_run_style};
pub(crate) use drawing::Place;
pub(crate) use field::surface_relief::SurfaceRelief;
pub(crate) use fields::{FieldExtent, FrameFields};
pub(crate) use ink::canvas::PANE;
pub(crate) use ink::eye::Eye;
pub(crate) use ink::palette::{Palette, SERIES, STATE_CURVES};
pub(crate) use ink::pane::{ContainerKind, Corner, GRID_COLUMNS, Pane, PaneView};
pub(crate) use parts::all as parts;
pub(crate) use run::DrawnRun;
pub(crate) use stage::{Stage, level};
