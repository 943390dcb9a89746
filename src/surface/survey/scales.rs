//! Heights along an axis at several scales.

use crate::chunks;
use crate::formats::Scan;
use crate::surface::Surface;
use crate::surface::bends::{DEVIATION, median, white};

/// Exponent of the growth of bends from which on heights are smooth at a scale: 4 where they have a curvature, at most 2 where they are
/// self-affine.
const SMOOTH: f64 = 3.0;
/// Differences below this part of the largest height are rounding errors.
const ROUNDING: f64 = 1e-13;
/// The part by which noise may be larger than the median of the bends says.
const SURE: f64 = 1.15;
/// The most nodes of which a median is found, or other things that a part of the nodes tells.
const SAMPLE: usize = 1 << 16;
/// Growth of the bends of smooth heights from one spacing to two.
const SMOOTHEST: f64 = 16.0;
/// Second differences of noise divided by those of the heights, at the shortest scale that counts as above the noise.
const ABOVE_NOISE: f64 = 0.5;

/// Differences of heights over a distance along an axis. Pairs and triples with a void are left out.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Scale {
    /// The distance `s`.
    pub distance: f64,
    /// Root mean square of `h(x + s) - h(x)`, a length.
    pub rms_step: f64,
    /// Root mean square of `(h(x + s) - h(x)) / s`.
    pub rms_gradient: f64,
    /// Root mean square of `(h(x + s) - 2 h(x) + h(x - s)) / s^2`, 1/length.
    pub rms_curvature: f64,
}

/// Heights along an axis: their differences at one, two, four, ... spacings, and the noise and resolution that follow
/// from them.
///
/// The mean square `B(s)` of the bends `h(x + s) - 2 h(x) + h(x - s)` is that of independent noise of the rms height
/// `sigma`, which does not depend on `s`, and that of the surface, which grows as `s^(2H)` where it is self-affine:
/// `B(s) = 6 sigma^2 + b s^(2H)`. Its values at one, two and four spacings give `sigma`; noise that is weaker than the
/// steps of the surface is underestimated. Differences that are rounding errors of the heights count as 0.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Scales {
    /// The axis, "y" or "x".
    pub axis: &'static str,
    /// Differences at one spacing, two, four and so on, as far as a quarter of the axis.
    pub scales: Vec<Scale>,
    /// Rms height of independent noise, a length; 0 if it cannot be distinguished from the roughness.
    pub noise: f64,
    /// The share of that noise in the mean square gradient at the spacing.
    pub noise_share: f64,
    /// The shortest wavelength above the noise: twice the distance at which the second differences are twice those of
    /// the noise.
    pub shortest_wavelength: f64,
    /// The rms height that independent noise would have by the median of the bends at the spacing. Noise is everywhere, and edges of steps and
    /// particles are not.
    #[serde(skip)]
    usual_noise: f64,
    /// The root mean square of normally distributed differences between neighbours with the median of those of the heights.
    #[serde(skip)]
    pub(super) usual_step: f64,
    /// The wavelength below which the heights are smooth, so that gradient and contact do not depend on the spacing;
    /// none for heights that are rough down to the spacing.
    pub smooth_wavelength: Option<f64>,
}

impl Scales {
    /// The scales of a surface along y and x, at every `every`-th node along an axis; an axis of less than 9 of these is
    /// left out.
    pub fn from_surface(surface: &Surface, every: usize) -> Vec<Self> {
        let scan = Scan::from_surface(surface, every);
        (0..2).filter_map(|axis| Self::new(&scan, axis)).collect()
    }

    /// Heights along an axis, 0 for y and 1 for x; none for an axis of less than 9 nodes or without differences.
    pub(super) fn new(scan: &Scan, axis: usize) -> Option<Self> {
        let (nodes, spacing) = (scan.shape()[axis], scan.spacing[axis]);
        let doubles = std::iter::successors(Some(1), |s| Some(2 * s)).take_while(|s| *s == 1 || 4 * s <= nodes);
        let found: Option<Vec<_>> = doubles.map(|s| differences(scan, axis, s)).collect();
        let squares = found.filter(|it| it.len() >= 3)?;
        let scale = |(i, [steps, bends]): (usize, &[f64; 2])| {
            let distance = spacing * 2f64.powi(i as i32);
            let (rms_step, rms_bend) = (steps.sqrt(), bends.sqrt());
            Scale {
                distance,
                rms_step,
                rms_gradient: rms_step / distance,
                rms_curvature: rms_bend / distance / distance,
            }
        };
        let bends: Vec<f64> = squares.iter().map(|[_, bends]| *bends).collect();
        let (step, noise) = (squares[0][0], white(&bends));
        let first = |is_it: &dyn Fn(usize) -> bool| (0..bends.len()).find(|i| is_it(*i));
        let rough = first(&|i| bends.get(i + 1).is_none_or(|next| (next / bends[i]).log2() < SMOOTH));
        let wavelength = |i: usize| 2.0 * spacing * 2f64.powi(i as i32);
        let found = Self {
            axis: ["y", "x"][axis],
            scales: squares.iter().enumerate().map(scale).collect(),
            noise: noise.sqrt(),
            noise_share: if step > 0.0 { (2.0 * noise / step).min(1.0) } else { 0.0 },
            shortest_wavelength: 0.0,
            usual_noise: usual(scan, axis, &[1.0, -2.0, 1.0]) / 6f64.sqrt(),
            usual_step: usual(scan, axis, &[-1.0, 1.0]),
            smooth_wavelength: rough.filter(|i| *i > 0).map(wavelength),
        };
        Some(Self { shortest_wavelength: found.shortest_wavelength_above(noise.sqrt()), ..found })
    }

