//! A drawing: lines, shapes and words on a sheet.

use super::colour::Colour;
use super::font::width;

/// Lines, shapes and words, the later over the earlier, on white. Positions are right and down from the top left corner.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Sheet {
    /// Width and height, in units.
    pub size: [u32; 2],
    /// Everything on the sheet.
    pub elements: Vec<Element>,
}

/// A thing on a sheet, with lengths in its units.
#[derive(Debug, PartialEq)]
pub(crate) enum Element {
    /// A line through points.
    Line { points: Vec<[f64; 2]>, colour: Colour, width: f64 },
    /// A filled convex shape, whose opacity is the share of the light that it holds back.
    Shape { corners: Vec<[f64; 2]>, colour: Colour, opacity: f64 },
    /// One line of black words that runs to the right or upwards; its part `align`, half-way up the letters, stands at `at`.
    Words { words: String, at: [f64; 2], size: f64, align: Align, upwards: bool },
    /// A picture of pixels.
    PixelImage(PixelImage),
}

/// A rectangle of pixels.
#[derive(Debug, PartialEq)]
pub(crate) struct PixelImage {
    /// Top left corner.
    pub corner: [f64; 2],
    /// Width and height on the sheet.
    pub size: [f64; 2],
    /// Rows and columns of pixels.
    pub shape: [usize; 2],
    /// Pixels, row by row from the top.
    pub pixels: Vec<Colour>,
}

/// A part of a line of words.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Align {
    Left,
    Middle,
    Right,
}

impl Sheet {
    /// Adds a line.
    pub(crate) fn line(&mut self, points: Vec<[f64; 2]>, colour: Colour, width: f64) {
        self.elements.push(Element::Line { points, colour, width });
    }

    /// Adds a shape.
    pub(crate) fn shape(&mut self, corners: Vec<[f64; 2]>, colour: Colour, opacity: f64) {
        self.elements.push(Element::Shape { corners, colour, opacity });
    }

    /// Adds a picture.
    pub(crate) fn image(&mut self, image: PixelImage) {
        self.elements.push(Element::PixelImage(image));
    }

    /// Adds a line around a shape.
    pub(crate) fn edge(&mut self, corners: &[[f64; 2]], colour: Colour, width: f64) {
        self.line(corners.iter().chain(corners.first()).copied().collect(), colour, width);
    }

    /// Adds words from left to right.
    pub(crate) fn words(&mut self, words: &str, at: [f64; 2], size: f64, align: Align) {
        self.elements.push(Element::Words { words: words.into(), at, size, align, upwards: false });
    }

    /// Adds words around their middle, smaller where they would be longer than `room`.
    pub(crate) fn fitted_words(&mut self, words: &str, at: [f64; 2], size: f64, room: f64, upwards: bool) {
        let size = size * (room / width(words, size)).min(1.0);
        self.elements.push(Element::Words { words: words.into(), at, size, align: Align::Middle, upwards });
    }
}

/// The corners of a rectangle.
pub(crate) fn rectangle([left, top]: [f64; 2], [width, height]: [f64; 2]) -> Vec<[f64; 2]> {
    vec![[left, top], [left + width, top], [left + width, top + height], [left, top + height]]
}
