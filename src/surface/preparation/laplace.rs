//! Laplace's equation on the voids of a map, by conjugate gradients with a cycle over ever coarser grids.

/// The residual, over that at the start, at which a solution is done.
const TOLERANCE: f64 = 1e-8;
/// Steps of conjugate gradients at most: a few tens are enough.
const STEPS: usize = 1000;

/// A grid of unknowns, each of which pulls at its neighbours and is pulled by what is known.
struct LaplaceGrid {
    shape: [usize; 2],
    /// The weight of each node and the one below it.
    below: Vec<f64>,
    /// The weight of each node and the one to the right of it.
    right: Vec<f64>,
    /// The weight of each node and what is known around it.
    known: Vec<f64>,
    /// The sum of all weights of a node, zero where nothing is unknown.
    all: Vec<f64>,
}

/// Laplace's equation on the voids of a map, whose rim has no slope across it.
///
/// The cycle that makes a step of conjugate gradients a good one takes four nodes together to one of the next grid, whose weights are half
/// of the sums of theirs as its nodes are twice as far apart.
///
/// # Source
/// D. Braess, Computing 55 (1995) 379, for grids that take nodes together and their weights.
pub(super) struct Laplace {
    levels: Vec<LaplaceGrid>,
    /// What pulls at each node before anything is changed.
    pull: Vec<f64>,
}

impl Laplace {
    /// The equation for the void nodes of heights of some shape, all of which have the same height to begin with; with the weights of
    /// neighbours along y and x.
    pub(crate) fn new(shape: [usize; 2], weights: [f64; 2], height: &[f64], is_void: &[bool]) -> Self {
        let mut fine = LaplaceGrid::empty(shape);
        let mut pull = vec![0.0; height.len()];
        for (stride, weight) in [shape[1], 1].into_iter().zip(weights) {
            for i in 0..height.len().saturating_sub(stride) {
                let j = i + stride;
                match [is_void[i], is_void[j]] {
                    _ if stride == 1 && j.is_multiple_of(shape[1]) => {}
                    [true, true] if stride == shape[1] => fine.below[i] = weight,
                    [true, true] => fine.right[i] = weight,
                    [false, false] => {}
                    [is_first, _] => {
                        let (void, there) = if is_first { (i, j) } else { (j, i) };
                        fine.known[void] += weight;
                        pull[void] += weight * (height[there] - height[void]);
                    }
                }
            }
        }
        let mut levels = vec![fine.summed()];
        while let Some(coarse) = levels.last().filter(|it| it.all.len() > 1).map(LaplaceGrid::coarse) {
            levels.push(coarse);
        }
        Self { levels, pull }
    }

    /// Solves for the voids.
    pub(crate) fn solve(mut self, height: &mut [f64]) {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut z = cycle(&self.levels, &self.pull);
        let (mut along, mut square) = (z.clone(), dot(&self.pull, &z));
        let goal = TOLERANCE.powi(2) * square;
        for _ in 0..STEPS {
            if square.is_nan() || square <= goal {
                break;
            }
            let response = self.levels[0].response(&along);
            let step = square / dot(&along, &response);
            height.iter_mut().zip(&along).for_each(|(height, along)| *height += step * along);
            self.pull.iter_mut().zip(&response).for_each(|(pull, response)| *pull -= step * response);
            z = cycle(&self.levels, &self.pull);
            let before = std::mem::replace(&mut square, dot(&self.pull, &z));
            along.iter_mut().zip(&z).for_each(|(along, z)| *along = z + square / before * *along);
        }
    }
}

impl LaplaceGrid {
    /// A grid of some shape without unknowns.
    fn empty(shape: [usize; 2]) -> Self {
        let [below, right, known, all] = [(); 4].map(|()| vec![0.0; shape[0] * shape[1]]);
        Self { shape, below, right, known, all }
    }

    /// The grid with the sums of its weights.
    fn summed(mut self) -> Self {
        let nx = self.shape[1];
        for i in 0..self.all.len() {
            let above = if i >= nx { self.below[i - nx] } else { 0.0 };
            let left = if i >= 1 { self.right[i - 1] } else { 0.0 };
            self.all[i] = self.known[i] + self.below[i] + self.right[i] + above + left;
        }
        self
    }

    /// All nodes, and those of the next coarser grid to which they belong.
    fn places(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let [ny, nx] = self.shape;
        let width = nx.div_ceil(2);
        (0..ny).flat_map(move |y| (0..nx).map(move |x| y / 2 * width + x / 2)).enumerate()
    }

    /// The next coarser grid, of half as many rows and columns.
    fn coarse(&self) -> Self {
        let nx = self.shape[1];
        let mut coarse = Self::empty(self.shape.map(|n| n.div_ceil(2)));
        for (i, place) in self.places() {
            coarse.known[place] += 0.5 * self.known[i];
            if (i / nx) % 2 == 1 {
                coarse.below[place] += 0.5 * self.below[i];
            }
            if (i % nx) % 2 == 1 {
                coarse.right[place] += 0.5 * self.right[i];
            }
        }
        coarse.summed()
    }

    /// The weighted sum of the neighbours of a node.
    #[inline]
    fn neighbours(&self, field: &[f64], i: usize) -> f64 {
        let nx = self.shape[1];
        let above = if i >= nx { self.below[i - nx] * field[i - nx] } else { 0.0 };
        let below = if i + nx < field.len() { self.below[i] * field[i + nx] } else { 0.0 };
        let left = if i >= 1 { self.right[i - 1] * field[i - 1] } else { 0.0 };
        let right = if i + 1 < field.len() { self.right[i] * field[i + 1] } else { 0.0 };
        above + below + left + right
    }

    /// What the operator makes of a field: each node less its neighbours, by their weights.
    fn response(&self, field: &[f64]) -> Vec<f64> {
        let at = |i: usize| if self.all[i] > 0.0 { self.all[i] * field[i] - self.neighbours(field, i) } else { 0.0 };
        (0..field.len()).map(at).collect()
    }

    /// Brings nodes one after another to where they are pulled.
    fn relax(&self, field: &mut [f64], pull: &[f64], nodes: impl Iterator<Item = usize>) {
        for i in nodes {
            if self.all[i] > 0.0 {
                field[i] = (pull[i] + self.neighbours(field, i)) / self.all[i];
            }
        }
    }
}

/// The field that nearly answers a pull: exactly so on a grid of one node.
fn cycle(levels: &[LaplaceGrid], pull: &[f64]) -> Vec<f64> {
    let mut field = vec![0.0; pull.len()];
    let [level, coarser @ ..] = levels else { return field };
    level.relax(&mut field, pull, 0..pull.len());
    let Some(next) = coarser.first() else { return field };
    let response = level.response(&field);
    let mut rest = vec![0.0; next.all.len()];
    level.places().for_each(|(i, place)| rest[place] += pull[i] - response[i]);
    let correction = cycle(coarser, &rest);
    level.places().filter(|(i, _)| level.all[*i] > 0.0).for_each(|(i, place)| field[i] += correction[place]);
    level.relax(&mut field, pull, (0..pull.len()).rev());
    field
}
