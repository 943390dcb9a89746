//! The figure of a scene: error against seconds and against transforms, side by side.

use super::super::plot::{Drawing, FONT, power_of_ten};
use super::Measured;
use super::curve::{Curve, Point};
use super::quantity::KAPPA_R;
use crate::cli::contender::Contender;
use anyhow::Result;
use plotters::coord::Shift;
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::f64::consts::TAU;
use std::ops::Range;

/// Grey of all that is not a curve.
const GREY: RGBColor = RGBColor(110, 110, 110);
const PALE: RGBColor = RGBColor(225, 225, 225);
const TEXT: u32 = 13;
const TITLE: u32 = 16;
/// Of the markers.
const RADIUS: u32 = 5;
/// Height of title and legend.
const HEAD: u32 = 84;
/// Errors above this tell nothing and are left out.
const TOP: f64 = 10.0;

/// What the kinds of lines mean, and where that is said.
const LINES: [(i32, &str); 3] = [
    (28, "solid: pressure, relative L2"),
    (278, "dotted: certificate η"),
    (528, "dashed: corrected kappa_r, error of the grid of n points along a side"),
];

/// Draws what was measured.
pub struct Figure<'a>(pub &'a Measured);

/// What the work is counted in.
struct Axis {
    name: &'static str,
    work: fn(&Point) -> f64,
}

const AXES: [Axis; 2] = [
    Axis { name: "run time in s, median", work: Point::median },
    Axis { name: "Fourier transforms", work: |point| point.transforms as f64 },
];

/// One panel of a figure on a surface of `scale` pixels per unit.
struct Panel<'a> {
    measured: &'a Measured,
    axis: &'a Axis,
    scale: u32,
}

impl Drawing for Figure<'_> {
    const SIZE: [u32; 2] = [1200, 600];

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: u32) -> Result<()>
    where
        B::ErrorType: 'static,
    {
        let (head, body) = area.split_vertically(scale * HEAD);
        draw_head(self.0, &head, scale as i32)?;
        for (axis, part) in AXES.iter().zip(body.split_evenly((1, 2))) {
            Panel { measured: self.0, axis, scale }.draw(&part)?;
        }
        Ok(())
    }
}

/// Colour-blind safe, after Okabe and Ito.
fn colour(contender: Contender) -> RGBColor {
    match contender {
        Contender::Multilevel => RGBColor(0, 114, 178),
        Contender::PolonskyKeer => RGBColor(213, 94, 0),
        Contender::Gfmd => RGBColor(0, 158, 115),
        Contender::GfmdUniform => RGBColor(204, 121, 167),
    }
}

/// Corners, about its middle, of the shape that tells a curve from others without colours.
fn outline(contender: Contender, radius: u32) -> Vec<(i32, i32)> {
    let (corners, turn) = match contender {
        Contender::Multilevel => (24, 0.0),
        Contender::PolonskyKeer => (4, 0.125),
        Contender::Gfmd => (3, 0.0),
        Contender::GfmdUniform => (4, 0.0),
    };
    let corner = |i| {
        let (x, y) = (TAU * (f64::from(i) / f64::from(corners) + turn)).sin_cos();
        ((f64::from(radius) * x).round() as i32, (-f64::from(radius) * y).round() as i32)
    };
    (0..corners).map(corner).collect()
}

fn font<'a>(size: u32, scale: u32, colour: &'a RGBColor) -> TextStyle<'a> {
    (FONT, scale * size).into_font().color(colour)
}

/// Title and legend.
fn draw_head<B: DrawingBackend>(measured: &Measured, area: &DrawingArea<B, Shift>, scale: i32) -> Result<()>
where
    B::ErrorType: 'static,
{
    let at = |x: i32, y: i32| (scale * x, scale * y);
    let points = measured.finest().next().map_or(0, Curve::side);
    let kind = if measured.scene.is_line() { "points" } else { "points a side" };
    let title = format!("{}, {points} {kind}: error against work", measured.scene.name());
    area.draw_text(&title, &font(TITLE, scale as u32, &BLACK), at(20, 10))?;
    for (i, contender) in Contender::ALL.into_iter().enumerate() {
        let x = 28 + 250 * i as i32;
        let line = PathElement::new(vec![at(x, 46), at(x + 30, 46)], colour(contender).stroke_width(2 * scale as u32));
        area.draw(&line)?;
        area.draw(
            &(EmptyElement::at(at(x + 15, 46))
                + Polygon::new(outline(contender, RADIUS * scale as u32), colour(contender))),
        )?;
        area.draw_text(contender.title(), &font(TEXT, scale as u32, &BLACK), at(x + 38, 39))?;
    }
    for (x, text) in LINES {
        area.draw_text(text, &font(TEXT, scale as u32, &GREY), at(x, 62))?;
    }
    Ok(())
}

