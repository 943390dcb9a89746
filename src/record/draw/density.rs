//! Where the error sits: the density of the error in energy, of a line as a curve and of a surface as an image.

use super::canvas::{self, BOX, TEXT, strip, style};
use super::fields::Fields;
use super::fill;
use super::line::curve;
use super::palette::{Map, Palette};
use super::reduce::Blocks;
use super::ruler::Ruler;
use super::surface::{Image, frame};
use super::window::Window;
use crate::contact::error_density;
use crate::plot::{Axis, Frame};
use crate::record::options::Options;
use crate::record::scene::Scene;
use rerun::{Radius, RecordingStream, RecordingStreamResult};

/// Decades of the density below its largest value that are shown.
const DECADES: f64 = 4.0;

/// The density `p (v - min v)` over its largest value at each step, in decades: its place, whatever its size, which the certificate
/// tells.
pub struct DensityPicture {
    root: String,
    palette: &'static Palette,
    drawing: Drawing,
}

enum Drawing {
    Curve { window: Window, frame: Frame },
    Image { blocks: Blocks, image: Box<Image> },
}

impl DensityPicture {
    pub fn new(scene: &Scene<'_>, root: &str, options: &Options) -> Self {
        let (palette, grid) = (Palette::of(options.theme), scene.problem.surface().grid());
        let root = format!("{root}/density");
        let drawing = if grid.is_line() {
            let window = Window::around(scene);
            let x = Ruler::new("x", &options.length_unit, window.ends(grid.spacing()[1])).axis;
            let y = Axis::log("error density / largest", [10f64.powf(-DECADES), 1.0]);
            Drawing::Curve { window, frame: Frame { x, y, corner: [0.0, 0.0], size: BOX, text: TEXT } }
        } else {
            let blocks = Blocks::image(grid);
            let frame = frame(grid, &blocks, &options.length_unit);
            let scale = Ruler::new("log10 of error density / largest", "", [-DECADES, 0.0]);
            let image = Image::new(root.clone(), &frame, palette, scale, Map::inferno());
            Drawing::Image { blocks, image: Box::new(image) }
        };
        Self { root, palette, drawing }
    }

    pub fn bounds(&self) -> [f64; 4] {
        match &self.drawing {
            Drawing::Curve { frame, .. } => canvas::bounds(frame),
            Drawing::Image { image, .. } => canvas::bounds(&image.frame),
        }
    }

    pub fn root(&self) -> &str {
        &self.root
    }

    pub fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let (root, frame) = match &self.drawing {
            Drawing::Image { image, .. } => return image.log_static(to),
            Drawing::Curve { frame, .. } => (&self.root, frame),
        };
        canvas::log_axes(to, self.palette, &format!("{root}/axes"), frame)?;
        let bars = Radius::new_scene_units(fill::radius(BOX[0] as f32));
        to.log_static(format!("{root}/fill"), &style(self.palette.indenter_fill, bars, 8.0))?;
        to.log_static(format!("{root}/curve"), &style(self.palette.contact, Radius::new_ui_points(1.0), 32.0))
    }

    pub fn log_frame(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let shares = shares(fields);
        let root = &self.root;
        match &self.drawing {
            Drawing::Curve { window, .. } => {
                let nodes = window.every(fields.stride[1]);
                let [width, height] = BOX.map(|length| length as f32);
                let curve = curve(&nodes, |i| height * (1.0 - shares[nodes.node(i)] as f32));
                to.log(format!("{root}/fill"), &strip(fill::under(&curve, width, height, f32::max)))?;
                to.log(format!("{root}/curve"), &strip(curve))
            }
            Drawing::Image { blocks, image } => {
                let shares = blocks.fold(&shares, fields.stride, 0.0, f64::max);
                image.log(to, blocks.rows_down(&shares).map(|share| DECADES * (share - 1.0)))
            }
        }
    }
}

/// The place of the density on the axis at each node: 1 for its largest value, 0 for what is below the axis.
fn shares(fields: &Fields<'_>) -> Vec<f64> {
    let density = error_density(&fields.pressure, &fields.gap);
    let largest = density.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    density.into_iter().map(|it| (1.0 + (it / largest).log10() / DECADES).max(0.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::draw::fields::Outline;

    #[test]
    fn the_largest_density_is_at_the_top_and_four_decades_less_at_the_bottom() {
        let (pressure, gap) = ([0.0, 1.0, 1e-2, 1e-5, 2.0], [9.0, 1.0, 1.0, 1.0, 0.0]);
        let fields = Fields {
            stride: [1, 1],
            pressure: pressure.as_slice().into(),
            gap: gap.as_slice().into(),
            outline: Outline::default(),
            patches: Vec::new(),
        };
        let found = shares(&fields);
        let expected = [0.0, 1.0, 0.5, 0.0, 0.0];
        assert!(found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12), "{found:?}");
    }
}
