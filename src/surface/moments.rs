//! Spectral moments of a surface.

use super::{Detrend, Surface};
use crate::formats::Scan;
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use std::borrow::Cow;
use std::f64::consts::PI;

/// Spectral moments: mean squares of the heights, their slopes and their curvatures, as sums over the waves of the
/// surface.
///
/// With the Fourier coefficients `h_q` of [`crate::fourier`] and sums over all wave vectors but `q = 0`,
///
/// ```text
/// m0 = <z^2> = sum |h_q|^2
/// line     m2 = <h'^2> = sum q^2 |h_q|^2                  m4 = <h''^2> = sum q^4 |h_q|^2
/// surface  m2 = 1/2 <|grad h|^2> = 1/2 sum q^2 |h_q|^2    m4 = 3/8 <(lap h)^2> = 3/8 sum q^4 |h_q|^2
/// ```
///
/// The factors of surfaces make `m2` and `m4` the moments of a profile, where the surface is isotropic: the means over
/// all directions of `cos^2` and `cos^4` are 1/2 and 3/8. The sums have no error of differences: they are exact for heights
/// without waves beyond the shortest one that the grid resolves. For other heights they are larger than mean
/// squares of differences.
///
/// *Free axes.* Heights are periodic along periodic axes, see [`Grid::periodic`]. Along a free axis they are a part of a
/// larger surface, as measured heights are. Repeated, they would jump at the rim, and `m2` and `m4` would be those of
/// the jump. So the slope of the least-squares plane along a free axis is subtracted, and the heights are multiplied by a
/// Hann window of mean square 1, as for the spectrum of a [`Survey`](super::Survey). The moments are then estimates
/// for heights that are everywhere alike. Waves longer than half of the cell are lost in part. The window adds `(4/3)
/// (pi/L)^2 m0` to `m2` along that axis, with the length `L` of the cell: little, if the waves are much shorter.
///
/// Source: Longuet-Higgins, Phil. Trans. R. Soc. A 249:321, 1957; Nayak, J. Lubr. Technol. 93:398, 1971.
///
/// ```
/// use asperity::Grid;
/// use asperity::surface::{Indenter, SpectralMoments};
/// let surface = Indenter::Sine { amplitude: 2.0 }.surface(Grid::line(64, 1.0)?)?;
/// let moments = SpectralMoments::new(&surface);
/// let q = std::f64::consts::TAU;
/// assert!((moments.m0 / 2.0 - 1.0).abs() < 1e-12);
/// assert!((moments.m2 / (2.0 * q.powi(2)) - 1.0).abs() < 1e-12);
/// assert!((moments.m4 / (2.0 * q.powi(4)) - 1.0).abs() < 1e-12);
/// assert!((moments.nayak() - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpectralMoments {
    /// Mean square of the heights about their mean, a length squared.
    pub m0: f64,
    /// Mean square of the slope of a profile, without a dimension.
    pub m2: f64,
    /// Mean square of the curvature of a profile, 1/length squared.
    pub m4: f64,
    /// `<h_y^2>` and `<h_x^2>`: mean squares of the slopes along y (0 for a line) and x.
    pub m2_along: [f64; 2],
    /// `<h_yy^2>` and `<h_xx^2>`: mean squares of the curvatures along y (0 for a line) and x, 1/length squared.
    pub m4_along: [f64; 2],
}

impl SpectralMoments {
    /// The moments of `surface`.
    pub fn new(surface: &Surface) -> Self {
        Self::from_waves(&WaveSums::new(surface))
    }

