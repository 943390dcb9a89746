//! Fields that a history has besides pressure and gap, such as tractions: curves of a line, images of a surface.

use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::{FieldExtent, FrameFields};
use crate::record::draw::ink::canvas::{self, strip, style};
use crate::record::draw::ink::image::Image;
use crate::record::draw::ink::line_plane::{LinePlane, curve};
use crate::record::draw::ink::palette::ColourMap;
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::ruler::Ruler;
use crate::record::draw::ink::surface_plane::SurfacePlane;
use crate::record::draw::plane::Plane;
use crate::record::scene::FurtherField;
use rerun::{Radius, RecordingStream, RecordingStreamResult, Transform3D};

/// A further field of a scene, on an axis that reaches over its first state with some room, and at the end over all states.
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
                let image = Box::new(Image::new(root, &plane.frame, plane.palette, ruler, colours(&field)));
                Shape::Image { plane: plane.clone(), image }
            }
        };
        Self { field, shape }
    }

    fn root(&self, scene: &str) -> String {
        format!("{scene}/{}", self.field.name)
    }

    /// The values of the field in a state that has it.
    fn values<'f>(&self, fields: &'f FrameFields<'_>) -> Option<&'f [f64]> {
        fields.further.iter().find(|(name, _)| *name == self.field.name).map(|(_, values)| &**values)
    }

    /// The axis of a line and its zero, and the curve stretched to them: states that were recorded before stay right.
    fn log_scaled(
        &self,
        to: &RecordingStream,
        plane: &LinePlane,
        drawn: &Ruler,
        ruler: &Ruler,
    ) -> RecordingStreamResult<()> {
        let (root, palette, height) = (self.root(&plane.root), plane.palette, plane.height());
        canvas::log_axes(to, palette, &format!("{root}/axes"), &plane.frame_with(&ruler.axis))?;
        let zero = height * (1.0 - ruler.place(0.0) as f32);
        let zero = strip(vec![[0.0, zero], [plane.frame.size[0] as f32, zero]]);
        to.log_static(
            format!("{root}/zero"),
            &[&style(palette.gap, Radius::new_ui_points(0.5), 20.0) as &dyn rerun::AsComponents, &zero],
        )?;
        let [low, high] = drawn.axis.range.map(|end| ruler.place(end * drawn.unit) as f32);
        let transform = Transform3D::from_translation([0.0, height * (1.0 - high), 0.0]);
        to.log_static(format!("{root}/curve"), &transform.with_scale([1.0, high - low, 1.0]))
    }
}

/// The colours of the image of a field: other ones where it has both signs.
fn colours(field: &FurtherField) -> ColourMap {
    if field.range[0] < 0.0 { ColourMap::viridis() } else { ColourMap::inferno() }
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
        let curve = format!("{}/curve", self.root(&plane.root));
        to.log_static(curve, &style(plane.palette.contact, Radius::new_ui_points(1.4), 32.0))?;
        self.log_scaled(to, plane, ruler, ruler)
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let Some(values) = self.values(fields) else { return Ok(()) };
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

    fn extent(&self, fields: &FrameFields<'_>) -> FieldExtent {
        self.values(fields).map_or(FieldExtent::NONE, |values| FieldExtent::of_further(self.field.name, values))
    }

    fn settle(&self, to: &RecordingStream, extent: &FieldExtent) -> RecordingStreamResult<()> {
        let Some(range) = extent.further(self.field.name) else { return Ok(()) };
        let field = self.field.over(range);
        let ruler = Ruler::over(field.symbol, field.range, field.unit);
        match &self.shape {
            Shape::Curve { plane, ruler: drawn } => self.log_scaled(to, plane, drawn, &ruler),
            Shape::Image { image, .. } => image.scaled(ruler, colours(&field)).log_static(to),
        }
    }
}
