//! How often the nodes of a surface entered or left the contact, as an image.

use super::canvas;
use super::palette::{Map, Palette};
use super::reduce::Blocks;
use super::scale::ColourScale;
use crate::plot::{Axis, Frame};
use crate::record::sdk::{ChannelDatatype, ImageFormat};
use rerun::components::{MagnificationFilter, ValueRange};
use rerun::{DepthImage, RecordingStream, RecordingStreamResult};

/// The nodes of a surface, coloured by how often each flipped; of several in a pixel the one that did so most often.
pub struct FlipMap {
    pub root: String,
    pub frame: Frame,
    pub palette: &'static Palette,
    blocks: Blocks,
}

impl FlipMap {
    pub fn new(root: String, palette: &'static Palette, frame: Frame, blocks: Blocks) -> Self {
        Self { root, frame, palette, blocks }
    }

    /// Makes it as large as a pane of so many points allows.
    pub fn fit(&mut self, pane: [f64; 2]) {
        canvas::fit_image(&mut self.frame, pane);
    }

    pub fn bounds(&self) -> [f64; 4] {
        canvas::bounds(&self.frame, canvas::SCALE_ROOM)
    }

    pub fn log(&self, to: &RecordingStream, flips: &[u32]) -> RecordingStreamResult<()> {
        let flips: Vec<f64> = flips.iter().copied().map(f64::from).collect();
        let most = flips.iter().copied().fold(1.0, f64::max);
        let pixels = self.blocks.fold(&flips, [1, 1], 0.0, f64::max);
        let [height, width] = self.blocks.cells.map(|n| n as u32);
        let rows_down = pixels.rchunks(self.blocks.cells[1]).flatten();
        let map = Map::inferno();
        let image = DepthImage::update_fields()
            .with_buffer(rows_down.flat_map(|&flips| (flips as f32).to_le_bytes()).collect::<Vec<u8>>())
            .with_format(ImageFormat::depth([width, height], ChannelDatatype::F32))
            .with_meter(1.0)
            .with_colormap(map.viewer)
            .with_depth_range(ValueRange::from([0.0, most]))
            .with_magnification_filter(MagnificationFilter::Nearest)
            .with_draw_order(0.0);
        to.log_static(format!("{}/image", self.root), &image)?;
        canvas::log_axes(to, self.palette, &format!("{}/axes", self.root), &self.frame)?;
        let scale = ColourScale { root: format!("{}/scale", self.root), palette: self.palette, map };
        scale.log(to, &self.frame, &Axis::linear("flips", [0.0, most]))
    }
}
