//! The extension of vectors from the contact set to all nodes.

use super::support::Support;
use crate::chunks;

/// Cells of a line that one task restricts.
const TILE: usize = 1 << 12;

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
/// Memory: 2 fields of n doubles on lines, two thirds of one on surfaces.
///
/// # Source
/// The pyramid is the pull-push of Gortler, Grzeszczuk, Szeliski & Cohen, "The Lumigraph", SIGGRAPH 1996. Its use here, the
/// blending by capacity and the exact transpose are this crate's own.
pub(super) struct Extension {
    /// Shape of the nodes.
    shape: [usize; 2],
    /// Rows of the half-space in a row of nodes.
    pieces: usize,
    /// From the finest to the single cell.
    levels: Vec<Cells>,
}

/// Cells of one size, each over two of the finer ones along each side that has more than one.
struct Cells {
    shape: [usize; 2],
    /// `a`.
    share: Vec<f32>,
    /// `a / w`, 0 for empty cells.
    gain: Vec<f32>,
    values: Vec<f64>,
}

impl Extension {
    /// The extension from `support` on a grid of `shape` nodes.
    pub fn new(support: &Support, shape: [usize; 2]) -> Self {
        let mut levels = Vec::new();
        let mut finer = shape;
        while finer != [1, 1] {
            finer = finer.map(|n| n.div_ceil(2));
            levels.push(Cells {
                shape: finer,
                share: Vec::new(),
                gain: Vec::new(),
                values: vec![0.0; finer[0] * finer[1]],
            });
        }
        let mut extension = Self { shape, pieces: shape[1] / support.shape()[1], levels };
        extension.pool(support, |_| 1.0);
        let share = if shape[0] == 1 { |w: f64| 1.0 / (1.0 - w.ln()) } else { f64::sqrt };
        for cells in &mut extension.levels {
            let shares =
                || cells.values.iter().map(|&w| if w > 0.0 { (w.min(1.0), share(w.min(1.0))) } else { (1.0, 0.0) });
            cells.share = shares().map(|(_, share)| share as f32).collect();
            cells.gain = shares().map(|(w, share)| (share / w) as f32).collect();
        }
        extension
    }

    /// Prepares [`Extension::fill`] for a vector.
    pub fn extend(&mut self, support: &Support, values: &[f64]) {
        self.pool(support, |node| values[node]);
        let mut coarser: Option<&Cells> = None;
        for cells in self.levels.iter_mut().rev() {
            let Cells { shape, share, gain, values } = cells;
            chunks::rows_mut(values, shape[1], |y, row| {
                let at = y * shape[1];
                row.iter_mut().zip(&gain[at..]).for_each(|(value, gain)| *value *= f64::from(*gain));
                if let Some(coarser) = coarser {
                    let share = &share[at..];
                    coarser
                        .interpolate(*shape, y, 0..shape[1], |x, value| row[x] += (1.0 - f64::from(share[x])) * value);
                }
            });
            coarser = Some(cells);
        }
    }

    /// Writes the extended vector to a row of the half-space; the nodes of the set are left to the caller.
    pub fn fill(&self, row: usize, to: &mut [f64]) {
        let Some(finest) = self.levels.first() else { return };
        let (y, first) = self.place(row, to.len());
        finest.interpolate(self.shape, y, first..first + to.len(), |x, value| to[x - first] = value);
    }

