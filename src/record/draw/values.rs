//! The values behind a curve: numbers for programs, and for people who point at the curve.

use super::palette::colour;
use crate::plot::Colour;
use rerun::datatypes::Float32;
use rerun::{AnyValues, AsComponents, Points2D, Radius, RecordingStream, RecordingStreamResult};

/// Records the look of the values of a curve, which is that of the curve: they lie on it and do not show themselves.
pub fn log_style(
    to: &RecordingStream,
    entity: &str,
    rgb: Colour,
    radius: f32,
    order: f32,
) -> RecordingStreamResult<()> {
    let style = Points2D::update_fields().with_colors([colour(rgb)]).with_radii([Radius::new_ui_points(radius)]);
    to.log_static(entity, &style.with_draw_order(order))
}

/// The values of a curve at some places.
#[derive(Default)]
pub struct Values {
    /// Places on the canvas.
    pub places: Vec<[f32; 2]>,
    /// Positions, in the unit of the lengths of the problem.
    pub x: Vec<f32>,
    /// Values, in the unit of the problem.
    pub values: Vec<f32>,
}

impl Values {
    /// Records them at the current time: positions as the component `x`, values as the component `name`.
    pub fn log(self, to: &RecordingStream, entity: &str, name: &'static str) -> RecordingStreamResult<()> {
        let numbers = AnyValues::default()
            .with_component_override::<Float32>("x", "length", self.x)
            .with_component_override::<Float32>(name, name, self.values);
        let places = Points2D::update_fields().with_positions(self.places);
        to.log(entity, &[&places as &dyn AsComponents, &numbers])
    }
}
