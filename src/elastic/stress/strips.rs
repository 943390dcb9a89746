//! The stress below a line without images.

use super::{Stress, check};
use crate::chunks;
use crate::error::SolidError;
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use std::f64::consts::PI;

/// Depths of one task, which plans the transforms that they share.
const DEPTHS_PER_TASK: usize = 8;

/// The stress below a line of pressure on a half-space that is free on both sides: each value acts uniformly on an element as wide
/// as the `spacing`, about its node.
///
/// With `theta = atan(x/z)` and `r^2 = x^2 + z^2`, where `x` is the distance from an end of an element, a strip of unit pressure
/// between two ends makes the difference of
///
/// | stress     | primitive                          |
/// |------------|------------------------------------|
/// | `sigma_zz` | `-(theta + x z/r^2) / pi`          |
/// | `sigma_xx` | `-(theta - x z/r^2) / pi`          |
/// | `sigma_xz` | `z^2 / (pi r^2)`                   |
///
/// at both, and `sigma_yy = nu (sigma_xx + sigma_zz)`. All elements are summed by convolutions on a line twice as long, whose other
/// half is empty: no images.
///
/// | argument   | shape | unit     |
/// |------------|-------|----------|
/// | `pressure` | `nx`  | pressure |
/// | `spacing`  |       | length   |
/// | `poisson`  |       |          |
/// | `depth`    | any   | length   |
///
/// # Errors
/// [`SolidError::Poisson`] for a ratio outside `(-1, 1/2]`.
///
/// # Source
/// Johnson, *Contact Mechanics* (1985), section 2.5, Eqs. 2.30.
///
/// ```
/// use asperity::elastic::stress::under_strips;
/// // far below, a strip is the concentrated load of Flamant: sigma_zz = -2P / (pi z)
/// let stress = under_strips(&[0.0, 3.0, 0.0], 0.01, 0.3, &[1.0])?;
/// assert!((stress.zz[[0, 1]] / (-2.0 * 0.03 / std::f64::consts::PI) - 1.0).abs() < 1e-4);
/// # Ok::<(), asperity::error::SolidError>(())
/// ```
pub fn under_strips(pressure: &[f64], spacing: f64, poisson: f64, depth: &[f64]) -> Result<Stress, SolidError> {
    check(poisson)?;
    let nx = pressure.len();
    let strips = Strips::new(pressure, spacing);
    let mut stress = Stress::zero(depth, nx, poisson, true);
    let mut rows = rows(&mut stress, nx);
    let mut tasks: Vec<_> = rows.chunks_mut(DEPTHS_PER_TASK).zip(depth.chunks(DEPTHS_PER_TASK)).collect();
    chunks::each(&mut tasks, DEPTHS_PER_TASK * nx, |_, (rows, depth)| {
        let mut fourier = Fourier::new(&strips.padded);
        rows.iter_mut().zip(*depth).for_each(|(rows, &depth)| strips.write(depth, rows, &mut fourier));
    });
    stress.yy = (&stress.xx + &stress.zz) * poisson;
    Ok(stress)
}

/// The components `zz`, `xx` and `xz` at one depth each.
fn rows(stress: &mut Stress, nx: usize) -> Vec<[&mut [f64]; 3]> {
    let Stress { xx, zz, xz, .. } = stress;
    let [mut zz, mut xx, mut xz] = [zz, xx, xz]
        .map(|field| field.as_slice_mut().expect("fields are made in standard layout").chunks_exact_mut(nx));
    std::iter::from_fn(|| Some([zz.next()?, xx.next()?, xz.next()?])).collect()
}

/// The primitives of `zz`, `xx` and `xz` at a distance from the end of a strip and a depth.
const PRIMITIVES: [fn(f64, f64) -> f64; 3] = [
    |x, z| -((x / z).atan() + x * z / (x * x + z * z)) / PI,
    |x, z| -((x / z).atan() - x * z / (x * x + z * z)) / PI,
    |x, z| z * z / (x * x + z * z) / PI,
];

/// A pressure on a line whose other half is empty.
struct Strips {
    padded: Grid,
    waves: Vec<Complex>,
}

impl Strips {
    fn new(pressure: &[f64], spacing: f64) -> Self {
        let points = (2 * pressure.len()).next_power_of_two().max(Grid::MIN_POINTS);
        let padded = Grid::line(points, spacing * points as f64).expect("a longer line is a line");
        let mut values = pressure.to_vec();
        values.resize(points, 0.0);
        let mut waves = vec![Complex::default(); padded.modes()];
        Fourier::new(&padded).forward(&values, &mut waves);
        waves.iter_mut().for_each(|wave| *wave *= points as f64);
        Self { padded, waves }
    }

    /// Writes the stress at one depth.
    fn write(&self, depth: f64, rows: &mut [&mut [f64]; 3], fourier: &mut Fourier) {
        let mut kernel = vec![Complex::default(); self.waves.len()];
        for (row, primitive) in rows.iter_mut().zip(PRIMITIVES) {
            let mut values = self.influence(|x| primitive(x, depth));
            fourier.forward(&values, &mut kernel);
            kernel.iter_mut().zip(&self.waves).for_each(|(factor, wave)| *factor *= wave);
            fourier.inverse(&mut kernel, &mut values);
            row.copy_from_slice(&values[..row.len()]);
        }
    }

    /// The stress at each distance from an element, those to its left at the end of the padded line.
    fn influence(&self, primitive: impl Fn(f64) -> f64) -> Vec<f64> {
        let (points, spacing) = (self.padded.len(), self.padded.spacing()[1]);
        let distance = |i: usize| if 2 * i > points { i as f64 - points as f64 } else { i as f64 };
        let strip = |x: f64| primitive((x + 0.5) * spacing) - primitive((x - 0.5) * spacing);
        (0..points).map(|i| strip(distance(i))).collect()
    }
}
