//! A membrane on patches of a surface.

use crate::chunks;
use crate::fourier::Real;

/// The part of a Jacobi step that is taken. Below 1 a step lowers the error of every membrane.
const DAMPING: f64 = 0.8;

/// Part of the links across the side of a cell by which the cell is linked to the next one, twice as far away. Links to the nodes around
/// the patches keep their sum: a softer rim would make the correction of narrow patches many times too large.
const LINK: f32 = 0.5;

/// An approximate inverse of `c0 - c2 lap` on some nodes of a periodic surface, zero at the nodes around them: symmetric and positive.
///
/// It is a V-cycle of multigrid with cells of two, four, eight ... nodes along each side, and a damped Jacobi step before and after the
/// correction by the coarser cells, which is the same in the four finer ones. A V-cycle whose steps after the correction are those before
/// it is symmetric, and positive if these steps converge.
///
/// Memory: 4 fields of n numbers in single precision and 4 of the precision `T`.
///
/// # Source
/// Briggs, Henson & McCormick, *A Multigrid Tutorial* (2000). Aggregation with rescaled links: Braess, Computing 55, 379 (1995).
pub(super) struct Membrane<T> {
    /// From the nodes to the single cell.
    grids: Vec<MembraneGrid<T>>,
}

/// Nodes, or cells of one size.
struct MembraneGrid<T> {
    shape: [usize; 2],
    /// The inverse of the diagonal; zero off the patches.
    pivots: Vec<f32>,
    /// Links to the next row and to the next column.
    links: [Vec<f32>; 2],
    load: Vec<T>,
    values: Vec<T>,
    /// Values after a Jacobi step.
    relaxed: Vec<T>,
}

/// The parts of the diagonal of a grid, besides the links within the patches.
struct MembraneGround {
    /// Nodes of the patches in a cell.
    nodes: Vec<f32>,
    /// Links to nodes around the patches.
    rim: Vec<f32>,
}

impl<T: Real> Membrane<T> {
    /// The membrane on the nodes that are `inside`, with `foundation` `c0` and the `links` `c2 / dy^2` and `c2 / dx^2`.
    pub(crate) fn new(inside: &[bool], shape: [usize; 2], foundation: f64, links: [f64; 2]) -> Self {
        let foundation = foundation as f32;
        let (ground, links) = finest(inside, shape, links.map(|link| link as f32));
        let mut grids = vec![MembraneGrid::new(shape, &ground, links, foundation)];
        let mut ground = ground;
        while let Some(finer) = grids.last().filter(|grid| grid.shape != [1, 1]) {
            let (shape, coarser, links) = finer.coarser(&ground);
            grids.push(MembraneGrid::new(shape, &coarser, links, foundation));
            ground = coarser;
        }
        Self { grids }
    }

    /// Takes the values from a load at all nodes.
    pub(crate) fn press(&mut self, load: &[T]) {
        self.grids[0].load.copy_from_slice(load);
        cycle(&mut self.grids);
    }

    /// Adds the values to a field.
    pub(crate) fn add_to(&self, field: &mut [T]) {
        let values = &self.grids[0].values;
        let width = self.grids[0].shape[1];
        chunks::rows_mut(field, width, |y, row| {
            row.iter_mut().zip(&values[y * width..]).for_each(|(sum, &value)| *sum = *sum + value);
        });
    }
}

/// One V-cycle from zero.
fn cycle<T: Real>(grids: &mut [MembraneGrid<T>]) {
    let Some((grid, coarser)) = grids.split_first_mut() else { return };
    let width = grid.shape[1];
    let MembraneGrid { pivots, load, values, .. } = grid;
    chunks::rows_mut(values, width, |y, row| {
        let at = y * width;
        row.iter_mut().enumerate().for_each(|(x, value)| *value = damped::<T>(pivots[at + x]) * load[at + x]);
    });
    if let Some(next) = coarser.first_mut() {
        grid.restrict(next);
        cycle(coarser);
        grid.correct(&coarser[0]);
    }
    grid.relax();
}

fn damped<T: Real>(pivot: f32) -> T {
    T::from_double(DAMPING * f64::from(pivot))
}