    /// The moments of `surface`, and their standard errors as a sample of a larger surface.
    ///
    /// Each wave of a random surface has an amplitude of its own, whose square has a standard deviation equal to its mean. A wave with the
    /// term `t` for both signs of `q` adds `t^2/2` to the variance of the sum, since the mean of `t^2` is twice its variance. The terms of
    /// Nayak's parameter are those of its relative change, `dm0/m0 + dm4/m4 - 2 dm2/m2`. A Hann window along a free axis correlates
    /// neighbouring waves, which multiplies the variance by `<w^4>/<w^2>^2 = 35/18`.
    ///
    /// The errors hold for heights that are everywhere alike, with many waves in the cell. They mean nothing for an indenter.
    ///
    /// ```
    /// use asperity::Grid;
    /// use asperity::surface::{SpectralMoments, Spectrum};
    /// # use asperity::Surface;
    /// let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.05, short_cutoff: 0.01, rms_gradient: 0.1 };
    /// let surface = Surface::rough(Grid::line(2048, 1.0)?, &spectrum, 1)?;
    /// let (moments, errors) = SpectralMoments::with_errors(&surface);
    /// assert!(errors.m0 < 0.3 * moments.m0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_errors(surface: &Surface) -> (Self, MomentErrors) {
        let waves = WaveSums::new(surface);
        let moments = Self::from_waves(&waves);
        let relative = |of: Self| {
            if moments.m2 > 0.0 { of.m0 / moments.m0 + of.m4 / moments.m4 - 2.0 * of.m2 / moments.m2 } else { 0.0 }
        };
        let windows = surface.grid().periodic().iter().filter(|is_periodic| !**is_periodic).count();
        let correlated = (35f64 / 18.0).powi(windows as i32);
        let error = |of: &dyn Fn(Self) -> f64| (correlated * waves.variance(of)).sqrt();
        let errors = MomentErrors {
            m0: error(&|it| it.m0),
            m2: error(&|it| it.m2),
            m4: error(&|it| it.m4),
            m2_along: [0, 1].map(|axis| error(&|it| it.m2_along[axis])),
            m4_along: [0, 1].map(|axis| error(&|it| it.m4_along[axis])),
            nayak: moments.nayak() * error(&relative),
        };
        (moments, errors)
    }

    fn from_waves(waves: &WaveSums) -> Self {
        waves.terms().fold(Self::default(), |sum, (_, term)| sum.plus(&term))
    }

    /// The terms of one wave, of the mean square `square`.
    fn of_wave([qy, qx]: [f64; 2], square: f64, is_line: bool) -> Self {
        let ([y, x], [second, fourth]) = ([qy * qy, qx * qx], if is_line { [1.0; 2] } else { [0.5, 0.375] });
        Self {
            m0: square,
            m2: second * (y + x) * square,
            m4: fourth * (y + x) * (y + x) * square,
            m2_along: [y * square, x * square],
            m4_along: [y * y * square, x * x * square],
        }
    }

    fn plus(&self, other: &Self) -> Self {
        let both = |one: [f64; 2], other: [f64; 2]| [one[0] + other[0], one[1] + other[1]];
        Self {
            m0: self.m0 + other.m0,
            m2: self.m2 + other.m2,
            m4: self.m4 + other.m4,
            m2_along: both(self.m2_along, other.m2_along),
            m4_along: both(self.m4_along, other.m4_along),
        }
    }

    /// Nayak's parameter `alpha = m0 m4 / m2^2`, the breadth of the spectrum; 0 for a flat. It is at least 1 for a line and at least
    /// 3/2 for a surface, and these for waves of one length.
    pub fn nayak(&self) -> f64 {
        if self.m2 > 0.0 { self.m0 / self.m2 * (self.m4 / self.m2) } else { 0.0 }
    }
}

/// Standard errors of the moments of a surface, in their units, see [`SpectralMoments::with_errors`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MomentErrors {
    /// Standard error of `m0`, a length squared.
    pub m0: f64,
    /// Standard error of `m2`, without a dimension.
    pub m2: f64,
    /// Standard error of `m4`, 1/length squared.
    pub m4: f64,
    /// Standard errors of the mean squares of the slopes along y (0 for a line) and x, without a dimension.
    pub m2_along: [f64; 2],
    /// Standard errors of the mean squares of the curvatures along y (0 for a line) and x, 1/length squared.
    pub m4_along: [f64; 2],
    /// Standard error of Nayak's parameter, without a dimension.
    pub nayak: f64,
}

/// The waves of a surface.
struct WaveSums {
    grid: Grid,
    spectrum: Vec<Complex>,
}

impl WaveSums {
    fn new(surface: &Surface) -> Self {
        let grid = *surface.grid();
        let mut spectrum = vec![Complex::default(); grid.modes()];
        Fourier::new(&grid).forward(&stationary(surface), &mut spectrum);
        Self { grid, spectrum }
    }

    /// The number of modes that a stored wave represents, and its terms of the moments; without the mean.
    fn terms(&self) -> impl Iterator<Item = (f64, SpectralMoments)> {
        let is_line = self.grid.is_line();
        let waves = self.grid.wave_vectors().zip(self.grid.multiplicities()).zip(&self.spectrum).skip(1);
        waves.map(move |((q, multiplicity), coefficient)| {
            (multiplicity, SpectralMoments::of_wave(q, multiplicity * coefficient.norm_sqr(), is_line))
        })
    }

    /// The variance of a sum over the waves. A wave that is stored once for both signs of `q` has twice the terms, and `t^2/2`; of
    /// two that are stored apart each has `t^2`.
    fn variance(&self, of: &dyn Fn(SpectralMoments) -> f64) -> f64 {
        self.terms().map(|(multiplicity, term)| of(term).powi(2) / multiplicity).sum()
    }
}

/// The heights, less their slope and under a window along free axes.
pub(super) fn stationary(surface: &Surface) -> Cow<'_, [f64]> {
    let grid = surface.grid();
    if grid.is_periodic() {
        return surface.heights().into();
    }
    let tilt = Detrend::tilt(&Scan::from_surface(surface, 1));
    let [y, x] = [0, 1].map(|axis| Along::new(grid, axis, tilt[axis]));
    let nx = grid.shape()[1];
    let flat = surface.heights().iter().enumerate().map(|(node, h)| {
        let (row, column) = (node / nx, node % nx);
        (h - y.trend[row] - x.trend[column]) * y.window[row] * x.window[column]
    });
    flat.collect()
}

/// What is taken off along an axis, and the window there.
struct Along {
    trend: Vec<f64>,
    window: Vec<f64>,
}

impl Along {
    fn new(grid: &Grid, axis: usize, slope: f64) -> Self {
        let n = grid.shape()[axis];
        if grid.periodic()[axis] {
            return Self { trend: vec![0.0; n], window: vec![1.0; n] };
        }
        let place = |i: usize| (i as f64 + 0.5) / n as f64;
        let hann = |i: usize| (8.0f64 / 3.0).sqrt() * (PI * place(i)).sin().powi(2);
        let rise = slope * grid.size()[axis];
        Self { trend: (0..n).map(|i| rise * (place(i) - 0.5)).collect(), window: (0..n).map(hann).collect() }
    }
}
