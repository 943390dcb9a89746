//! Colours: the colour-blind safe set of Okabe and Ito on a dark ground, and continuous maps.

use colorgrad::Gradient;
use rerun::Color;
use rerun::components::Colormap;

pub const GROUND: u32 = 0x12_14_19;
pub const INK: u32 = 0xc8_cc_d4;
pub const FAINT: u32 = 0x6b_70_7c;
pub const INDENTER: u32 = 0xb4_b8_c0;
pub const INDENTER_FILL: u32 = 0x3a_3d_45;
pub const SOLID: u32 = 0x56_b4_e9;
pub const SOLID_FILL: u32 = 0x1c_3c_52;
pub const SOLID_RELIEF: u32 = 0x6f_8a_9e;
pub const CONTACT: u32 = 0xd5_5e_00;
pub const PRESSURE: u32 = 0xe6_9f_00;
pub const GAP: u32 = 0x00_9e_73;
pub const EXACT: u32 = 0xf2_f2_f2;
pub const GHOST: u32 = 0x8c_92_9e;

/// Colours of curves that stand side by side.
pub const SERIES: [u32; 6] = [0xe6_9f_00, 0x56_b4_e9, 0x00_9e_73, 0xcc_79_a7, 0xf0_e4_42, 0xd5_5e_00];

/// The colour `0xrrggbb`.
pub fn colour(rgb: u32) -> Color {
    Color::from_u32((rgb << 8) | 0xff)
}

/// A colour chosen for paper, on the dark ground: greys from white to black become those from the ground to white.
pub fn on_ground([r, g, b]: [u8; 3]) -> Color {
    let is_grey = r == g && g == b;
    let [low, high] = [GROUND, EXACT].map(|rgb| rgb.to_be_bytes().map(f32::from));
    let inverted = |part: usize| (high[part] + f32::from(r) / 255.0 * (low[part] - high[part])) as u8;
    if is_grey { Color::from_rgb(inverted(1), inverted(2), inverted(3)) } else { Color::from_rgb(r, g, b) }
}

/// A continuous map, by the name under which the viewer knows it and as colours of our own.
pub struct Map {
    /// The map of the viewer.
    pub viewer: Colormap,
    colours: Vec<Color>,
}

impl Map {
    /// Black over red to yellow.
    pub fn inferno() -> Self {
        Self::of(Colormap::Inferno, &colorgrad::preset::inferno())
    }

    /// Blue over green to yellow.
    pub fn viridis() -> Self {
        Self::of(Colormap::Viridis, &colorgrad::preset::viridis())
    }

    fn of(viewer: Colormap, gradient: &impl Gradient) -> Self {
        let colours = gradient.colors(256).map(|c| {
            let [r, g, b, _] = c.to_rgba8();
            Color::from_rgb(r, g, b)
        });
        Self { viewer, colours: colours.collect() }
    }

    /// The colour at `t` in 0 to 1, beyond which it stays.
    pub fn at(&self, t: f64) -> Color {
        self.colours[(t * 255.0).clamp(0.0, 255.0) as usize]
    }
}
