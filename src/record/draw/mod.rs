//! The drawings of a recording: pictures, curves and captions, and the scenes that they show.

mod canvas;
mod contrast;
mod curves;
mod fields;
mod figure;
mod fill;
mod ghost;
mod line;
mod palette;
mod patches;
mod picture;
mod reduce;
mod relief;
mod ruler;
mod spectrum;
mod stage;
mod surface;
mod traces;
mod window;

pub use curves::{Curve, Curves};
pub use fields::{Extent, Fields};
pub use figure::FigurePicture;
pub use ghost::{Ghost, entity_under};
pub use palette::{GROUND, colour};
pub use reduce::Columns;
pub use relief::vertices;
pub use stage::{Stage, level, stride};
pub use surface::pixels;
pub use traces::{COMPARED, SECONDS, STEP, TRANSFORMS, Traces, drawn, log_off_scale, log_run_style, title, traced};
