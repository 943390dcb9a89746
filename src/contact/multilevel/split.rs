//! The compliance of a half-space as a sum of a near and a smooth part.

use super::extension::Extension;
use super::far::Smooth;
use super::near::Stencil;
use super::operator::{SetOperator, largest, power_of_two};
use super::support::Support;
use crate::contact::Problem;
use crate::elastic::element;
use crate::fourier::{Complex, Filter, Fourier, smooth};
use crate::grid::Grid;
use libm::{erf, erfc};
use std::f64::consts::{PI, TAU};

/// How a kernel is split: nodes along the side of a cell, the radius of the near part, and the product of the radius and the width
/// parameter `alpha` of the split. A larger product cuts off less of the near part, and leaves a less smooth far part.
#[derive(Debug, Clone, Copy, PartialEq)]
struct KernelSplit {
    side: usize,
    radius: f64,
    product: f64,
}

impl KernelSplit {
    /// `1 / (2 alpha)`.
    const fn width(self) -> f64 {
        0.5 * self.radius / self.product
    }

    const fn nodes_per_cell(self) -> f64 {
        (self.side * self.side) as f64
    }
}

/// The parts of the compliance and of the stiffness. Displacements err by less than `ACCURACY` of the largest one; the error of
/// the stiffness only makes the preconditioner a little worse.
const COMPLIANCE: KernelSplit = KernelSplit { side: 8, radius: 16.0, product: 1.7 };
const STIFFNESS: KernelSplit = KernelSplit { side: 4, radius: 6.0, product: 1.6 };
const ACCURACY: f64 = 5e-3;

/// Values of the near parts, per node of the set, that cost as much as a point of a grid that is transformed forth and back: measured
/// on periodic and free rough contacts of [`MEASURED_NODES`].
const VALUES_PER_POINT: f64 = 4.0;
/// The nodes of 1024^2. Points of larger grids cost more, since these do not fit the caches.
const MEASURED_NODES: f64 = 1048576.0;
/// The power of the nodes by which points of larger grids cost more, measured on rough contacts of 4096^2 nodes.
const SLOWDOWN: f64 = 1.0 / 6.0;

/// Nodes along the sides of the grid on which the near part is computed.
const PATCH: usize = 128;

/// Largest ratio of the spacings along both axes.
const LONGEST: f64 = 1.5;

/// The compliance of a half-space `A = A_near + A_far` (an Ewald sum): in the periodic case, with the width parameter `alpha`,
///
/// `A_far(q) = (2 / (E* q)) erfc(q / (2 alpha))`,
///
/// which is smooth and is applied on a coarser grid; the rest is of short range and is applied as a sum over neighbours, cut off at a
/// radius. With free boundaries `A_far(r) = erf(alpha r) / (pi E* r)`. The cost grows with the nodes of the sets.
///
/// The preconditioner is `E' K_far E + K_near` with the stiffness split alike: the far part acts on the means over cells and their
/// [`Extension`], the near part on the nodes of the set alone.
///
/// Lengths are in units of the geometric mean `d` of the spacings, displacements under the pressure 1 in units of `d / E*`.
///
/// # Source
/// Ewald, Ann. Phys. 369, 253 (1921). Its use on contact sets is this crate's own.
pub(super) struct Split {
    /// `d / E*`.
    unit: f64,
    near: Stencil,
    far: Smooth,
    stiffness: SplitStiffness,
    /// A transform of the coarse grid in those of the whole one.
    share: f64,
    transforms: f64,
}

/// The preconditioner of [`Split`].
struct SplitStiffness {
    shape: [usize; 2],
    near: Stencil,
    far: Filter<f32>,
    factors: Vec<f32>,
    extension: Option<Extension<f32>>,
    share: f64,
}

impl Split {
    /// The split compliance of the problem; none if it is not that of a half-space over a suitable grid, or if transforms of the whole
    /// grid cost less on a set of `set` nodes.
    pub(crate) fn new(problem: &Problem, set: usize) -> Option<Self> {
        let grid = problem.surface().grid();
        if !suits(grid) || !problem.solid().is_half_space() {
            return None;
        }
        let (shape, spacing, is_periodic) = (grid.shape(), grid.spacing(), grid.is_periodic());
        let unit = (spacing[0] * spacing[1]).sqrt();
        let spacing = spacing.map(|d| d / unit);
        let (near, stiffness) = (near(shape, spacing, is_periodic), SplitStiffness::new(shape, spacing, is_periodic));
        let values = (near.values() + stiffness.near.values()) * set;
        // a product and the preconditioner
        let points = problem.compliance().transformed_points();
        let slowdown = (grid.len() as f64 / MEASURED_NODES).max(1.0).powf(SLOWDOWN);
        if values as f64 > VALUES_PER_POINT * slowdown * (points + grid.len()) as f64 {
            return None;
        }
        let far = if is_periodic { periodic(shape, spacing, near.sum()) } else { free(shape, spacing) };
        let share = far.points() as f64 / points as f64;
        Some(Self { unit: unit / problem.contact_modulus(), near, far, stiffness, share, transforms: 0.0 })
    }
}

