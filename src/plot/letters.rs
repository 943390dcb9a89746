//! Letters as polygons, for outputs that can draw lines but no text.

use super::font::{BASELINE, FONT, advance, glyphs, metrics};
use skrifa::MetadataProvider;
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};

/// Straight pieces of a curve of an outline.
const PIECES: usize = 4;

/// The closed outlines of a letter: right and down from the start of its words, half-way up the letters.
pub(crate) type Letter = Vec<Vec<[f64; 2]>>;

/// The letters of `words` in the font of `size`.
pub(crate) fn letters(words: &str, size: f64) -> Vec<Letter> {
    let (metrics, shapes) = (metrics(size), FONT.outline_glyphs());
    let mut start = 0.0;
    let mut letters = Vec::new();
    for glyph in glyphs(words) {
        let mut pen = Pen { start, middle: BASELINE * size, outlines: Vec::new() };
        let settings = DrawSettings::unhinted(Size::new(size as f32), LocationRef::default());
        if let Some(shape) = shapes.get(glyph) {
            shape.draw(settings, &mut pen).ok(); // a glyph that cannot be drawn stays empty
        }
        letters.push(pen.outlines);
        start += advance(&metrics, glyph);
    }
    letters
}

/// Outlines that are being drawn.
struct Pen {
    /// Where the glyph begins.
    start: f64,
    /// From the middle of the letters down to the baseline.
    middle: f64,
    outlines: Letter,
}

impl Pen {
    /// Adds a point, right and up from the start of the glyph on the baseline.
    fn add(&mut self, [x, y]: [f32; 2]) {
        let point = [self.start + f64::from(x), self.middle - f64::from(y)];
        self.outlines.last_mut().into_iter().for_each(|outline| outline.push(point));
    }

    /// The last point, as it was added.
    fn last(&self) -> [f32; 2] {
        let last = self.outlines.last().and_then(|outline| outline.last());
        last.map_or([0.0; 2], |[x, y]| [(x - self.start) as f32, (self.middle - y) as f32])
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
            self.add(points[0]);
        }
    }
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.outlines.push(Vec::new());
        self.add([x, y]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.add([x, y]);
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
        let words = letters("H0", 100.0);
        let points: Vec<[f64; 2]> = words.concat().concat();
        let ends = |axis: usize| {
            points.iter().fold([f64::MAX, f64::MIN], |[low, high], at| [low.min(at[axis]), high.max(at[axis])])
        };
        let ([left, right], [top, bottom]) = (ends(0), ends(1));
        assert!(left > 0.0 && right < width("H0", 100.0), "{left} {right}");
        assert!((top + bottom).abs() < 3.0 && (70.0..80.0).contains(&(bottom - top)), "{top} {bottom}");
        assert_eq!(words.iter().map(Vec::len).collect::<Vec<_>>(), [1, 2], "an H, and an oval with its hole");
        assert_eq!(letters(" ", 10.0), [Letter::new()]);
    }
}
