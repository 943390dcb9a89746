//! Common parts of drawings: canvases, colours, axes, images, panes, and the reduction of nodes to points.

pub(crate) mod canvas;
mod contrast;
pub(crate) mod eye;
pub(crate) mod fill;
pub(crate) mod image;
pub(crate) mod letter_lines;
pub(crate) mod line_plane;
pub(crate) mod mirror;
pub(crate) mod palette;
pub(crate) mod pane;
pub(crate) mod reduce;
pub(crate) mod ruler;
pub(crate) mod scale;
pub(crate) mod strips;
pub(crate) mod surface_plane;
pub(crate) mod window;

pub(crate) use contrast::legible;
