//! The stress below the surface, in a vertical cut: the largest shear stress in colour, and as photoelastic fringes.

use crate::elastic::stress::{USUAL_POISSON, below, is_known};
use crate::grid::Grid;
use crate::plot::AxesFrame;
use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::field::fringes::{light, per_order};
use crate::record::draw::fields::{FieldExtent, FrameFields};
use crate::record::draw::ink::canvas;
use crate::record::draw::ink::image::Image;
use crate::record::draw::ink::palette::ColourMap;
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::reduce::Blocks;
use crate::record::draw::ink::ruler::Ruler;
use crate::record::draw::ink::window::Window;
use crate::record::scene::Scene;
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult};

/// Columns of the pictures, whose pixels are square in space, and the fewest and the most rows: as many as the pane has room for.
pub(super) const COLUMNS: usize = 256;
pub(super) const ROWS: [usize; 2] = [64, 256];
/// Largest number of pixels of a picture.
pub(crate) const MOST_PIXELS: usize = COLUMNS * ROWS[1];
/// Blocks of the pressure per column of a picture of a line, and their largest number on the whole line.
const FINER: usize = 2;
const MOST: usize = 8192;
/// Largest number of blocks along the longer side of a surface.
const MOST_OF_SURFACE: usize = 256;
/// The largest shear stress below a Hertzian line over the largest pressure: what is expected.
const HERTZ: f64 = 0.30;
/// The share of the largest shear stress that is common below rough contacts, where the largest one stands below one asperity: fringes are
/// so much finer there.
const COMMON: f64 = 0.25;

/// The stress below a line, or below the row of the highest peak of a surface. Each block of nodes presses with its mean: what is
/// closer to the surface than a block is wide is smoothed.
struct StressDrawing {
    grid: Grid,
    contact_modulus: f64,
    poisson: f64,
    blocks: Blocks,
    /// The row of the blocks.
    row: usize,
    /// First and last position.
    ends: [f64; 2],
    /// The side of a pixel, and the unit of lengths.
    pixel: f64,
    length_unit: String,
    /// The depth of each row.
    depth: Vec<f64>,
    colours: Option<Image>,
    fringes: Option<Image>,
    /// The difference of the principal stresses from one fringe to the next.
    per_order: f64,
}

/// The drawing of the stress of a scene, in colours, as fringes, or both: they show the same stress, which is computed once.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    Some(Box::new(StressDrawing::new(subject)?))
}

/// The drawing of fringes alone.
pub(crate) fn draw_fringes(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    if subject.has(Part::Stress) { None } else { draw(subject) }
}

impl StressDrawing {
    fn new(subject: &Subject<'_>) -> Option<Self> {
        let Subject { scene, forecast, root, options, palette, .. } = *subject;
        let has = |part: Part| subject.has(part);
        let is_known = is_known(scene.problem.surface().grid(), scene.problem.solid().as_ref());
        if !is_known {
            return None;
        }
        let (grid, contact_modulus) = (*scene.problem.surface().grid(), scene.problem.contact_modulus());
        let whole = [0.0, grid.size()[1]];
        let ends = if grid.is_line() { Window::around(scene).ends(grid.spacing()[1]) } else { whole };
        let pixel = (ends[1] - ends[0]) / COLUMNS as f64;
        let frame = frame(ends, pixel, ROWS[0], &options.length_unit);
        let highest = HERTZ * forecast.max_pressure;
        let common = if scene.exact.is_some() { highest } else { COMMON * highest };
        let image = |name: &str, scale, map| Image::new(format!("{root}/{name}"), &frame, palette, scale, map);
        let blocks = blocks(&grid, pixel);
        let row = options.raster_at.map_or_else(|| highest_row(scene), |[row, _]| row);
        Some(Self {
            row: row * blocks.cells[0] / blocks.shape[0],
            blocks,
            poisson: scene.setup.as_ref().and_then(|setup| setup.poisson()).unwrap_or(USUAL_POISSON),
            ends,
            depth: depths(ROWS[0], pixel),
            pixel,
            length_unit: options.length_unit.clone(),
            colours: has(Part::Stress)
                .then(|| image("stress", Ruler::shear(highest, contact_modulus), ColourMap::inferno())),
            fringes: has(Part::Fringes)
                .then(|| image("fringes", Ruler::new("light", "", [0.0, 1.0]), ColourMap::grey())),
            per_order: per_order(common, contact_modulus),
            contact_modulus,
            grid,
        })
    }

    /// The pictures with their titles.
    fn images(&self) -> impl Iterator<Item = (String, &Image)> {
        let cut = if self.grid.is_line() { "below the line" } else { "in a cut through the highest peak" };
        let colours = format!("Largest shear stress τ_max {cut} (ν = {})", self.poisson);
        let order = self.per_order / self.contact_modulus;
        let fringes = format!(
            "Photoelastic fringes, dark field: 2 τ_max increases by {order:.0e} E* from one dark fringe to the next"
        );
        [(colours, &self.colours), (fringes, &self.fringes)]
            .into_iter()
            .filter_map(|(title, image)| Some((title, image.as_ref()?)))
    }