    /// Adds to `values` on the set what the transpose of the extension makes of the `field` off the set; `field` is zero on it.
    pub fn restrict(&mut self, field: &[f64], support: &Support, values: &mut [f64]) {
        let [_, nx] = self.shape;
        let mut shape = self.shape;
        let mut finer: Option<&Cells> = None;
        for cells in &mut self.levels {
            match finer {
                None => cells.collect(shape, |y, x| field[y * nx + x]),
                Some(Cells { share, values, .. }) => {
                    let width = shape[1];
                    cells.collect(shape, |y, x| (1.0 - f64::from(share[y * width + x])) * values[y * width + x]);
                }
            }
            shape = cells.shape;
            finer = Some(cells);
        }
        let mut coarser: Option<&Cells> = None;
        for cells in self.levels.iter_mut().rev() {
            let Cells { shape, gain, values, .. } = cells;
            chunks::rows_mut(values, shape[1], |y, row| {
                row.iter_mut().zip(&gain[y * shape[1]..]).for_each(|(value, gain)| *value *= f64::from(*gain));
                if let Some(coarser) = coarser {
                    let weight = weight(*shape);
                    let above = &coarser.values[y / 2 * coarser.shape[1]..];
                    row.iter_mut().enumerate().for_each(|(x, value)| *value += weight * above[x / 2]);
                }
            });
            coarser = Some(cells);
        }
        self.add_to(support, values);
    }

    /// The row of nodes, and its first column, of a row of the half-space.
    fn place(&self, row: usize, width: usize) -> (usize, usize) {
        (row / self.pieces, row % self.pieces * width)
    }

    fn add_to(&self, support: &Support, values: &mut [f64]) {
        let Some(finest) = self.levels.first() else { return };
        let weight = weight(self.shape);
        let mut pieces = support.pieces(values);
        chunks::each(&mut pieces, support.shape()[1], |row, piece| {
            let (y, first) = self.place(row, support.shape()[1]);
            let cells = &finest.values[y / 2 * finest.shape[1]..];
            let columns = support.runs(row).flat_map(|(run, _)| run);
            piece.iter_mut().zip(columns).for_each(|(value, x)| *value += weight * cells[(first + x) / 2]);
        });
    }

    /// Means of `value` over the cells of all sizes, zero off the set.
    fn pool(&mut self, support: &Support, value: impl Fn(usize) -> f64 + Sync) {
        let ([ny, _], pieces) = (self.shape, self.pieces);
        let mut shape = self.shape;
        let mut finer: Option<&Cells> = None;
        for cells in &mut self.levels {
            let (width, height) = (shape[1], shape[0]);
            let weight = weight(shape);
            let length = cells.shape[1];
            chunks::rows_mut(&mut cells.values, length, |y, row| {
                row.fill(0.0);
                match finer {
                    None => {
                        for piece in 2 * y * pieces..ny.min(2 * y + 2) * pieces {
                            let first = piece % pieces * support.shape()[1];
                            for (run, nodes) in support.runs(piece) {
                                run.zip(nodes).for_each(|(x, node)| row[(first + x) / 2] += weight * value(node));
                            }
                        }
                    }
                    Some(finer) => {
                        for finer in finer.values[2 * y * width..height.min(2 * y + 2) * width].chunks_exact(width) {
                            row.iter_mut()
                                .zip(finer.chunks(2))
                                .for_each(|(cell, pair)| *cell += weight * pair.iter().sum::<f64>());
                        }
                    }
                }
            });
            shape = cells.shape;
            finer = Some(cells);
        }
    }
}

