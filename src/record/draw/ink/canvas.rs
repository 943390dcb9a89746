//! Canvases: drawings on sheets as lines of the viewer, whose flat views have neither axes nor filled shapes, and whose words stand
//! on grey plates: the letters of axes and legends are lines, too.
//!
//! The layout knows how large the pane of each picture is. The canvas has the proportions of that pane, and its words have the same
//! size in every pane. The box of a curve is [`WIDTH`] wide on every canvas, so that what stands at a share of its width has the same
//! coordinate everywhere; its height, and the size of words, follow from the pane.

use crate::plot::{Align, AxesFrame, Axis, AxisSide, Colour, Element, NAME, Sheet, dashes, width};
use crate::record::draw::ink::fill;
use crate::record::draw::ink::letter_lines::{RADIUS, letter_lines};
use crate::record::draw::ink::palette::{Palette, colour};
use crate::record::draw::ink::strips;
use rerun::components::Text;
use rerun::{AnyValues, AsComponents, Color, LineStrips2D, Radius, RecordingStream, RecordingStreamResult};

/// Width of the box of a curve.
pub(crate) const WIDTH: f64 = 1000.0;
/// Size of words in points of the viewer, which can be read from afar.
pub(crate) const TEXT: f64 = 16.0;
/// Width and height of a pane of unknown size, in points.
pub(crate) const PANE: [f64; 2] = [1040.0, 420.0];
/// Least width and height of a box, in points of the viewer.
const LEAST: f64 = 40.0;
/// Room left, right, above and below the box of a frame, over the size of its words: for the axes, and for a caption above.
const ROOM: [f64; 4] = [5.6, 1.6, 1.9, 3.8];
/// Room to the right of a frame for a scale of colours, over the size of its words.
pub(crate) const SCALE_ROOM: f64 = 7.4;
/// Length of a dash, and of what is between dashes.
const DASHES: [f64; 2] = [14.0, 9.0];
/// From a box up to the middle of the words above it, over their size.
const HEAD: f64 = 0.95;
/// From the corner of a box left and up to the start of the name of the y axis, where it stands above, over the size of words.
const ABOVE: [f64; 2] = [5.2, 1.3];
/// Draw order of points that one points at, above the lines of a contact.
pub(crate) const POINTS: f32 = 36.0;
/// Distance of the lines that fill a shape.
const PITCH: f32 = 1.0;

type Strip = (Vec<[f32; 2]>, Color, Radius);

/// The frame of curves in a pane of a size, with `aside` free to the right, over the size of words.
pub(crate) fn frame(pane: [f64; 2], [x, y]: [Axis; 2], aside: f64) -> AxesFrame {
    let [width, height] = boxed(pane, aside);
    let unit = WIDTH / width;
    AxesFrame { x, y, corner: [0.0, 0.0], size: [WIDTH, unit * height], text: unit * TEXT }
}

/// The frame of an image of `size` with a scale of colours beside it, as large as it can be in a pane of a size.
pub(crate) fn image_frame(pane: [f64; 2], [x, y]: [Axis; 2], size: [f64; 2]) -> AxesFrame {
    let room = boxed(pane, SCALE_ROOM);
    let unit = (0..2).map(|i| size[i] / room[i]).fold(0.0, f64::max);
    AxesFrame { x, y, corner: [0.0, 0.0], size, text: unit * TEXT }
}

/// Gives a frame of curves the proportions of a pane of a size, with `aside` free to the right.
pub(crate) fn fit(frame: &mut AxesFrame, pane: [f64; 2], aside: f64) {
    *frame = self::frame(pane, [frame.x.clone(), frame.y.clone()], aside);
}

/// Makes the frame of an image as large as a pane of a size allows.
pub(crate) fn fit_image(frame: &mut AxesFrame, pane: [f64; 2]) {
    *frame = image_frame(pane, [frame.x.clone(), frame.y.clone()], frame.size);
}

/// Width and height that are left for the box in a pane, with `aside` free to the right.
pub(crate) fn boxed(pane: [f64; 2], aside: f64) -> [f64; 2] {
    let [left, right, above, below] = ROOM.map(|room| room * TEXT);
    [pane[0] - left - right - aside * TEXT, pane[1] - above - below].map(|length| length.max(LEAST))
}

/// The part of the canvas that box, ticks and words of a frame take, with `aside` to the right: left, right, top, bottom.
pub(crate) fn bounds(frame: &AxesFrame, aside: f64) -> [f64; 4] {
    let ([x, y], [width, height]) = (frame.corner, frame.size);
    let [left, right, above, below] = ROOM.map(|room| room * frame.text);
    [x - left, x + width + right + aside * frame.text, y - above, y + height + below]
}

/// Words above the middle of a frame.
pub(crate) fn caption(palette: &Palette, frame: &AxesFrame, words: &str) -> impl AsComponents + use<> {
    let mut sheet = Sheet::default();
    let at = [frame.corner[0] + 0.5 * frame.size[0], frame.corner[1] - HEAD * frame.text];
    sheet.words(words, at, frame.text, Align::Middle);
    written(palette, &sheet)
}

