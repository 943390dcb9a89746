//! The font, which comes with the program, so that bare machines draw the same.

use crate::seen::plain;
use resvg::usvg::{Error, Options, Tree, fontdb::Database};
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::GlyphMetrics;
use skrifa::{FontRef, GlyphId, MetadataProvider};
use std::sync::{Arc, LazyLock};

/// Font of an SVG: the one that comes with the program, or else one of the reader of the SVG.
pub(crate) const FAMILY: &str = "DejaVu Sans, sans-serif";
/// From the middle of a line of words down to its baseline, over the size of the font.
pub(crate) const BASELINE: f64 = 0.36;

/// The letters of the font.
pub(crate) static FONT: LazyLock<FontRef<'static>> =
    LazyLock::new(|| FontRef::new(dejavu::sans::regular()).expect("the font of the crate `dejavu` is whole"));

/// The parts of an SVG, its words as outlines of letters.
pub(crate) fn tree(svg: &str) -> Result<Tree, Error> {
    static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
        let mut fonts = Database::new();
        fonts.load_font_data(dejavu::sans::regular().to_vec());
        Arc::new(fonts)
    });
    Tree::from_str(svg, &Options { fontdb: FONTS.clone(), ..Options::default() })
}

/// The width of `words` in the font of `size`.
pub(crate) fn width(words: &str, size: f64) -> f64 {
    let metrics = metrics(size);
    glyphs(words).map(|glyph| advance(&metrics, glyph)).sum()
}

/// The glyphs of `words`; a character that the font does not have becomes its empty box.
pub(crate) fn glyphs(words: &str) -> impl Iterator<Item = GlyphId> {
    let characters = FONT.charmap();
    words.chars().map(move |character| characters.map(character).unwrap_or_default())
}

/// The widths of glyphs in the font of `size`.
pub(crate) fn metrics(size: f64) -> GlyphMetrics<'static> {
    FONT.glyph_metrics(Size::new(size as f32), LocationRef::default())
}

/// From the start of a glyph to that of the next one.
pub(crate) fn advance(metrics: &GlyphMetrics<'_>, glyph: GlyphId) -> f64 {
    metrics.advance_width(glyph).map_or(0.0, f64::from)
}

/// `words` with the marks of SVG spelt out, and without characters that it cannot hold.
pub(crate) fn escaped(words: &str) -> String {
    plain(words).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_grow_with_size_and_words_and_nothing_is_missing_from_the_font() {
        let one = width("κ", 10.0);
        assert!((4.0..8.0).contains(&one), "{one}");
        assert!((width("κκ", 20.0) - 4.0 * one).abs() < 1e-3);
        let words = "⁻³·√η<&τ_µ²κ−×±";
        assert!(glyphs(words).all(|glyph| glyph != GlyphId::default()));
        assert!(width(words, 10.0) > 7.0 * 2.0 && width("", 10.0) == 0.0);
    }

    #[test]
    fn words_are_as_wide_as_an_svg_draws_them() {
        for words in ["p / E* [1e-3]", "kappa_r", "10⁻³"] {
            let svg = format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\"><text font-family=\"{FAMILY}\" font-size=\"100\">{}</text></svg>",
                escaped(words)
            );
            let drawn = f64::from(tree(&svg).unwrap().root().bounding_box().width());
            assert!((width(words, 100.0) - drawn).abs() < 30.0, "{words}: {drawn}");
        }
    }
}
