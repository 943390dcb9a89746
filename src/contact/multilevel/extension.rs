//! The extension of vectors from the contact set to all nodes.

use super::support::Support;
use crate::chunks;
use crate::fourier::Real;

/// Cells whose shares are set together.
const SHARES: usize = 1 << 14;

/// Weights of linear interpolation between cell centres, for the cell around a point and for the neighbour next to it.
const NEAR: f64 = 0.75;
const FAR: f64 = 0.25;

/// The extension `E` of a vector from a set to all nodes, a field of small energy under the stiffness operator.
///
/// Cells of two, four, eight ... nodes along each side carry the mean `m` of the vector, zero off the set, and the share `w` of
/// nodes that are in the set. From the coarsest cells to the nodes,
///
/// `e = a(w) m / w + (1 - a(w)) I e_coarser`
///
/// with linear interpolation `I` between cells; nodes of the set keep their values (`w = a = 1`). What a set of size `b` knows
/// of a field at the distance `s` is its capacity over that of the cell: `a = 1 / (1 + ln(s / b))` on a line, `a = b / s` on a
/// surface, so `a = sqrt(w)` there.
///
/// Where only long waves matter, the finest cells have more than two nodes per side, and the extension ends at these cells. Where only
/// short ones do, there are no cells beyond a size.
///
/// Memory: 2 fields of n numbers on lines, two thirds of one on surfaces, with cells of two nodes.
///
/// # Source
/// The pyramid is the pull-push of Gortler, Grzeszczuk, Szeliski & Cohen, "The Lumigraph", SIGGRAPH 1996. Its use here, the
/// blending by capacity and the exact transpose are this crate's own.
pub(super) struct Extension<T> {
    /// Shape of the nodes of the grid.
    shape: [usize; 2],
    /// Shape of all nodes that vectors are extended to, of which those of the grid are the first ones along each axis.
    wide: [usize; 2],
    /// Nodes along each side of the finest cells.
    side: usize,
    /// Rows of the half-space in a row of nodes.
    pieces: usize,
    /// From the finest to the coarsest cells.
    levels: Vec<Cells<T>>,
}

/// Cells of one size, each over two of the finer ones along each side that has more than one.
struct Cells<T> {
    shape: [usize; 2],
    /// `a`.
    share: Vec<f32>,
    /// `a / w`, 0 for empty cells.
    gain: Vec<f32>,
    values: Vec<T>,
}

impl<T: Real> Extension<T> {
    /// The extension from `support` on a grid of `shape` nodes to `wide` ones, with finest cells of `side` nodes along each side, and
    /// coarsest ones of at most `largest` nodes.
    pub(crate) fn new(support: &Support, [shape, wide]: [[usize; 2]; 2], side: usize, largest: f64) -> Self {
        let mut levels = Vec::new();
        let (mut finer, mut nodes) = (wide, side as f64);
        while finer != [1, 1] && nodes <= largest {
            nodes *= 2.0;
            let side = if levels.is_empty() { side } else { 2 };
            finer = finer.map(|n| n.div_ceil(side));
            let values = vec![T::zero(); finer[0] * finer[1]];
            levels.push(Cells { shape: finer, share: Vec::new(), gain: Vec::new(), values });
        }
        let mut extension = Self { shape, wide, side, pieces: shape[1] / support.shape()[1], levels };
        extension.pool(support, |_| T::one());
        let share = if shape[0] == 1 { |w: f64| 1.0 / (1.0 - w.ln()) } else { f64::sqrt };
        extension.levels.iter_mut().for_each(|cells| cells.set_shares(share));
        extension
    }

    /// Extends a vector to the cells.
    pub(crate) fn extend(&mut self, support: &Support, value: impl Fn(usize) -> T + Sync) {
        self.pool(support, value);
        let mut coarser: Option<&Cells<T>> = None;
        for cells in self.levels.iter_mut().rev() {
            let tile = chunks::tile(cells.shape);
            let Cells { shape, share, gain, values } = cells;
            chunks::rows_mut(values, tile, |task, part| {
                let at = task * tile;
                let (y, first) = (at / shape[1], at % shape[1]);
                part.iter_mut().zip(&gain[at..]).for_each(|(value, &gain)| *value = *value * number(gain));
                if let Some(coarser) = coarser {
                    let share = &share[at..];
                    coarser.interpolate(*shape, y, first..first + part.len(), |x, value| {
                        let at = x - first;
                        part[at] = part[at] + number::<T>(1.0 - share[at]) * value;
                    });
                }
            });
            coarser = Some(cells);
        }
    }

    /// The values at the finest cells, row by row.
    pub(crate) fn cells(&self) -> &[T] {
        self.levels.first().map_or(&[], |cells| &cells.values)
    }

