//! Compliances that are not symmetric: those of contacts that move steadily over a solid.
//!
//! One picture holds in the whole crate. The rough surface lies above the solid, moves towards `+x` over it, and is at rest in the frame
//! of the fields. So the material of the solid runs through the frame towards `-x`, and enters the contact at its `+x` side: what is at
//! `x` now was at `x + V dt` a time `dt` ago.
//!
//! A wave of the pressure is then displaced with a phase. Its weight is complex, `u_q = w(q) p_q`, and the weight of `-q` is the
//! conjugate of that of `q`.

use super::element;
use super::free::padded;
use crate::chunks;
use crate::error::GridError;
use crate::fourier::{Complex, Fourier, Real};
use crate::grid::Grid;
use std::f64::consts::TAU;

/// The motion of a contact over a solid.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum SteadyMotion {
    /// It slides over a viscoelastic solid at a speed, a length per time, with pairs of creep `f` and retardation time `tau`.
    Sliding { speed: f64, terms: Vec<(f64, f64)> },
    /// It rolls: displacements are taken less those one step, a length, ahead.
    Rolling { step: f64 },
}

impl SteadyMotion {
    /// The factor of the compliance of a wave whose wavenumber along `x` is `qx`.
    pub(crate) fn factor(&self, qx: f64) -> Complex {
        match self {
            Self::Sliding { speed, terms } => {
                let one = Complex::new(1.0, 0.0);
                terms.iter().fold(one, |sum, &(ratio, time)| sum + ratio / Complex::new(1.0, -qx * speed * time))
            }
            &Self::Rolling { step } => {
                let (sin, cos) = (0.5 * qx * step).sin_cos();
                Complex::new(2.0 * sin * sin, -2.0 * sin * cos)
            }
        }
    }
}

/// The complex weights of the waves of a grid, or of a grid that is padded with zeros along a free line.
#[derive(Debug, Clone)]
pub(super) struct DirectedTable {
    /// The padded grid of a free line.
    padded: Option<Grid>,
    /// Displacement over pressure, in the order of [`Grid::wavenumbers`].
    pub weights: Vec<Complex>,
}

impl DirectedTable {
    /// The weights of the waves `[q_y, q_x]` of a periodic grid. At the Nyquist wave along `x`, which runs in no direction, it is the
    /// real part.
    pub(crate) fn periodic(grid: &Grid, weight: impl Fn([f64; 2]) -> Complex) -> Self {
        let nx = grid.shape()[1];
        let nyquist = 0.5 * TAU / grid.spacing()[1];
        let at = |[qy, qx]: [f64; 2]| {
            let weight = weight([qy, qx]);
            let is_real = qx == 0.0 || nx.is_multiple_of(2) && qx > nyquist * (1.0 - 0.5 / nx as f64);
            if is_real { Complex::new(weight.re, 0.0) } else { weight }
        };
        Self { padded: None, weights: grid.wave_vectors().map(at).collect() }
    }

    /// The weights of a free line: `kernel(x)` is the displacement at the signed distance `x` from an element.
    pub(crate) fn free(grid: &Grid, kernel: impl Fn(f64) -> f64) -> Result<Self, GridError> {
        let padded = padded(grid)?;
        let (points, spacing) = (padded.shape()[1], grid.spacing()[1]);
        let distance = |i: usize| if 2 * i <= points { i as f64 } else { i as f64 - points as f64 };
        let influence: Vec<f64> = (0..points).map(|i| kernel(spacing * distance(i))).collect();
        let mut weights = vec![Complex::default(); padded.modes()];
        Fourier::new(&padded).forward(&influence, &mut weights);
        weights.iter_mut().for_each(|weight| *weight *= points as f64);
        Ok(Self { padded: Some(padded), weights })
    }

    /// Whether waves are independent.
    pub(crate) fn is_periodic(&self) -> bool {
        self.padded.is_none()
    }

