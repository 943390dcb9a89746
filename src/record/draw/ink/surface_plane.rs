//! The canvas that the flat pictures of a surface share.

use super::canvas;
use super::image;
use super::line_plane::caption;
use super::mirror::MeasuredPart;
use super::palette::Palette;
use super::pane::{Pane, PaneView};
use super::reduce::Blocks;
use crate::contact::Law;
use crate::plot::AxesFrame;
use crate::record::options::Options;
use crate::record::parts::Parts;
use crate::record::scene::Scene;
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult};

/// The blocks of nodes that are the pixels of images, and the frame around them.
#[derive(Clone)]
pub(crate) struct SurfacePlane {
    /// Root of the entities of the scene.
    pub root: String,
    pub palette: &'static Palette,
    pub law: Law,
    pub blocks: Blocks,
    /// The box with both axes, a unit for each block.
    pub frame: AxesFrame,
    parts: Parts,
    /// The part that was measured, if the rest is its mirror images.
    measured: Option<MeasuredPart>,
}

impl SurfacePlane {
    /// The canvas of a scene whose entities lie under `root`.
    pub(crate) fn new(scene: &Scene<'_>, root: &str, options: &Options) -> Self {
        let grid = scene.problem.surface().grid();
        let blocks = Blocks::image(grid);
        Self {
            root: root.into(),
            palette: Palette::new(options.theme),
            law: scene.problem.law(),
            frame: image::frame(grid, &blocks, &options.length_unit),
            blocks,
            parts: options.what,
            measured: MeasuredPart::new(scene),
        }
    }

    /// Makes it as large as a pane allows, width and height in points.
    pub(crate) fn fit(&mut self, pane: [f64; 2]) {
        canvas::fit_image(&mut self.frame, pane);
    }

    /// The view of a picture on this canvas. The contact and its contour lie in it if it `has_contact`, else the contour alone.
    pub(crate) fn pane(&self, picture: &str, title: &str, has_contact: bool) -> Pane {
        let root = &self.root;
        let mut contents = vec![format!("{root}/{picture}/**"), caption(root)];
        if self.parts.has(Part::Mask) {
            let contact = ["contact", "contact/patches"].map(|entity| format!("{root}/{entity}"));
            contents.extend(contact.into_iter().filter(|_| has_contact));
            contents.push(format!("{root}/contact/contour"));
        }
        let bounds = canvas::bounds(&self.frame, canvas::SCALE_ROOM);
        PaneView::plane(title, root, contents, (root.clone(), bounds), self.palette)
    }

    /// Outlines the measured part in a picture.
    pub(crate) fn log_measured(&self, to: &RecordingStream, picture: &str) -> RecordingStreamResult<()> {
        let entity = format!("{}/{picture}/measured", self.root);
        self.measured.map_or(Ok(()), |measured| measured.log(to, &entity, self.frame.size, self.palette))
    }

    /// The pixel at a place in nodes of the grid with every `stride`-th node.
    pub(crate) fn pixel(&self, [y, x]: [f64; 2], [stride_y, stride_x]: [usize; 2]) -> [f32; 2] {
        let [per_y, per_x] = [0, 1].map(|axis| self.blocks.cells[axis] as f64 / self.blocks.shape[axis] as f64);
        let height = self.blocks.cells[0] as f64;
        [((x * stride_x as f64 + 0.5) * per_x) as f32, (height - (y * stride_y as f64 + 0.5) * per_y) as f32]
    }
}
