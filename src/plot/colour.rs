//! The palette: one set of colours for figures and recordings.

/// Red, green and blue. People with colour blindness can distinguish the named colours (Okabe & Ito, "Color Universal
/// Design", 2008).
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
    /// Yellow, too pale for white paper.
    pub const YELLOW: Self = Self([240, 228, 66]);
    /// Black.
    pub const BLACK: Self = Self([0, 0, 0]);
    /// Grey of axes and of references in the background.
    pub const GREY: Self = Self([110, 110, 110]);
    /// Pale grey of grid lines.
    pub(crate) const PALE: Self = Self([225, 225, 225]);
    /// White of the paper.
    pub(crate) const WHITE: Self = Self([255, 255, 255]);
}
