//! Canvases: drawings on sheets as lines and words of the viewer, whose flat views have neither axes nor filled shapes.

use super::fill;
use super::palette::{Palette, colour};
use crate::plot::{Align, Axis, Colour, Element, Frame, Sheet, Side, dashes, width};
use rerun::{Color, LineStrips2D, Points2D, Radius, RecordingStream, RecordingStreamResult};

/// Width and height of the box of a curve.
pub const BOX: [f64; 2] = [1000.0, 460.0];
/// Size of words beside a curve.
pub const TEXT: f64 = 18.0;
/// Room left, right, above and below the box of a frame, over the size of its words.
const MARGINS: [f64; 4] = [4.8, 8.2, 3.1, 3.9];
/// Room left and right over the width of the box, if that is more: the viewer's words do not shrink with a narrow pane.
const SIDES: [f64; 2] = [0.13, 0.26];
/// From the lower right corner of a box to the middle of the name of its x axis, over the size of its words: beside the numbers.
const X_NAME: [f64; 2] = [4.3, 1.2];
/// The same to the right over the width of the box, if that is more.
const X_NAME_ASIDE: f64 = 0.15;
/// Length of a dash, and of what is between dashes.
const DASHES: [f64; 2] = [14.0, 9.0];
/// From a box up to the words above it, over their size.
const HEAD: f64 = 2.5;
/// From the middle of words up to their position, over their size: the viewer hangs words below their positions.
const RISE: f64 = 0.72;
/// Draw order of points that one points at, above the lines of a contact.
pub const POINTS: f32 = 36.0;
/// Distance of the lines that fill a shape.
const PITCH: f32 = 1.0;

type Strip = (Vec<[f32; 2]>, Color, Radius);

/// The part of the canvas that box, ticks and words of a frame take: left, right, top, bottom.
pub fn bounds(frame: &Frame) -> [f64; 4] {
    let ([x, y], [width, height]) = (frame.corner, frame.size);
    let [left, right, above, below] = MARGINS.map(|margin| margin * frame.text);
    let [left, right] = [left.max(SIDES[0] * width), right.max(SIDES[1] * width)];
    [x - left, x + width + right, y - above, y + height + below]
}

/// The height of the words above a frame.
pub fn head(frame: &Frame) -> f64 {
    frame.corner[1] - HEAD * frame.text
}

/// Words above the middle of a frame.
pub fn caption(palette: &Palette, frame: &Frame, words: String) -> Points2D {
    labels(palette, vec![([(frame.corner[0] + 0.5 * frame.size[0]) as f32, head(frame) as f32], words)])
}

/// Draws the box and both axes of a frame under `entity`, for all times.
pub fn log_axes(to: &RecordingStream, palette: &Palette, entity: &str, frame: &Frame) -> RecordingStreamResult<()> {
    let mut sheet = Sheet::default();
    frame.draw_box(&mut sheet);
    frame.draw_axis(&mut sheet, Side::Left);
    draw_x_axis(&mut sheet, frame);
    log_sheet(to, palette, entity, &sheet, head(frame))
}

/// Draws the lower side of a frame with its axis under `entity`, for all times.
pub fn log_floor(to: &RecordingStream, palette: &Palette, entity: &str, frame: &Frame) -> RecordingStreamResult<()> {
    let mut sheet = Sheet::default();
    sheet.line([0.0, 1.0].map(|x| frame.position([x, 0.0])).to_vec(), Colour::GREY, 1.2);
    draw_x_axis(&mut sheet, frame);
    log_sheet(to, palette, entity, &sheet, head(frame))
}

/// Draws the axis below a frame, its name to the right of the numbers: below them the viewer's words would lie on one another.
fn draw_x_axis(sheet: &mut Sheet, frame: &Frame) {
    let nameless = Axis { name: String::new(), ..frame.x.clone() };
    Frame { x: nameless, ..frame.clone() }.draw_axis(sheet, Side::Below);
    let corner = frame.position([1.0, 0.0]);
    let aside = (X_NAME[0] * frame.text).max(X_NAME_ASIDE * frame.size[0]);
    let at = [corner[0] + aside, corner[1] + X_NAME[1] * frame.text];
    sheet.words(&frame.x.name, at, frame.text, Align::Middle);
}

