//! Marks of series: lines and symbols.

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A solid line.
    Line,
    /// A dashed line.
    Dashed,
    /// A dotted line.
    Dotted,
    /// A symbol at each point.
    Symbol {
        /// Its shape.
        symbol: Symbol,
        /// Filled, or an outline on white.
        filled: bool,
    },
    /// Symbols joined by a line.
    Joined {
        /// Their shape.
        symbol: Symbol,
        /// Filled, or outlines on white.
        filled: bool,
    },
}

/// A shape that tells a series from others without colours.
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
