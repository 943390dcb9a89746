//! How often the nodes of a surface entered or left the contact, as an image.

use crate::plot::Axis;
use crate::record::draw::ink::canvas;
use crate::record::draw::ink::palette::ColourMap;
use crate::record::draw::ink::pane::{Pane, PaneView};
use crate::record::draw::ink::scale::ColourScale;
use crate::record::draw::ink::surface_plane::SurfacePlane;
use crate::record::sdk::{ChannelDatatype, ImageFormat};
use rerun::components::{MagnificationFilter, ValueRange};
use rerun::{DepthImage, RecordingStream, RecordingStreamResult};

/// A map of changes, on the canvas of the other images of a surface.
#[derive(Clone)]
pub(crate) struct FlipMap {
    plane: SurfacePlane,
    root: String,
}

impl FlipMap {
    /// The map on a canvas.
    pub(crate) fn new(plane: &SurfacePlane) -> Self {
        Self { plane: plane.clone(), root: format!("{}/flips", plane.root) }
    }

    /// Gives it the proportions of its pane, whose width and height in points `size` finds.
    pub(crate) fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        size(&self.root).into_iter().for_each(|size| self.plane.fit(size));
    }

    /// The view of the map.
    pub(crate) fn pane(&self) -> Pane {
        let picture = (self.root.clone(), canvas::bounds(&self.plane.frame, canvas::SCALE_ROOM));
        let title = "How often nodes entered or left the contact";
        PaneView::plane(title, &self.root, vec![format!("{}/**", self.root)], picture, self.plane.palette)
    }

    /// Records how often each node has changed so far.
    pub(crate) fn log(&self, to: &RecordingStream, flips: &[u32]) -> RecordingStreamResult<()> {
        let flips: Vec<f64> = flips.iter().copied().map(f64::from).collect();
        let most = flips.iter().copied().fold(1.0, f64::max);
        let pixels = self.plane.blocks.fold(&flips, [1, 1], 0.0, f64::max);
        let [height, width] = self.plane.blocks.cells.map(|n| n as u32);
        let rows_down = pixels.rchunks(self.plane.blocks.cells[1]).flatten();
        let map = ColourMap::inferno();
        let image = DepthImage::update_fields()
            .with_buffer(rows_down.flat_map(|&flips| (flips as f32).to_le_bytes()).collect::<Vec<u8>>())
            .with_format(ImageFormat::depth([width, height], ChannelDatatype::F32))
            .with_meter(1.0)
            .with_colormap(map.viewer)
            .with_depth_range(ValueRange::from([0.0, most]))
            .with_magnification_filter(MagnificationFilter::Nearest)
            .with_draw_order(0.0);
        to.log_static(format!("{}/image", self.root), &image)?;
        canvas::log_axes(to, self.plane.palette, &format!("{}/axes", self.root), &self.plane.frame)?;
        let scale = ColourScale { root: format!("{}/scale", self.root), palette: self.plane.palette, map };
        scale.log(to, &self.plane.frame, &Axis::linear("flips", [0.0, most]))
    }
}
