//! Marks of series: lines and symbols.

use std::f64::consts::TAU;

/// The style of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A solid line.
    Line,
    /// A dashed line.
    Dashed,
    /// A dotted line.
    Dotted,
    /// A pale fill of the area that a line through all points encloses.
    Area,
    /// An arrow from the first point to the last one.
    Arrow,
    /// A filled tile about each point, of which so many fill the frame: cells of a map in colours.
    Tile {
        /// Tiles along the frame.
        columns: u32,
        /// Tiles above each other.
        rows: u32,
    },
    /// A symbol at each point.
    Symbol {
        /// Shape of the symbol.
        symbol: Symbol,
        /// Filled, or an outline on white.
        filled: bool,
    },
    /// Symbols joined by a line.
    Joined {
        /// Shape of the symbols.
        symbol: Symbol,
        /// Filled, or outlines on white.
        filled: bool,
    },
}

/// A shape that distinguishes a series from others without colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Symbol {
    /// A circle.
    Circle,
    /// A square.
    Square,
    /// A triangle that points upwards.
    Triangle,
    /// A square on a corner.
    Diamond,
}

impl Symbol {
    const CURVES: [Self; 4] = [Self::Circle, Self::Square, Self::Triangle, Self::Diamond];

    /// The symbol of a curve by its number from 0, again and again.
    pub fn of_curve(number: usize) -> Self {
        Self::CURVES[number % Self::CURVES.len()]
    }

    /// Corners, right and down from its middle, of a symbol about nine units wide, with its edge `inset` further in.
    pub fn outline(self, inset: f64) -> Vec<[f64; 2]> {
        let (corners, turn, radius) = match self {
            Self::Circle => (24, 0.0, 4.8),
            Self::Square => (4, 0.125, 6.0),
            Self::Triangle => (3, 0.0, 6.6),
            Self::Diamond => (4, 0.0, 6.4),
        };
        let radius = radius - inset / (0.5 * TAU / f64::from(corners)).cos();
        let corner = |i| {
            let (right, up) = (TAU * (f64::from(i) / f64::from(corners) + turn)).sin_cos();
            [radius * right, -radius * up]
        };
        (0..corners).map(corner).collect()
    }
}
