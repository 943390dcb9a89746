//! The flow of a fluid through the gap of a surface that was solved to the end: its flux and its pressure, as images.

use crate::contact::Contact;
use crate::flow::{FlowAxis, Leakage};
use crate::plot::Axis;
use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::ink::image::Image;
use crate::record::draw::ink::palette::ColourMap;
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::ruler::Ruler;
use crate::record::draw::ink::surface_plane::SurfacePlane;
use crate::record::draw::plane::Plane;
use rerun::{RecordingStream, RecordingStreamResult};
use std::sync::{Mutex, PoisonError};

/// The goal for the distance of the bounds of the leakage. Colours show three digits at the most.
const TOLERANCE: f64 = 1e-3;
/// Decades of the flux below its mean that are shown, and decades above it that are expected.
const BELOW: f64 = 2.0;
const ABOVE: f64 = 1.0;

/// The flow along both axes. It is found for contacts and not for the steps before, since each flow takes about as long as five
/// contacts.
struct FlowPicture {
    plane: SurfacePlane,
    along: [AxisPicture; 2],
}

/// The images of the flow along one axis.
struct AxisPicture {
    axis: FlowAxis,
    /// The decimal logarithm of the flux over its mean.
    flux: Image,
    /// The pressure of the fluid over its drop.
    pressure: Image,
    /// The largest logarithm of all contacts so far.
    highest: Mutex<f64>,
}

/// The drawing of the flow of a scene; none for a line, in which the flux is the same everywhere.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    let Plane::Surface(plane) = subject.plane else { return None };
    Some(Box::new(FlowPicture { along: FlowAxis::ALL.map(|axis| AxisPicture::new(plane, axis)), plane: plane.clone() }))
}

impl AxisPicture {
    fn new(plane: &SurfacePlane, axis: FlowAxis) -> Self {
        let image = |quantity: &str, scale| {
            let root = format!("{}/{quantity}_{}", plane.root, axis.name());
            Image::new(root, &plane.frame, plane.palette, scale, ColourMap::viridis())
        };
        Self {
            axis,
            flux: image("flux", Ruler::new("log10 of |J| / <J>", "", [-BELOW, ABOVE])),
            pressure: image("fluid_pressure", Ruler::new("P / drop", "", [0.0, 1.0])),
            highest: Mutex::new(ABOVE),
        }
    }

    fn images(&self) -> [&Image; 2] {
        [&self.flux, &self.pressure]
    }

    fn log(&self, to: &RecordingStream, plane: &SurfacePlane, leakage: &Leakage) -> RecordingStreamResult<()> {
        let fold = |values: &crate::surface::Field| {
            plane.blocks.fold(values.as_slice().unwrap_or_default(), [1, 1], 0.0, f64::max)
        };
        let flux: Vec<f64> = fold(&leakage.flux).into_iter().map(|flux| flux.log10().max(-BELOW)).collect();
        let mut highest = self.highest.lock().unwrap_or_else(PoisonError::into_inner);
        *highest = flux.iter().copied().fold(*highest, f64::max);
        self.flux.log_scale(to, &Axis { range: [-BELOW, *highest], ..self.flux.scale.axis.clone() })?;
        self.flux.log(to, plane.blocks.rows_down(&flux))?;
        self.pressure.log(to, plane.blocks.rows_down(&fold(&leakage.pressure)))
    }
}

impl Drawing for FlowPicture {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let panes = |it: &AxisPicture| {
            let name = it.axis.name();
            [("flux", "Flux of the fluid"), ("fluid_pressure", "Pressure of the fluid")].map(|(quantity, title)| {
                let (picture, title) = (format!("{quantity}_{name}"), format!("{title} along {name}, and contact"));
                (Place::Further, self.plane.pane(&picture, &title, true))
            })
        };
        self.along.iter().flat_map(panes).collect()
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        let Some(size) = size(&self.plane.root) else { return };
        self.plane.fit(size);
        self.along.iter_mut().for_each(|it| [&mut it.flux, &mut it.pressure].into_iter().for_each(|it| it.fit(size)));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.along.iter().flat_map(AxisPicture::images).try_for_each(|image| image.log_static(to))
    }

    fn log_contact(&self, to: &RecordingStream, contact: &Contact) -> RecordingStreamResult<()> {
        // what cannot be solved at all, such as more than 1e9 nodes, has no picture
        let Ok(leakages) = Leakage::along(contact, &self.along.each_ref().map(|it| it.axis), TOLERANCE) else {
            return Ok(());
        };
        self.along.iter().zip(&leakages).try_for_each(|(it, leakage)| it.log(to, &self.plane, leakage))
    }
}