/// Whether cells fit the grid, which has more nodes than the near part and nearly equal spacings along both axes.
fn suits(grid: &Grid) -> bool {
    let ([dy, dx], [round_y, round_x]) = (grid.spacing(), grid.periodic());
    let fits =
        |n: usize, KernelSplit { side, radius, .. }: KernelSplit| n.is_multiple_of(side) && n as f64 > 4.0 * radius;
    !grid.is_line()
        && round_y == round_x
        && (dy / dx).max(dx / dy) <= LONGEST
        && grid.shape().iter().all(|&n| fits(n, COMPLIANCE) && fits(n, STIFFNESS))
}

impl SetOperator for Split {
    fn comply(&mut self, from: &Support, pressure: &[f64], to: &Support, displacement: &mut [f64]) {
        self.transforms += 2.0 * self.share;
        let largest = power_of_two(largest(pressure));
        let scales = [largest.recip(), largest * self.unit];
        displacement.fill(0.0);
        self.near.add(from, pressure, to, scales, displacement);
        self.far.add(from, pressure, to, scales, displacement);
    }

    fn prepare(&mut self, support: &Support) {
        self.stiffness.extension =
            Some(Extension::new(support, [self.stiffness.shape; 2], STIFFNESS.side, f64::INFINITY));
    }

    fn precondition(&mut self, support: &Support, residual: &[f64], pressure: &mut [f64]) {
        self.transforms += 2.0 * self.stiffness.share;
        let largest = power_of_two(largest(residual));
        self.stiffness.press(support, residual, [largest.recip(), largest / self.unit], pressure);
    }

    /// The coarse grids need little.
    fn release(&mut self) {}

    fn accuracy(&self) -> f64 {
        ACCURACY
    }

    fn transforms(&self) -> f64 {
        self.transforms
    }
}

impl SplitStiffness {
    fn new(shape: [usize; 2], spacing: [f64; 2], is_periodic: bool) -> Self {
        let KernelSplit { side, radius, .. } = STIFFNESS;
        let width = STIFFNESS.width();
        let (kernel, place) = on_patch(spacing, |q| 0.5 * q * erf(q * width));
        let near = Stencil::new(shape, [is_periodic; 2], half_axes(radius, spacing), |node| kernel[place(node)]);
        let cells = cells(shape, spacing, side);
        let factors = Filter::places(&cells).into_iter().map(|place| {
            let q = wavenumber(&cells, place);
            (0.5 * q * erfc(q * width)) as f32
        });
        let share = cells.len() as f64 / (shape[0] * shape[1]) as f64;
        Self { shape, near, factors: factors.collect(), far: Filter::new(&cells), extension: None, share }
    }

    /// Writes the pressure on the set that the residual asks for, times `down` before and `up` after.
    fn press(&mut self, support: &Support, residual: &[f64], [down, up]: [f64; 2], pressure: &mut [f64]) {
        let Self { near, far, factors, extension, shape, .. } = self;
        let extension = extension.as_mut().expect("the operator is prepared for the set");
        let width = shape[1] / STIFFNESS.side;
        extension.extend(support, |node| (down * residual[node]) as f32);
        let mut pressed = vec![0.0; extension.cells().len()];
        let mut sinks: Vec<_> = pressed.chunks_exact_mut(width).collect();
        far.load(|row, to| to.copy_from_slice(&extension.cells()[row * width..][..width]));
        far.scale(|wave| f64::from(factors[wave.place]));
        far.store(&mut sinks, |_, row, sink| sink.copy_from_slice(row));
        extension.cells_mut().copy_from_slice(&pressed);
        pressure.fill(0.0);
        extension.restrict_cells(support, pressure, up * STIFFNESS.nodes_per_cell());
        near.add(support, residual, support, [down, up], pressure);
    }
}