impl<T: Real> MembraneGrid<T> {
    fn new(shape: [usize; 2], ground: &MembraneGround, links: [Vec<f32>; 2], foundation: f32) -> Self {
        let pivot = |i: usize| {
            let linked: f32 = neighbours(shape, i).iter().map(|&[axis, link, _]| links[axis][link]).sum();
            let diagonal = foundation * ground.nodes[i] + ground.rim[i] + linked;
            if diagonal > 0.0 { diagonal.recip() } else { 0.0 }
        };
        let nodes = shape[0] * shape[1];
        let pivots = (0..nodes).map(pivot).collect();
        let zeros = || vec![T::zero(); nodes];
        Self { shape, pivots, links, load: zeros(), values: zeros(), relaxed: zeros() }
    }

    /// The shape, ground and links of cells of two by two.
    fn coarser(&self, ground: &MembraneGround) -> ([usize; 2], MembraneGround, [Vec<f32>; 2]) {
        let shape = self.shape.map(|n| n.div_ceil(2));
        let zeros = || vec![0.0; shape[0] * shape[1]];
        let mut coarser = MembraneGround { nodes: zeros(), rim: zeros() };
        let mut links = [zeros(), zeros()];
        for i in 0..self.pivots.len() {
            let cell = self.cell(i, shape);
            coarser.nodes[cell] += ground.nodes[i];
            coarser.rim[cell] += ground.rim[i];
            for axis in [0, 1] {
                if self.cell(next(self.shape, i, axis), shape) != cell {
                    links[axis][cell] += LINK * self.links[axis][i];
                }
            }
        }
        (shape, coarser, links)
    }

    /// The cell of a coarser `shape` in which a node lies.
    fn cell(&self, i: usize, shape: [usize; 2]) -> usize {
        i / self.shape[1] / 2 * shape[1] + i % self.shape[1] / 2
    }

    /// The load of a node minus what the values carry of it.
    fn residual(&self, i: usize) -> T {
        if self.pivots[i] == 0.0 {
            return T::zero();
        }
        let pull = neighbours(self.shape, i).iter().fold(T::zero(), |sum, &[axis, link, other]| {
            sum + T::from_double(f64::from(self.links[axis][link])) * self.values[other]
        });
        self.load[i] + pull - self.values[i] * T::from_double(f64::from(self.pivots[i]).recip())
    }

    /// Hands the sums of the residual to coarser cells.
    fn restrict(&self, coarser: &mut Self) {
        let [height, width] = self.shape;
        let length = coarser.shape[1];
        chunks::rows_mut(&mut coarser.load, length, |y, row| {
            row.fill(T::zero());
            for y in 2 * y..height.min(2 * y + 2) {
                (0..width).for_each(|x| row[x / 2] = row[x / 2] + self.residual(y * width + x));
            }
        });
    }

    /// Adds the values of coarser cells.
    fn correct(&mut self, coarser: &Self) {
        let width = self.shape[1];
        let pivots = &self.pivots;
        chunks::rows_mut(&mut self.values, width, |y, row| {
            let above = &coarser.values[y / 2 * coarser.shape[1]..];
            let on_patches = row.iter_mut().enumerate().filter(|(x, _)| pivots[y * width + x] > 0.0);
            on_patches.for_each(|(x, value)| *value = *value + above[x / 2]);
        });
    }

    /// A Jacobi step.
    fn relax(&mut self) {
        let width = self.shape[1];
        let mut relaxed = std::mem::take(&mut self.relaxed);
        chunks::rows_mut(&mut relaxed, width, |y, row| {
            let step = |i: usize| damped::<T>(self.pivots[i]) * self.residual(i);
            row.iter_mut().zip(y * width..).for_each(|(value, i)| *value = self.values[i] + step(i));
        });
        self.relaxed = std::mem::replace(&mut self.values, relaxed);
    }
}

/// The next node along an axis, around the end.
fn next([ny, nx]: [usize; 2], i: usize, axis: usize) -> usize {
    match axis {
        0 if i + nx < ny * nx => i + nx,
        0 => i + nx - ny * nx,
        _ if (i + 1).is_multiple_of(nx) => i + 1 - nx,
        _ => i + 1,
    }
}

/// The links of a node to its four neighbours: their axes and places, and the neighbours.
fn neighbours(shape: [usize; 2], i: usize) -> [[usize; 3]; 4] {
    let [ny, nx] = shape;
    let above = if i >= nx { i - nx } else { i + (ny - 1) * nx };
    let left = if i.is_multiple_of(nx) { i + nx - 1 } else { i - 1 };
    [[0, i, next(shape, i, 0)], [0, above, above], [1, i, next(shape, i, 1)], [1, left, left]]
}

