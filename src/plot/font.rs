//! The font, which comes with the program, so that bare machines draw the same.

use plotters::style::{FontDesc, FontStyle, IntoFont, register_font};
use std::sync::Once;

/// The name that the font goes by; in an SVG it is what the viewer has.
const NAME: &str = "sans-serif";
/// Size at which texts are measured, so that rounding does not tell.
const FINE: f64 = 1000.0;

/// The font at `size`.
pub fn font(size: f64) -> FontDesc<'static> {
    static REGISTERED: Once = Once::new();
    REGISTERED.call_once(|| {
        register_font(NAME, FontStyle::Normal, dejavu::sans::regular()).ok();
    });
    (NAME, size).into_font()
}

/// Width of a text in the font of `size`.
pub fn width(text: &str, size: f64) -> f64 {
    let (width, _) = font(FINE).box_size(text).unwrap_or_default();
    f64::from(width) / FINE * size
}
