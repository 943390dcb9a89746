//! The palette: one set of colours for figures and recordings.

use std::str::FromStr;

/// Red, green and blue. People with colour blindness can distinguish the named colours (Okabe & Ito, "Color Universal
/// Design", 2008).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Colour(pub [u8; 3]);

impl Colour {
    /// The colours of curves, in their order.
    const CURVES: [Self; 6] = [Self::BLUE, Self::VERMILION, Self::GREEN, Self::PURPLE, Self::ORANGE, Self::SKY];
    /// The colours that have names in flags.
    const NAMED: [(&str, Self); 9] = [
        ("blue", Self::BLUE),
        ("vermilion", Self::VERMILION),
        ("green", Self::GREEN),
        ("purple", Self::PURPLE),
        ("orange", Self::ORANGE),
        ("sky", Self::SKY),
        ("yellow", Self::YELLOW),
        ("black", Self::BLACK),
        ("grey", Self::GREY),
    ];

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

impl Colour {
    /// The colour of a curve by its number from 0, again and again.
    pub fn of_curve(number: usize) -> Self {
        Self::CURVES[number % Self::CURVES.len()]
    }
}

/// A name such as "blue", or red, green and blue as six hexadecimal digits such as "#0072b2".
///
/// ```
/// use asperity::plot::Colour;
/// assert_eq!("blue".parse(), Ok(Colour::BLUE));
/// assert_eq!("#0072b2".parse(), Ok(Colour::BLUE));
/// assert!("bluish".parse::<Colour>().unwrap_err().contains("sky"));
/// ```
impl FromStr for Colour {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if let Some((_, colour)) = Self::NAMED.iter().find(|(name, _)| *name == text) {
            return Ok(*colour);
        }
        let digits = text.strip_prefix('#').filter(|it| it.len() == 6 && it.bytes().all(|it| it.is_ascii_hexdigit()));
        let number = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let names = Self::NAMED.map(|(name, _)| name).join(", ");
        let [_, rgb @ ..] =
            number.ok_or_else(|| format!("`{text}` is no colour: give {names}, or one such as #0072b2"))?.to_be_bytes();
        Ok(Self(rgb))
    }
}
