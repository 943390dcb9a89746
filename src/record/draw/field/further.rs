//! Fields that a history has besides pressure and gap, such as tractions: curves of a line, images of a surface.

use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::FrameFields;
use crate::record::draw::ink::canvas::{self, strip, style};
use crate::record::draw::ink::image::Image;
use crate::record::draw::ink::line_plane::{LinePlane, curve};
use crate::record::draw::ink::palette::ColourMap;
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::ruler::Ruler;
use crate::record::draw::ink::surface_plane::SurfacePlane;
use crate::record::draw::plane::Plane;
use crate::record::scene::FurtherField;
use rerun::{Radius, RecordingStream, RecordingStreamResult};

/// A further field of a scene, on an axis that reaches over all of its states.
struct FurtherPicture {
    field: FurtherField,
    shape: Shape,
}

enum Shape {
    Curve { plane: LinePlane, ruler: Ruler },
    Image { plane: SurfacePlane, image: Box<Image> },
}

/// The drawings of the further fields of a scene.
pub(crate) fn draw(subject: &Subject<'_>) -> Vec<Box<dyn Drawing>> {
    let picture = |field: &FurtherField| Box::new(FurtherPicture::new(subject, field.clone())) as Box<dyn Drawing>;
    subject.scene.further.iter().map(picture).collect()
}

impl FurtherPicture {
    fn new(subject: &Subject<'_>, field: FurtherField) -> Self {
        let ruler = Ruler::over(field.symbol, field.range, field.unit);
        let shape = match subject.plane {
            Plane::Line(plane) => Shape::Curve { plane: plane.clone(), ruler },
            Plane::Surface(plane) => {
                let root = format!("{}/{}", plane.root, field.name);
                let map = if field.range[0] < 0.0 { ColourMap::viridis() } else { ColourMap::inferno() };
                let image = Box::new(Image::new(root, &plane.frame, plane.palette, ruler, map));
                Shape::Image { plane: plane.clone(), image }
            }
        };
        Self { field, shape }
    }

    fn root(&self, scene: &str) -> String {
        format!("{scene}/{}", self.field.name)
    }
}

impl Drawing for FurtherPicture {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let FurtherField { name, title, .. } = &self.field;
        let pane = match &self.shape {
            Shape::Curve { plane, .. } => plane.pane(name, title, true),
            Shape::Image { plane, .. } => plane.pane(name, title, false),
        };
        vec![(Place::OfState, pane)]
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        match &mut self.shape {
            Shape::Curve { plane, .. } => size(&plane.root).into_iter().for_each(|size| plane.fit(size)),
            Shape::Image { plane, image } => {
                let Some(size) = size(&plane.root) else { return };
                plane.fit(size);
                image.fit(size);
            }
        }
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let (plane, ruler) = match &self.shape {
            Shape::Image { image, .. } => return image.log_static(to),
            Shape::Curve { plane, ruler } => (plane, ruler),
        };
        let (root, palette) = (self.root(&plane.root), plane.palette);
        canvas::log_axes(to, palette, &format!("{root}/axes"), &plane.frame_with(&ruler.axis))?;
        let zero = plane.height() * (1.0 - ruler.place(0.0) as f32);
        let zero = strip(vec![[0.0, zero], [plane.frame.size[0] as f32, zero]]);
        to.log_static(
            format!("{root}/zero"),
            &[&style(palette.gap, Radius::new_ui_points(0.5), 20.0) as &dyn rerun::AsComponents, &zero],
        )?;
        to.log_static(format!("{root}/curve"), &style(palette.contact, Radius::new_ui_points(1.4), 32.0))
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let Some((_, values)) = fields.further.iter().find(|(name, _)| *name == self.field.name) else { return Ok(()) };
        match &self.shape {
            Shape::Curve { plane, ruler } => {
                let nodes = plane.window.every(fields.stride[1]);
                let level = |i: usize| plane.height() * (1.0 - ruler.place(values[nodes.node(i)]) as f32);
                to.log(format!("{}/curve", self.root(&plane.root)), &strip(curve(&nodes, level)))
            }
            Shape::Image { plane, image } => {
                let pick = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
                let values = plane.blocks.fold(values, fields.stride, 0.0, pick);
                image.log(to, plane.blocks.rows_down(&values))
            }
        }
    }
}
