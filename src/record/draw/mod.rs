//! The drawings of a recording: pictures, curves and captions, and the scenes that they show.

mod below;
mod canvas;
mod chart;
mod contrast;
mod curves;
mod density;
mod fields;
mod figure;
mod fill;
mod flip_map;
mod fringes;
mod ghost;
mod instruments;
mod lanes;
mod line;
mod load_axis;
mod palette;
mod patch_points;
mod patches;
mod picture;
mod raster;
mod reduce;
mod relief;
mod ritz;
mod ruler;
mod scale;
mod spectrum;
mod stage;
mod step_image;
mod strips;
mod surface;
mod surface_relief;
mod survey_picture;
mod traces;
mod waterfall;
mod window;

pub use below::PIXELS as CUT_PIXELS;
pub use chart::{Chart, LOAD};
pub use curves::{Curve, CurveKind, Curves};
pub use fields::{Extent, Fields};
pub use figure::FigurePicture;
pub use ghost::{Ghost, entity_under};
pub use instruments::{Instruments, Readings};
pub use load_axis::LoadAxis;
pub use palette::{Palette, colour};
pub use reduce::{Columns, has_contour, pixels};
pub use relief::vertices;
pub use stage::{Stage, level};
pub use step_image::StepImage;
pub use surface::Image;
pub use surface_relief::SurfaceRelief;
pub use survey_picture::figure as survey_figure;
pub use traces::{
    COMPARED, PHASE, SECONDS, STEP, TRANSFORMS, Traces, drawn, log_off_scale, log_run_style, title, traced,
};
