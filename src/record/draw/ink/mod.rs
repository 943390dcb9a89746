//! Common parts of drawings: canvases, colours, axes, images, panes, and the reduction of nodes to points.

pub mod canvas;
mod contrast;
pub mod eye;
pub mod fill;
pub mod image;
pub mod letter_lines;
pub mod line_plane;
pub mod mirror;
pub mod palette;
pub mod pane;
pub mod reduce;
pub mod ruler;
pub mod scale;
pub mod strips;
pub mod surface_plane;
pub mod window;

pub use contrast::legible;