/// The inverse transform of an even function of the wavenumber on a patch of nodes, and the place of a node there.
fn on_patch(nodes: [f64; 2], of: impl Fn(f64) -> f64) -> (Vec<f64>, impl Fn([usize; 2]) -> usize) {
    let patch = Grid::surface([PATCH; 2], nodes.map(|d| d * PATCH as f64)).expect("spacings are positive");
    let mut spectrum: Vec<Complex> = patch.wavenumbers().map(|q| Complex::new(of(q), 0.0)).collect();
    let mut field = vec![0.0; patch.len()];
    Fourier::new(&patch).inverse(&mut spectrum, &mut field);
    field.iter_mut().for_each(|value| *value /= (PATCH * PATCH) as f64);
    (field, |[dy, dx]: [usize; 2]| dy * PATCH + dx)
}

/// Half axes of the ellipse of a radius, in nodes.
fn half_axes(radius: f64, nodes: [f64; 2]) -> [f64; 2] {
    nodes.map(|d| (radius / d).min(PATCH as f64 / 2.0))
}

/// The grid of cells of `side` nodes along each side.
fn cells(shape: [usize; 2], spacing: [f64; 2], side: usize) -> Grid {
    let size = [0, 1].map(|axis| shape[axis] as f64 * spacing[axis]);
    Grid::surface(shape.map(|n| n / side), size).expect("cells of a grid are a grid")
}

fn wavenumber(grid: &Grid, [ky, kx]: [usize; 2]) -> f64 {
    let [ly, lx] = grid.size();
    (TAU * ky as f64 / ly).hypot(TAU * kx as f64 / lx)
}

/// Near part of the compliance.
fn near(shape: [usize; 2], spacing: [f64; 2], is_periodic: bool) -> Stencil {
    let reach = half_axes(COMPLIANCE.radius, spacing);
    if is_periodic {
        let width = COMPLIANCE.width();
        let of = |q: f64| if q > 0.0 { 2.0 / q * erf(q * width) } else { 4.0 * width / PI.sqrt() };
        let (kernel, place) = on_patch(spacing, of);
        return Stencil::new(shape, [true; 2], reach, |node| kernel[place(node)]);
    }
    Stencil::new(shape, [false; 2], reach, |[y, x]| {
        let [y, x] = [y as f64 * spacing[0], x as f64 * spacing[1]];
        element::rectangle([y, x], spacing, 1.0) - smooth_part(y.hypot(x))
    })
}

/// Far part of a periodic half-space. A uniform pressure displaces nothing, so that it takes away what the near part makes of it.
fn periodic(shape: [usize; 2], spacing: [f64; 2], of_uniform: f64) -> Smooth {
    let (width, area) = (COMPLIANCE.width(), COMPLIANCE.nodes_per_cell());
    let grid = cells(shape, spacing, COMPLIANCE.side);
    Smooth::new(&grid, COMPLIANCE.side, |place| {
        let q = wavenumber(&grid, place);
        if q > 0.0 { 2.0 / q * erfc(q * width) / area } else { -of_uniform / area }
    })
}

/// Far part of a half-space without images, on a padded grid: values are spread up to two nodes beyond the last cell, and one before
/// the first.
fn free(shape: [usize; 2], spacing: [f64; 2]) -> Smooth {
    let coarse = shape.map(|n| smooth(2 * (n / COMPLIANCE.side) + 4));
    let steps = spacing.map(|d| d * COMPLIANCE.side as f64);
    let size = [0, 1].map(|axis| coarse[axis] as f64 * steps[axis]);
    let grid = Grid::surface(coarse, size).expect("cells of a grid are a grid");
    let at = |i: usize, axis: usize| i.min(coarse[axis] - i) as f64 * steps[axis];
    let kernel: Vec<f64> =
        (0..grid.len()).map(|i| smooth_part(at(i / coarse[1], 0).hypot(at(i % coarse[1], 1)))).collect();
    let mut spectrum = vec![Complex::default(); grid.modes()];
    Fourier::new(&grid).forward(&kernel, &mut spectrum);
    Smooth::new(&grid, COMPLIANCE.side, |[ky, kx]| grid.len() as f64 * spectrum[kx * coarse[0] + ky].re)
}

