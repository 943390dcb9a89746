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

pub use chart::curves::{CurveKind, Curves, RecordedCurve};
pub use chart::figure::FigurePicture;
pub use chart::ghost::{Ghost, entity_under};
pub use chart::load_axis::LoadAxis;
pub use chart::load_chart::{Chart, LOAD};
pub use chart::observable_traces::{COMPARED, SECONDS, STEP, TRANSFORMS, drawn, title, traced};
pub use chart::survey_figure::figure as survey_figure;
pub use chart::traces::{PHASE, log_run_style};
pub use drawing::Place;
pub use field::surface_relief::SurfaceRelief;
pub use fields::{FieldExtent, FrameFields};
pub use ink::canvas::PANE;
pub use ink::eye::Eye;
pub use ink::palette::{Palette, SERIES};
pub use ink::pane::{ContainerKind, Corner, GRID_COLUMNS, Pane, PaneView};
pub use parts::all as parts;
pub use run::DrawnRun;
pub use stage::{Stage, level};
