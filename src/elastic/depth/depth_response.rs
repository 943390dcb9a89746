//! The response of a half-space to a plastic strain in layers below its surface.

use super::DepthLayers;
use super::plane::PlaneSolid;
use super::wave_column::{GridWave, WaveColumn};
use super::wave_tensor::Direction;
use crate::chunks::spread;
use crate::error::PlasticError;
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use ndarray::{Array3, ArrayViewMut1, Axis};

/// Waves of one task, whose columns share cache lines.
const BLOCK: usize = 64;

/// The stress in the layers of a half-space, and the displacement of its surface, by a plastic strain in the layers and a pressure on the surface.
///
/// The plastic strain `e` is uniform in each layer and periodic along the surface. The stress is `C : (strain - e)`. Both are exact for each wave of
/// the grid, whatever the thicknesses of the layers are. A wave of strain is split into a part in the plane of its wave vector and the depth, which has an
/// Airy function, and a part across this plane; two scans over the layers solve each. Stresses are **means over the layer**: with them the stress by a plastic
/// strain is a symmetric operator, and
///
/// ```text
/// <p u^r(e)> = sum_j h_j <sigma(p) : e>    (Betti)
/// ```
///
/// holds to rounding, with the thicknesses `h_j` and means `<>` over the nodes.
///
/// | field                      | shape                         | unit     | sign                                      |
/// |----------------------------|-------------------------------|----------|-------------------------------------------|
/// | plastic strain, stress     | `(layers, components, nodes)` | 1, pressure | positive in tension                     |
/// | pressure                   | `nodes`                       | pressure | positive in compression                   |
/// | displacement               | `nodes`                       | length   | positive into the solid                   |
///
/// The components below a line are `xx`, `yy`, `zz`, `xz` (plane strain, but `yy` of the plastic strain is free), those below a surface `xx`, `yy`, `zz`,
/// `xy`, `xz`, `yz`. Shears are those of the tensor, not engineering ones.
///
/// Memory: one half spectrum for each layer and component, which is about as much as the strain itself.
///
/// # Source
/// Derived for this crate; the setting is that of Jacq et al., J. Tribol. 124, 653 (2002), and Frérot et al., Comput. Methods Appl. Mech. Eng. 351,
/// 951 (2019), whose volume integrals act on nodes in depth.
///
/// ```
/// use asperity::Grid;
/// use asperity::elastic::{DepthLayers, DepthResponse};
/// // a layer that has become thinner by one percent, at its constant volume
/// let grid = Grid::surface([8, 8], [1.0, 1.0])?;
/// let (layers, poisson) = (DepthLayers::new(vec![0.0, 0.1, 0.3])?, 0.3);
/// let mut response = DepthResponse::new(&grid, 210e9, poisson, layers)?;
/// let mut strain = response.zeros();
/// for (component, value) in [0.005, 0.005, -0.01].into_iter().enumerate() {
///     (0..grid.len()).for_each(|node| strain[[1, component, node]] = value);
/// }
/// let mut sunk = vec![0.0; grid.len()];
/// response.residual_displacement(&strain, &mut sunk);
/// // the neighbouring cells hold the layer, whose sides would grow, so that it is compressed along them and sinks by less
/// let expected = 0.2 * 0.01 * (1.0 - poisson / (1.0 - poisson));
/// assert!(sunk.iter().all(|u| (u - expected).abs() < 1e-15));
/// let stress = response.residual_stress(&strain);
/// assert!((stress[[1, 0, 3]] / 210e9 + 0.005 / (1.0 - poisson)).abs() < 1e-14 && stress[[0, 0, 3]] == 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct DepthResponse {
    grid: Grid,
    layers: DepthLayers,
    solid: PlaneSolid,
    /// The transforms of tasks that share the layers.
    lanes: Vec<Lane>,
    /// Waves of strain, and then of stress, shape `(layers, components, modes)`.
    waves: Array3<Complex>,
    /// Waves of a field of the surface.
    surface_waves: Vec<Complex>,
    transforms: u64,
}

/// What one task of transforms needs.
struct Lane {
    fourier: Fourier,
    field: Vec<f64>,
}

impl DepthResponse {
    /// Bytes for each node, layer and component that the response takes.
    pub(crate) const BYTES: f64 = 9.0;

