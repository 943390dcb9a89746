//! The power spectra of the solid's surface and of the indenter, as curves on logarithmic axes.

use super::axes::{Axis, Frame, Quantity};
use super::palette::{self, colour};
use super::scene::{Fields, Scene};
use crate::grid::Grid;
use crate::surface::{Field, PowerSpectrum, Surface};
use rerun::{EntityPath, LineStrip2D, LineStrips2D, Radius, RecordingStream, RecordingStreamResult};
use std::f64::consts::TAU;

/// Width and height of the box on the canvas.
const BOX: [f32; 2] = [1000.0, 400.0];
/// Height of a line of text on the canvas.
const TEXT: f32 = 20.0;
/// Decades of density below the largest one of the heights.
const DECADES: f64 = 16.0;
/// Decades above it.
const ABOVE: f64 = 0.5;
/// Points of a curve in each decade of wavelengths.
const BINS: f64 = 40.0;

/// How much each wavelength of the displacement weighs, beside that of the heights: in full contact they are the same. Long
/// waves that a solver leaves behind show on the left.
pub struct SpectrumPicture {
    grid: Grid,
    height: Vec<f64>,
    /// The largest density of the heights.
    largest: f64,
    frame: Frame,
    heights: Vec<[f32; 2]>,
    root: String,
    displacement: EntityPath,
}

impl SpectrumPicture {
    /// The picture of `scene`.
    pub fn new(scene: &Scene<'_>, root: &str) -> Self {
        let surface = scene.problem.surface();
        let spectrum = PowerSpectrum::of(surface);
        let axis = |symbol, low, high| Axis::new(Quantity { symbol, unit: String::new() }, low, high);
        let waves = (surface.grid().shape()[1] as f64 / 2.0).log10();
        let frame = Frame {
            x: axis("log10 of waves per longest period", 0.0, waves),
            y: axis("log10 C(q) / C_max", -DECADES, ABOVE),
            width: BOX[0],
            height: BOX[1],
            text: TEXT,
        };
        let mut picture = Self {
            grid: *surface.grid(),
            height: scene.problem.height().to_vec(),
            largest: spectrum.density.iter().copied().fold(f64::MIN_POSITIVE, f64::max),
            frame,
            heights: Vec::new(),
            root: format!("{root}/spectrum"),
            displacement: format!("{root}/spectrum/displacement").into(),
        };
        picture.heights = picture.curve(&spectrum);
        picture
    }

    /// The part of the canvas that it takes.
    pub fn bounds(&self) -> [f64; 4] {
        self.frame.bounds()
    }

    /// Records axes, styles and the spectrum of the heights.
    pub fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.frame.log(to, &format!("{}/axes", self.root))?;
        let heights = style(palette::INDENTER, 30.0).with_strips([LineStrip2D::from_iter(self.heights.clone())]);
        to.log_static(format!("{}/heights", self.root), &heights)?;
        to.log_static(self.displacement.clone(), &style(palette::SOLID, 32.0))
    }

    /// Records the spectrum of the displacement at the current time.
    pub fn log_frame(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let Some(solid) = self.solid(fields) else { return Ok(()) };
        let curve = LineStrip2D::from_iter(self.curve(&PowerSpectrum::of(&solid)));
        to.log(self.displacement.clone(), &LineStrips2D::update_fields().with_strips([curve]))
    }

    /// The solid's surface, a gap below the indenter, on every `stride`-th node of the scene.
    fn solid(&self, fields: &Fields<'_>) -> Option<Surface> {
        let [ny, nx] = [0, 1].map(|axis| self.grid.shape()[axis] / fields.stride[axis]);
        let grid =
            if ny == 1 { Grid::line(nx, self.grid.size()[1]) } else { Grid::surface([ny, nx], self.grid.size()) };
        let [along_y, along_x] = fields.stride;
        let node = |y: usize, x: usize| y * along_y * self.grid.shape()[1] + x * along_x;
        let level = |(y, x): (usize, usize)| self.height[node(y, x)] + fields.gap[y * nx + x];
        Surface::new(grid.ok()?, Field::from_shape_fn([ny, nx], level)).ok()
    }

    /// Mean densities, where they lie on the axes.
    fn curve(&self, spectrum: &PowerSpectrum) -> Vec<[f32; 2]> {
        let period = self.grid.longest_wavelength();
        let waves = spectrum.wavenumber.iter().zip(&spectrum.density);
        let waves: Vec<[f64; 2]> =
            waves.map(|(&q, density)| [(q * period / TAU).log10(), density / self.largest]).collect();
        let bin = |wave: &[f64; 2]| (wave[0] * BINS).floor();
        let bins = waves.chunk_by(|a, b| bin(a) == bin(b));
        let places = bins.map(|waves| {
            let mean = |i: usize| waves.iter().map(|wave| wave[i]).sum::<f64>() / waves.len() as f64;
            let x = self.frame.x.place(mean(0)) as f32 * self.frame.width;
            [x, self.frame.place_y(mean(1).log10().clamp(-DECADES, ABOVE))]
        });
        places.filter(|[x, _]| (0.0..=self.frame.width).contains(x)).collect()
    }
}

fn style(rgb: u32, order: f32) -> LineStrips2D {
    let thin = Radius::new_ui_points(1.0);
    LineStrips2D::update_fields().with_colors([colour(rgb)]).with_radii([thin]).with_draw_order(order)
}