    /// The largest rms height that independent noise may have: heights whose bends grow 16 times, the most that they can, make the rest of the bends.
    pub(super) fn most_noise(&self) -> f64 {
        let [one, two] = [0, 1].map(|i| (self.scales[i].rms_curvature * self.scales[i].distance.powi(2)).powi(2));
        let by_growth = ((SMOOTHEST * one - two) / (SMOOTHEST - 1.0) / 6.0).max(0.0).sqrt();
        by_growth.min(SURE * self.usual_noise)
    }

    /// The shortest wavelength above noise of some rms height: twice the distance at which the second differences are twice those of the noise.
    pub(super) fn shortest_wavelength_above(&self, noise: f64) -> f64 {
        let is_above =
            |it: &&Scale| 6.0 * noise * noise <= ABOVE_NOISE * (it.rms_curvature * it.distance.powi(2)).powi(2);
        let above = self.scales.iter().find(is_above).or(self.scales.last());
        above.map_or(0.0, |it| 2.0 * it.distance)
    }
}

/// The root mean square of normally distributed differences, by some factors of successive nodes along an axis, with the median of those of
/// the heights.
pub(super) fn usual(scan: &Scan, axis: usize, factors: &[f64]) -> f64 {
    let every = scan.height.len().div_ceil(SAMPLE);
    let [ny, nx] = scan.shape();
    let places = (0..ny * nx).step_by(every).map(|i| [i / nx, i % nx]);
    let difference = |[y, x]: [usize; 2]| -> Option<f64> {
        let at = |i: usize| scan.height.get(if axis == 0 { [y + i, x] } else { [y, x + i] });
        factors.iter().enumerate().map(|(i, factor)| Some(factor * at(i)?)).sum()
    };
    let mut known: Vec<f64> = places.filter_map(difference).filter(|it| !it.is_nan()).map(f64::abs).collect();
    DEVIATION * median(&mut known).unwrap_or(0.0)
}

/// Some of the heights, ascending.
pub(super) fn sample(scan: &Scan) -> Vec<f64> {
    let every = scan.height.len().div_ceil(SAMPLE);
    let mut heights: Vec<f64> = scan.height.iter().copied().step_by(every).filter(|h| !h.is_nan()).collect();
    heights.sort_unstable_by(f64::total_cmp);
    heights
}

/// The mean squares of first and second differences over a number of spacings; none if there are no such nodes.
fn differences(scan: &Scan, axis: usize, distance: usize) -> Option<[f64; 2]> {
    let ([ny, nx], h) = (scan.shape(), &scan.height);
    let h = h.as_slice()?;
    let (stride, nodes) = if axis == 0 { (nx, ny) } else { (1, nx) };
    let rounding = ROUNDING * h.iter().filter(|h| !h.is_nan()).fold(0.0, |most, h| f64::max(most, h.abs()));
    let sums = chunks::visit(h.len(), |range| {
        range.fold([0.0; 4], |[steps, all_steps, bends, all_bends], node| {
            let place = if axis == 0 { node / nx } else { node % nx };
            let step = if place + distance < nodes { h[node + distance * stride] - h[node] } else { f64::NAN };
            let back = if place >= distance { h[node] - h[node - distance * stride] } else { f64::NAN };
            let square = |it: f64| if it.abs() <= rounding { 0.0 } else { it * it };
            let [step, bend] = [step, step - back].map(|it| if it.is_nan() { [0.0; 2] } else { [square(it), 1.0] });
            [steps + step[0], all_steps + step[1], bends + bend[0], all_bends + bend[1]]
        })
    });
    let [steps, all_steps, bends, all_bends] =
        sums.into_iter().fold([0.0; 4], |sum, part| std::array::from_fn(|i| sum[i] + part[i]));
    (all_steps > 0.0 && all_bends > 0.0).then(|| [steps / all_steps, bends / all_bends])
}
