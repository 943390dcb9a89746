//! One wave of strain in all layers, and the stress that it causes.

use super::DepthLayers;
use super::antiplane::AntiplaneScan;
use super::layer_wave::LayerWave;
use super::parity::{Coupled, coupled};
use super::plane::{PlaneScan, PlaneSolid};
use super::wave_tensor::{Components, Direction, WaveTensor};
use crate::fourier::Complex;
use ndarray::{ArrayView2, ArrayViewMut2};

/// The places of the components `xx`, `yy`, `zz`, `xz` of a line among those of a surface.
const OF_LINE: &[usize] = &[0, 1, 2, 4];
const OF_SURFACE: &[usize] = &[0, 1, 2, 3, 4, 5];

/// A wave of the grid.
#[derive(Debug, Clone, Copy)]
pub(super) struct GridWave {
    /// Its wavenumber; 0 for the mean.
    pub q: f64,
    pub direction: Direction,
    /// Whether it is at the Nyquist wavenumber along y.
    pub is_nyquist: bool,
}

/// The operators of one wave, with their scratch. Waves are given by layers (rows) and components (columns).
pub(super) struct WaveColumn<'a> {
    layers: &'a DepthLayers,
    solid: PlaneSolid,
    /// Whether nothing is out of the plane of the wave and the depth, as below a line.
    is_plane: bool,
    /// How the wave fades in each layer.
    fading: Vec<LayerWave>,
    given: Vec<Components>,
    sum: Vec<Components>,
    strain: Vec<WaveTensor>,
    stress: Vec<WaveTensor>,
    plane: PlaneScan,
    antiplane: AntiplaneScan,
}

impl<'a> WaveColumn<'a> {
    pub(crate) fn new(layers: &'a DepthLayers, solid: PlaneSolid, is_plane: bool) -> Self {
        let count = layers.count();
        Self {
            layers,
            solid,
            is_plane,
            fading: vec![LayerWave::default(); count],
            given: vec![Components::default(); count],
            sum: vec![Components::default(); count],
            strain: vec![WaveTensor::default(); count],
            stress: vec![WaveTensor::default(); count],
            plane: PlaneScan::new(count),
            antiplane: AntiplaneScan::new(count),
        }
    }

    /// The displacement of the surface into the solid by a wave of strain:
    ///
    /// `u_z = -sum_j h_j [(A0 - A1) a + (A0 + A1) c + 2 i A1 e_nz]`, of the mean `-sum_j h_j [e_zz + nu/(1 - nu) (e_nn + e_tt)]`,
    ///
    /// with `a` and `c` of [`PlaneScan`]. By Betti's theorem it is the work on the strain by the stress of a unit of pressure.
    pub(crate) fn displacement(&mut self, wave: GridWave, strain: ArrayView2<'_, Complex>) -> Complex {
        self.begin(wave, strain);
        self.take(wave, &coupled(wave.is_nyquist)[0]);
        let nu = self.solid.poisson;
        let parts = self.strain.iter().zip(&self.fading).map(|(strain, layer)| {
            let [a0, a1] = layer.means;
            let part = if wave.q == 0.0 {
                strain.zz + (strain.nn + strain.tt) * (nu / (1.0 - nu))
            } else {
                let (a, c) = (strain.nn + strain.tt * nu, strain.zz + strain.tt * nu);
                a * (a0 - a1) + c * (a0 + a1) + strain.nz * (2.0 * a1)
            };
            part * -layer.thickness
        });
        parts.sum()
    }

    /// Puts the layer means of the stress by a wave of strain and a wave of pressure in the place of the strain.
    pub(crate) fn respond(&mut self, wave: GridWave, pressure: Complex, mut field: ArrayViewMut2<'_, Complex>) {
        self.begin(wave, field.view());
        self.sum.fill(Components::default());
        for (number, set) in coupled(wave.is_nyquist).iter().enumerate() {
            self.take(wave, set);
            self.strained(wave);
            if number == 0 {
                self.pressed(wave, pressure);
            }
            for (sum, stress) in self.sum.iter_mut().zip(&self.stress) {
                let parts = stress.into_components(wave.direction);
                (0..6).filter(|i| set[*i]).for_each(|i| sum[i] += parts[i]);
            }
        }
        let places = places(field.ncols());
        for (mut row, sum) in field.rows_mut().into_iter().zip(&self.sum) {
            row.iter_mut().zip(places).for_each(|(value, &place)| *value = sum[place]);
        }
    }

    /// Takes what is given, and how the wave fades.
    fn begin(&mut self, wave: GridWave, field: ArrayView2<'_, Complex>) {
        let places = places(field.ncols());
        for (given, row) in self.given.iter_mut().zip(field.rows()) {
            row.iter().zip(places).for_each(|(&value, &place)| given[place] = value);
        }
        let mut above = LayerWave::surface();
        for (j, fading) in self.fading.iter_mut().enumerate() {
            above = LayerWave::new(wave.q, self.layers.interfaces()[j], self.layers.thickness(j), &above);
            *fading = above;
        }
    }

    /// The strain of a set of components in the frame of the wave.
    fn take(&mut self, wave: GridWave, set: &Coupled) {
        for (strain, given) in self.strain.iter_mut().zip(&self.given) {
            let taken = std::array::from_fn(|i| if set[i] { given[i] } else { Complex::default() });
            *strain = WaveTensor::from_components(taken, wave.direction);
        }
    }

    /// The stress by the strain. The mean causes none across the layers, since nothing holds the surface, and no mean strain along them, since
    /// neighbouring cells do.
    fn strained(&mut self, wave: GridWave) {
        let PlaneSolid { young, poisson, contact_modulus } = self.solid;
        let shear_modulus = 0.5 * young / (1.0 + poisson);
        if wave.q == 0.0 {
            for (stress, strain) in self.stress.iter_mut().zip(&self.strain) {
                *stress = WaveTensor {
                    nn: (strain.nn + strain.tt * poisson) * -contact_modulus,
                    tt: (strain.tt + strain.nn * poisson) * -contact_modulus,
                    nt: strain.nt * (-2.0 * shear_modulus),
                    ..WaveTensor::default()
                };
            }
            return;
        }
        self.plane.run(wave.q, self.solid, &self.fading, &self.strain, &mut self.stress);
        if self.is_plane {
            return;
        }
        self.antiplane.run(wave.q, shear_modulus, &self.fading, &self.strain, &mut self.stress);
    }

    /// Adds the stress by a pressure: `nn = -(A0 - A1) p`, `zz = -(A0 + A1) p`, `nz = i A1 p`, `tt = nu (nn + zz)`, or of the mean
    /// `zz = -p`, `nn = tt = -nu/(1 - nu) p`.
    fn pressed(&mut self, wave: GridWave, pressure: Complex) {
        let nu = self.solid.poisson;
        for (stress, layer) in self.stress.iter_mut().zip(&self.fading) {
            let [a0, a1] = layer.means;
            if wave.q == 0.0 {
                let lateral = pressure * (nu / (1.0 - nu));
                *stress = WaveTensor {
                    nn: stress.nn - lateral,
                    tt: stress.tt - lateral,
                    zz: stress.zz - pressure,
                    ..*stress
                };
            } else {
                stress.nn -= pressure * (a0 - a1);
                stress.zz -= pressure * (a0 + a1);
                stress.nz -= pressure * a1;
                stress.tt -= pressure * (2.0 * nu * a0);
            }
        }
    }
}

/// The places of so many components among those of a surface.
fn places(count: usize) -> &'static [usize] {
    if count == OF_LINE.len() { OF_LINE } else { OF_SURFACE }
}
