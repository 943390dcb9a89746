//! The contact of a line, as segments at its lower side.

use crate::contact::Law;
use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::FrameFields;
use crate::record::draw::ink::canvas::{self, style};
use crate::record::draw::ink::line_plane::{LinePlane, WIDTH};
use crate::record::draw::ink::palette::{CONTACT_CLASS, YIELDING_CLASS};
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::reduce::Columns;
use crate::record::draw::patch::patch_points;
use rerun::{LineStrips2D, Radius, RecordingStream, RecordingStreamResult};

/// The nodes in contact, those of them that yield, and the patches as points.
pub(crate) struct ContactSegments {
    plane: LinePlane,
    title: String,
    /// Whether the contact needs its own pane, because there are no other pictures.
    is_alone: bool,
}

impl ContactSegments {
    /// The contact on the canvas of a line.
    pub(crate) fn new(subject: &Subject<'_>, plane: &LinePlane) -> Self {
        let title = format!("{}: contact", subject.scene.title);
        Self { plane: plane.clone(), title, is_alone: subject.options.what.has_mask_alone() }
    }

    fn law(&self) -> &Law {
        &self.plane.law
    }

    /// Runs of nodes that yield, half a spacing beyond the outer ones.
    fn yielding(&self, fields: &FrameFields<'_>) -> Vec<[f32; 2]> {
        let nodes = self.plane.window.every(fields.stride[1]);
        let runs = Columns::new(nodes.count()).runs(|i| self.law().yields(fields.pressure[nodes.node(i)]));
        let end = |i: usize, beyond: f32| ((nodes.place(i) + beyond * nodes.spacing()) * WIDTH).clamp(0.0, WIDTH);
        runs.into_iter().map(|run| [end(run.start, -0.5), end(run.end - 1, 0.5)]).collect()
    }

    fn strips(&self, segments: Vec<[f32; 2]>) -> LineStrips2D {
        let height = self.plane.height();
        LineStrips2D::update_fields().with_strips(segments.into_iter().map(|ends| ends.map(|x| [x, height])))
    }
}

impl Drawing for ContactSegments {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let pane = self.is_alone.then(|| (Place::Main, self.plane.pane("contact", &self.title, false)));
        pane.into_iter().collect()
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        size(&self.plane.root).into_iter().for_each(|size| self.plane.fit(size));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let LinePlane { root, palette, .. } = &self.plane;
        to.log_static(root.as_str(), &palette.classes())?;
        patch_points::log_style(to, &format!("{root}/contact/patches"), palette.contact)?;
        let contact = style(palette.contact, Radius::new_ui_points(2.5), 34.0);
        let contact = contact.with_class_ids([CONTACT_CLASS]).with_show_labels(false);
        to.log_static(format!("{root}/contact"), &contact)?;
        if !self.law().is_hard_wall() {
            let yielding = style(palette.yielding, Radius::new_ui_points(2.5), 35.0);
            let yielding = yielding.with_class_ids([YIELDING_CLASS]).with_show_labels(false);
            to.log_static(format!("{root}/contact/yielding"), &yielding)?;
        }
        if self.is_alone {
            canvas::log_floor(to, palette, &format!("{root}/contact/axes"), &self.plane.frame)?;
        }
        Ok(())
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let (root, nodes) = (&self.plane.root, self.plane.window.every(fields.stride[1]));
        to.log(format!("{root}/contact"), &self.strips(self.plane.segments(fields)))?;
        if !self.law().is_hard_wall() {
            to.log(format!("{root}/contact/yielding"), &self.strips(self.yielding(fields)))?;
        }
        let place = |node| Some([nodes.place(nodes.sample(node)?) * WIDTH, self.plane.height()]);
        patch_points::log(to, &format!("{root}/contact/patches"), &fields.patches, place)
    }
}
