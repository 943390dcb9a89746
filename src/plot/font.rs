//! The font, which comes with the program, so that bare machines draw the same.

use resvg::usvg::{Error, Options, Tree, fontdb::Database};
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::GlyphMetrics;
use skrifa::{FontRef, GlyphId, MetadataProvider};
use std::sync::{Arc, LazyLock};

/// Font of an SVG: the one that comes with the program, or else whatever the reader of the SVG has.
pub const FAMILY: &str = "DejaVu Sans, sans-serif";
/// From the middle of a line of words down to its baseline, over the size of the font.
pub const BASELINE: f64 = 0.36;

static FONT: LazyLock<FontRef<'static>> =
    LazyLock::new(|| FontRef::new(dejavu::sans::regular()).expect("the font of the crate `dejavu` is whole"));

/// The parts of an SVG, its words as outlines of letters.
pub fn tree(svg: &str) -> Result<Tree, Error> {
    static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
        let mut fonts = Database::new();
        fonts.load_font_data(dejavu::sans::regular().to_vec());
        Arc::new(fonts)
    });
    Tree::from_str(svg, &Options { fontdb: FONTS.clone(), ..Options::default() })
}

/// The width of `words` in the font of `size`.
pub fn width(words: &str, size: f64) -> f64 {
    let metrics = metrics(size);
    glyphs(words).map(|glyph| advance(&metrics, glyph)).sum()
}

/// The glyphs of `words`; a character that the font does not have becomes its empty box.
fn glyphs(words: &str) -> impl Iterator<Item = GlyphId> {
    let characters = FONT.charmap();
    words.chars().map(move |character| characters.map(character).unwrap_or_default())
}

fn metrics(size: f64) -> GlyphMetrics<'static> {
    FONT.glyph_metrics(Size::new(size as f32), LocationRef::default())
}

/// From the start of a glyph to that of the next one.
fn advance(metrics: &GlyphMetrics<'_>, glyph: GlyphId) -> f64 {
    metrics.advance_width(glyph).map_or(0.0, f64::from)
}

/// `words` with the marks of SVG spelt out.
pub fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(feature = "record")]
pub use outlines::outlines;

/// Letters as polygons.
#[cfg(feature = "record")]
mod outlines {
    use super::{BASELINE, FONT, advance, glyphs, metrics};
    use skrifa::MetadataProvider;
    use skrifa::instance::{LocationRef, Size};
    use skrifa::outline::{DrawSettings, OutlinePen};

    /// Straight pieces of a curve of an outline.
    const PIECES: usize = 4;

    /// The closed outlines of `words` in the font of `size`: right and down from the start of the words, half-way up the letters.
    pub fn outlines(words: &str, size: f64) -> Vec<Vec<[f64; 2]>> {
        let (metrics, shapes) = (metrics(size), FONT.outline_glyphs());
        let mut pen = Pen { start: 0.0, outlines: Vec::new() };
        for glyph in glyphs(words) {
            let settings = DrawSettings::unhinted(Size::new(size as f32), LocationRef::default());
            if let Some(shape) = shapes.get(glyph) {
                shape.draw(settings, &mut pen).ok(); // a glyph that cannot be drawn stays empty
            }
            pen.start += advance(&metrics, glyph);
        }
        let lowered = |[x, y]: [f64; 2]| [x, BASELINE * size - y];
        pen.outlines.into_iter().map(|outline| outline.into_iter().map(lowered).collect()).collect()
    }

    /// Outlines that are being drawn, from the baseline upwards.
    struct Pen {
        /// Where the glyph begins.
        start: f64,
        outlines: Vec<Vec<[f64; 2]>>,
    }

    impl Pen {
        fn add(&mut self, x: f32, y: f32) {
            let point = [self.start + f64::from(x), f64::from(y)];
            self.outlines.last_mut().into_iter().for_each(|outline| outline.push(point));
        }

        /// The last point, right and up from the start of the glyph.
        fn last(&self) -> [f32; 2] {
            let last = self.outlines.last().and_then(|outline| outline.last());
            last.map_or([0.0; 2], |[x, y]| [(x - self.start) as f32, *y as f32])
        }

        /// Adds a Bezier curve from the last point on, in straight pieces.
        fn bend<const N: usize>(&mut self, others: [[f32; 2]; N]) {
            let first = self.last();
            for piece in 1..=PIECES {
                let share = piece as f32 / PIECES as f32;
                let mut points: Vec<[f32; 2]> = [first].into_iter().chain(others).collect();
                while points.len() > 1 {
                    let between = |ends: &[[f32; 2]]| [0, 1].map(|i| ends[0][i] + share * (ends[1][i] - ends[0][i]));
                    points = points.windows(2).map(between).collect();
                }
                self.add(points[0][0], points[0][1]);
            }
        }
    }

    impl OutlinePen for Pen {
        fn move_to(&mut self, x: f32, y: f32) {
            self.outlines.push(Vec::new());
            self.add(x, y);
        }

        fn line_to(&mut self, x: f32, y: f32) {
            self.add(x, y);
        }

        fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
            self.bend([[cx, cy], [x, y]]);
        }

        fn curve_to(&mut self, ax: f32, ay: f32, bx: f32, by: f32, x: f32, y: f32) {
            self.bend([[ax, ay], [bx, by], [x, y]]);
        }

        fn close(&mut self) {}
    }

    #[cfg(test)]
    mod tests {
        use super::*;
        use crate::plot::width;

        #[test]
        fn letters_stand_around_their_middle_and_within_their_width() {
            let words = "H0";
            let points: Vec<[f64; 2]> = outlines(words, 100.0).concat();
            let ends = |axis: usize| {
                points.iter().fold([f64::MAX, f64::MIN], |[low, high], at| [low.min(at[axis]), high.max(at[axis])])
            };
            let ([left, right], [top, bottom]) = (ends(0), ends(1));
            assert!(left > 0.0 && right < width(words, 100.0), "{left} {right}");
            assert!((top + bottom).abs() < 3.0 && (70.0..80.0).contains(&(bottom - top)), "{top} {bottom}");
            assert_eq!(outlines("0", 10.0).len(), 3, "an oval, its hole, and nothing else but what the font has");
        }
    }
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