/// The weight of a node, or finer cell, in the mean of its cell.
fn weight(shape: [usize; 2]) -> f64 {
    shape.map(|n| if n > 1 { 0.5 } else { 1.0 }).iter().product()
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

impl Cells {
    /// Hands the values interpolated at the points `xs` of row `y` of a finer shape to `put`.
    fn interpolate(&self, [ny, nx]: [usize; 2], y: usize, xs: std::ops::Range<usize>, mut put: impl FnMut(usize, f64)) {
        let [my, mx] = self.shape;
        let [(near, by_near), (far, by_far)] = around(y, ny, my);
        let (near, far) = (&self.values[near * mx..][..mx], &self.values[far * mx..][..mx]);
        let at = |x: usize| by_near * near[x] + by_far * far[x];
        if nx == 1 {
            return put(0, at(0));
        }
        let mut cell = xs.start / 2;
        let (mut before, mut here) = (at((cell + mx - 1) % mx), at(cell));
        for x in xs.step_by(2) {
            cell = if cell + 1 < mx { cell + 1 } else { 0 };
            let after = at(cell);
            put(x, NEAR * here + FAR * before);
            if x + 1 < nx {
                put(x + 1, NEAR * here + FAR * after);
            }
            (before, here) = (here, after);
        }
    }

    /// The transpose of [`Cells::interpolate`], of the `value` at row `y` and column `x` of the finer shape.
    fn collect(&mut self, [ny, nx]: [usize; 2], value: impl Fn(usize, usize) -> f64 + Sync) {
        let [my, mx] = self.shape;
        let tile = if my == 1 { mx.min(TILE) } else { mx };
        chunks::rows_mut(&mut self.values, tile, |task, cells| {
            let (y, first) = (task * tile / mx, task * tile % mx);
            let columns = (2 * first).saturating_sub(1)..nx.min(2 * (first + cells.len()) + 1);
            let mut sums = vec![0.0; 2 * cells.len() + 2];
            for (y, weight) in points(y, ny, my) {
                let at = columns.start + 1 - 2 * first;
                sums[at..].iter_mut().zip(columns.clone()).for_each(|(sum, x)| *sum += weight * value(y, x));
                if first == 0 && nx.is_multiple_of(2) {
                    sums[0] += weight * value(y, nx - 1);
                }
                if first + cells.len() == mx {
                    sums[2 * cells.len() + 1] += weight * value(y, 0);
                }
            }
            if nx == 1 {
                cells[0] = sums[1];
                return;
            }
            for (cell, sums) in cells.iter_mut().zip(sums.windows(4).step_by(2)) {
                *cell = NEAR * (sums[1] + sums[2]) + FAR * (sums[0] + sums[3]);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Some nodes of a grid in rows of `width`, and numbers on them.
    fn some_nodes([ny, nx]: [usize; 2], width: usize) -> (Support, Vec<f64>) {
        Support::choose([ny * nx / width, width], |row, nodes| {
            for x in 0..width {
                let i = row * width + x;
                let noise = ((i * i) as f64 * 0.37).sin();
                if noise > 0.3 {
                    nodes.push(x, noise);
                }
            }
        })
    }

    fn extended(extension: &mut Extension, support: &Support, values: &[f64]) -> Vec<f64> {
        let [count, width] = support.shape();
        let mut field = vec![0.0; count * width];
        extension.extend(support, values);
        for (row, field) in field.chunks_mut(width).enumerate() {
            extension.fill(row, field);
            support.scatter(row, values, field);
        }
        field
    }

    #[test]
    fn restriction_is_the_transpose_of_extension_on_every_shape() {
        for (shape, width) in
            [([1, 64], 64), ([1, 64], 16), ([1, 37], 37), ([8, 8], 8), ([5, 7], 7), ([13, 4], 4), ([4, 27], 27)]
        {
            let (support, values) = some_nodes(shape, width);
            let mut extension = Extension::new(&support, shape);
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
            extension.restrict(&off_set, &support, &mut back);
            let backward: f64 = back.iter().zip(&values).map(|(a, b)| a * b).sum();
            assert!((forward - backward).abs() < 1e-12 * forward.abs().max(1.0), "{shape:?}: {forward} and {backward}");
        }
    }

    /// Nothing is known of the field but one number, and of the surroundings of a single node next to nothing.
    #[test]
    fn a_dense_set_extends_constants_and_a_sparse_one_on_a_surface_fades() {
        let (support, values) = Support::choose([16, 16], |row, nodes| {
            (0..16).filter(|x| (x + row) % 2 == 0).for_each(|x| nodes.push(x, 1.0));
        });
        let field = extended(&mut Extension::new(&support, [16, 16]), &support, &values);
        assert!(field.iter().all(|&e| (0.9..=1.0 + 1e-12).contains(&e)));
        let (support, values) = Support::choose([16, 16], |row, nodes| {
            if row == 5 {
                nodes.push(6, 1.0);
            }
        });
        let field = extended(&mut Extension::new(&support, [16, 16]), &support, &values);
        assert!(field[13 * 16 + 14].abs() < 0.2 && field[5 * 16 + 6] == 1.0 && field[5 * 16 + 7] > 0.3);
    }
}
