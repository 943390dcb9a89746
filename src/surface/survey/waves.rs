//! The waves of a map by their wave vectors: those that stand alone, and those that rows or columns have alone.

use crate::formats::Scan;
use crate::fourier::{Complex, Fourier};
use crate::surface::Detrend;
use crate::surface::bends::median;
use std::f64::consts::TAU;

/// The fewest nodes along each axis.
const FEWEST: usize = 64;
/// The shortest wave vector of a wave that may stand alone, in waves over the map: longer waves are too few to be compared.
const LONGEST: isize = 8;
/// A wave stands alone where its power is so many times the median of the waves around it.
const ALONE: f64 = 50.0;
/// The least part of the mean square gradient of such a wave.
const LEAST: f64 = 0.002;
/// How far the power of a wave under a Hann window reaches, and how far the waves around it that it is compared with.
const REACH: [isize; 2] = [2, 6];
/// The waves along the lines whose bends across the lines are compared with those of the levels of the lines.
const BESIDE: std::ops::RangeInclusive<isize> = 2..=5;
/// Levels wander where their bends are so many times those of the waves beside them.
const WANDER: f64 = 4.0;
/// The part of the power of levels that a Hann window of mean square 1 leaves in the wave that is constant along the lines: the square of its mean.
const OF_LEVELS: f64 = 2.0 / 3.0;
/// Levels of which one wave makes more than this part of the bends are a grating.
const GRATING: f64 = 0.25;
/// Levels of which a sixteenth of the waves makes more than this part of the bends are a profile that repeats, as turning and blazed gratings leave
/// it, with harmonics that alone are too weak. Of 300 random walks, as drift is one,
/// the largest part was 0.54, and the mean 0.31.
const PROFILE: [f64; 2] = [1.0 / 16.0, 0.6];

/// The power of the waves of a map without its plane, under a Hann window of mean square 1.
pub(super) struct WavePower {
    shape: [usize; 2],
    spacing: [f64; 2],
    /// The factors from the power of a wave to its mean square step from one node to the next one along y and x, by its number.
    steps: [Vec<f64>; 2],
    /// `|h_q|^2` of `kx` from 0 to half of the nodes, each with all `ky`.
    power: Vec<f64>,
}

/// Waves that stand alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Alone {
    /// How many there are.
    pub count: usize,
    /// The wavelength of the strongest one.
    pub wavelength: f64,
    /// Their rms height.
    pub rms: f64,
    /// Their share of the mean square gradient.
    pub share: f64,
}

/// A wave vector in waves over the map along y and x, and its power with that of its opposite.
type Peak = ([isize; 2], f64);

impl WavePower {
    /// The waves of a map, in which voids are at the level of the plane; none of a profile, and of less than 64 nodes along an axis.
    pub(crate) fn new(scan: &Scan) -> Option<Self> {
        let shape @ [ny, nx] = scan.shape();
        if ny.min(nx) < FEWEST {
            return None;
        }
        let mut flat = Detrend::Plane.apply(scan.clone());
        flat.height.iter_mut().filter(|h| h.is_nan()).for_each(|h| *h = 0.0);
        let flat = super::band::windowed(&flat);
        let mut spectrum = vec![Complex::default(); ny * (nx / 2 + 1)];
        Fourier::new(&flat.grid().ok()?).forward(flat.height.as_slice()?, &mut spectrum);
        let steps = shape.map(|n| (0..n).map(|k| 2.0 - 2.0 * (TAU * k as f64 / n as f64).cos()).collect());
        Some(Self { shape, spacing: scan.spacing, steps, power: spectrum.iter().map(|it| it.norm_sqr()).collect() })
    }

    /// The power of a wave.
    fn at(&self, [ky, kx]: [isize; 2]) -> f64 {
        let [ny, nx] = self.shape.map(|n| n as isize);
        // opposite wave vectors have the same power
        let [ky, kx] = if kx.rem_euclid(nx) > nx / 2 { [-ky, -kx] } else { [ky, kx] };
        self.power[(kx.rem_euclid(nx) * ny + ky.rem_euclid(ny)) as usize]
    }

    /// The wave vectors without their opposites.
    fn half(&self) -> impl Iterator<Item = [isize; 2]> + use<> {
        let [ny, nx] = self.shape.map(|n| n as isize);
        (0..=(nx - 1) / 2).flat_map(move |kx| (-(ny - 1) / 2..=ny / 2).map(move |ky| [ky, kx]))
    }

    /// The factor from a power to the mean square step from one node to the next one along an axis.
    fn step(&self, axis: usize, k: isize) -> f64 {
        self.steps[axis][k.rem_euclid(self.shape[axis] as isize) as usize]
    }