/// Draws `sheet` under `entity`, for all times. Words that read upwards on paper cannot do so here and stand at the height `head`.
pub fn log_sheet(
    to: &RecordingStream,
    palette: &Palette,
    entity: &str,
    sheet: &Sheet,
    head: f64,
) -> RecordingStreamResult<()> {
    let lines = strips(sheet.elements.iter().filter_map(|it| outline(palette, it)));
    to.log_static(format!("{entity}/lines"), &lines.with_draw_order(20.0))?;
    let words = sheet.elements.iter().filter_map(|it| words(it, head)).collect();
    to.log_static(format!("{entity}/words"), &labels(palette, words))
}

pub fn strips(strips: impl IntoIterator<Item = Strip>) -> LineStrips2D {
    let strips = strips.into_iter().map(|(points, colour, radius)| (points, (colour, radius)));
    let (points, styles): (Vec<_>, Vec<_>) = strips.unzip();
    let (colours, radii): (Vec<_>, Vec<_>) = styles.into_iter().unzip();
    LineStrips2D::new(points).with_colors(colours).with_radii(radii)
}

/// A line in dashes.
pub fn dashed(line: &[[f64; 2]]) -> impl Iterator<Item = Vec<[f32; 2]>> + use<> {
    let dashes = dashes(line, DASHES).into_iter();
    dashes.map(|dash| dash.into_iter().map(|point| point.map(|p| p as f32)).collect())
}

/// A strip without its style, which is recorded once.
pub fn strip(points: Vec<[f32; 2]>) -> LineStrips2D {
    LineStrips2D::update_fields().with_strips([points])
}

/// The style of a strip.
pub fn style(rgb: Colour, radius: Radius, order: f32) -> LineStrips2D {
    LineStrips2D::update_fields().with_colors([colour(rgb)]).with_radii([radius]).with_draw_order(order)
}

/// Words at points that do not show themselves.
pub fn labels(palette: &Palette, labels: Vec<([f32; 2], String)>) -> Points2D {
    let (positions, words): (Vec<_>, Vec<_>) = labels.into_iter().unzip();
    Points2D::new(positions)
        .with_labels(words)
        .with_show_labels(true)
        .with_colors([colour(palette.ink)])
        .with_radii([Radius::new_ui_points(0.0)])
        .with_draw_order(40.0)
}

/// A line, or the line that fills a shape.
fn outline(palette: &Palette, element: &Element) -> Option<Strip> {
    let single = |points: &[[f64; 2]]| points.iter().map(|point| point.map(|p| p as f32)).collect::<Vec<_>>();
    match element {
        Element::Line { points, colour: paper, width } => {
            Some((single(points), colour(palette.on_ground(*paper)), Radius::new_ui_points(0.5 * *width as f32)))
        }
        Element::Shape { corners, colour: paper, .. } => {
            let line = fill::shape(&single(corners), PITCH);
            Some((line, colour(palette.on_ground(*paper)), Radius::new_scene_units(0.7 * PITCH)))
        }
        Element::Words { .. } => None,
    }
}

/// Words, and the middle of their upper edge.
fn words(element: &Element, head: f64) -> Option<([f32; 2], String)> {
    let Element::Words { words, at: [x, y], size, align, upwards } = element else { return None };
    let half = 0.5 * width(words, *size);
    let [x, y] = match align {
        _ if *upwards => [half.max(*x), head],
        Align::Left => [x + half, y - RISE * size],
        Align::Middle => [*x, y - RISE * size],
        Align::Right => [x - half, y - RISE * size],
    };
    (!words.is_empty()).then(|| ([x as f32, y as f32], words.clone()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Axis;

    #[test]
    fn all_words_of_a_frame_are_there_and_the_name_of_the_y_axis_stands_above_it() {
        let (x, y) = (Axis::linear("across", [0.0, 1.0]), Axis::linear("up", [0.0, 1.0]));
        let frame = Frame { x, y, corner: [0.0, 0.0], size: [100.0, 100.0], text: 10.0 };
        let mut sheet = Sheet::default();
        frame.draw_axis(&mut sheet, Side::Left);
        draw_x_axis(&mut sheet, &frame);
        let all: Vec<_> = sheet.elements.iter().filter_map(|element| words(element, head(&frame))).collect();
        let [left, right, top, bottom] = bounds(&frame);
        for word in ["across", "0.2", "up"] {
            let ([x, y], _) = all.iter().find(|(_, words)| words == word).unwrap();
            assert!((left..right).contains(&f64::from(*x)) && (top..bottom).contains(&f64::from(*y)), "{word}");
            assert_eq!(*y == -25.0, word == "up");
        }
    }
}
