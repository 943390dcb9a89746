//! The font, which comes with the program, so that bare machines draw the same.

use resvg::usvg::{Error, Options, Tree, fontdb::Database};
use std::sync::{Arc, LazyLock};

/// Font of an SVG: the one that comes with the program, or else whatever the reader of the SVG has.
pub const FAMILY: &str = "DejaVu Sans, sans-serif";
/// Size at which words are measured, large enough that rounding does not show.
const FINE: f64 = 1000.0;

/// The parts of an SVG, its words as outlines of letters.
pub fn tree(svg: &str) -> Result<Tree, Error> {
    static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
        let mut fonts = Database::new();
        fonts.load_font_data(dejavu::sans::regular().to_vec());
        Arc::new(fonts)
    });
    Tree::from_str(svg, &Options { fontdb: FONTS.clone(), ..Options::default() })
}

/// Width of `words` in the font of `size`.
pub fn width(words: &str, size: f64) -> f64 {
    let words = escaped(words);
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1\" height=\"1\">\
         <text font-family=\"{FAMILY}\" font-size=\"{FINE}\">{words}</text></svg>"
    );
    tree(&svg).map_or(0.0, |tree| f64::from(tree.root().bounding_box().width())) / FINE * size
}

/// `words` with the marks of SVG spelt out.
pub fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_grow_with_size_and_words_and_nothing_is_missing_from_the_font() {
        let one = width("κ", 10.0);
        assert!((4.0..8.0).contains(&one), "{one}");
        assert!((width("κκ", 20.0) - 4.0 * one).abs() < 1e-3);
        assert!(width("⁻³·√η<&", 10.0) > 7.0 * 2.0 && width("", 10.0) == 0.0);
    }
}