    /// Plans the response of a half-space of Young's modulus, a pressure, and Poisson's ratio below a grid.
    ///
    /// # Errors
    /// [`PlasticError::NeedsPeriodic`] for a grid with a free boundary, [`PlasticError::NotPositive`] for a modulus that is not positive and finite, and
    /// [`PlasticError::Poisson`] for a ratio outside `(-1, 1/2]`.
    pub fn new(grid: &Grid, young: f64, poisson: f64, layers: DepthLayers) -> Result<Self, PlasticError> {
        if !grid.is_periodic() {
            return Err(PlasticError::NeedsPeriodic);
        }
        if !(young.is_finite() && young > 0.0) {
            return Err(PlasticError::NotPositive { name: "Young's modulus", value: young });
        }
        if !(poisson > -1.0 && poisson <= 0.5) {
            return Err(PlasticError::Poisson { poisson });
        }
        let lane = || Lane { fourier: Fourier::new(grid), field: vec![0.0; grid.len()] };
        let lanes = layers.count().min(rayon::current_num_threads());
        Ok(Self {
            grid: *grid,
            solid: PlaneSolid { young, poisson, contact_modulus: young / (1.0 - poisson * poisson) },
            lanes: std::iter::repeat_with(lane).take(lanes).collect(),
            waves: Array3::default((layers.count(), Self::components(grid), grid.modes())),
            surface_waves: vec![Complex::default(); grid.modes()],
            layers,
            transforms: 0,
        })
    }

    /// The number of components of a tensor below a grid.
    pub fn components(grid: &Grid) -> usize {
        if grid.is_line() { 4 } else { 6 }
    }

    /// The layers.
    pub fn layers(&self) -> &DepthLayers {
        &self.layers
    }

    /// Number of transforms so far, forward and inverse, of a layer or the surface.
    pub fn transforms(&self) -> u64 {
        self.transforms
    }

    /// A tensor that is zero everywhere, shape `(layers, components, nodes)`.
    pub fn zeros(&self) -> Array3<f64> {
        let (layers, components, _) = self.waves.dim();
        Array3::zeros((layers, components, self.grid.len()))
    }

    /// Writes the displacement of the surface by a plastic strain.
    ///
    /// # Panics
    /// If a length does not fit the grid and the layers.
    pub fn residual_displacement(&mut self, strain: &Array3<f64>, displacement: &mut [f64]) {
        self.take(strain);
        self.displace(displacement);
    }

    /// The stress by a plastic strain.
    ///
    /// # Panics
    /// If the shape does not fit the grid and the layers.
    pub fn residual_stress(&mut self, strain: &Array3<f64>) -> Array3<f64> {
        self.take(strain);
        let mut stress = self.zeros();
        self.stress(None, &mut stress);
        stress
    }

    /// The stress by a plastic strain and a pressure.
    ///
    /// # Panics
    /// If the shape or the length does not fit the grid and the layers.
    pub fn stress_of(&mut self, strain: &Array3<f64>, pressure: &[f64]) -> Array3<f64> {
        self.take(strain);
        let mut stress = self.zeros();
        self.stress(Some(pressure), &mut stress);
        stress
    }

    /// The stress by a pressure without any plastic strain.
    ///
    /// # Panics
    /// If the length does not fit the grid.
    pub fn elastic_stress(&mut self, pressure: &[f64]) -> Array3<f64> {
        let mut stress = self.zeros();
        self.load(0, |_, _, _| ());
        self.stress(Some(pressure), &mut stress);
        stress
    }

    fn take(&mut self, strain: &Array3<f64>) {
        let (layers, components, _) = self.waves.dim();
        assert_eq!(strain.dim(), (layers, components, self.grid.len()), "the strain must fit the grid and its layers");
        self.load(layers, |layer, component, field| {
            let layer = strain.index_axis(Axis(0), layer);
            field.iter_mut().zip(layer.row(component)).for_each(|(to, from)| *to = *from);
        });
    }

