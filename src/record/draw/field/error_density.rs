//! Where the error is: the density of the error in energy, of a line as a curve and of a surface as an image.

use crate::contact::{contact_reach, error_density};
use crate::plot::{AxesFrame, Axis};
use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::FrameFields;
use crate::record::draw::ink::canvas::{self, WIDTH, strip, style};
use crate::record::draw::ink::fill;
use crate::record::draw::ink::image::{Image, format, frame};
use crate::record::draw::ink::line_plane::curve;
use crate::record::draw::ink::palette::{ColourMap, GAP_CLASS, Palette, colour};
use crate::record::draw::ink::pane::{Pane, PaneView};
use crate::record::draw::ink::reduce::{Blocks, Columns};
use crate::record::draw::ink::ruler::Ruler;
use crate::record::draw::ink::window::{Samples, Window};
use crate::record::sdk::ChannelDatatype;
use rerun::{
    AnnotationContext, AnnotationInfo, LineStrips2D, Radius, RecordingStream, RecordingStreamResult, Rgba32,
    SegmentationImage,
};

/// Decades of the density below its largest value that are shown.
const DECADES: f64 = 4.0;
/// Classes of the nodes of a surface that are in contact by their pressure and not by their gap, and the reverse.
const APART_CLASS: u16 = 2;
const UNPRESSED_CLASS: u16 = 3;

/// The density `p (v - min v)` over its largest value at each step, in decades. It shows where the error is; its size
/// is in the certificate. The contact by pressure and the contact by gap are also shown, see [`contact_reach`]: on a
/// line below and above the curve, on a surface where they differ.
struct ErrorDensity {
    root: String,
    palette: &'static Palette,
    shape: CurveOrImage,
}

enum CurveOrImage {
    Curve { window: Window, frame: AxesFrame },
    Image { blocks: Blocks, image: Box<Image> },
}

/// The drawing of the density of the error of a scene.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    Some(Box::new(ErrorDensity::new(subject)))
}

impl ErrorDensity {
    fn new(subject: &Subject<'_>) -> Self {
        let Subject { scene, root, options, palette, .. } = *subject;
        let grid = subject.grid();
        let root = format!("{root}/density");
        let shape = if grid.is_line() {
            let window = Window::around(scene);
            let x = Ruler::new("x", &options.length_unit, window.ends(grid.spacing()[1])).axis;
            let y = Axis::log("error density / largest", [10f64.powf(-DECADES), 1.0]);
            CurveOrImage::Curve { window, frame: canvas::frame(canvas::PANE, [x, y], 0.0) }
        } else {
            let blocks = Blocks::image(grid);
            let frame = frame(grid, &blocks, &options.length_unit);
            let scale = Ruler::new("log10 of error density / largest", "", [-DECADES, 0.0]);
            let image = Image::new(root.clone(), &frame, palette, scale, ColourMap::inferno());
            CurveOrImage::Image { blocks, image: Box::new(image) }
        };
        Self { root, palette, shape }
    }

    /// Records the names and colours of the nodes of a surface in one contact alone.
    fn log_classes(&self, to: &RecordingStream, frame: &AxesFrame) -> RecordingStreamResult<()> {
        let class = |id, name: &str, color| AnnotationInfo { id, label: Some(name.into()), color: Some(color) };
        let classes = AnnotationContext::new([
            class(GAP_CLASS, "no contact, or both", Rgba32::from_unmultiplied_rgba(0, 0, 0, 0)),
            class(APART_CLASS, "pressure across a gap", colour(self.palette.solid).0),
            class(UNPRESSED_CLASS, "touching, no pressure", colour(self.palette.exact).0),
        ]);
        to.log_static(self.root.as_str(), &classes)?;
        let format = format(frame, ChannelDatatype::U8);
        let style = SegmentationImage::update_fields().with_opacity(1.0).with_draw_order(10.0).with_format(format);
        to.log_static(format!("{}/contacts", self.root), &style)
    }
}