/// `erf(alpha r) / (pi r)`.
fn smooth_part(r: f64) -> f64 {
    let alpha = COMPLIANCE.product / COMPLIANCE.radius;
    if r > 0.0 { erf(alpha * r) / (PI * r) } else { 2.0 * alpha / PI.powf(1.5) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{ContactModulus, Load};
    use crate::surface::{Field, Surface};

    const POINTS: usize = 128;

    /// Some round patches of nodes, with a pressure of either sign on them.
    fn patches() -> (Support, Vec<f64>) {
        let centres = [[20.0, 30.0], [22.0, 41.0], [64.0, 64.0], [100.0, 5.0], [127.0, 120.0], [3.0, 90.0]];
        Support::choose_values([POINTS; 2], |row, nodes| {
            for column in 0..POINTS {
                let inside = |centre: &[f64; 2]| (row as f64 - centre[0]).hypot(column as f64 - centre[1]) < 4.5;
                if centres.iter().any(inside) {
                    nodes.push(column, 1.0 + 1.5 * ((row * 31 + column * 17) as f64 * 0.7).sin());
                }
            }
        })
    }

    /// A half-space in units that single precision could not take as they are.
    fn problem(is_periodic: bool) -> Problem {
        let grid = Grid::surface([POINTS; 2], [1.2e-30, 1e-30]).unwrap().with_periodic([is_periodic; 2]);
        let height = Field::from_shape_fn((POINTS, POINTS), |(y, x)| 1e-33 * ((y * y + 3 * x) as f64).sin());
        let surface = Surface::new(grid, height).unwrap();
        Problem::new(surface, ContactModulus(1e11), Load::MeanPressure(1e3)).unwrap()
    }

    #[test]
    fn displacements_are_those_of_the_whole_grid_to_the_stated_accuracy() {
        for is_periodic in [true, false] {
            let (problem, (support, pressure)) = (problem(is_periodic), patches());
            let mut split = Split::new(&problem, 1).unwrap();
            let everywhere = Support::choose([POINTS; 2], |_, nodes| (0..POINTS).for_each(|x| nodes.push(x)));
            let mut found = vec![0.0; POINTS * POINTS];
            split.comply(&support, &pressure, &everywhere, &mut found);
            let mut expected = vec![0.0; found.len()];
            problem.response().displacement(&support.spread(&pressure), &mut expected);
            let error = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let range = largest(&expected);
            assert!(error < ACCURACY * range, "periodic {is_periodic}: {:e}", error / range);
            assert!(error > 0.0 && split.transforms() < 0.1);
        }
    }

    #[test]
    fn the_preconditioner_is_symmetric_and_positive() {
        for is_periodic in [true, false] {
            let (problem, (support, a)) = (problem(is_periodic), patches());
            let mut split = Split::new(&problem, 1).unwrap();
            split.prepare(&support);
            let b: Vec<f64> = (0..a.len()).map(|i| (i as f64 * 0.3).cos()).collect();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let [of_a, of_b] = [&a, &b].map(|it| {
                let mut pressed = vec![0.0; it.len()];
                split.precondition(&support, it, &mut pressed);
                pressed
            });
            let [forth, back] = [dot(&a, &of_b), dot(&b, &of_a)];
            let size = (dot(&a, &of_a) * dot(&b, &of_b)).sqrt();
            assert!(dot(&a, &of_a) > 0.0 && dot(&b, &of_b) > 0.0);
            assert!((forth - back).abs() < 1e-5 * size, "{forth} and {back} beside {size}");
        }
    }

    /// On many nodes, on lines and on mixed boundaries, transforms are cheaper or the only way.
    #[test]
    fn it_is_made_where_it_pays_and_fits() {
        let problem = problem(true);
        let nodes = problem.nodes();
        assert!(Split::new(&problem, nodes / 200).is_some() && Split::new(&problem, nodes / 20).is_none());
        let with = |grid: Grid| {
            let height = Field::from_shape_fn(grid.shape(), |(y, x)| ((y * y + 3 * x) as f64).sin());
            let surface = Surface::new(grid, height).unwrap();
            Split::new(&Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(1e-3)).unwrap(), 10)
        };
        let grid = |shape, size| Grid::surface(shape, size).unwrap();
        assert!(with(grid([128, 256], [1.0, 2.0])).is_some());
        assert!(with(grid([128, 256], [1.0, 1.0])).is_none());
        assert!(with(grid([128, 252], [1.0, 2.0])).is_none());
        assert!(with(grid([64, 64], [1.0, 1.0])).is_none());
        assert!(with(grid([128, 128], [1.0, 1.0]).with_periodic([true, false])).is_none());
        assert!(with(Grid::line(1 << 14, 1.0).unwrap()).is_none());
    }
}
