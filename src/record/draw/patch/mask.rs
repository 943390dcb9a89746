//! The contact of a surface, as an image with its contour.

use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::FrameFields;
use crate::record::draw::ink::canvas;
use crate::record::draw::ink::image::format;
use crate::record::draw::ink::palette::{CANDIDATE_CLASS, CONTACT_CLASS, CONTOUR, GAP_CLASS, YIELDING_CLASS};
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::strips::lines_of;
use crate::record::draw::ink::surface_plane::SurfacePlane;
use crate::record::draw::patch::patch_points;
use crate::record::sdk::ChannelDatatype;
use rerun::{Radius, RecordingStream, RecordingStreamResult, SegmentationImage};

/// The nodes in contact, those of them that yield, the candidates of an inner iteration, the contour, and the patches as points.
pub(crate) struct ContactMask {
    plane: SurfacePlane,
    title: String,
    /// Whether the contact needs its own pane, because there are no other pictures.
    is_alone: bool,
}

impl ContactMask {
    /// The contact on the canvas of a surface.
    pub(crate) fn new(subject: &Subject<'_>, plane: &SurfacePlane) -> Self {
        let title = format!("{}: contact", subject.scene.title);
        Self { plane: plane.clone(), title, is_alone: subject.options.what.has_mask_alone() }
    }

    /// The class of a pressure, of a candidate or not.
    fn class(&self, pressure: f64, is_candidate: bool) -> u16 {
        match pressure > 0.0 {
            true if self.plane.law.yields(pressure) => YIELDING_CLASS,
            true => CONTACT_CLASS,
            false if is_candidate => CANDIDATE_CLASS,
            false => GAP_CLASS,
        }
    }

    /// The classes of the pixels, from the top row down.
    fn classes(&self, FrameFields { stride, pressure, candidates, .. }: &FrameFields<'_>) -> Vec<u8> {
        let blocks = &self.plane.blocks;
        let largest = |values: &[f64]| blocks.fold(values, *stride, 0.0, f64::max);
        let pressure = largest(pressure);
        if candidates.is_empty() {
            return blocks.rows_down(&pressure).map(|p| self.class(p, false) as u8).collect();
        }
        let candidates = largest(candidates);
        let both = blocks.rows_down(&pressure).zip(blocks.rows_down(&candidates));
        both.map(|(p, candidate)| self.class(p, candidate > 0.0) as u8).collect()
    }

    /// The lines of the contour in pixels.
    fn contour(&self, fields: &FrameFields<'_>) -> Vec<[[f32; 2]; 2]> {
        let lines = fields.outline.contour.iter();
        lines.map(|line| line.map(|place| self.plane.pixel(place, fields.stride))).collect()
    }
}

impl Drawing for ContactMask {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let pane = self.is_alone.then(|| (Place::Main, self.plane.pane("contact", &self.title, false)));
        pane.into_iter().collect()
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        size(&self.plane.root).into_iter().for_each(|size| self.plane.fit(size));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let SurfacePlane { root, palette, frame, .. } = &self.plane;
        let contact = format!("{root}/contact");
        to.log_static(root.as_str(), &palette.classes())?;
        let style = SegmentationImage::update_fields().with_opacity(0.9).with_draw_order(10.0);
        to.log_static(contact.as_str(), &style.with_format(format(frame, ChannelDatatype::U8)))?;
        patch_points::log_style(to, &format!("{contact}/patches"), CONTOUR)?;
        let line = canvas::style(CONTOUR, Radius::new_ui_points(0.6), 15.0);
        to.log_static(format!("{contact}/contour"), &line)?;
        if self.is_alone {
            self.plane.log_measured(to, "contact")?;
            canvas::log_axes(to, palette, &format!("{contact}/axes"), frame)?;
        }
        Ok(())
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let SurfacePlane { root, blocks, .. } = &self.plane;
        let mask = SegmentationImage::update_fields().with_buffer(self.classes(fields));
        to.log(format!("{root}/contact"), &mask)?;
        to.log(format!("{root}/contact/contour"), &lines_of(&self.contour(fields)))?;
        let nx = blocks.shape[1] / fields.stride[1];
        let place = |node: usize| Some(self.plane.pixel([node / nx, node % nx].map(|n| n as f64), fields.stride));
        patch_points::log(to, &format!("{root}/contact/patches"), &fields.patches, place)
    }
}