    /// Writes the extended vector to a row of all nodes, or to a piece of a line; the nodes of the set are left to the caller. The finest
    /// cells must have two nodes per side.
    pub(crate) fn fill(&self, row: usize, to: &mut [T]) {
        let Some(finest) = self.levels.first() else { return to.fill(T::zero()) };
        let at = row * to.len();
        let (y, first) = (at / self.wide[1], at % self.wide[1]);
        finest.interpolate(self.wide, y, first..first + to.len(), |x, value| to[x - first] = value);
    }

    /// Adds to `values` on the set what the transpose of the extension makes of the `field` off the set; `field` is zero on it.
    pub(crate) fn restrict(&mut self, field: &[T], support: &Support, values: &mut [f64], scale: f64) {
        let nx = self.wide[1];
        if let Some(finest) = self.levels.first_mut() {
            finest.collect(self.wide, |y, x| field[y * nx + x]);
        }
        self.restrict_cells(support, values, scale);
    }

    /// Adds to `values` on the set `scale` times what the transpose of the extension makes of values at the finest cells, which are
    /// put into [`Extension::cells_mut`] before.
    pub(crate) fn restrict_cells(&mut self, support: &Support, values: &mut [f64], scale: f64) {
        for level in 1..self.levels.len() {
            let (finer, coarser) = self.levels.split_at_mut(level);
            let Cells { shape, share, values, .. } = &finer[level - 1];
            let width = shape[1];
            coarser[0].collect(*shape, |y, x| number::<T>(1.0 - share[y * width + x]) * values[y * width + x]);
        }
        let mut coarser: Option<&Cells<T>> = None;
        for cells in self.levels.iter_mut().rev() {
            let tile = chunks::tile(cells.shape);
            let Cells { shape, gain, values, .. } = cells;
            chunks::rows_mut(values, tile, |task, part| {
                let at = task * tile;
                let (y, first) = (at / shape[1], at % shape[1]);
                part.iter_mut().zip(&gain[at..]).for_each(|(value, &gain)| *value = *value * number(gain));
                if let Some(coarser) = coarser {
                    let weight = weight::<T>(*shape, 2);
                    let above = &coarser.values[y / 2 * coarser.shape[1] + first / 2..];
                    part.iter_mut().enumerate().for_each(|(x, value)| *value = *value + weight * above[x / 2]);
                }
            });
            coarser = Some(cells);
        }
        self.add_to(support, values, scale);
    }

    /// Room for values at the finest cells, row by row.
    pub(crate) fn cells_mut(&mut self) -> &mut [T] {
        self.levels.first_mut().map_or(&mut [], |cells| &mut cells.values)
    }

    /// The row of nodes, and its first column, of a row of the half-space.
    fn place(&self, row: usize, width: usize) -> (usize, usize) {
        (row / self.pieces, row % self.pieces * width)
    }

    fn add_to(&self, support: &Support, values: &mut [f64], scale: f64) {
        let Some(finest) = self.levels.first() else { return };
        let (side, weight) = (self.side, scale * weight::<f64>(self.shape, self.side));
        let mut pieces = support.pieces(values);
        chunks::each(&mut pieces, support.shape()[1], |row, piece| {
            let (y, first) = self.place(row, support.shape()[1]);
            let cells = &finest.values[y / side * finest.shape[1]..];
            let columns = support.runs(row).flat_map(|(run, _)| run);
            let cells = columns.map(|x| cells[(first + x) / side].to_double());
            piece.iter_mut().zip(cells).for_each(|(value, cell)| *value += weight * cell);
        });
    }

    /// Means of `value` over the cells of all sizes, zero off the set.
    fn pool(&mut self, support: &Support, value: impl Fn(usize) -> T + Sync) {
        let (side, by_node, [count, width]) = (self.side, weight::<T>(self.shape, self.side), support.shape());
        let Some(finest) = self.levels.first_mut() else { return };
        // a row of cells lies on some rows of nodes; of a line, cells are taken by the pieces that they lie on
        let (rows, length) = if self.pieces == 1 { (side, finest.shape[1]) } else { (1, width / side) };
        chunks::rows_mut(&mut finest.values, length, |y, cells| {
            cells.fill(T::zero());
            // cells beyond the grid are empty
            for (run, nodes) in (rows * y..count.min(rows * (y + 1))).flat_map(|row| support.runs(row)) {
                run.zip(nodes).for_each(|(x, node)| cells[x / side] = cells[x / side] + by_node * value(node));
            }
        });
        for level in 1..self.levels.len() {
            let (finer, coarser) = self.levels.split_at_mut(level);
            coarser[0].pool(&finer[level - 1]);
        }
    }
}