    /// The factor from a power to the mean square gradient.
    fn gradient(&self, k: [isize; 2]) -> f64 {
        [0, 1].iter().map(|&axis| self.step(axis, k[axis]) / self.spacing[axis].powi(2)).sum()
    }

    /// The sum over all waves of their power times a factor.
    fn sum(&self, factor: impl Fn([isize; 2]) -> f64) -> f64 {
        let times = |k: &[isize; 2]| if k[1] == 0 { 1.0 } else { 2.0 };
        self.half().map(|k| times(&k) * self.at(k) * factor(k)).sum()
    }

    /// The rms step from line to line by which the levels of the lines across an axis wander, and the share of the mean square gradient that it
    /// makes; none where they do not. Waves that are long along the lines have as much power as the levels, unless the levels move alone.
    pub(crate) fn wander(&self, axis: usize) -> Option<[f64; 2]> {
        let lines = self.shape[axis] as isize;
        let place = |across: isize, along: isize| if axis == 0 { [across, along] } else { [along, across] };
        let bend = |along: isize, across: isize| self.at(place(across, along)) * self.step(axis, across).powi(2);
        let bends = |along: isize| -> f64 { (0..lines).map(|across| bend(along, across)).sum() };
        let mut strongest: Vec<f64> = (0..lines).map(|across| bend(0, across)).collect();
        strongest.sort_unstable_by(|a, b| b.total_cmp(a));
        let few: f64 = strongest.iter().take((PROFILE[0] * lines as f64) as usize).sum();
        let is_grating = strongest[0] > GRATING * bends(0) || few > PROFILE[1] * bends(0);
        let usual = BESIDE.map(bends).sum::<f64>() / BESIDE.count() as f64;
        // the square of a bend of independent steps is that of two steps
        let step = 0.5 * (bends(0) - usual) / OF_LEVELS;
        let share = step / self.spacing[axis].powi(2) / self.sum(|k| self.gradient(k));
        (!is_grating && bends(0) > WANDER * usual).then_some([step.sqrt(), share])
    }

    /// The waves that stand alone above those around them; none where they are most of the heights. Where the levels of the lines across an axis
    /// repeat, waves across these lines are the harmonics of that profile, and left out.
    pub(crate) fn alone(&self, repeats: [bool; 2]) -> Option<Alone> {
        let (square, gradient) = (self.sum(|_| 1.0), self.sum(|k| self.gradient(k)));
        let is_harmonic = |k: &[isize; 2]| [0, 1].iter().any(|&axis| repeats[axis] && k[1 - axis].abs() <= REACH[0]);
        let all = self.half().filter(|k| !is_harmonic(k));
        let peaks: Vec<Peak> = all.filter_map(|k| self.peak(k, LEAST * gradient)).collect();
        let (strongest, _) = peaks.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let power: f64 = peaks.iter().map(|it| it.1).sum();
        let waves = [0, 1].map(|axis| strongest[axis] as f64 / (self.shape[axis] as f64 * self.spacing[axis]));
        (power < 0.5 * square).then(|| Alone {
            count: peaks.len(),
            wavelength: 1.0 / waves[0].hypot(waves[1]),
            rms: power.sqrt(),
            share: peaks.iter().map(|(k, power)| power * self.gradient(*k)).sum::<f64>() / gradient,
        })
    }

    /// The wave, if it stands alone with a mean square gradient of at least some value.
    fn peak(&self, k: [isize; 2], least: f64) -> Option<Peak> {
        let is_short = k[0].pow(2) + k[1].pow(2) >= LONGEST.pow(2);
        let here = self.at(k);
        if !is_short || here * self.gradient(k) < least {
            return None;
        }
        let [near, far] = REACH;
        let at = |step: [isize; 2]| self.at([k[0] + step[0], k[1] + step[1]]);
        let usual = |steps: &dyn Fn(isize, isize) -> bool| {
            let all = (-far..=far).flat_map(|y| (-far..=far).map(move |x| [y, x]));
            let outside = all.filter(|[y, x]| y.abs().max(x.abs()) > near && steps(*y, *x));
            median(&mut outside.map(at).collect::<Vec<f64>>()).unwrap_or(0.0)
        };
        // a ridge along an axis, as a step makes it, is no wave
        let along_axes = usual(&|y, _| y == 0).max(usual(&|_, x| x == 0));
        let background = usual(&|_, _| true);
        let inside: Vec<f64> = (-near..=near).flat_map(|y| (-near..=near).map(move |x| [y, x])).map(at).collect();
        let is_highest = inside.iter().all(|it| *it <= here);
        let power = 2.0 * (inside.iter().sum::<f64>() - background * inside.len() as f64);
        (is_highest && here > ALONE * background.max(along_axes)).then_some((k, power))
    }
}
