//! Images whose columns are steps.

use super::canvas::{self, BOX, TEXT};
use super::palette::Palette;
use super::traces::times;
use crate::contact::Work;
use crate::plot::{Axis, Frame};
use rerun::{AsComponents, Boxes2D, Radius, RecordingStream, RecordingStreamResult, Transform3D};

/// Frame and scale of an image whose columns are steps, to the right, with a quantity upwards.
pub struct StepImage {
    pub root: String,
    pub palette: &'static Palette,
    /// The axis upwards, if there is one.
    y: Option<Axis>,
}

/// The steps that an image shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steps {
    /// Columns of the image.
    pub columns: usize,
    /// Steps of each column.
    pub per_column: usize,
}

impl Steps {
    fn count(self) -> f64 {
        (self.columns * self.per_column).max(1) as f64
    }
}

impl StepImage {
    pub fn new(root: String, palette: &'static Palette, y: Option<Axis>) -> Self {
        Self { root, palette, y }
    }

    pub fn frame(&self, steps: Steps) -> Frame {
        let x = Axis::linear("step", [0.0, steps.count()]);
        let y = self.y.clone().unwrap_or_else(|| Axis::linear("", [0.0, 1.0]));
        Frame { x, y, corner: [0.0, 0.0], size: BOX, text: TEXT }
    }

    /// The part of the canvas that image, axes and scale take.
    pub fn bounds(&self) -> [f64; 4] {
        canvas::bounds(&self.frame(Steps { columns: 1, per_column: 1 }))
    }

    /// Records an image of so many rows with its axes, for all times.
    pub fn log(
        &self,
        to: &RecordingStream,
        image: &impl AsComponents,
        rows: usize,
        steps: Steps,
    ) -> RecordingStreamResult<()> {
        let log_axes = if self.y.is_some() { canvas::log_axes } else { canvas::log_floor };
        log_axes(to, self.palette, &format!("{}/axes", self.root), &self.frame(steps))?;
        let scale = [BOX[0] / steps.columns as f64, BOX[1] / rows as f64].map(|scale| scale as f32);
        let stretched = Transform3D::from_scale([scale[0], scale[1], 1.0]);
        to.log_static(format!("{}/image", self.root), &[&stretched as &dyn AsComponents, image])
    }
}

/// A line through all images at the current step.
pub struct Cursor {
    root: String,
    passed: Vec<(Work, f32)>,
}

impl Cursor {
    pub fn new(root: &str) -> Self {
        Self { root: root.into(), passed: Vec::new() }
    }

    pub fn log_static(&self, to: &RecordingStream, palette: &Palette) -> RecordingStreamResult<()> {
        let line = Boxes2D::update_fields()
            .with_half_sizes([[0.0, 0.5 * BOX[1] as f32]])
            .with_colors([super::palette::colour(palette.ink)])
            .with_radii([Radius::new_ui_points(0.6)])
            .with_draw_order(35.0);
        to.log_static(self.root.as_str(), &line)
    }

    pub fn add(&mut self, work: Work) {
        self.passed.push((work, work.iterations as f32 + 0.5));
    }

    /// Sends the places of the steps so far, and stretches all to the steps of the images.
    pub fn flush(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        if self.passed.is_empty() {
            return Ok(());
        }
        let centers = self.passed.iter().map(|(_, step)| [*step, 0.5 * BOX[1] as f32]);
        let lines = Boxes2D::update_fields().with_centers(centers).columns_of_unit_batches()?;
        to.send_columns(self.root.as_str(), times(&self.passed), lines)?;
        self.passed.clear();
        Ok(())
    }

    pub fn stretch(&self, to: &RecordingStream, steps: Steps) -> RecordingStreamResult<()> {
        let scale = (BOX[0] / steps.count()) as f32;
        to.log_static(self.root.as_str(), &Transform3D::from_scale([scale, 1.0, 1.0]))
    }
}