    /// Stiffness of the softest and of the stiffest wave of the symmetric part, and the softest real part of the stiffness. Waves that
    /// are not displaced are left out.
    pub(crate) fn range(&self) -> ([f64; 2], f64) {
        let waves = self.weights.iter().filter(|weight| weight.norm_sqr() > 0.0);
        let ends = ([f64::INFINITY, 0.0], f64::INFINITY);
        waves.fold(ends, |([soft, stiff], softest), weight| {
            let real = weight.re.max(0.0);
            ([soft.min(real.recip()), stiff.max(real.recip())], softest.min(real / weight.norm_sqr()))
        })
    }

    /// Whether the mean is displaced.
    pub(crate) fn has_uniform(&self) -> bool {
        self.padded.is_some() || self.weights[0].re > 0.0
    }
}

/// The displacement at the signed distance `x` from a strip of the width of the spacing of a line, by a contact that rolls.
pub(super) fn rolling_strip(x: f64, step: f64, [width, datum, modulus]: [f64; 3]) -> f64 {
    element::strip(x, width, datum, modulus) - element::strip(x + step, width, datum, modulus)
}

/// The integral of `sgn(x - s)` over a strip about `s = 0`.
pub(super) fn sign_strip(x: f64, width: f64) -> f64 {
    (2.0 * x).clamp(-width, width)
}

/// The convolution with a table, and its scratch: a field of both precisions and a half spectrum, of the padded grid on a free line.
pub(super) struct DirectedConvolution<T> {
    fourier: Fourier,
    spectrum: Vec<Complex>,
    field: Vec<f64>,
    stage: Vec<T>,
}

impl<T: Real> DirectedConvolution<T> {
    pub(crate) fn new(grid: &Grid, table: &DirectedTable) -> Self {
        let padded = table.padded.as_ref().unwrap_or(grid);
        Self {
            fourier: Fourier::new(padded),
            spectrum: vec![Complex::default(); padded.modes()],
            field: vec![0.0; padded.len()],
            stage: vec![T::zero(); grid.len()],
        }
    }

    /// Gives `unit` times the displacement under a pressure, both in `rows`, as [`super::Convolution::displace`] has them.
    pub(crate) fn displace<S: Send>(
        &mut self,
        table: &DirectedTable,
        unit: f64,
        rows: [usize; 2],
        fill: impl Fn(usize, &mut [T]) + Sync,
        sinks: &mut [S],
        store: impl Fn(usize, &[T], &mut S) + Sync,
    ) {
        let width = rows[1];
        chunks::rows_mut(&mut self.stage, width, fill);
        self.multiply(|place| unit * table.weights[place]);
        chunks::each(sinks, width, |r, sink| store(r, &self.stage[r * width..][..width], sink));
    }

    /// Makes of a displacement on a periodic grid the pressure, times `per_unit`; waves that are not displaced vanish.
    pub(crate) fn press(&mut self, table: &DirectedTable, per_unit: f64, field: &mut [T]) {
        self.stage.copy_from_slice(field);
        self.multiply(|place| {
            let weight = table.weights[place];
            if weight.norm_sqr() > 0.0 { per_unit / weight } else { Complex::default() }
        });
        field.copy_from_slice(&self.stage);
    }

    fn multiply(&mut self, weight: impl Fn(usize) -> Complex) {
        let Self { fourier, spectrum, field, stage } = self;
        let (used, rest) = field.split_at_mut(stage.len());
        used.iter_mut().zip(&*stage).for_each(|(value, from)| *value = from.to_double());
        rest.fill(0.0);
        fourier.forward(field, spectrum);
        spectrum.iter_mut().enumerate().for_each(|(place, mode)| *mode *= weight(place));
        fourier.inverse(spectrum, field);
        stage.iter_mut().zip(&*field).for_each(|(to, &value)| *to = T::from_double(value));
    }
}
