//! Figures as SVG and PNG.

use super::font::font;
use super::sheet::{Align, Element, Sheet};
use super::{Colour, Figure};
use crate::error::FileError;
use crate::files::write_beside;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::io::{self, Write};
use std::path::Path;

/// Dots per unit in which a figure is drawn, of which an SVG knows the positions only.
const GRAIN: u32 = 4;
/// Of the size of a font: how much too high texts come out in dots.
const DROP: f64 = 0.15;
/// Dots along a side of a pixel.
const COARSENING: u32 = 2;

/// What a figure is drawn in.
#[derive(Clone, Copy)]
enum Medium {
    Vectors,
    Dots,
}

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
    paint(SVGBackend::with_string(&mut text, fine.into()), sheet, Medium::Vectors)?;
    let head = |[width, height]: [u32; 2]| format!("width=\"{width}\" height=\"{height}\"");
    Ok(text.replacen(&head(fine), &head([width, height]), 1))
}

/// Size and pixels of a sheet.
fn pixels(sheet: &Sheet) -> io::Result<([u32; 2], Vec<u8>)> {
    let [width, height] = sheet.size.map(|length| GRAIN * length);
    let mut dots = vec![0; 3 * width as usize * height as usize];
    paint(BitMapBackend::with_buffer(&mut dots, (width, height)), sheet, Medium::Dots)?;
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

fn paint<B: DrawingBackend>(backend: B, sheet: &Sheet, medium: Medium) -> io::Result<()> {
    let area = backend.into_drawing_area();
    area.fill(&WHITE).map_err(broken)?;
    sheet.elements.iter().try_for_each(|element| draw(&area, element, medium).map_err(broken))?;
    area.present().map_err(broken)
}

fn broken(error: impl std::error::Error) -> io::Error {
    io::Error::other(error.to_string())
}

fn draw<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    element: &Element,
    medium: Medium,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    match element {
        Element::Line { points, colour, width } => draw_line(area, &dots(points), rgb(*colour), dot(*width), medium),
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
            let drop = if let Medium::Dots = medium { DROP * size } else { 0.0 };
            let [right, down] = if *upwards { [drop, 0.0] } else { [0.0, drop] };
            area.draw_text(text, &style, (dot(x + right), dot(y + down)))
        }
    }
}

/// A line in dots is drawn piece by piece, with round joints: where a single one meets itself, it would leave holes.
fn draw_line<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    points: &[(i32, i32)],
    colour: RGBColor,
    width: i32,
    medium: Medium,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let path = |points: &[(i32, i32)]| area.draw(&PathElement::new(points, colour.stroke_width(width as u32)));
    match medium {
        Medium::Vectors => path(points),
        Medium::Dots => {
            points.windows(2).try_for_each(path)?;
            let joint = |three: &[(i32, i32)]| area.draw(&Circle::new(three[1], width / 2, colour.filled()));
            points.windows(3).try_for_each(joint)
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

#[cfg(test)]
mod tests {
    use super::super::{Axis, Corner, Mark, Panel, Point, Series, Symbol};
    use super::*;

    fn figure() -> Figure {
        let panel = |title: &str| {
            let mut panel =
                Panel::new(title, Axis::log("p*", [1e-3, 1.0]), Axis::linear("κ_r", [0.0, 2.5]), Corner::TopRight);
            let points = vec![Point { x: 1e-2, y: 1.75, spread: 0.1 }, Point::at(0.1, 1.7)];
            let joined = Mark::Joined { symbol: Symbol::Diamond, filled: false };
            panel.series.push(Series::new("H = 0.8 < 1", Colour::BLUE, joined, points.clone()));
            panel.series.push(Series::new("", Colour::BLACK, Mark::Dashed, points));
            panel
        };
        Figure { title: "both".into(), panels: vec![panel("lines"), panel("surfaces")] }
    }

    fn written(name: &str, write: fn(&Path, &Figure) -> Result<(), FileError>) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        write(&path, &figure()).unwrap();
        std::fs::read(path).unwrap()
    }

    #[test]
    fn an_svg_says_all_that_the_figure_says() {
        let text = String::from_utf8(written("figure.svg", write_svg)).unwrap();
        assert!(text.starts_with("<svg width=\"1200\" height=\"520\" viewBox=\"0 0 4800 2080\""), "{text}");
        for (words, times) in
            [("both", 1), ("lines", 1), ("surfaces", 1), ("p*", 2), ("κ_r", 2), ("10⁻³", 2), ("H = 0.8 &lt; 1", 2)]
        {
            assert_eq!(text.lines().filter(|line| *line == words).count(), times, "{words} in {text}");
        }
    }

    #[test]
    fn a_png_has_two_pixels_per_unit_and_the_colours() {
        let bytes = written("figure.png", write_png);
        let mut reader = png::Decoder::new(io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let frame = reader.next_frame(&mut pixels).unwrap();
        assert_eq!([frame.width, frame.height], [2400, 1040]);
        let count = |colour: [u8; 3]| pixels.chunks_exact(3).filter(|pixel| *pixel == colour).count();
        assert_eq!(pixels[..3], [255; 3]);
        assert!(count(Colour::BLUE.0) > 500 && count(Colour::BLACK.0) > 500 && count(Colour::GREEN.0) == 0);
    }

    #[test]
    fn a_line_in_dots_may_lie_on_itself() {
        let line = |points| Element::Line { points, colour: Colour::GREEN, width: 2.0 };
        let [once, twice] = [vec![[2.0, 5.0], [8.0, 5.0]], vec![[2.0, 5.0], [8.0, 5.0], [2.0, 5.0]]].map(|points| {
            let (_, pixels) = pixels(&Sheet { size: [12, 10], elements: vec![line(points)] }).unwrap();
            pixels.chunks_exact(3).filter(|pixel| *pixel == Colour::GREEN.0).count()
        });
        assert!(once >= 11 * 3 && twice >= once, "{once} and {twice} pixels");
    }

    #[test]
    fn a_figure_is_the_same_bytes_every_time() {
        assert_eq!(written("figure.svg", write_svg), written("figure.svg", write_svg));
        assert_eq!(written("figure.png", write_png), written("figure.png", write_png));
    }

    #[test]
    fn a_place_without_room_for_a_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        for write in [write_svg, write_png] {
            for path in [folder.path().to_owned(), folder.path().join("missing/figure")] {
                assert!(matches!(write(&path, &figure()), Err(FileError::Target { .. })), "{path:?}");
            }
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn means_of_squares_make_pixels() {
        let dots = [[0, 0, 0, 200, 100, 0, 8, 8, 8, 8, 8, 8], [0, 0, 0, 200, 0, 4, 8, 8, 8, 8, 8, 8]].concat();
        assert_eq!(coarsened(&dots, 4), [100, 25, 1, 8, 8, 8]);
    }
}
