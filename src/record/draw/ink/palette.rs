//! Colours: of pictures, by background; of curves, which the viewer draws on its own background; and continuous maps.

use crate::plot::Colour;
use crate::record::draw::ink::contrast::{LEAST_CONTRAST, contrast};
use crate::setup::Theme;
use colorgrad::Gradient;
use rerun::components::Colormap;
use rerun::{AnnotationContext, AnnotationInfo, Color};

/// Exact values among the curves of the viewer, seen on its dark ground and on its light one.
pub(crate) const EXACT: Colour = Colour::GREEN;
/// An earlier solve, on both backgrounds.
pub(crate) const GHOST: Colour = Colour([0x80, 0x86, 0x92]);
/// Background curves, on both backgrounds.
pub(crate) const FAINT: Colour = Colour([0x6b, 0x70, 0x7c]);
/// Curves of the viewer that stand side by side, on either ground; green is left to exact values.
pub(crate) const SERIES: [Colour; 6] = [
    Colour([0xc4, 0x7f, 0x00]),
    Colour([0x2f, 0x8f, 0xd0]),
    Colour([0xb8, 0x67, 0x9b]),
    Colour::VERMILION,
    Colour([0x9a, 0x87, 0x00]),
    Colour([0x7d, 0x73, 0xd4]),
];

/// The two colours of curves over the states of a run. Those of one view differ: of a history numbers without a unit have the second one.
pub(crate) const STATE_CURVES: [Colour; 2] = [Colour::SKY, Colour::ORANGE];

/// Classes of the nodes of a mask.
pub(crate) const GAP_CLASS: u16 = 0;
pub(crate) const CONTACT_CLASS: u16 = 1;
pub(crate) const YIELDING_CLASS: u16 = 2;
pub(crate) const CANDIDATE_CLASS: u16 = 3;

/// Colour of candidates, seen on either ground and over the dark end of the scale of gaps, and their opacity.
const CANDIDATE: Colour = Colour([0xb0, 0xb4, 0xbc]);
const CANDIDATE_OPACITY: u8 = 140;

/// The contour of a contact, over the dark ends of the scales of pressure and gap that meet there.
pub(crate) const CONTOUR: Colour = Colour::WHITE;

/// Steps from a colour to that of words.
const SHADES: u16 = 20;

/// The colours of pictures on one background.
#[derive(Debug, PartialEq)]
pub(crate) struct Palette {
    pub ground: Colour,
    /// Text, and everything else that must stand out.
    pub ink: Colour,
    pub indenter: Colour,
    pub indenter_fill: Colour,
    pub solid: Colour,
    pub solid_fill: Colour,
    /// The solid's surface in space where it does not touch.
    pub relief: Colour,
    pub contact: Colour,
    /// What yields of the contact.
    pub yielding: Colour,
    pub pressure: Colour,
    pub gap: Colour,
    pub exact: Colour,
}

const DARK: Palette = Palette {
    ground: Colour([0x12, 0x14, 0x19]),
    ink: Colour([0xe8, 0xea, 0xee]),
    indenter: Colour([0xb4, 0xb8, 0xc0]),
    indenter_fill: Colour([0x3a, 0x3d, 0x45]),
    solid: Colour::SKY,
    solid_fill: Colour([0x1c, 0x3c, 0x52]),
    relief: Colour([0x6f, 0x8a, 0x9e]),
    contact: Colour::VERMILION,
    yielding: Colour::YELLOW,
    pressure: Colour::ORANGE,
    gap: Colour::PURPLE,
    exact: Colour([0x2b, 0xbf, 0x95]),
};

const LIGHT: Palette = Palette {
    ground: Colour::WHITE,
    ink: Colour([0x15, 0x18, 0x1d]),
    indenter: Colour([0x4b, 0x52, 0x60]),
    indenter_fill: Colour([0xdc, 0xdf, 0xe5]),
    solid: Colour([0x00, 0x67, 0xa5]),
    solid_fill: Colour([0xbf, 0xdd, 0xf0]),
    relief: Colour([0x8f, 0xab, 0xbf]),
    contact: Colour::VERMILION,
    yielding: Colour([0x7a, 0x5f, 0x00]),
    pressure: Colour([0xa8, 0x5b, 0x00]),
    gap: Colour([0x9c, 0x4f, 0x86]),
    exact: Colour([0x00, 0x70, 0x4f]),
};

