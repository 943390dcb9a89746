//! How figures are drawn: their size on paper, their words, and the limits of their axes.

use super::colour::Colour;
use super::figure::Figure;
use super::mark::Mark;
use strum::EnumString;

/// Metres of an inch, of a point, and of a unit of a figure without a size: a pixel of a page in a browser.
const INCH: f64 = 0.0254;
const POINT: f64 = INCH / 72.0;
const UNIT: f64 = INCH / 96.0;
/// The size of labels of a figure that has a size on paper, in points.
const FONT: f64 = 8.0;
/// Pixels per inch of a figure with and without a size.
const DPI: [f64; 2] = [300.0, 192.0];
/// The size of labels in units.
pub(crate) const LABEL: f64 = 15.0;
/// Sizes on paper, of labels and of pixels that make sense: metres, points, pixels per inch.
const LENGTHS: [f64; 2] = [0.02, 2.0];
const FONTS: [f64; 2] = [3.0, 72.0];
const DPIS: [f64; 2] = [30.0, 2400.0];
/// Pixels of a picture at most.
const MOST_PIXELS: f64 = 2e8;

/// How a figure is drawn. What is left out is chosen.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FigureStyle {
    /// Width on paper, in metres.
    pub width: Option<f64>,
    /// Height on paper, in metres; without it, that of the panels below each other.
    pub height: Option<f64>,
    /// Size of the labels, in points.
    pub font: Option<f64>,
    /// Pixels per inch of a PNG.
    pub dpi: Option<f64>,
    /// Title in place of the one that the figure has; an empty one leaves it out.
    pub title: Option<String>,
    /// Limits of the x axes of all panels.
    pub x: Option<[f64; 2]>,
    /// Limits of the y axes, panel by panel.
    pub y: Vec<[f64; 2]>,
    /// Where the legends are.
    pub legend: LegendPlace,
    /// Colours of the curves in the order of the legends; further curves keep theirs.
    pub colours: Vec<Colour>,
}

/// Where the legend of a panel is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, EnumString)]
#[strum(serialize_all = "kebab-case")]
pub enum LegendPlace {
    /// Where it hides least.
    #[default]
    Auto,
    /// Nowhere.
    None,
    /// In a corner.
    TopLeft,
    /// In a corner.
    TopRight,
    /// In a corner.
    BottomLeft,
    /// In a corner.
    BottomRight,
}

impl FigureStyle {
    /// Checks sizes, and limits of axes.
    ///
    /// # Errors
    /// A sentence on the first value that makes no figure.
    pub fn check(&self) -> Result<(), String> {
        let lengths = [self.width, self.height].into_iter().flatten().map(|it| (it, LENGTHS, "length", "m"));
        let others = [(self.font, FONTS, "font", "pt"), (self.dpi, DPIS, "resolution", "dpi")];
        let others = others.into_iter().filter_map(|(it, range, name, unit)| Some((it?, range, name, unit)));
        for (value, [least, most], name, unit) in lengths.chain(others) {
            if !(least..=most).contains(&value) {
                return Err(format!(
                    "a {name} of {value} {unit} makes no figure: give one from {least} to {most} {unit}"
                ));
            }
        }
        match self.x.iter().chain(&self.y).find(|[low, high]| !(low < high && low.is_finite() && high.is_finite())) {
            Some([low, high]) => Err(format!("an axis from {low} to {high} has no length: give the smaller end first")),
            None => Ok(()),
        }
    }

    /// Metres of a unit.
    pub(super) fn unit(&self) -> f64 {
        let font = self.font.or(self.width.map(|_| FONT));
        font.map_or(UNIT, |points| points * POINT / LABEL)
    }

    /// Points of a unit.
    pub(super) fn points(&self) -> f64 {
        self.unit() / POINT
    }

    /// Pixels along a unit, fewer where a sheet of some units would have too many.
    pub(super) fn pixels(&self, [width, height]: [u32; 2]) -> f64 {
        let dpi = self.dpi.unwrap_or(DPI[usize::from(self.width.is_none())]);
        let most = (MOST_PIXELS / (f64::from(width) * f64::from(height))).sqrt();
        (dpi * self.unit() / INCH).min(most)
    }

    /// Whether the size on paper is stated.
    pub(super) fn is_sized(&self) -> bool {
        self.width.is_some() || self.height.is_some() || self.font.is_some()
    }

    /// The figure with the title and the limits of the style. Limits that a logarithmic axis cannot have are left out.
    pub(super) fn applied(&self, figure: &Figure) -> Figure {
        let mut figure = figure.clone();
        if let Some(title) = &self.title {
            figure.title.clone_from(title);
        }
        for (i, panel) in figure.panels.iter_mut().enumerate() {
            let limits = [(&mut panel.x, self.x), (&mut panel.y, self.y.get(i).copied())];
            for (axis, limits) in limits {
                axis.range = limits.filter(|limits| axis.holds_limits(*limits)).unwrap_or(axis.range);
            }
        }
        self.colour(&mut figure);
        figure
    }

    /// Gives the curves their colours. Those of one colour, in whatever panel, keep one in common; tiles of maps keep theirs.
    fn colour(&self, figure: &mut Figure) {
        let mut before: Vec<Colour> = Vec::new();
        let series = figure.panels.iter_mut().flat_map(|panel| &mut panel.series);
        for series in series.filter(|series| !matches!(series.mark, Mark::Tile { .. })) {
            let number = before.iter().position(|it| *it == series.colour).unwrap_or_else(|| {
                before.push(series.colour);
                before.len() - 1
            });
            series.colour = self.colours.get(number).copied().unwrap_or(series.colour);
        }
    }
}
