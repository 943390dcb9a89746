//! Contrasts of colours, after the Web Content Accessibility Guidelines 2.1.

use crate::plot::Colour;

/// Contrast of a line with its ground at which it is seen well (success criterion 1.4.11).
pub(crate) const LEAST_CONTRAST: f64 = 3.0;
/// Luminances at which a colour has a contrast of 3.1 with white, and of 3.1 with the dark ground of the viewer.
const LUMINANCES: [f64; 2] = [0.127, 0.288];

/// The contrast of two colours: 1 for the same, 21 for black on white.
pub(crate) fn contrast(a: Colour, b: Colour) -> f64 {
    let [a, b] = [a, b].map(|colour| luminance(colour) + 0.05);
    a.max(b) / a.min(b)
}

/// The colour, darkened or made paler until it is seen well on white and on the dark ground of the viewer.
pub(crate) fn legible(rgb: Colour) -> Colour {
    let own = luminance(rgb);
    let [low, high] = LUMINANCES;
    let light = rgb.0.map(linear);
    let mixed = match own {
        _ if own > high => light.map(|channel| channel * high / own),
        _ if own < low => light.map(|channel| channel + (1.0 - channel) * (low - own) / (1.0 - own)),
        _ => return rgb,
    };
    Colour(mixed.map(|channel| (255.0 * encoded(channel)).round() as u8))
}

/// The light of a colour over that of white.
fn luminance(Colour(channels): Colour) -> f64 {
    channels.into_iter().zip([0.2126, 0.7152, 0.0722]).map(|(channel, weight)| weight * linear(channel)).sum()
}

/// The light of a channel of sRGB, in 0 to 1.
fn linear(channel: u8) -> f64 {
    match f64::from(channel) / 255.0 {
        channel if channel <= 0.04045 => channel / 12.92,
        channel => ((channel + 0.055) / 1.055).powf(2.4),
    }
}

/// The channel of sRGB, in 0 to 1, of a light.
fn encoded(light: f64) -> f64 {
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contrast_is_that_of_the_guidelines() {
        assert!((contrast(Colour::BLACK, Colour::WHITE) - 21.0).abs() < 1e-9);
        let grey = Colour([0x77; 3]);
        assert!((contrast(grey, Colour::WHITE) - 4.48).abs() < 5e-3 && contrast(grey, grey) == 1.0);
    }

    #[test]
    fn any_colour_becomes_one_that_is_seen_on_both_grounds() {
        let hues = [Colour::ORANGE, Colour::SKY, Colour::GREEN, Colour::PURPLE, Colour::YELLOW, Colour::VERMILION];
        for rgb in hues.into_iter().chain([Colour::BLUE, Colour::BLACK, Colour::WHITE, Colour::GREY]) {
            for ground in [Colour([0x12, 0x14, 0x19]), Colour::WHITE] {
                assert!(contrast(legible(rgb), ground) >= LEAST_CONTRAST, "{rgb:?} becomes {:?}", legible(rgb));
            }
        }
        assert_eq!(legible(Colour::GREEN), Colour::GREEN);
    }
}
