//! Pictures of fields: pressure, gap, the surface of the solid, its spectrum, the stress below it, the flow through the gap, and
//! where the error is.

mod curves;
mod error_density;
mod flow;
mod fringes;
pub(crate) mod further;
mod images;
pub(crate) mod relief;
mod relief_mesh;
mod relief_walls;
mod rigid_grid;
mod spectrum;
mod stress;
pub(crate) mod surface_relief;
pub(crate) mod zone;

use super::drawing::{Bytes, Drawing, PartRow, Subject};
use super::ink::reduce::{Columns, curve_points, pixels};
use super::plane::Plane;
use crate::grid::Grid;
use crate::setup::Part;

/// The parts of this group, in the order of their panes.
pub(crate) const PARTS: &[PartRow] = &[
    PartRow {
        part: Part::Mesh,
        draw: relief::draw,
        bytes: |grid| Bytes::per_frame(28.0 * relief_mesh::vertices(grid) as f64),
    },
    PartRow { part: Part::Fields, draw: fields, bytes: bytes_of_fields },
    PartRow { part: Part::Stress, draw: stress::draw, bytes: |_| Bytes::per_frame((4 * stress::MOST_PIXELS) as f64) },
    PartRow {
        part: Part::Fringes,
        draw: stress::draw_fringes,
        bytes: |_| Bytes::per_frame((4 * stress::MOST_PIXELS) as f64),
    },
    PartRow { part: Part::Flow, draw: flow::draw, bytes: bytes_of_flow },
    PartRow { part: Part::Spectrum, draw: spectrum::draw, bytes: |_| Bytes::per_frame(2e3) },
    PartRow { part: Part::Error, draw: error_density::draw, bytes: bytes_of_error },
];

/// Pressure and gap: curves of a line, images of a surface.
fn fields(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    Some(match subject.plane {
        Plane::Line(plane) => Box::new(curves::FieldCurves::new(subject, plane)),
        Plane::Surface(plane) => Box::new(images::FieldImages::new(subject, plane)),
    })
}

fn bytes_of_fields(grid: &Grid) -> Bytes {
    Bytes::per_frame(if grid.is_line() {
        16.0 * curve_points(grid) + 40.0 * Columns::new(grid.len()).count() as f64
    } else {
        8.0 * pixels(grid) as f64
    })
}

fn bytes_of_flow(grid: &Grid) -> Bytes {
    Bytes { contact: 16.0 * pixels(grid) as f64, ..Bytes::default() }
}

fn bytes_of_error(grid: &Grid) -> Bytes {
    Bytes::per_frame(if grid.is_line() { 12.0 * curve_points(grid) } else { 4.0 * pixels(grid) as f64 })
}
