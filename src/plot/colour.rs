//! Colours.

/// Red, green and blue. The named ones are told apart by the colour-blind (Okabe & Ito, "Color Universal Design", 2008).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Colour(pub [u8; 3]);

impl Colour {
    /// Blue.
    pub const BLUE: Self = Self([0, 114, 178]);
    /// Vermilion.
    pub const VERMILION: Self = Self([213, 94, 0]);
    /// Bluish green.
    pub const GREEN: Self = Self([0, 158, 115]);
    /// Reddish purple.
    pub const PURPLE: Self = Self([204, 121, 167]);
    /// Orange.
    pub const ORANGE: Self = Self([230, 159, 0]);
    /// Sky blue.
    pub const SKY: Self = Self([86, 180, 233]);
    /// Black.
    pub const BLACK: Self = Self([0, 0, 0]);
    /// Grey of what stands behind.
    pub const GREY: Self = Self([110, 110, 110]);
    /// Lines of the grid.
    pub(super) const PALE: Self = Self([225, 225, 225]);
    /// The ground.
    pub(super) const WHITE: Self = Self([255, 255, 255]);
}
