//! Colours of curves in views whose ground is that of the viewer's theme, which may be dark or white.

use super::palette::colour;
use crate::plot::Colour;
use rerun::Color;

/// Luminances at which a colour has a contrast of 3.1 with white, and of 3.1 with the ground of the pictures.
const LUMINANCES: [f32; 2] = [0.127, 0.288];

/// The colour, darkened or made paler until it has a contrast of 3:1 at least with white and with the dark ground (WCAG 2.1,
/// 1.4.11).
pub fn legible(rgb: Colour) -> Color {
    let Colour(channels) = rgb;
    let own = luminance(rgb);
    let [low, high] = LUMINANCES;
    let linear = channels.map(|channel| linear(f32::from(channel) / 255.0));
    let mixed = match own {
        _ if own > high => linear.map(|channel| channel * high / own),
        _ if own < low => linear.map(|channel| channel + (1.0 - channel) * (low - own) / (1.0 - own)),
        _ => return colour(rgb),
    };
    colour(Colour(mixed.map(|channel| (255.0 * encoded(channel)).round() as u8)))
}

/// Relative luminance (WCAG 2.1).
fn luminance(Colour(channels): Colour) -> f32 {
    let [red, green, blue] = channels.map(|channel| linear(f32::from(channel) / 255.0));
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// The intensity of a channel of sRGB.
fn linear(channel: f32) -> f32 {
    if channel <= 0.04045 { channel / 12.92 } else { ((channel + 0.055) / 1.055).powf(2.4) }
}

/// The channel of sRGB of an intensity.
fn encoded(intensity: f32) -> f32 {
    if intensity <= 0.003_130_8 { 12.92 * intensity } else { 1.055 * intensity.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::super::palette::{FAINT, GHOST, GROUND};
    use super::*;

    fn contrast(one: Colour, other: Colour) -> f32 {
        let [one, other] = [one, other].map(|colour| luminance(colour) + 0.05);
        one.max(other) / one.min(other)
    }

    #[test]
    fn contrasts_are_those_of_the_standard() {
        let [black, white] = [Colour([0; 3]), Colour([255; 3])];
        assert!((contrast(black, white) - 21.0).abs() < 1e-3);
        assert!((contrast(Colour([0x76; 3]), white) - 4.54).abs() < 0.01);
    }

    #[test]
    fn curves_are_seen_on_both_grounds() {
        let greys = [Colour([0; 3]), Colour([255; 3]), Colour::GREY, FAINT, GHOST];
        let hues = [Colour::ORANGE, Colour::SKY, Colour::GREEN, Colour::PURPLE, Colour::YELLOW, Colour::VERMILION];
        for rgb in greys.into_iter().chain(hues).chain([Colour::BLUE]) {
            let [r, g, b, _] = legible(rgb).to_array();
            for ground in [GROUND, Colour([255; 3])] {
                assert!(contrast(Colour([r, g, b]), ground) >= 3.0, "{rgb:?} becomes {:?}", [r, g, b]);
            }
        }
        assert_eq!(legible(Colour::GREEN), colour(Colour::GREEN));
    }
}