impl Palette {
    pub(crate) fn new(theme: Theme) -> &'static Self {
        match theme {
            Theme::Dark => &DARK,
            Theme::Light => &LIGHT,
        }
    }

    /// A colour chosen for paper, on this ground: greys from white to black become those from the ground to the words, and
    /// other colours come near to the words until they are seen well.
    pub(crate) fn on_ground(&self, paper: Colour) -> Colour {
        let Colour([r, g, b]) = paper;
        if r == g && g == b {
            return mixed(self.ground, self.ink, 1.0 - f64::from(r) / 255.0);
        }
        let shade = |i| mixed(paper, self.ink, f64::from(i) / f64::from(SHADES));
        let is_seen = |shade: &Colour| contrast(*shade, self.ground) >= LEAST_CONTRAST;
        (0..=SHADES).map(shade).find(is_seen).unwrap_or(self.ink)
    }

    /// The names and colours of contact, of what yields of it, of the gap, and of the candidates of an inner iteration, through
    /// which the picture below is seen.
    pub(crate) fn classes(&self) -> AnnotationContext {
        let class = |id, name: &str, color| AnnotationInfo { id, label: Some(name.into()), color: Some(color) };
        let clear = rerun::Rgba32::from_unmultiplied_rgba(0, 0, 0, 0);
        let contact = class(CONTACT_CLASS, "contact", colour(self.contact).0);
        let yielding = class(YIELDING_CLASS, "yielding", colour(self.yielding).0);
        let Colour([r, g, b]) = CANDIDATE;
        let candidate =
            class(CANDIDATE_CLASS, "candidate", rerun::Rgba32::from_unmultiplied_rgba(r, g, b, CANDIDATE_OPACITY));
        AnnotationContext::new([class(GAP_CLASS, "gap", clear), contact, yielding, candidate])
    }
}

/// A colour as the viewer knows it.
pub(crate) fn colour(Colour([r, g, b]): Colour) -> Color {
    Color::from_rgb(r, g, b)
}

/// The colour at `share` of the way between two others.
pub(crate) fn mixed(Colour(from): Colour, Colour(to): Colour, share: f64) -> Colour {
    Colour([0, 1, 2].map(|i| (f64::from(from[i]) + share * (f64::from(to[i]) - f64::from(from[i]))).round() as u8))
}

/// A continuous map, by the name under which the viewer knows it and as colours.
pub(crate) struct ColourMap {
    pub viewer: Colormap,
    colours: Vec<Color>,
}

impl ColourMap {
    pub(crate) fn inferno() -> Self {
        Self::from_gradient(Colormap::Inferno, &colorgrad::preset::inferno())
    }

    pub(crate) fn viridis() -> Self {
        Self::from_gradient(Colormap::Viridis, &colorgrad::preset::viridis())
    }

    pub(crate) fn grey() -> Self {
        let shade = |level: u8| colour(Colour([level; 3]));
        Self { viewer: Colormap::Grayscale, colours: (0..=u8::MAX).map(shade).collect() }
    }

    fn from_gradient(viewer: Colormap, gradient: &impl Gradient) -> Self {
        let colours = gradient.colors(256).map(|c| {
            let [r, g, b, _] = c.to_rgba8();
            colour(Colour([r, g, b]))
        });
        Self { viewer, colours: colours.collect() }
    }

    /// The colour at `t` in 0 to 1, beyond which it stays.
    pub(crate) fn at(&self, t: f64) -> Color {
        self.colours[(t * 255.0).clamp(0.0, 255.0) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each palette, and the plates that the viewer of the same theme lays under words.
    const PLATES: [(&Palette, Colour); 2] = [(&DARK, Colour([0x2c, 0x2e, 0x33])), (&LIGHT, Colour([0xdd, 0xde, 0xe0]))];
    /// Colours on paper.
    const PAPER: [Colour; 7] =
        [Colour::BLUE, Colour::VERMILION, Colour::GREEN, Colour::PURPLE, Colour::ORANGE, Colour::SKY, Colour::YELLOW];

    #[test]
    fn words_are_read_on_every_ground_under_them() {
        for (palette, plate) in PLATES {
            for ground in [palette.ground, plate, palette.indenter_fill, palette.solid_fill] {
                assert!(contrast(palette.ink, ground) >= 4.5, "{:?} on {ground:?}", palette.ink);
            }
        }
    }

    #[test]
    fn lines_are_seen_on_their_ground() {
        for (palette, _) in PLATES {
            let Palette { indenter, solid, relief, contact, yielding, pressure, gap, exact, .. } = *palette;
            let axis = palette.on_ground(Colour::GREY);
            for line in [indenter, solid, contact, yielding, pressure, gap, exact, axis, GHOST] {
                let seen = contrast(line, palette.ground);
                assert!(seen >= LEAST_CONTRAST, "{line:?} on {:?}: {seen}", palette.ground);
            }
            assert!(contrast(relief, palette.ground) > 2.0);
            for paper in PAPER {
                assert!(contrast(palette.on_ground(paper), palette.ground) >= LEAST_CONTRAST, "{paper:?}");
            }
        }
    }

    #[test]
    fn curves_of_the_viewer_are_seen_on_both_of_its_grounds() {
        for curve in SERIES.into_iter().chain([EXACT, GHOST, FAINT]) {
            for ground in [Colour::BLACK, Colour([0x12, 0x14, 0x19]), Colour::WHITE] {
                assert!(contrast(curve, ground) >= LEAST_CONTRAST, "{curve:?} on {ground:?}");
            }
        }
    }

    #[test]
    fn paper_becomes_the_ground_and_its_print_the_words() {
        for (palette, _) in PLATES {
            assert_eq!(palette.on_ground(Colour::WHITE), palette.ground);
            assert_eq!(palette.on_ground(Colour::BLACK), palette.ink);
        }
        assert_eq!(LIGHT.on_ground(Colour::BLUE), Colour::BLUE);
    }
}