impl Drawing for ErrorDensity {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let root = &self.root;
        let pane = match &self.shape {
            CurveOrImage::Curve { frame, .. } => {
                let title =
                    "Where the error is: p (v - min v); contact by pressure (lower line) and by gap (upper line)";
                let picture = (root.clone(), canvas::bounds(frame, 0.0));
                PaneView::plane(title, root, vec![format!("{root}/**")], picture, self.palette)
            }
            CurveOrImage::Image { image, .. } => image
                .pane("Where the error is: p (v - min v); blue: pressure across a gap, green: touching, no pressure"),
        };
        vec![(Place::Further, pane)]
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        let Some(size) = size(&self.root) else { return };
        match &mut self.shape {
            CurveOrImage::Curve { frame, .. } => canvas::fit(frame, size, 0.0),
            CurveOrImage::Image { image, .. } => image.fit(size),
        }
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let (root, frame) = match &self.shape {
            CurveOrImage::Image { image, .. } => {
                image.log_static(to)?;
                return self.log_classes(to, &image.frame);
            }
            CurveOrImage::Curve { frame, .. } => (&self.root, frame),
        };
        canvas::log_axes(to, self.palette, &format!("{root}/axes"), frame)?;
        let bars = Radius::new_scene_units(fill::radius(WIDTH as f32));
        to.log_static(format!("{root}/fill"), &style(self.palette.indenter_fill, bars, 8.0))?;
        to.log_static(format!("{root}/curve"), &style(self.palette.contact, Radius::new_ui_points(1.0), 32.0))?;
        let [pressed, closed] = [self.palette.contact, self.palette.gap];
        to.log_static(format!("{root}/pressed"), &style(pressed, Radius::new_ui_points(2.5), 34.0))?;
        to.log_static(format!("{root}/closed"), &style(closed, Radius::new_ui_points(2.5), 34.0))
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let shares = shares(fields);
        let root = &self.root;
        match &self.shape {
            CurveOrImage::Curve { window, frame } => {
                let nodes = window.every(fields.stride[1]);
                let [width, height] = frame.size.map(|length| length as f32);
                let curve = curve(&nodes, |i| height * (1.0 - shares[nodes.node(i)] as f32));
                to.log(format!("{root}/fill"), &strip(fill::under(&curve, width, height, f32::max)))?;
                to.log(format!("{root}/curve"), &strip(curve))?;
                let reach = contact_reach(&fields.gap);
                let pressed = segments(&nodes, height, |node| fields.pressure[node] > 0.0);
                to.log(format!("{root}/pressed"), &pressed)?;
                to.log(format!("{root}/closed"), &segments(&nodes, 0.0, |node| fields.gap[node] <= reach))
            }
            CurveOrImage::Image { blocks, image } => {
                let shares = blocks.fold(&shares, fields.stride, 0.0, f64::max);
                image.log(to, blocks.rows_down(&shares).map(|share| DECADES * (share - 1.0)))?;
                let buffer: Vec<u8> = classes(blocks, fields);
                to.log(format!("{root}/contacts"), &SegmentationImage::update_fields().with_buffer(buffer))
            }
        }
    }
}

/// The place of the density on the axis at each node: 1 for its largest value, 0 for what is below the axis.
fn shares(fields: &FrameFields<'_>) -> Vec<f64> {
    let density = error_density(&fields.pressure, &fields.gap);
    let largest = density.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    density.into_iter().map(|it| (1.0 + (it / largest).log10() / DECADES).max(0.0)).collect()
}

/// Runs of nodes of a line at a height of the canvas.
fn segments(nodes: &Samples, y: f32, is_in: impl Fn(usize) -> bool) -> LineStrips2D {
    let runs = Columns::new(nodes.count()).runs(|i| is_in(nodes.node(i)));
    let end = |i: usize, beyond: f32| (nodes.place(i) + beyond * nodes.spacing()).clamp(0.0, 1.0) * WIDTH as f32;
    let strips = runs.into_iter().map(|run| [[end(run.start, -0.5), y], [end(run.end - 1, 0.5), y]]);
    LineStrips2D::update_fields().with_strips(strips)
}

/// The classes of the blocks of a surface.
fn classes(blocks: &Blocks, fields: &FrameFields<'_>) -> Vec<u8> {
    let reach = contact_reach(&fields.gap);
    let pressure = blocks.fold(&fields.pressure, fields.stride, 0.0, f64::max);
    let gap = blocks.fold(&fields.gap, fields.stride, f64::INFINITY, f64::min);
    let class = |(p, g): (f64, f64)| match (p > 0.0, g <= reach) {
        (true, false) => APART_CLASS,
        (false, true) => UNPRESSED_CLASS,
        _ => GAP_CLASS,
    };
    blocks.rows_down(&pressure).zip(blocks.rows_down(&gap)).map(|both| class(both) as u8).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::draw::fields::Outline;

    #[test]
    fn the_largest_density_is_at_the_top_and_four_decades_less_at_the_bottom() {
        let (pressure, gap) = ([0.0, 1.0, 1e-2, 1e-5, 2.0], [9.0, 1.0, 1.0, 1.0, 0.0]);
        let fields = FrameFields {
            stride: [1, 1],
            pressure: pressure.as_slice().into(),
            gap: gap.as_slice().into(),
            candidates: (&[]).into(),
            outline: Outline::default(),
            patches: Vec::new(),
            further: Vec::new(),
        };
        let found = shares(&fields);
        let expected = [0.0, 1.0, 0.5, 0.0, 0.0];
        assert!(found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12), "{found:?}");
    }
}
