//! The power spectra of the solid's surface and of the indenter, as curves on logarithmic axes.

use crate::grid::Grid;
use crate::plot::{AxesFrame, Axis};
use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::FrameFields;
use crate::record::draw::ink::canvas::{self, strip, style};
use crate::record::draw::ink::palette::Palette;
use crate::record::draw::ink::pane::{Pane, PaneView};
use crate::surface::{Field, PowerSpectrum, Surface};
use rerun::{Radius, RecordingStream, RecordingStreamResult};
use std::f64::consts::TAU;

/// Densities on the axis, over the largest one of the heights.
const DENSITIES: [f64; 2] = [1e-16, 3.0];
/// Points of a curve in each decade of wavelengths.
const BINS: f64 = 40.0;

/// The weight of each wavelength in the displacement, beside that in the heights: in full contact they are the same. Long
/// waves that a solver leaves behind show on the left.
struct Spectra {
    palette: &'static Palette,
    grid: Grid,
    height: Vec<f64>,
    largest_density: f64,
    frame: AxesFrame,
    heights: PowerSpectrum,
    root: String,
}

/// The drawing of the spectra of a scene.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    Some(Box::new(Spectra::new(subject)))
}

impl Spectra {
    fn new(Subject { scene, palette, root, .. }: &Subject<'_>) -> Self {
        let surface = scene.problem.surface();
        let spectrum = PowerSpectrum::new(surface);
        let waves = surface.grid().shape()[1] as f64 / 2.0;
        let [x, y] = [("q L / 2π", [1.0, waves]), ("C(q) / C_max", DENSITIES)];
        let [x, y] = [x, y].map(|(name, range)| Axis::log(name, range));
        Self {
            palette,
            grid: *surface.grid(),
            height: scene.problem.height().to_vec(),
            largest_density: spectrum.density.iter().copied().fold(f64::MIN_POSITIVE, f64::max),
            frame: canvas::frame(canvas::PANE, [x, y], 0.0),
            heights: spectrum,
            root: format!("{root}/spectrum"),
        }
    }

    /// The solid's surface, a gap below the indenter, on every `stride`-th node of the scene.
    fn solid(&self, fields: &FrameFields<'_>) -> Option<Surface> {
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
        let waves = spectrum.wavenumber.iter().map(|q| (q * period / TAU).log10()).zip(&spectrum.density);
        let waves: Vec<(f64, f64)> = waves.map(|(wave, density)| (wave, density / self.largest_density)).collect();
        let bins = waves.chunk_by(|a, b| (a.0 * BINS).floor() == (b.0 * BINS).floor());
        let places = bins.map(|waves| {
            let mean = |value: fn(&(f64, f64)) -> f64| waves.iter().map(value).sum::<f64>() / waves.len() as f64;
            let [low, high] = DENSITIES;
            self.frame.places(10f64.powf(mean(|wave| wave.0)), mean(|wave| wave.1).clamp(low, high))
        });
        let inside = places.filter(|[x, _]| (-1e-9..=1.0 + 1e-9).contains(x));
        inside.map(|places| self.frame.position(places).map(|p| p as f32)).collect()
    }
}

impl Drawing for Spectra {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let root = &self.root;
        let picture = (root.clone(), canvas::bounds(&self.frame, 0.0));
        let title = "Power spectra (blue: displacement, grey: heights)";
        vec![(Place::Further, PaneView::plane(title, root, vec![format!("{root}/**")], picture, self.palette))]
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        size(&self.root).into_iter().for_each(|size| canvas::fit(&mut self.frame, size, 0.0));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        canvas::log_axes(to, self.palette, &format!("{}/axes", self.root), &self.frame)?;
        let style = |rgb, order| style(rgb, Radius::new_ui_points(1.0), order);
        let heights = style(self.palette.indenter, 30.0).with_strips([self.curve(&self.heights)]);
        to.log_static(format!("{}/heights", self.root), &heights)?;
        to.log_static(format!("{}/displacement", self.root), &style(self.palette.solid, 32.0))
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let Some(solid) = self.solid(fields) else { return Ok(()) };
        to.log(format!("{}/displacement", self.root), &strip(self.curve(&PowerSpectrum::new(&solid))))
    }
}
