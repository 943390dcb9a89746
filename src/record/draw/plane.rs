//! The canvas that the flat pictures of a scene share.

use super::ink::line_plane::LinePlane;
use super::ink::surface_plane::SurfacePlane;
use crate::plot::AxesFrame;
use crate::record::options::Options;
use crate::record::scene::Scene;

/// The canvas of a line or of a surface.
#[derive(Clone)]
pub(crate) enum Plane {
    Line(LinePlane),
    Surface(SurfacePlane),
}

impl Plane {
    /// The canvas of a scene whose entities lie under `root`.
    pub(crate) fn new(scene: &Scene<'_>, root: &str, options: &Options) -> Self {
        if scene.problem.surface().grid().is_line() {
            Self::Line(LinePlane::new(scene, root, options))
        } else {
            Self::Surface(SurfacePlane::new(scene, root, options))
        }
    }

    /// Gives it the proportions of a pane, width and height in points.
    pub(crate) fn fit(&mut self, pane: [f64; 2]) {
        match self {
            Self::Line(plane) => plane.fit(pane),
            Self::Surface(plane) => plane.fit(pane),
        }
    }

    /// The frame above which captions stand.
    pub(crate) fn frame(&self) -> &AxesFrame {
        match self {
            Self::Line(plane) => &plane.frame,
            Self::Surface(plane) => &plane.frame,
        }
    }
}
