//! Figures as data, and their writers: what is drawn is decided in one place and looks the same wherever it is drawn.
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
mod font;
mod frame;
mod legend;
mod mark;
mod series;
mod sheet;
mod write;

pub use axis::{Axis, Scale};
pub use colour::Colour;
pub use mark::{Mark, Symbol};
pub use write::{write_png, write_svg};
#[cfg(feature = "record")]
pub(crate) use {
    font::width,
    frame::Frame,
    sheet::{Align, Element, Sheet},
};

/// A figure: panels side by side, two in a row.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Above all panels.
    pub title: String,
    /// Row by row.
    pub panels: Vec<Panel>,
}

/// Two axes and what is drawn between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Above the panel.
    pub title: String,
    /// To the right.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// The later over the earlier.
    pub series: Vec<Series>,
    /// Where the legend is.
    pub legend: Corner,
}

impl Panel {
    /// A panel without series.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis, legend: Corner) -> Self {
        Self { title: title.into(), x, y, series: Vec::new(), legend }
    }
}

/// Points that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// What the legend calls it; an empty name keeps it out of the legend.
    pub name: String,
    /// Of lines, symbols and error bars.
    pub colour: Colour,
    /// How the points are drawn.
    pub mark: Mark,
    /// In the order in which a line joins them.
    pub points: Vec<Point>,
}

impl Series {
    /// A series of `points`.
    pub fn new(name: impl Into<String>, colour: Colour, mark: Mark, points: Vec<Point>) -> Self {
        Self { name: name.into(), colour, mark, points }
    }
}

/// A point with an error bar. One that is not finite breaks a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Value on the x axis.
    pub x: f64,
    /// Value on the y axis.
    pub y: f64,
    /// Length of the error bar to either side in y; 0 for none.
    pub spread: f64,
}

impl Point {
    /// A point without error bar.
    pub fn at(x: f64, y: f64) -> Self {
        Self { x, y, spread: 0.0 }
    }
}

/// A corner of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Corner {
    /// Upper left.
    TopLeft,
    /// Upper right.
    TopRight,
    /// Lower left.
    BottomLeft,
    /// Lower right.
    BottomRight,
}