/// Draws the box and both axes of a frame under `entity`, for all times.
pub(crate) fn log_axes(
    to: &RecordingStream,
    palette: &Palette,
    entity: &str,
    frame: &AxesFrame,
) -> RecordingStreamResult<()> {
    log_sheet(to, palette, entity, &axes(frame))
}

/// The box and both axes of a frame. A name of the y axis that is longer than the axis stands above the box.
fn axes(frame: &AxesFrame) -> Sheet {
    let mut sheet = Sheet::default();
    frame.draw_box(&mut sheet);
    frame.draw_axis(&mut sheet, AxisSide::Below);
    let name = &frame.y.name;
    if width(name, NAME * frame.text) <= frame.size[1] {
        frame.draw_axis(&mut sheet, AxisSide::Left);
        return sheet;
    }
    let nameless = AxesFrame { y: Axis { name: String::new(), ..frame.y.clone() }, ..frame.clone() };
    nameless.draw_axis(&mut sheet, AxisSide::Left);
    let [x, y] = frame.corner;
    sheet.words(name, [x - ABOVE[0] * frame.text, y - ABOVE[1] * frame.text], frame.text, Align::Left);
    sheet
}

/// Draws the lower side of a frame with its axis under `entity`, for all times.
pub(crate) fn log_floor(
    to: &RecordingStream,
    palette: &Palette,
    entity: &str,
    frame: &AxesFrame,
) -> RecordingStreamResult<()> {
    let mut sheet = Sheet::default();
    sheet.line([0.0, 1.0].map(|x| frame.position([x, 0.0])).to_vec(), Colour::GREY, 1.2);
    frame.draw_axis(&mut sheet, AxisSide::Below);
    log_sheet(to, palette, entity, &sheet)
}

/// Draws `sheet` under `entity`, for all times.
pub(crate) fn log_sheet(
    to: &RecordingStream,
    palette: &Palette,
    entity: &str,
    sheet: &Sheet,
) -> RecordingStreamResult<()> {
    let lines = strips(sheet.elements.iter().filter_map(|it| outline(palette, it)));
    to.log_static(format!("{entity}/lines"), &lines.with_draw_order(20.0))?;
    to.log_static(format!("{entity}/words"), &written(palette, sheet))
}

pub(crate) fn strips(strips: impl IntoIterator<Item = Strip>) -> LineStrips2D {
    let strips = strips.into_iter().map(|(points, colour, radius)| (points, (colour, radius)));
    let (points, styles): (Vec<_>, Vec<_>) = strips.unzip();
    let (colours, radii): (Vec<_>, Vec<_>) = styles.into_iter().unzip();
    LineStrips2D::new(points).with_colors(colours).with_radii(radii)
}

/// A line in dashes.
pub(crate) fn dashed(line: &[[f64; 2]]) -> impl Iterator<Item = Vec<[f32; 2]>> + use<> {
    let dashes = dashes(line, DASHES).into_iter();
    dashes.map(|dash| dash.into_iter().map(|point| point.map(|p| p as f32)).collect())
}

/// A strip without its style, which is recorded once.
pub(crate) fn strip(points: Vec<[f32; 2]>) -> LineStrips2D {
    LineStrips2D::update_fields().with_strips([points])
}

/// The style of a strip.
pub(crate) fn style(rgb: Colour, radius: Radius, order: f32) -> LineStrips2D {
    LineStrips2D::update_fields().with_colors([colour(rgb)]).with_radii([radius]).with_draw_order(order)
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
        Element::Words { .. } | Element::PixelImage(_) => None,
    }
}

/// The text of a sheet, drawn as lines, together with the text itself, for programs and for the pointer.
pub(crate) fn written(palette: &Palette, sheet: &Sheet) -> impl AsComponents + use<> {
    let mut lines: Vec<[[f32; 2]; 2]> = Vec::new();
    let mut size = 0.0f64;
    let mut all = Vec::new();
    for element in &sheet.elements {
        let Element::Words { words, size: own, .. } = element else { continue };
        lines.extend(lines_of(element));
        size = size.max(*own);
        all.extend((!words.is_empty()).then(|| words.clone()));
    }
    let lines = strips::lines_of(&lines)
        .with_colors([colour(palette.ink)])
        .with_radii([Radius::new_scene_units(RADIUS * size as f32)])
        .with_draw_order(40.0);
    let lines: Vec<_> = lines.as_serialized_batches();
    lines
        .into_iter()
        .chain(AnyValues::default().with_component::<Text>("words", all).as_serialized_batches())
        .collect::<Vec<_>>()
}

