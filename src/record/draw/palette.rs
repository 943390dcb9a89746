//! Colours on the dark ground: those of the one palette, some greys, and continuous maps.

use crate::plot::Colour;
use colorgrad::Gradient;
use rerun::components::Colormap;
use rerun::{AnnotationContext, AnnotationInfo, Color};

pub const GROUND: Colour = Colour([0x12, 0x14, 0x19]);
pub const INK: Colour = Colour([0xc8, 0xcc, 0xd4]);
pub const FAINT: Colour = Colour([0x6b, 0x70, 0x7c]);
pub const INDENTER: Colour = Colour([0xb4, 0xb8, 0xc0]);
pub const INDENTER_FILL: Colour = Colour([0x3a, 0x3d, 0x45]);
pub const SOLID: Colour = Colour::SKY;
pub const SOLID_FILL: Colour = Colour([0x1c, 0x3c, 0x52]);
pub const SOLID_RELIEF: Colour = Colour([0x6f, 0x8a, 0x9e]);
pub const CONTACT: Colour = Colour::VERMILION;
pub const PRESSURE: Colour = Colour::ORANGE;
pub const GAP: Colour = Colour::GREEN;
pub const EXACT: Colour = Colour([0xf2, 0xf2, 0xf2]);
pub const GHOST: Colour = Colour([0x8c, 0x92, 0x9e]);

/// Classes of the nodes of a mask.
pub const GAP_CLASS: u16 = 0;
pub const CONTACT_CLASS: u16 = 1;

/// A colour as the viewer knows it.
pub fn colour(Colour([r, g, b]): Colour) -> Color {
    Color::from_rgb(r, g, b)
}

/// A colour chosen for paper, on the dark ground: greys from white to black become those from the ground to white.
pub fn on_ground(Colour([r, g, b]): Colour) -> Color {
    let darkness = 1.0 - f32::from(r) / 255.0;
    let inverted = |i: usize| {
        let [low, high] = [GROUND, EXACT].map(|end| f32::from(end.0[i]));
        (low + darkness * (high - low)) as u8
    };
    colour(Colour(if r == g && g == b { [0, 1, 2].map(inverted) } else { [r, g, b] }))
}

/// The names and colours of contact and gap.
pub fn classes() -> AnnotationContext {
    let class = |id, name: &str, color| AnnotationInfo { id, label: Some(name.into()), color: Some(color) };
    let clear = rerun::Rgba32::from_unmultiplied_rgba(0, 0, 0, 0);
    let [gap, contact] = [class(GAP_CLASS, "gap", clear), class(CONTACT_CLASS, "contact", colour(CONTACT).0)];
    AnnotationContext::new([gap, contact])
}

/// A continuous map, by the name under which the viewer knows it and as colours.
pub struct Map {
    pub viewer: Colormap,
    colours: Vec<Color>,
}

impl Map {
    pub fn inferno() -> Self {
        Self::of(Colormap::Inferno, &colorgrad::preset::inferno())
    }

    pub fn viridis() -> Self {
        Self::of(Colormap::Viridis, &colorgrad::preset::viridis())
    }

    fn of(viewer: Colormap, gradient: &impl Gradient) -> Self {
        let colours = gradient.colors(256).map(|c| {
            let [r, g, b, _] = c.to_rgba8();
            colour(Colour([r, g, b]))
        });
        Self { viewer, colours: colours.collect() }
    }

    /// The colour at `t` in 0 to 1, beyond which it stays.
    pub fn at(&self, t: f64) -> Color {
        self.colours[(t * 255.0).clamp(0.0, 255.0) as usize]
    }
}
