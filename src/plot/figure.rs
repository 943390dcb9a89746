//! Figures as data: panels, and the series in them.

use super::axis::Axis;
use super::colour::Colour;
use super::field_map::FieldMap;
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
    /// A field below the series, which gives the panel the proportions of its axes.
    pub map: Option<FieldMap>,
    /// Series, the later over the earlier.
    pub series: Vec<Series>,
}

impl Panel {
    /// A panel without series.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), x, y, map: None, series: Vec::new() }
    }

    /// Adds a series.
    pub fn add(&mut self, name: impl Into<String>, colour: Colour, mark: Mark, dots: impl IntoIterator<Item = Dot>) {
        self.series.push(Series { name: name.into(), colour, mark, dots: dots.into_iter().collect() });
    }

    /// Adds a function of `x`, from end to end of the axis.
    pub fn add_curve(&mut self, name: impl Into<String>, colour: Colour, mark: Mark, y: impl Fn(f64) -> f64) {
        let dots: Vec<Dot> = (0..=200).map(|i| self.x.value(f64::from(i) / 200.0)).map(|x| Dot::at(x, y(x))).collect();
        self.add(name, colour, mark, dots);
    }
}

/// Dots that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend; an empty name keeps the series out of it.
    pub name: String,
    /// Colour of lines, symbols and error bars.
    pub colour: Colour,
    /// Style of the dots.
    pub mark: Mark,
    /// Dots in the order in which a line joins them.
    pub dots: Vec<Dot>,
}

/// A pair of values with an error bar. One that is not finite breaks the line of its series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dot {
    /// Value on the x axis.
    pub x: f64,
    /// Value on the y axis.
    pub y: f64,
    /// Length of the error bar to either side in y; 0 for none.
    pub spread: f64,
}

impl Dot {
    /// A dot without error bar.
    pub fn at(x: f64, y: f64) -> Self {
        Self { x, y, spread: 0.0 }
    }
}