/// The ground of nodes, and their links.
fn finest(inside: &[bool], shape: [usize; 2], [along_y, along_x]: [f32; 2]) -> (MembraneGround, [Vec<f32>; 2]) {
    let by_axis = [along_y, along_x];
    let links = [0, 1].map(|axis| {
        let linked = |i: usize| inside[i] && inside[next(shape, i, axis)];
        (0..inside.len()).map(|i| if linked(i) { by_axis[axis] } else { 0.0 }).collect()
    });
    let rim = |i: usize| {
        let outside = neighbours(shape, i).into_iter().filter(|&[_, _, other]| inside[i] && !inside[other]);
        outside.map(|[axis, ..]| by_axis[axis]).sum()
    };
    let nodes = inside.iter().map(|&inside| f32::from(u8::from(inside))).collect();
    (MembraneGround { nodes, rim: (0..inside.len()).map(rim).collect() }, links)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Patches of all sizes and single nodes, also around the end.
    fn patches([ny, nx]: [usize; 2]) -> Vec<bool> {
        let wave = |y: usize, x: usize| (0.11 * (y * y) as f64).sin() + (0.37 * x as f64).cos();
        (0..ny * nx).map(|i| wave(i / nx, i % nx) > 0.4 || i % 7 == 0).collect()
    }

    fn noise(nodes: usize, seed: f64) -> Vec<f64> {
        (0..nodes).map(|i| ((i * i % 1013) as f64 * seed).sin()).collect()
    }

    fn dot(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    fn pressed(membrane: &mut Membrane<f64>, load: &[f64]) -> Vec<f64> {
        membrane.press(load);
        let mut values = vec![0.0; load.len()];
        membrane.add_to(&mut values);
        values
    }

    /// `c0 - c2 lap` by its definition.
    fn stiff(inside: &[bool], [ny, nx]: [usize; 2], foundation: f64, [by_y, by_x]: [f64; 2], p: &[f64]) -> Vec<f64> {
        let at = |y: usize, x: usize| p[y % ny * nx + x % nx];
        let one = |i: usize| {
            let (y, x) = (i / nx, i % nx);
            let along_y = 2.0 * at(y, x) - at(y + 1, x) - at(y + ny - 1, x);
            let along_x = 2.0 * at(y, x) - at(y, x + 1) - at(y, x + nx - 1);
            if inside[i] { foundation * at(y, x) + by_y * along_y + by_x * along_x } else { 0.0 }
        };
        (0..p.len()).map(one).collect()
    }

    #[test]
    fn a_cycle_is_symmetric_and_close_to_the_inverse() {
        for shape in [[64, 64], [33, 17], [5, 48], [6, 7]] {
            for (foundation, links) in [(0.0, [1.0, 1.0]), (0.3, [2.0, 1.0]), (1.0, [0.0, 0.0]), (0.01, [7.0, 8.0])] {
                let (inside, nodes) = (patches(shape), shape[0] * shape[1]);
                let mut membrane = Membrane::<f64>::new(&inside, shape, foundation, links);
                let [a, b] = [0.7, 1.3].map(|seed| noise(nodes, seed));
                let [pressed_a, pressed_b] = [&a, &b].map(|load| pressed(&mut membrane, load));
                assert!((0..nodes).all(|i| inside[i] == (pressed_a[i] != 0.0)));
                let energy = dot(&a, &pressed_a);
                assert!(energy > 0.0 && (dot(&b, &pressed_a) - dot(&a, &pressed_b)).abs() < 1e-6 * energy);
                let mut p = vec![0.0; nodes];
                let residual = |p: &[f64]| -> Vec<f64> {
                    let pulled = stiff(&inside, shape, foundation, links, p);
                    (0..nodes).map(|i| if inside[i] { a[i] - pulled[i] } else { 0.0 }).collect()
                };
                let begin = dot(&residual(&p), &residual(&p));
                for _ in 0..10 {
                    let step = pressed(&mut membrane, &residual(&p));
                    p.iter_mut().zip(step).for_each(|(p, step)| *p += 0.7 * step);
                }
                let part = (dot(&residual(&p), &residual(&p)) / begin).sqrt();
                assert!(part < 5e-3, "{shape:?} {foundation} {links:?}: {part}");
            }
        }
    }
}
