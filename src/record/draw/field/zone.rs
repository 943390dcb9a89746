//! The solid below a contact that yields, in a vertical cut: the plastic strain, and the von Mises stress.

use super::stress::{COLUMNS, ROWS, depths, frame};
use crate::contact::{FieldKind, FieldRow};
use crate::grid::Grid;
use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::{FieldExtent, FrameFields};
use crate::record::draw::ink::canvas;
use crate::record::draw::ink::image::Image;
use crate::record::draw::ink::palette::ColourMap;
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::ruler::Ruler;
use crate::record::draw::ink::window::Window;
use crate::record::scene::YieldZone;
use rerun::{RecordingStream, RecordingStreamResult};

/// The pictures of one cut, whose pixels are square in space.
struct ZoneDrawing {
    grid: Grid,
    zone: YieldZone,
    /// First and last position.
    ends: [f64; 2],
    /// The side of a pixel, and the unit of lengths.
    pixel: f64,
    length_unit: String,
    /// The depth of each row.
    depth: Vec<f64>,
    /// The name of each field among those of a frame, its title, and its picture.
    images: [(&'static str, String, Image); 2],
}

/// Room for the largest plastic strain, over that of the first state: it grows in the states that follow. The stress stays near the yield stress
/// where the solid flows.
const STRAIN_ROOM: f64 = 4.0;

/// The drawing of the cut of a scene, if its solid yields below the surface.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    let Subject { scene, root, options, palette, .. } = *subject;
    let zone = scene.zone.clone()?;
    let grid = *scene.problem.surface().grid();
    let whole = [0.0, grid.size()[1]];
    let ends = if grid.is_line() { Window::around(scene).ends(grid.spacing()[1]) } else { whole };
    let pixel = (ends[1] - ends[0]) / COLUMNS as f64;
    let sheet = frame(ends, pixel, ROWS[0], &options.length_unit);
    let place = if grid.is_line() { "below the line" } else { "in a cut through the highest peak" };
    let [strain, stress] = zone.first;
    let scales = scales(&zone, [STRAIN_ROOM * strain, stress]);
    let image = |kind: FieldKind, scale: Ruler| {
        let FieldRow { name, title, .. } = *kind.row();
        let image = Image::new(format!("{root}/{name}"), &sheet, palette, scale, ColourMap::inferno());
        (name, format!("{title} {place}"), image)
    };
    let [strain, stress] = scales;
    let images = [image(FieldKind::PlasticStrain, strain), image(FieldKind::VonMises, stress)];
    let (depth, length_unit) = (depths(ROWS[0], pixel), options.length_unit.clone());
    Some(Box::new(ZoneDrawing { grid, zone, ends, pixel, length_unit, depth, images }))
}

/// The scales of both pictures, for a largest strain and a largest stress: at least up to a small strain and the yield stress.
fn scales(zone: &YieldZone, [strain, stress]: [f64; 2]) -> [Ruler; 2] {
    let scale = |kind: FieldKind, most: f64, unit: f64| Ruler::over(kind.row().symbol, [0.0, most], unit);
    let yield_stress = zone.yield_stress;
    [
        scale(FieldKind::PlasticStrain, strain.max(zone.least_strain), 1.0),
        scale(FieldKind::VonMises, stress.max(yield_stress), yield_stress),
    ]
}

impl ZoneDrawing {
    /// Makes the pictures as large as a pane allows, as deep as it has room for.
    fn fit_pane(&mut self, pane: [f64; 2]) {
        let [width, height] = canvas::boxed(pane, canvas::SCALE_ROOM);
        let rows = ((COLUMNS as f64 * height / width) as usize).clamp(ROWS[0], ROWS[1]);
        self.depth = depths(rows, self.pixel);
        let frame = frame(self.ends, self.pixel, rows, &self.length_unit);
        for (_, _, image) in &mut self.images {
            image.frame = frame.clone();
            image.fit(pane);
        }
    }

    /// The values of a field of the layers in each pixel, row by row from the surface on; 0 below the layers.
    fn pixels(&self, layers: &[f64]) -> Vec<f64> {
        let nx = self.grid.shape()[1];
        let columns: Vec<usize> = (0..COLUMNS).map(|column| self.node(column)).collect();
        let row = |depth: &f64| {
            let layer = self.zone.interfaces.partition_point(|interface| interface <= depth).saturating_sub(1);
            let values = layers.get(layer * nx..(layer + 1) * nx);
            columns.iter().map(move |&node| values.map_or(0.0, |values| values[node])).collect::<Vec<_>>()
        };
        self.depth.iter().flat_map(row).collect()
    }

    /// The node above a column.
    fn node(&self, column: usize) -> usize {
        let [start, end] = self.ends;
        let position = start + (column as f64 + 0.5) / COLUMNS as f64 * (end - start);
        let nx = self.grid.shape()[1];
        ((position / self.grid.spacing()[1]).round().rem_euclid(nx as f64)) as usize % nx
    }
}

impl Drawing for ZoneDrawing {
    fn panes(&self) -> Vec<(Place, Pane)> {
        // the cells of a surface are two in a row
        let places = [Place::Deep, if self.grid.is_line() { Place::Deep } else { Place::Field }];
        let images = self.images.iter().zip(places);
        images.map(|((_, title, image), place)| (place, image.pane(title))).collect()
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        let known = self.images.iter().find_map(|(_, _, image)| size(&image.root));
        known.into_iter().for_each(|size| self.fit_pane(size));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.images.iter().try_for_each(|(_, _, image)| image.log_static(to))
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        self.images.iter().try_for_each(|(name, _, image)| {
            let Some((_, values)) = fields.further.iter().find(|(other, _)| other == name) else { return Ok(()) };
            image.log(to, self.pixels(values).into_iter())
        })
    }

    fn extent(&self, fields: &FrameFields<'_>) -> FieldExtent {
        let shown = fields.further.iter().filter(|(name, _)| self.images.iter().any(|(other, ..)| other == name));
        let extents = shown.map(|(name, values)| FieldExtent::of_further(name, values));
        extents.fold(FieldExtent::NONE, FieldExtent::and)
    }

    fn settle(&self, to: &RecordingStream, extent: &FieldExtent) -> RecordingStreamResult<()> {
        let most = self.images.each_ref().map(|(name, ..)| extent.further(name).map_or(0.0, |[_, most]| most));
        let scaled = self.images.iter().zip(scales(&self.zone, most));
        scaled.into_iter().try_for_each(|((.., image), scale)| image.scaled(scale, ColourMap::inferno()).log_static(to))
    }
}