/// The lines that fill the letters of words.
fn lines_of(words: &Element) -> Vec<[[f32; 2]; 2]> {
    let Element::Words { words, at: [x, y], size, align, upwards } = words else { return Vec::new() };
    let start = match align {
        Align::Left => 0.0,
        Align::Middle => -0.5 * width(words, *size),
        Align::Right => -width(words, *size),
    };
    let place = |[along, down]: [f32; 2]| {
        let (along, down) = (f64::from(along) + start, f64::from(down));
        if *upwards { [x + down, y - along] } else { [x + along, y + down] }.map(|p| p as f32)
    };
    letter_lines(words, *size).into_iter().map(|line| line.map(place)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn both() -> [Axis; 2] {
        [Axis::linear("across", [0.0, 1.0]), Axis::linear("up", [0.0, 1.0])]
    }

    #[test]
    fn a_frame_fills_its_pane_and_its_words_have_the_same_size_in_every_pane() {
        for pane in [[1040.0, 420.0], [500.0, 440.0], [700.0, 200.0]] {
            for (frame, aside) in [(frame(pane, both(), 0.0), 0.0), (frame(pane, both(), SCALE_ROOM), SCALE_ROOM)] {
                let [left, right, top, bottom] = bounds(&frame, aside);
                let points_per_unit = pane[0] / (right - left);
                assert!(((bottom - top) * points_per_unit / pane[1] - 1.0).abs() < 1e-9, "{pane:?}");
                assert!((frame.text * points_per_unit - TEXT).abs() < 1e-9 && frame.size[0] == WIDTH);
            }
        }
    }

    #[test]
    fn an_image_is_as_large_as_its_pane_allows() {
        for (pane, size) in [([520.0, 420.0], [512.0, 512.0]), ([900.0, 420.0], [256.0, 118.0])] {
            let frame = image_frame(pane, both(), size);
            let [left, right, top, bottom] = bounds(&frame, SCALE_ROOM);
            let points_per_unit = TEXT / frame.text;
            let filled = [right - left, bottom - top].map(|length| length * points_per_unit);
            assert!((0..2).all(|i| filled[i] < pane[i] + 1e-9), "{filled:?} in {pane:?}");
            assert!((0..2).any(|i| (filled[i] / pane[i] - 1.0).abs() < 1e-9), "{filled:?} in {pane:?}");
        }
    }

    #[test]
    fn all_words_of_a_frame_are_there_within_its_bounds_and_the_name_of_the_y_axis_reads_upwards() {
        let frame = frame(PANE, both(), 0.0);
        let sheet = axes(&frame);
        let [left, right, top, bottom] = bounds(&frame, 0.0).map(|end| end as f32);
        for element in &sheet.elements {
            let Element::Words { words, .. } = element else { continue };
            let points: Vec<[f32; 2]> = lines_of(element).concat();
            assert!(!points.is_empty(), "{words}");
            assert!(points.iter().all(|[x, y]| (left..right).contains(x) && (top..bottom).contains(y)), "{words}");
            let reach = |axis: usize| {
                points.iter().fold([f32::MAX, f32::MIN], |[low, high], at| [low.min(at[axis]), high.max(at[axis])])
            };
            let [width, height] = [0, 1].map(|axis| reach(axis)[1] - reach(axis)[0]);
            if words == "up" {
                assert!(width < 1.2 * frame.text as f32 && reach(0)[1] < -3.0 * frame.text as f32);
            }
            if words == "0.2" {
                assert!(width > height);
            }
            if words == "across" {
                assert!(height < width && reach(1)[0] > frame.size[1] as f32);
            }
        }
    }
    #[test]
    fn a_minus_is_as_high_as_a_pixel_in_the_smallest_windows() {
        let mut sheet = Sheet::default();
        sheet.words("−5·10⁻³", [0.0, 0.0], 100.0, Align::Left);
        let rows = |within: [f32; 2]| {
            let spans = lines_of(&sheet.elements[0]).into_iter();
            let mut rows: Vec<f32> =
                spans.filter(|[from, to]| within[0] < from[0] && to[0] < within[1]).map(|[from, _]| from[1]).collect();
            rows.sort_by(f32::total_cmp);
            rows.dedup();
            rows
        };
        let minus = rows([0.0, width("−", 100.0) as f32]);
        let height = minus.last().unwrap() - minus[0] + 200.0 * RADIUS;
        assert!(minus.len() >= 2 && f64::from(height) / 100.0 * 0.7 * TEXT >= 1.0, "{minus:?}");
    }

    #[test]
    fn a_name_that_is_longer_than_its_axis_stands_above_it_as_large_as_ever() {
        let y = Axis::linear("Mean gap over rms height of the surface", [0.0, 1.0]);
        let frame = frame([700.0, 200.0], [both()[0].clone(), y.clone()], 0.0);
        let is_name = |element: &&Element| matches!(element, Element::Words { words, .. } if *words == y.name);
        let sheet = axes(&frame);
        let Some(Element::Words { size, at, upwards, .. }) = sheet.elements.iter().find(is_name) else {
            panic!("the name is not there")
        };
        assert!(!upwards && at[1] < 0.0 && *size == frame.text);
    }
}
