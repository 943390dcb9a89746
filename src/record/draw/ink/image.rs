//! Fields in colours, with axes and a scale.

use super::canvas;
use super::palette::{ColourMap, Palette};
use super::pane::{Pane, PaneView};
use super::reduce::Blocks;
use super::ruler::Ruler;
use super::scale::ColourScale;
use crate::grid::Grid;
use crate::plot::{AxesFrame, Axis};
use crate::record::sdk::{ChannelDatatype, ImageFormat};
use rerun::components::{MagnificationFilter, ValueRange};
use rerun::{DepthImage, RecordingStream, RecordingStreamResult};

/// A field in colours, its frame and its scale.
pub(crate) struct Image {
    pub root: String,
    pub frame: AxesFrame,
    pub colours: ColourScale,
    pub scale: Ruler,
}

impl Image {
    /// The image under `root` in a frame, with its scale and its colours.
    pub(crate) fn new(
        root: String,
        frame: &AxesFrame,
        palette: &'static Palette,
        scale: Ruler,
        map: ColourMap,
    ) -> Self {
        let colours = ColourScale { root: format!("{root}/scale"), palette, map };
        Self { root, frame: frame.clone(), colours, scale }
    }

    /// The same image on another scale and in other colours.
    pub(crate) fn scaled(&self, scale: Ruler, map: ColourMap) -> Self {
        let Self { root, frame, colours, .. } = self;
        Self::new(root.clone(), frame, colours.palette, scale, map)
    }

    /// Makes it as large as a pane allows, width and height in points.
    pub(crate) fn fit(&mut self, pane: [f64; 2]) {
        canvas::fit_image(&mut self.frame, pane);
    }

    /// The view of the image alone.
    pub(crate) fn pane(&self, title: &str) -> Pane {
        let bounds = canvas::bounds(&self.frame, canvas::SCALE_ROOM);
        let contents = vec![format!("{}/**", self.root)];
        PaneView::plane(title, &self.root, contents, (self.root.clone(), bounds), self.colours.palette)
    }

    fn pixels(&self) -> String {
        format!("{}/image", self.root)
    }

    /// Records axes, scale and style.
    pub(crate) fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        canvas::log_axes(to, self.colours.palette, &format!("{}/axes", self.root), &self.frame)?;
        let style = DepthImage::update_fields()
            .with_format(format(&self.frame, ChannelDatatype::F32))
            .with_meter(1.0)
            .with_colormap(self.colours.map.viewer)
            .with_magnification_filter(MagnificationFilter::Nearest)
            .with_draw_order(0.0);
        to.log_static(self.pixels(), &style)?;
        self.log_scale(to, &self.scale.axis)
    }

    /// Records the values of the pixels, row by row from above, at the current time.
    pub(crate) fn log(&self, to: &RecordingStream, values: impl Iterator<Item = f64>) -> RecordingStreamResult<()> {
        let mut bytes = Vec::with_capacity(self.frame.size.iter().product::<f64>() as usize * size_of::<f32>());
        values.for_each(|value| bytes.extend_from_slice(&(value as f32).to_le_bytes()));
        to.log(self.pixels(), &DepthImage::update_fields().with_buffer(bytes))
    }

    /// Records the range of the colours, and beside the image the bar that explains it.
    pub(crate) fn log_scale(&self, to: &RecordingStream, scale: &Axis) -> RecordingStreamResult<()> {
        let range = ValueRange::from(scale.range.map(|number| number * self.scale.unit));
        let range = DepthImage::update_fields().with_depth_range(range);
        to.log_static(self.pixels(), &range)?;
        self.colours.log(to, &self.frame, scale)
    }
}

/// The frame of an image of a surface, a unit for each of its blocks.
pub(crate) fn frame(grid: &Grid, blocks: &Blocks, length_unit: &str) -> AxesFrame {
    let [height, width] = blocks.cells.map(|n| n as f64);
    let axes = [1, 0].map(|i| Ruler::new(["y", "x"][i], length_unit, [0.0, grid.size()[i]]).axis);
    canvas::image_frame(canvas::PANE, axes, [width, height])
}

/// The format of an image that fills a frame with a unit for each pixel.
pub(crate) fn format(frame: &AxesFrame, datatype: ChannelDatatype) -> ImageFormat {
    ImageFormat::depth(frame.size.map(|n| n as u32), datatype)
}
