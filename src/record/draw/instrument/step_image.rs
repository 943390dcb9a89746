//! Images whose columns are steps.

use crate::contact::Work;
use crate::plot::{AxesFrame, Axis};
use crate::record::draw::chart::observable_traces::times;
use crate::record::draw::ink::canvas;
use crate::record::draw::ink::palette::{self, Palette};
use crate::record::draw::ink::pane::{Pane, PaneView};
use rerun::{AsComponents, Boxes2D, Radius, RecordingStream, RecordingStreamResult, Transform3D};

/// Frame and scale of an image whose columns are steps, to the right, with a quantity upwards, and a line at the current step.
#[derive(Clone)]
pub(crate) struct StepImage {
    pub root: String,
    pub palette: &'static Palette,
    /// The axis upwards, if there is one.
    y: Option<Axis>,
    /// Room for a scale of colours, over the size of words.
    aside: f64,
    frame: AxesFrame,
}

/// The steps that an image shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StepAxis {
    /// Columns of the image.
    pub columns: usize,
    /// Steps of each column.
    pub per_column: usize,
}

/// The steps that a solver has passed, each with its work and its place on the axis.
#[derive(Default)]
pub(crate) struct Passed(Vec<(Work, f32)>);

impl Passed {
    pub(crate) fn add(&mut self, work: Work) {
        self.0.push((work, work.iterations as f32 + 0.5));
    }
}

impl StepAxis {
    fn count(self) -> f64 {
        (self.columns * self.per_column).max(1) as f64
    }
}

impl StepImage {
    /// An image under `root`, with room for a scale of colours beside it if it `is_scaled`.
    pub(crate) fn new(root: String, palette: &'static Palette, y: Option<Axis>, is_scaled: bool) -> Self {
        let aside = if is_scaled { canvas::SCALE_ROOM } else { 0.0 };
        let axes = [Axis::linear("step", [0.0, 1.0]), y.clone().unwrap_or_else(|| Axis::linear("", [0.0, 1.0]))];
        Self { root, palette, y, aside, frame: canvas::frame(canvas::PANE, axes, aside) }
    }

    /// The frame of the image of some steps.
    pub(crate) fn frame(&self, steps: StepAxis) -> AxesFrame {
        AxesFrame { x: Axis::linear("step", [0.0, steps.count()]), ..self.frame.clone() }
    }

    /// Gives it the proportions of its pane, whose width and height in points `size` finds.
    pub(crate) fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        size(&self.root).into_iter().for_each(|size| canvas::fit(&mut self.frame, size, self.aside));
    }

    /// The view of the image, with axes and scale.
    pub(crate) fn pane(&self, title: &str) -> Pane {
        let bounds = canvas::bounds(&self.frame, self.aside);
        let contents = vec![format!("{}/**", self.root)];
        PaneView::plane(title, &self.root, contents, (self.root.clone(), bounds), self.palette)
    }

    /// Records an image with a number of rows, and its axes, for all times.
    pub(crate) fn log(
        &self,
        to: &RecordingStream,
        image: &impl AsComponents,
        rows: usize,
        steps: StepAxis,
    ) -> RecordingStreamResult<()> {
        let log_axes = if self.y.is_some() { canvas::log_axes } else { canvas::log_floor };
        log_axes(to, self.palette, &format!("{}/axes", self.root), &self.frame(steps))?;
        let [width, height] = self.frame.size;
        let scale = [width / steps.columns as f64, height / rows as f64].map(|scale| scale as f32);
        let stretched = Transform3D::from_scale([scale[0], scale[1], 1.0]);
        to.log_static(format!("{}/image", self.root), &[&stretched as &dyn AsComponents, image])?;
        let stretched = Transform3D::from_scale([(width / steps.count()) as f32, height as f32, 1.0]);
        to.log_static(self.cursor(), &stretched)
    }

    /// Records what the line at the current step looks like.
    pub(crate) fn log_cursor_style(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let line = Boxes2D::update_fields()
            .with_half_sizes([[0.0, 0.5]])
            .with_colors([palette::colour(self.palette.ink)])
            .with_radii([Radius::new_ui_points(0.6)])
            .with_draw_order(35.0);
        to.log_static(self.cursor(), &line)
    }

    /// Sends where the line stands at the steps that a solver has passed since the last time.
    pub(crate) fn send_cursor(&self, to: &RecordingStream, Passed(passed): &mut Passed) -> RecordingStreamResult<()> {
        if passed.is_empty() {
            return Ok(());
        }
        let centers = passed.iter().map(|(_, step)| [*step, 0.5]);
        let lines = Boxes2D::update_fields().with_centers(centers).columns_of_unit_batches()?;
        to.send_columns(self.cursor(), times(passed), lines)?;
        passed.clear();
        Ok(())
    }

    fn cursor(&self) -> String {
        format!("{}/cursor", self.root)
    }
}