fn number<T: Real>(value: f32) -> T {
    T::from_double(f64::from(value))
}

/// The weight of a node, or finer cell, in the mean of its cell of `side` along each side.
fn weight<T: Real>(shape: [usize; 2], side: usize) -> T {
    T::from_double(shape.map(|n| if n > 1 { 1.0 / side as f64 } else { 1.0 }).iter().product())
}

/// The two cells of `m` between whose centres the point `i` of `n` lies, periodic, with their weights.
fn around(i: usize, n: usize, m: usize) -> [(usize, f64); 2] {
    let cell = i / 2;
    let neighbour = if i.is_multiple_of(2) { (cell + m - 1) % m } else { (cell + 1) % m };
    if n == 1 { [(0, 1.0), (0, 0.0)] } else { [(cell, NEAR), (neighbour, FAR)] }
}

/// The points of `n` to which the cell `cell` of `m` contributes, with their weights: the transpose of [`around`].
fn points(cell: usize, n: usize, m: usize) -> impl Iterator<Item = (usize, f64)> {
    let before = if cell > 0 { Some(2 * cell - 1) } else { n.is_multiple_of(2).then(|| n - 1) };
    let after = if cell + 1 < m { 2 * cell + 2 } else { 0 };
    let second = (2 * cell + 1 < n).then_some(2 * cell + 1);
    let many = [Some((2 * cell, NEAR)), second.map(|i| (i, NEAR)), before.map(|i| (i, FAR)), Some((after, FAR))];
    let alone = [Some((0, 1.0)), None, None, None];
    (if n == 1 { alone } else { many }).into_iter().flatten()
}

impl<T: Real> Cells<T> {
    /// Sets `a` and `a / w` by the shares `w` of nodes, which are the values.
    fn set_shares(&mut self, share_of: impl Fn(f64) -> f64 + Sync) {
        let Self { share, gain, values, .. } = self;
        for shares in [&mut *share, &mut *gain] {
            *shares = vec![0.0; values.len()];
        }
        let parts = share.chunks_mut(SHARES).zip(gain.chunks_mut(SHARES)).zip(values.chunks(SHARES));
        chunks::spread(parts, |((shares, gains), values)| {
            for ((share, gain), value) in shares.iter_mut().zip(gains).zip(values) {
                let w = value.to_double().min(1.0);
                if w > 0.0 {
                    let of_cell = share_of(w);
                    (*share, *gain) = (of_cell as f32, (of_cell / w) as f32);
                }
            }
        });
    }

    /// Takes the means of finer cells.
    fn pool(&mut self, finer: &Self) {
        let ([height, width], tile, length) = (finer.shape, chunks::tile(self.shape), self.shape[1]);
        let weight = weight::<T>(finer.shape, 2);
        chunks::rows_mut(&mut self.values, tile, |task, cells| {
            cells.fill(T::zero());
            let (y, first) = (task * tile / length, task * tile % length);
            let columns = 2 * first..width.min(2 * (first + cells.len()));
            for y in 2 * y..height.min(2 * y + 2) {
                let pairs = finer.values[y * width..][columns.clone()].chunks(2);
                cells.iter_mut().zip(pairs).for_each(|(cell, pair)| {
                    *cell = pair.iter().fold(*cell, |cell, &finer| cell + weight * finer);
                });
            }
        });
    }

    /// Hands the values interpolated at the points `xs` of row `y` of a finer shape to `put`.
    fn interpolate(&self, [ny, nx]: [usize; 2], y: usize, xs: std::ops::Range<usize>, mut put: impl FnMut(usize, T)) {
        let [my, mx] = self.shape;
        let [(near, by_near), (far, by_far)] = around(y, ny, my).map(|(cell, weight)| (cell, T::from_double(weight)));
        let (near, far) = (&self.values[near * mx..][..mx], &self.values[far * mx..][..mx]);
        let at = |x: usize| by_near * near[x] + by_far * far[x];
        if nx == 1 {
            return put(0, at(0));
        }
        let [by_near, by_far] = [NEAR, FAR].map(T::from_double);
        let mut cell = xs.start / 2;
        let (mut before, mut here) = (at((cell + mx - 1) % mx), at(cell));
        for x in xs.step_by(2) {
            cell = if cell + 1 < mx { cell + 1 } else { 0 };
            let after = at(cell);
            put(x, by_near * here + by_far * before);
            if x + 1 < nx {
                put(x + 1, by_near * here + by_far * after);
            }
            (before, here) = (here, after);
        }
    }