    /// Takes the strain whose component in a layer is written by `fill(layer, component, field)`; what `field` holds before is undefined. It is
    /// zero below the first layers.
    pub(crate) fn load(&mut self, layers: usize, fill: impl Fn(usize, usize, &mut [f64]) + Sync) {
        let components = self.waves.dim().1;
        self.transforms += (layers * components) as u64;
        let per_lane = layers.div_ceil(self.lanes.len()).max(1);
        let (mut strained, mut rest) = self.waves.view_mut().split_at(Axis(0), layers);
        rest.fill(Complex::default());
        let tasks = strained.axis_chunks_iter_mut(Axis(0), per_lane).zip(&mut self.lanes).enumerate();
        spread(tasks, |(task, (mut waves, Lane { fourier, field }))| {
            for (i, mut waves) in waves.outer_iter_mut().enumerate() {
                for (component, waves) in waves.outer_iter_mut().enumerate() {
                    fill(task * per_lane + i, component, field);
                    fourier.forward(field, contiguous(waves));
                }
            }
        });
    }

    /// Writes the displacement of the surface by the strain that was taken.
    pub(crate) fn displace(&mut self, displacement: &mut [f64]) {
        let Self { grid, layers, solid, waves, .. } = self;
        let blocks = waves.axis_chunks_iter(Axis(2), BLOCK).zip(self.surface_waves.chunks_mut(BLOCK)).enumerate();
        spread(blocks, |(block, (waves, displaced))| {
            let mut column = WaveColumn::new(layers, *solid, grid.is_line());
            for ((wave, strain), displaced) in
                grid_waves(grid, block * BLOCK).zip(waves.axis_iter(Axis(2))).zip(displaced)
            {
                *displaced = column.displacement(wave, strain);
            }
        });
        self.transforms += 1;
        self.lanes[0].fourier.inverse(&mut self.surface_waves, displacement);
    }

    /// Writes the stress by the strain that was taken, which is lost, and by a pressure.
    pub(crate) fn stress(&mut self, pressure: Option<&[f64]>, stress: &mut Array3<f64>) {
        match pressure {
            Some(pressure) => self.lanes[0].fourier.forward(pressure, &mut self.surface_waves),
            None => self.surface_waves.fill(Complex::default()),
        }
        let Self { grid, layers, solid, waves, .. } = self;
        let blocks = waves.axis_chunks_iter_mut(Axis(2), BLOCK).zip(self.surface_waves.chunks(BLOCK)).enumerate();
        spread(blocks, |(block, (mut waves, pressure))| {
            let mut column = WaveColumn::new(layers, *solid, grid.is_line());
            let of_block = grid_waves(grid, block * BLOCK).zip(pressure);
            for ((wave, pressure), field) in of_block.zip(waves.axis_iter_mut(Axis(2))) {
                column.respond(wave, *pressure, field);
            }
        });
        self.store(stress);
    }

    fn store(&mut self, stress: &mut Array3<f64>) {
        let (layers, components, _) = self.waves.dim();
        self.transforms += (layers * components) as u64 + 1;
        let per_lane = layers.div_ceil(self.lanes.len());
        let waves = self.waves.axis_chunks_iter_mut(Axis(0), per_lane);
        let tasks = waves.zip(stress.axis_chunks_iter_mut(Axis(0), per_lane)).zip(&mut self.lanes);
        spread(tasks, |((mut waves, mut stress), Lane { fourier, .. })| {
            for (mut waves, mut stress) in waves.outer_iter_mut().zip(stress.outer_iter_mut()) {
                for (waves, stress) in waves.outer_iter_mut().zip(stress.outer_iter_mut()) {
                    fourier.inverse(contiguous(waves), contiguous(stress));
                }
            }
        });
    }
}

/// The waves of a grid from one on, in the order of [`Grid::wave_vectors`]. A line has the direction of `x`, and so has the mean.
fn grid_waves(grid: &Grid, first: usize) -> impl Iterator<Item = GridWave> + use<> {
    let ([ny, _], [ly, lx]) = (grid.shape(), grid.size());
    (first..).map(move |number| {
        let (kx, ky) = (number / ny, number % ny);
        let along_y = if 2 * ky <= ny { ky as f64 } else { ky as f64 - ny as f64 };
        let [qy, qx] = [along_y / ly, kx as f64 / lx].map(|turns| std::f64::consts::TAU * turns);
        let q = qx.hypot(qy);
        let direction = if q > 0.0 { Direction(qx / q, qy / q) } else { Direction(1.0, 0.0) };
        GridWave { q, direction, is_nyquist: ny > 1 && 2 * ky == ny }
    })
}

/// The values of a row.
fn contiguous<T>(row: ArrayViewMut1<'_, T>) -> &mut [T] {
    row.into_slice().expect("rows are made in standard layout")
}
