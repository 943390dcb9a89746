//! Flags of pictures: their size on paper, their words, and the limits of their axes.

use super::exit_status::usage;
use anyhow::Result;
use asperity::plot::{Colour, FigureStyle, LegendPlace};
use asperity::quantity::length_of;
use clap::Args;

/// Heading of these flags.
const FIGURE: &str = "Figure (of a file .svg, .pdf or .png)";
/// Widths on paper that have names.
const NAMED_WIDTHS: [(&str, f64); 2] = [("column", 0.085), ("page", 0.17)];

/// How pictures are drawn.
#[derive(Args, Default)]
pub(crate) struct FigureArgs {
    /// Width on paper, or width and height: lengths such as 85mm or 170mm,100mm; column is 85mm, page 170mm
    #[arg(long, value_name = "W[,H]", value_parser = size, help_heading = FIGURE)]
    figure_size: Option<[Option<f64>; 2]>,
    /// Size of the labels in points [default: 8 for a figure with a size]
    #[arg(long, value_name = "PT", value_parser = number, help_heading = FIGURE)]
    figure_font: Option<f64>,
    /// Pixels per inch of a .png [default: 300 for a figure with a size]
    #[arg(long, value_name = "DPI", value_parser = number, help_heading = FIGURE)]
    figure_dpi: Option<f64>,
    /// Title of the figure; "" leaves it out
    #[arg(long, value_name = "TEXT", help_heading = FIGURE)]
    figure_title: Option<String>,
    /// Limits of the x axes
    #[arg(long, value_name = "MIN,MAX", value_parser = limits, allow_hyphen_values = true, help_heading = FIGURE)]
    figure_x: Option<[f64; 2]>,
    /// Limits of the y axis of the first panel; give it again for the next ones
    #[arg(long, value_name = "MIN,MAX", value_parser = limits, allow_hyphen_values = true, help_heading = FIGURE)]
    figure_y: Vec<[f64; 2]>,
    /// Place of the legends: auto, none, top-left, top-right, bottom-left or bottom-right
    #[arg(long, value_name = "PLACE", value_parser = place, help_heading = FIGURE)]
    figure_legend: Option<LegendPlace>,
    /// Colours of the curves in the order of the legend: names such as blue,orange or hexadecimal ones such as #0072b2
    #[arg(long, value_name = "COLOUR[,COLOUR]", value_delimiter = ',', help_heading = FIGURE)]
    figure_colours: Vec<Colour>,
}

impl FigureArgs {
    /// The style of the figures.
    ///
    /// # Errors
    /// For a size, a font, a resolution or limits that make no figure, and for flags without a picture that is written.
    pub(crate) fn style(&self, has_picture: bool) -> Result<FigureStyle> {
        let [width, height] = self.figure_size.unwrap_or_default();
        let style = FigureStyle {
            width,
            height,
            font: self.figure_font,
            dpi: self.figure_dpi,
            title: self.figure_title.clone(),
            x: self.figure_x,
            y: self.figure_y.clone(),
            legend: self.figure_legend.unwrap_or_default(),
            colours: self.figure_colours.clone(),
        };
        if !has_picture && style != FigureStyle::default() {
            return usage(
                "the flags --figure-... are for a picture, but none is written: give --out with a name .svg, .pdf or .png",
            );
        }
        style.check().or_else(usage).map(|()| style)
    }
}

fn size(text: &str) -> Result<[Option<f64>; 2], String> {
    let named = NAMED_WIDTHS.iter().find(|(name, _)| *name == text).map(|(_, width)| *width);
    let length = |text: &str| length_of(text).ok_or_else(|| format!("`{text}` is not a length: give one such as 85mm"));
    match (named, text.split_once(',')) {
        (Some(width), _) => Ok([Some(width), None]),
        (None, Some((width, height))) => Ok([Some(length(width)?), Some(length(height)?)]),
        (None, None) => Ok([Some(length(text)?), None]),
    }
}

fn number(text: &str) -> Result<f64, String> {
    let digits = text.trim_end_matches("pt").trim_end_matches("dpi").trim();
    digits.parse().map_err(|_| format!("`{text}` is not a number: give one such as 8"))
}

fn limits(text: &str) -> Result<[f64; 2], String> {
    let end = |text: &str| text.trim().parse::<f64>().ok();
    let both = text.split_once(',').and_then(|(low, high)| Some([end(low)?, end(high)?]));
    both.ok_or_else(|| {
        format!("`{text}` is not a pair of limits: give two numbers in the unit of the axis, such as 0,2.5")
    })
}

fn place(text: &str) -> Result<LegendPlace, String> {
    text.parse().map_err(|_| {
        format!("`{text}` is no place of a legend: give auto, none, top-left, top-right, bottom-left or bottom-right")
    })
}