    /// The transpose of [`Cells::interpolate`], of the `value` at row `y` and column `x` of the finer shape.
    fn collect(&mut self, [ny, nx]: [usize; 2], value: impl Fn(usize, usize) -> T + Sync) {
        let [my, mx] = self.shape;
        let tile = chunks::tile(self.shape);
        let [by_near, by_far] = [NEAR, FAR].map(T::from_double);
        chunks::rows_mut(&mut self.values, tile, |task, cells| {
            let (y, first) = (task * tile / mx, task * tile % mx);
            let columns = (2 * first).saturating_sub(1)..nx.min(2 * (first + cells.len()) + 1);
            let mut sums = vec![T::zero(); 2 * cells.len() + 2];
            for (y, weight) in points(y, ny, my).map(|(y, weight)| (y, T::from_double(weight))) {
                let at = columns.start + 1 - 2 * first;
                sums[at..].iter_mut().zip(columns.clone()).for_each(|(sum, x)| *sum = *sum + weight * value(y, x));
                if first == 0 && nx.is_multiple_of(2) {
                    sums[0] = sums[0] + weight * value(y, nx - 1);
                }
                if first + cells.len() == mx {
                    let last = 2 * cells.len() + 1;
                    sums[last] = sums[last] + weight * value(y, 0);
                }
            }
            if nx == 1 {
                cells[0] = sums[1];
                return;
            }
            for (cell, sums) in cells.iter_mut().zip(sums.windows(4).step_by(2)) {
                *cell = by_near * (sums[1] + sums[2]) + by_far * (sums[0] + sums[3]);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Some nodes of a grid in rows of `width`, and numbers on them.
    fn some_nodes([ny, nx]: [usize; 2], width: usize) -> (Support, Vec<f64>) {
        Support::choose_values([ny * nx / width, width], |row, nodes| {
            for x in 0..width {
                let i = row * width + x;
                let noise = ((i * i) as f64 * 0.37).sin();
                if noise > 0.3 {
                    nodes.push(x, noise);
                }
            }
        })
    }

    fn extended(extension: &mut Extension<f64>, support: &Support, values: &[f64]) -> Vec<f64> {
        let [count, width] = support.shape();
        let mut field = vec![0.0; count * width];
        extension.extend(support, |node| values[node]);
        for (row, field) in field.chunks_mut(width).enumerate() {
            extension.fill(row, field);
            support.scatter(row, values, 1.0, field);
        }
        field
    }

    #[test]
    fn restriction_is_the_transpose_of_extension_on_every_shape() {
        for (shape, width) in
            [([1, 64], 64), ([1, 64], 16), ([1, 37], 37), ([8, 8], 8), ([5, 7], 7), ([13, 4], 4), ([4, 27], 27)]
        {
            let (support, values) = some_nodes(shape, width);
            let mut extension = Extension::<f64>::new(&support, [shape; 2], 2, f64::INFINITY);
            let field: Vec<f64> = (0..shape[0] * shape[1]).map(|i| (i as f64 * 1.7).cos()).collect();
            let forward: f64 = extended(&mut extension, &support, &values).iter().zip(&field).map(|(a, b)| a * b).sum();
            let mut back = vec![0.0; values.len()];
            let mut off_set = field.clone();
            for (row, (field, off_set)) in field.chunks(width).zip(off_set.chunks_mut(width)).enumerate() {
                for (run, at) in support.runs(row) {
                    back[at].copy_from_slice(&field[run.clone()]);
                    off_set[run].fill(0.0);
                }
            }
            extension.restrict(&off_set, &support, &mut back, 1.0);
            let backward: f64 = back.iter().zip(&values).map(|(a, b)| a * b).sum();
            assert!((forward - backward).abs() < 1e-12 * forward.abs().max(1.0), "{shape:?}: {forward} and {backward}");
        }
    }

    /// Nothing is known of the field but one number, and of the surroundings of a single node next to nothing.
    #[test]
    fn a_dense_set_extends_constants_and_a_sparse_one_on_a_surface_fades() {
        let (support, values) = Support::choose_values([16, 16], |row, nodes| {
            (0..16).filter(|x| (x + row) % 2 == 0).for_each(|x| nodes.push(x, 1.0));
        });
        let field = extended(&mut Extension::new(&support, [[16, 16]; 2], 2, f64::INFINITY), &support, &values);
        assert!(field.iter().all(|&e| (0.9..=1.0 + 1e-12).contains(&e)));
        let (support, values) = Support::choose_values([16, 16], |row, nodes| {
            if row == 5 {
                nodes.push(6, 1.0);
            }
        });
        let field = extended(&mut Extension::new(&support, [[16, 16]; 2], 2, f64::INFINITY), &support, &values);
        assert!(field[13 * 16 + 14].abs() < 0.2 && field[5 * 16 + 6] == 1.0 && field[5 * 16 + 7] > 0.3);
    }
}
