//! Figures as SVG, as pixels drawn from the same SVG, and as PDF.

use super::colour::Colour;
use super::drawing::drawing;
use super::figure::Figure;
use super::font::{self, BASELINE, FAMILY, escaped};
use super::pdf::pdf;
use super::sheet::{Align, Element, PixelImage, Sheet};
use super::style::FigureStyle;
use crate::error::FileError;
use crate::files::write_beside;
use base64::prelude::{BASE64_STANDARD, Engine};
use flate2::Crc;
use resvg::tiny_skia::{Color, ColorU8, Pixmap, PixmapPaint, Transform};
use std::io::{self, Write};
use std::path::Path;

/// Endings of the names of figures.
pub const FIGURES: [&str; 3] = ["svg", "pdf", "png"];

/// Whether a path has the ending of a figure.
pub fn is_figure(path: &Path) -> bool {
    path.extension().is_some_and(|given| FIGURES.iter().any(|ending| given.eq_ignore_ascii_case(ending)))
}

/// Writes a scalable figure, in units of about a pixel.
///
/// # Errors
/// [`FileError::Target`] for a place where no file can be, [`FileError::Write`] if writing fails; nothing is left then.
pub fn write_svg(path: &Path, figure: &Figure) -> Result<(), FileError> {
    write(path, figure, &FigureStyle::default(), svg_bytes)
}

/// Writes a figure of pixels, two per unit.
///
/// # Errors
/// The errors of [`write_svg`].
pub fn write_png(path: &Path, figure: &Figure) -> Result<(), FileError> {
    write(path, figure, &FigureStyle::default(), png_bytes)
}

/// Writes a figure in a style, as SVG, PDF or PNG by the ending of its name. Letters of a PDF are outlines.
///
/// # Errors
/// The errors of [`write_svg`].
pub fn write_figure(path: &Path, figure: &Figure, style: &FigureStyle) -> Result<(), FileError> {
    let ends_with = |ending: &str| path.extension().is_some_and(|it| it.eq_ignore_ascii_case(ending));
    let bytes = if ends_with("svg") {
        svg_bytes
    } else if ends_with("pdf") {
        |sheet: &Sheet, style: &FigureStyle| pdf(sheet, style.points())
    } else {
        png_bytes
    };
    write(path, figure, style, bytes)
}

fn write(
    path: &Path,
    figure: &Figure,
    style: &FigureStyle,
    bytes: fn(&Sheet, &FigureStyle) -> io::Result<Vec<u8>>,
) -> Result<(), FileError> {
    write_beside(path, |file| file.write_all(&bytes(&drawing(figure, style), style)?))
}

fn svg_bytes(sheet: &Sheet, style: &FigureStyle) -> io::Result<Vec<u8>> {
    let [width, height] = sheet.size;
    let lengths = sheet.size.map(|length| match style.is_sized() {
        true => format!("{:.2}mm", 1e3 * style.unit() * f64::from(length)),
        false => length.to_string(),
    });
    let paper = format!("<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n");
    let elements: String = sheet.elements.iter().map(element).collect::<io::Result<_>>()?;
    Ok(svg(sheet.size, &lengths, &(paper + &elements)).into_bytes())
}

fn svg([width, height]: [u32; 2], lengths: &[String; 2], elements: &str) -> String {
    let [wide, high] = lengths;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{wide}\" height=\"{high}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"{FAMILY}\">\n{elements}</svg>\n"
    )
}

fn element(element: &Element) -> io::Result<String> {
    Ok(match element {
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
        Element::PixelImage(image) => {
            let ([x, y], [width, height]) = (image.corner, image.size);
            let pixels = BASE64_STANDARD.encode(pixmap(image)?.encode_png().map_err(io::Error::other)?);
            format!(
                "<image x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" preserveAspectRatio=\"none\" \
                 image-rendering=\"pixelated\" href=\"data:image/png;base64,{pixels}\"/>\n"
            )
        }
    })
}

/// The pixels of a picture.
fn pixmap(image: &PixelImage) -> io::Result<Pixmap> {
    let [height, width] = image.shape.map(|points| points as u32);
    let mut pixels = Pixmap::new(width, height).ok_or_else(|| io::Error::other("the picture is empty"))?;
    for (pixel, Colour([red, green, blue])) in pixels.pixels_mut().iter_mut().zip(&image.pixels) {
        *pixel = ColorU8::from_rgba(*red, *green, *blue, 255).premultiply();
    }
    Ok(pixels)
}

fn list(points: &[[f64; 2]]) -> String {
    points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect::<Vec<_>>().join(" ")
}

fn hex(Colour([red, green, blue]): Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn png_bytes(sheet: &Sheet, style: &FigureStyle) -> io::Result<Vec<u8>> {
    let scale = style.pixels(sheet.size);
    let mut bytes = pixels(sheet, scale)?.encode_png().map_err(io::Error::other)?;
    let per_metre = (scale / style.unit()).round() as u32;
    bytes.splice(HEAD..HEAD, resolution(per_metre));
    Ok(bytes)
}

/// Bytes of a PNG up to the end of its header.
const HEAD: usize = 33;

/// The part of a PNG that says how many pixels there are along a metre.
fn resolution(per_metre: u32) -> Vec<u8> {
    let metres = 1;
    let mut part = b"pHYs".to_vec();
    part.extend([per_metre.to_be_bytes(), per_metre.to_be_bytes()].concat());
    part.push(metres);
    let mut sum = Crc::new();
    sum.update(&part);
    [&9_u32.to_be_bytes()[..], &part, &sum.sum().to_be_bytes()].concat()
}

/// The pixels of a sheet, of which a unit has `scale`. Pictures lie below everything else.
fn pixels(sheet: &Sheet, scale: f64) -> io::Result<Pixmap> {
    let is_drawn = |it: &&Element| !matches!(it, Element::PixelImage(_));
    let elements: String = sheet.elements.iter().filter(is_drawn).map(element).collect::<io::Result<_>>()?;
    let lengths = sheet.size.map(|length| length.to_string());
    let tree = font::tree(&svg(sheet.size, &lengths, &elements)).map_err(io::Error::other)?;
    let [width, height] = sheet.size.map(|length| (f64::from(length) * scale).round() as u32);
    let mut pixels = Pixmap::new(width, height).ok_or_else(|| io::Error::other("the figure is too large"))?;
    pixels.fill(Color::WHITE);
    for element in &sheet.elements {
        let Element::PixelImage(image) = element else { continue };
        let [x, y] = image.corner.map(|it| (it * scale) as f32);
        let [wide, high] = [0, 1].map(|axis| (image.size[axis] * scale / image.shape[1 - axis] as f64) as f32);
        let place = Transform::from_row(wide, 0.0, 0.0, high, x, y);
        pixels.draw_pixmap(0, 0, pixmap(image)?.as_ref(), &PixmapPaint::default(), place, None);
    }
    resvg::render(&tree, Transform::from_scale(scale as f32, scale as f32), &mut pixels.as_mut());
    Ok(pixels)
}
