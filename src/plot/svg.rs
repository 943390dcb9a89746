//! Figures as SVG, and as pixels drawn from the same SVG.

use super::colour::Colour;
use super::drawing::drawing;
use super::figure::Figure;
use super::font::{self, BASELINE, FAMILY, escaped};
use super::sheet::{Align, Element, Sheet};
use crate::error::FileError;
use crate::files::write_beside;
use resvg::tiny_skia::{Pixmap, Transform};
use std::io::{self, Write};
use std::path::Path;

/// Pixels along a unit.
const PIXELS: u32 = 2;

/// Writes a scalable figure, in units of about a pixel.
///
/// # Errors
/// [`FileError::Target`] for a place where no file can be, [`FileError::Write`] if writing fails; nothing is left then.
pub fn write_svg(path: &Path, figure: &Figure) -> Result<(), FileError> {
    write_beside(path, |file| file.write_all(svg(&drawing(figure)).as_bytes()))
}

/// Writes a figure of pixels, two per unit.
///
/// # Errors
/// [`FileError::Target`] for a place where no file can be, [`FileError::Write`] if writing fails; nothing is left then.
pub fn write_png(path: &Path, figure: &Figure) -> Result<(), FileError> {
    write_beside(path, |file| file.write_all(&pixels(&drawing(figure))?.encode_png().map_err(io::Error::other)?))
}

fn svg(sheet: &Sheet) -> String {
    let [width, height] = sheet.size;
    let elements: String = sheet.elements.iter().map(element).collect();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"{FAMILY}\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n{elements}</svg>\n"
    )
}

fn element(element: &Element) -> String {
    match element {
        Element::Line { points, colour, width } => {
            let (points, colour) = (list(points), hex(*colour));
            format!(
                "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" \
                 stroke-linejoin=\"round\"/>\n"
            )
        }
        Element::Shape { corners, colour, opacity } => {
            let (points, colour) = (list(corners), hex(*colour));
            format!("<polygon points=\"{points}\" fill=\"{colour}\" fill-opacity=\"{opacity}\"/>\n")
        }
        Element::Words { words, at: [x, y], size, align, upwards } => {
            let anchor = match align {
                Align::Left => "start",
                Align::Middle => "middle",
                Align::Right => "end",
            };
            let (turn, down) = (if *upwards { " rotate(-90)" } else { "" }, BASELINE * size);
            format!(
                "<text transform=\"translate({x:.2} {y:.2}){turn}\" y=\"{down:.2}\" font-size=\"{size:.2}\" \
                 text-anchor=\"{anchor}\">{}</text>\n",
                escaped(words)
            )
        }
    }
}

fn list(points: &[[f64; 2]]) -> String {
    points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect::<Vec<_>>().join(" ")
}

fn hex(Colour([red, green, blue]): Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn pixels(sheet: &Sheet) -> io::Result<Pixmap> {
    let tree = font::tree(&svg(sheet)).map_err(io::Error::other)?;
    let [width, height] = sheet.size.map(|length| PIXELS * length);
    let mut pixels = Pixmap::new(width, height).ok_or_else(|| io::Error::other("the figure is too large"))?;
    let scale = PIXELS as f32;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    Ok(pixels)
}
