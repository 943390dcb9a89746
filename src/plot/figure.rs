//! Figures as data: panels, and the series in them.

use super::axis::Axis;
use super::colour::Colour;
use super::mark::Mark;

/// Panels side by side, two in a row.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Title above all panels.
    pub title: String,
    /// Panels, row by row.
    pub panels: Vec<Panel>,
}

/// Two axes and the series drawn between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Title above the panel.
    pub title: String,
    /// Axis to the right.
    pub x: Axis,
    /// Axis upwards.
    pub y: Axis,
    /// Series, the later over the earlier.
    pub series: Vec<Series>,
    /// Corner of the legend, unless it would hide less in another one.
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
    /// Name in the legend; an empty name keeps the series out of it.
    pub name: String,
    /// Colour of lines, symbols and error bars.
    pub colour: Colour,
    /// Style of the points.
    pub mark: Mark,
    /// Points in the order in which a line joins them.
    pub points: Vec<Point>,
}

impl Series {
    /// A series of `points`.
    pub fn new(name: impl Into<String>, colour: Colour, mark: Mark, points: Vec<Point>) -> Self {
        Self { name: name.into(), colour, mark, points }
    }
}

/// A point with an error bar. A point that is not finite breaks the line of its series.
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
