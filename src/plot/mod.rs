//! Figures as data, drawn once as lines, shapes and words on a sheet, and written as SVG, PNG and PDF.
//!
//! ```
//! use asperity::plot::{Axis, Colour, Dot, Figure, Mark, Panel, write_svg};
//!
//! let [x, y] = [Axis::log("p*", [1e-3, 1.0]), Axis::linear("a_rel", [0.0, 1.0])];
//! let mut panel = Panel::new("relative contact area", x, y);
//! panel.add_curve("theory", Colour::BLUE, Mark::Line, |p| (2.0 * p).tanh());
//! panel.add("measured", Colour::BLACK, Mark::Dotted, [Dot::at(1e-3, 2.1e-3), Dot::at(1e-2, 1.9e-2)]);
//! let figure = Figure { title: "rough line".into(), panels: vec![panel] };
//! let folder = tempfile::tempdir()?;
//! write_svg(&folder.path().join("area.svg"), &figure)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
mod clip;
mod colour;
mod drawing;
mod field_map;
mod figure;
mod font;
mod frame;
mod legend;
mod letters;

mod mark;
mod pdf;
mod series;
mod sheet;
mod style;
mod svg;

pub use axis::{Axis, AxisScale, label, unit};
pub use colour::Colour;
pub use field_map::FieldMap;
pub use figure::{Dot, Figure, Panel, Series};
pub use mark::{Mark, Symbol};
pub use style::{FigureStyle, LegendPlace};
pub use svg::{FIGURES, is_figure, write_figure, write_png, write_svg};
#[cfg(feature = "record")]
pub(crate) use {
    clip::dashes,
    drawing::{drawing_of, frame_in},
    font::width,
    frame::{AxesFrame, AxisSide, NAME},
    letters::letters,
    sheet::{Align, Element, Sheet},
};
