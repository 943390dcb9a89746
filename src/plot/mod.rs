//! Figures as data, drawn once as lines, shapes and words on a sheet, and written as SVG and PNG.
//!
//! ```
//! use asperity::plot::{Axis, Colour, Corner, Figure, Mark, Panel, Point, Series, write_svg};
//!
//! let [x, y] = [Axis::log("p*", [1e-3, 1.0]), Axis::linear("a_rel", [0.0, 1.0])];
//! let mut panel = Panel::new("relative contact area", x, y, Corner::TopLeft);
//! let theory = [1e-3, 1e-2, 1e-1, 1.0].map(|p: f64| Point::at(p, (2.0 * p).tanh()));
//! panel.series.push(Series::new("theory", Colour::BLUE, Mark::Line, theory.to_vec()));
//! let figure = Figure { title: "rough line".into(), panels: vec![panel] };
//! let folder = tempfile::tempdir()?;
//! write_svg(&folder.path().join("area.svg"), &figure)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
mod clip;
mod colour;
mod drawing;
mod figure;
mod font;
mod frame;
mod legend;
mod mark;
mod series;
mod sheet;
mod svg;

pub use axis::{Axis, Scale};
pub use colour::Colour;
pub use figure::{Corner, Figure, Panel, Point, Series};
pub use mark::{Mark, Symbol};
pub use svg::{write_png, write_svg};
#[cfg(feature = "record")]
pub(crate) use {
    drawing::{drawing, frame_of},
    font::width,
    frame::{Frame, Side},
    sheet::{Align, Element, Sheet},
};
