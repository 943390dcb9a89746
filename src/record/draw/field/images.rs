//! Pressure and gap of a surface, as images.

use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::{FieldExtent, FrameFields, range};
use crate::record::draw::ink::image::Image;
use crate::record::draw::ink::palette::ColourMap;
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::ruler::Ruler;
use crate::record::draw::ink::surface_plane::SurfacePlane;
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult};

/// The images of pressure and gap.
pub(crate) struct FieldImages {
    plane: SurfacePlane,
    pressure: Image,
    gap: Image,
    /// Whether the contact lies over the gap.
    has_contact: bool,
}

impl FieldImages {
    /// The images on the canvas of a surface.
    pub(crate) fn new(subject: &Subject<'_>, plane: &SurfacePlane) -> Self {
        let problem = subject.scene.problem;
        let [low, high] = range(problem.height().iter().copied());
        let image =
            |name, scale, map| Image::new(format!("{}/{name}", plane.root), &plane.frame, plane.palette, scale, map);
        let pressure = Ruler::pressure(subject.forecast.max_pressure, problem.contact_modulus());
        Self {
            pressure: image("pressure", pressure, ColourMap::inferno()),
            gap: image("gap", Ruler::gap(high - low, problem.rms_height()), ColourMap::viridis()),
            has_contact: subject.has(Part::Mask),
            plane: plane.clone(),
        }
    }
}

impl Drawing for FieldImages {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let gap = if self.has_contact { "Gap and contact" } else { "Gap" };
        let [pressure, gap] = [("pressure", "Pressure", false), ("gap", gap, true)]
            .map(|(picture, title, has_contact)| (Place::Field, self.plane.pane(picture, title, has_contact)));
        vec![pressure, gap]
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        let Some(size) = size(&self.plane.root) else { return };
        self.plane.fit(size);
        [&mut self.pressure, &mut self.gap].into_iter().for_each(|image| image.fit(size));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        for (name, image) in [("pressure", &self.pressure), ("gap", &self.gap)] {
            image.log_static(to)?;
            self.plane.log_measured(to, name)?;
        }
        Ok(())
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let blocks = &self.plane.blocks;
        let pressure = blocks.fold(&fields.pressure, fields.stride, 0.0, f64::max);
        self.pressure.log(to, blocks.rows_down(&pressure))?;
        let gap = blocks.fold(&fields.gap, fields.stride, f64::INFINITY, f64::min);
        self.gap.log(to, blocks.rows_down(&gap))
    }

    fn extent(&self, fields: &FrameFields<'_>) -> FieldExtent {
        let [pressure, gap] = [&fields.pressure, &fields.gap].map(|values| range(values.iter().copied())[1]);
        FieldExtent { pressure, gap, ..FieldExtent::NONE }
    }

    fn settle(&self, to: &RecordingStream, extent: &FieldExtent) -> RecordingStreamResult<()> {
        self.pressure.log_scale(to, &self.pressure.scale.fitted(extent.pressure))?;
        self.gap.log_scale(to, &self.gap.scale.fitted(extent.gap))
    }
}