impl Panel<'_> {
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<()>
    where
        B::ErrorType: 'static,
    {
        let scale = self.scale;
        let [x, y] = [self.works(), self.errors()];
        let mut chart = ChartBuilder::on(area)
            .margin(10 * scale)
            .margin_right(24 * scale)
            .x_label_area_size(44 * scale)
            .y_label_area_size(64 * scale)
            .build_cartesian_2d(x.clone().log_scale(), y.log_scale())?;
        chart
            .configure_mesh()
            .label_style(font(TEXT, scale, &BLACK))
            .axis_desc_style(font(TEXT, scale, &BLACK))
            .axis_style(GREY.stroke_width(scale))
            .bold_line_style(PALE.stroke_width(scale))
            .light_line_style(TRANSPARENT)
            .x_desc(self.axis.name)
            .y_desc("relative error")
            .x_label_formatter(&|x| power_of_ten(*x))
            .y_label_formatter(&|y| power_of_ten(*y))
            .y_labels(16)
            .draw()?;
        self.draw_grids(&mut chart, &x)?;
        self.measured.finest().try_for_each(|curve| self.draw_curve(&mut chart, curve))
    }

    /// Where the error of each grid lies.
    fn draw_grids<B: DrawingBackend, X, Y>(&self, chart: &mut Chart<'_, B, X, Y>, x: &Range<f64>) -> Result<()>
    where
        B::ErrorType: 'static,
        X: Ranged<ValueType = f64>,
        Y: Ranged<ValueType = f64>,
    {
        let scale = self.scale;
        for (i, rung) in self.measured.ladder.rungs.iter().enumerate() {
            let Some(error) = rung.errors[KAPPA_R] else { continue };
            let ends = [(x.start, error), (x.end, error)];
            chart.draw_series(DashedLineSeries::new(ends, 6 * scale, 4 * scale, GREY.stroke_width(scale)))?;
            self.draw_label(chart, (x.start, error), i)?;
        }
        Ok(())
    }

    /// The points of the `i`-th grid, on its line; every other one further right, where two lines are close.
    fn draw_label<B: DrawingBackend, X, Y>(
        &self,
        chart: &mut Chart<'_, B, X, Y>,
        start: (f64, f64),
        i: usize,
    ) -> Result<()>
    where
        B::ErrorType: 'static,
        X: Ranged<ValueType = f64>,
        Y: Ranged<ValueType = f64>,
    {
        let (scale, left) = (self.scale as i32, 8 + 68 * (i as i32 % 2));
        let style = font(TEXT - 2, self.scale, &GREY).pos(Pos::new(HPos::Left, VPos::Center));
        let text = format!("n = {}", self.measured.ladder.rungs[i].side());
        let (width, height) = style.font.box_size(&text)?;
        let [margin, half] = [3 * scale, height as i32 / 2];
        let corners = [(scale * left - margin, -half), (scale * left + width as i32 + margin, half)];
        let label = EmptyElement::at(start)
            + Rectangle::new(corners, WHITE.filled())
            + Text::new(text, (scale * left, 0), style);
        chart.draw_series([label])?;
        Ok(())
    }

    fn draw_curve<B: DrawingBackend, X, Y>(&self, chart: &mut Chart<'_, B, X, Y>, curve: &Curve) -> Result<()>
    where
        B::ErrorType: 'static,
        X: Ranged<ValueType = f64>,
        Y: Ranged<ValueType = f64>,
    {
        let (scale, colour) = (self.scale, colour(curve.contender));
        let at = |error: fn(&Point) -> f64| {
            let work = self.axis.work;
            curve
                .points
                .iter()
                .map(move |point| (work(point), error(point)))
                .filter(|(x, y)| *x > 0.0 && *y > 0.0 && *y <= TOP)
        };
        chart.draw_series(DashedLineSeries::new(at(|p| p.eta), scale, 3 * scale, colour.stroke_width(scale)))?;
        chart.draw_series(LineSeries::new(at(|p| p.pressure_error), colour.stroke_width(2 * scale)))?;
        let marker = outline(curve.contender, RADIUS * scale);
        chart.draw_series(
            at(|p| p.pressure_error).map(|at| EmptyElement::at(at) + Polygon::new(marker.clone(), colour)),
        )?;
        Ok(())
    }

    /// From the least to the most work, with room for the labels of the grids.
    fn works(&self) -> Range<f64> {
        let all = self.measured.finest().flat_map(|curve| curve.points.iter().map(self.axis.work));
        let [least, most] = extent(all);
        0.3 * least..1.3 * most
    }

    /// Whole powers of ten around all errors.
    fn errors(&self) -> Range<f64> {
        let points = self.measured.finest().flat_map(|curve| &curve.points);
        let grids = self.measured.ladder.rungs.iter().filter_map(|rung| rung.errors[KAPPA_R]);
        let [least, most] = extent(points.flat_map(|point| [point.eta, point.pressure_error]).chain(grids));
        10f64.powf(least.log10().floor())..10f64.powf(most.min(TOP).log10().ceil())
    }
}

/// A log-log chart.
type Chart<'a, B, X, Y> = ChartContext<'a, B, Cartesian2d<X, Y>>;

/// The least and the largest positive value.
fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.filter(|&v| v > 0.0).fold([f64::INFINITY, 0.0], |[least, most], v| [v.min(least), v.max(most)])
}
