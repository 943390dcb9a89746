//! What a figure comes to: lines, shapes and texts on a sheet.

use super::{Colour, Figure};

/// Lines, shapes and texts, the later over the earlier, on white. Positions are right and down from the top left corner.
#[derive(Debug, PartialEq)]
pub struct Sheet {
    /// Width and height, in units.
    pub size: [u32; 2],
    pub elements: Vec<Element>,
}

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
    /// One line of text, in black, with its middle at the height `at[1]`.
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
    pub fn of(_figure: &Figure) -> Self {
        Self { size: [600, 480], elements: Vec::new() }
    }
}