    /// Makes them as large as a pane allows, as deep as it has room for.
    fn fit_pane(&mut self, pane: [f64; 2]) {
        let [width, height] = canvas::boxed(pane, canvas::SCALE_ROOM);
        let rows = ((COLUMNS as f64 * height / width) as usize).clamp(ROWS[0], ROWS[1]);
        self.depth = depths(rows, self.pixel);
        let frame = frame(self.ends, self.pixel, rows, &self.length_unit);
        for image in [&mut self.colours, &mut self.fringes].into_iter().flatten() {
            image.frame = frame.clone();
            image.fit(pane);
        }
    }

    /// The largest shear stress in each pixel, row by row from the surface on.
    fn tau_max(&self, fields: &FrameFields<'_>) -> Vec<f64> {
        let pressure = self.mean_pressures(fields);
        let grid = self.grid.with_shape(self.blocks.cells).expect("blocks are fewer than nodes and more than three");
        let stress = below(&grid, &pressure, self.row, self.poisson, &self.depth).expect("the ratio was checked");
        let tau = stress.tau_max();
        let columns: Vec<(usize, usize, f64)> = (0..COLUMNS).map(|column| self.between(column)).collect();
        let pixels = tau.rows().into_iter().flat_map(|row| {
            columns.iter().map(move |&(left, right, share)| row[left] + share * (row[right] - row[left]))
        });
        pixels.collect()
    }

    /// The mean pressures of the blocks.
    fn mean_pressures(&self, fields: &FrameFields<'_>) -> Vec<f64> {
        let sums = self.blocks.fold(&fields.pressure, fields.stride, 0.0, |sum, p| sum + p);
        let counts = self.blocks.fold(&fields.pressure, fields.stride, 0.0, |count, _| count + 1.0);
        sums.into_iter().zip(counts).map(|(sum, count)| sum / count).collect()
    }

    /// The blocks to the left and to the right of the middle of a column, and how far it is from the first to the second.
    fn between(&self, column: usize) -> (usize, usize, f64) {
        let [start, end] = self.ends;
        let position = start + (column as f64 + 0.5) / COLUMNS as f64 * (end - start);
        let (blocks, spacing) = (self.blocks.cells[1], self.grid.spacing()[1]);
        let per_node = blocks as f64 / self.blocks.shape[1] as f64;
        // a node is in the middle of the area that it represents
        let place = ((position / spacing + 0.5) * per_node - 0.5).rem_euclid(blocks as f64);
        let left = place as usize % blocks;
        (left, (left + 1) % blocks, place.fract())
    }
}

impl Drawing for StressDrawing {
    fn panes(&self) -> Vec<(Place, Pane)> {
        self.images().map(|(title, image)| (Place::Deep, image.pane(&title))).collect()
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        let known = self.images().find_map(|(_, image)| size(&image.root));
        known.into_iter().for_each(|size| self.fit_pane(size));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.images().try_for_each(|(_, image)| image.log_static(to))
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let tau = self.tau_max(fields);
        if let Some(image) = &self.colours {
            image.log(to, tau.iter().copied())?;
        }
        let Some(image) = &self.fringes else { return Ok(()) };
        image.log(to, light(&tau, COLUMNS, self.per_order).into_iter())
    }

    fn extent(&self, fields: &FrameFields<'_>) -> FieldExtent {
        let shear = self.tau_max(fields).into_iter().fold(0.0, f64::max);
        FieldExtent { shear, ..FieldExtent::NONE }
    }

    /// Fits the colours to the shear stresses; the fringes stay.
    fn settle(&self, to: &RecordingStream, extent: &FieldExtent) -> RecordingStreamResult<()> {
        self.colours.as_ref().map_or(Ok(()), |image| image.log_scale(to, &image.scale.fitted(extent.shear)))
    }
}

/// The frame of the pictures, a unit for each pixel.
pub(super) fn frame(ends: [f64; 2], pixel: f64, rows: usize, length_unit: &str) -> AxesFrame {
    let size = [COLUMNS, rows].map(|n| n as f64);
    let x = Ruler::new("x", length_unit, ends).axis;
    let y = Ruler::new("z", length_unit, [-size[1] * pixel, 0.0]).axis;
    canvas::image_frame(canvas::PANE, [x, y], size)
}

/// The depth of the middle of each row.
pub(super) fn depths(rows: usize, pixel: f64) -> Vec<f64> {
    (0..rows).map(|row| (row as f64 + 0.5) * pixel).collect()
}

/// The blocks of the pressure: somewhat finer than the pixels of a line, all that can be afforded on a surface.
fn blocks(grid: &Grid, pixel: f64) -> Blocks {
    let shape = grid.shape();
    let fit = |cells: usize, nodes: usize| cells.clamp(Grid::MIN_POINTS, nodes);
    if grid.is_line() {
        let wanted = (grid.size()[1] / pixel * FINER as f64).ceil() as usize;
        return Blocks { shape, cells: [1, fit(wanted.min(MOST), shape[1])] };
    }
    let square = Blocks::square(shape, grid.size(), MOST_OF_SURFACE);
    Blocks { shape, cells: [0, 1].map(|axis| fit(square.cells[axis], shape[axis])) }
}

/// The row of the highest peak.
fn highest_row(scene: &Scene<'_>) -> usize {
    let height = scene.problem.height();
    let highest = (0..height.len()).fold(0, |best, node| if height[node] > height[best] { node } else { best });
    highest / scene.problem.surface().grid().shape()[1]
}
