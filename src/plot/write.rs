//! Figures as SVG and PNG.

use super::font::font;
use super::sheet::{Align, Element, Sheet};
use super::{Colour, Figure};
use crate::error::FileError;
use crate::surface::write_beside;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::io::{self, Write};
use std::path::Path;

/// Dots per unit in which a figure is drawn, of which an SVG knows the positions only.
const GRAIN: u32 = 4;
/// Of the size of a font: how much too high texts come out in pixels. An SVG has them in their place.
const DROP: f64 = 0.15;
/// Dots along a side of a pixel.
const COARSENING: u32 = 2;

/// Writes a scalable figure, in units of about a pixel.
///
/// # Errors
/// [`FileError::Target`] for a place where no file can be, [`FileError::Write`] if writing fails; nothing is left then.
pub fn write_svg(path: &Path, figure: &Figure) -> Result<(), FileError> {
    write_beside(path, |file| file.write_all(svg(&Sheet::of(figure))?.as_bytes()))
}

/// Writes a figure of pixels, two per unit.
///
/// # Errors
/// As [`write_svg`].
pub fn write_png(path: &Path, figure: &Figure) -> Result<(), FileError> {
    write_beside(path, |file| {
        let (size, pixels) = pixels(&Sheet::of(figure))?;
        encode(file, size, &pixels)
    })
}

fn svg(sheet: &Sheet) -> io::Result<String> {
    let [width, height] = sheet.size;
    let fine = sheet.size.map(|length| GRAIN * length);
    let mut text = String::new();
    paint(SVGBackend::with_string(&mut text, fine.into()), sheet, 0.0)?;
    let head = |[width, height]: [u32; 2]| format!("width=\"{width}\" height=\"{height}\"");
    Ok(text.replacen(&head(fine), &head([width, height]), 1))
}

/// Size and pixels of a sheet.
fn pixels(sheet: &Sheet) -> io::Result<([u32; 2], Vec<u8>)> {
    let [width, height] = sheet.size.map(|length| GRAIN * length);
    let mut dots = vec![0; 3 * width as usize * height as usize];
    paint(BitMapBackend::with_buffer(&mut dots, (width, height)), sheet, DROP)?;
    Ok(([width / COARSENING, height / COARSENING], coarsened(&dots, width as usize)))
}

/// The means of squares of dots, which smooths all edges.
fn coarsened(dots: &[u8], width: usize) -> Vec<u8> {
    let side = COARSENING as usize;
    let mut pixels = Vec::with_capacity(dots.len() / (side * side));
    for rows in dots.chunks_exact(3 * width * side) {
        for at in (0..3 * width).step_by(3 * side).flat_map(|column| column..column + 3) {
            let square = (0..side).flat_map(|i| (0..side).map(move |j| 3 * (i * width + j)));
            let sum: u32 = square.map(|offset| u32::from(rows[at + offset])).sum();
            pixels.push((sum / (COARSENING * COARSENING)) as u8);
        }
    }
    pixels
}

fn encode(file: impl Write, [width, height]: [u32; 2], pixels: &[u8]) -> io::Result<()> {
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    Ok(writer.finish()?)
}

fn paint<B: DrawingBackend>(backend: B, sheet: &Sheet, drop: f64) -> io::Result<()> {
    let area = backend.into_drawing_area();
    area.fill(&WHITE).map_err(broken)?;
    sheet.elements.iter().try_for_each(|element| draw(&area, element, drop).map_err(broken))?;
    area.present().map_err(broken)
}

fn broken(error: impl std::error::Error) -> io::Error {
    io::Error::other(error.to_string())
}

fn draw<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    element: &Element,
    drop: f64,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    match element {
        Element::Line { points, colour, width } => {
            area.draw(&PathElement::new(dots(points), rgb(*colour).stroke_width(dot(*width) as u32)))
        }
        Element::Shape { corners, colour, opacity } => {
            area.draw(&Polygon::new(dots(corners), rgb(*colour).mix(*opacity).filled()))
        }
        Element::Text { text, at: [x, y], size, align, upwards } => {
            let side = match align {
                Align::Left => HPos::Left,
                Align::Middle => HPos::Center,
                Align::Right => HPos::Right,
            };
            let turn = if *upwards { FontTransform::Rotate270 } else { FontTransform::None };
            let style = font(size * f64::from(GRAIN)).transform(turn).color(&BLACK).pos(Pos::new(side, VPos::Center));
            let [right, down] = if *upwards { [drop * size, 0.0] } else { [0.0, drop * size] };
            area.draw_text(text, &style, (dot(x + right), dot(y + down)))
        }
    }
}

fn rgb(Colour([red, green, blue]): Colour) -> RGBColor {
    RGBColor(red, green, blue)
}

fn dot(length: f64) -> i32 {
    (length * f64::from(GRAIN)).round() as i32
}

fn dots(points: &[[f64; 2]]) -> Vec<(i32, i32)> {
    points.iter().map(|&[x, y]| (dot(x), dot(y))).collect()
}
