//! What a figure comes to: lines, shapes and texts on a sheet.

use super::Colour;
use super::font::width;

/// Lines, shapes and texts, the later over the earlier, on white. Positions are right and down from the top left corner.
#[derive(Debug, PartialEq)]
pub struct Sheet {
    /// Width and height, in units.
    pub size: [u32; 2],
    pub elements: Vec<Element>,
}

/// Something on a sheet.
#[derive(Debug, PartialEq)]
pub enum Element {
    Line {
        points: Vec<[f64; 2]>,
        colour: Colour,
        width: f64,
    },
    Shape {
        corners: Vec<[f64; 2]>,
        colour: Colour,
        opacity: f64,
    },
    /// One line of black text, half of it above the height `at[1]`, or along a vertical at `at[0]`.
    Text {
        text: String,
        at: [f64; 2],
        size: f64,
        align: Align,
        upwards: bool,
    },
}

/// Which part of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Align {
    Left,
    Middle,
    Right,
}

impl Sheet {
    pub fn line(&mut self, points: Vec<[f64; 2]>, colour: Colour, width: f64) {
        self.elements.push(Element::Line { points, colour, width });
    }

    pub fn shape(&mut self, corners: Vec<[f64; 2]>, colour: Colour, opacity: f64) {
        self.elements.push(Element::Shape { corners, colour, opacity });
    }

    /// A line around a shape.
    pub fn edge(&mut self, corners: &[[f64; 2]], colour: Colour, width: f64) {
        self.line(corners.iter().chain(corners.first()).copied().collect(), colour, width);
    }

    /// A text from left to right.
    pub fn text(&mut self, text: &str, at: [f64; 2], size: f64, align: Align) {
        self.elements.push(Element::Text { text: text.into(), at, size, align, upwards: false });
    }

    /// A text around its middle, smaller where it would be longer than `room`.
    pub fn fitted_text(&mut self, text: &str, at: [f64; 2], size: f64, room: f64, upwards: bool) {
        let size = size * (room / width(text, size)).min(1.0);
        self.elements.push(Element::Text { text: text.into(), at, size, align: Align::Middle, upwards });
    }
}

/// The corners of a rectangle.
pub fn rectangle([left, top]: [f64; 2], [right, bottom]: [f64; 2]) -> Vec<[f64; 2]> {
    vec![[left, top], [right, top], [right, bottom], [left, bottom]]
}
