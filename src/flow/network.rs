//! The cells through which something flows, as a network of conductances.

use super::FlowAxis;
use super::balance::Balance;
use crate::chunks;
use crate::forest::Forest;
use crate::grid::Grid;

/// The faces between the nodes of a grid as conductances, each a cell, where cells that are not connected to both sides carry nothing.
///
/// Faces have numbers: first those between each cell and the next one along `y`, then along `x`, then those from the inlet to the cells of
/// the first side and from the cells of the last side to the outlet. After the last cell of a row or column comes the first one.
pub(super) struct Network {
    /// Rows and columns.
    shape: [usize; 2],
    /// The axis of the flow.
    along: FlowAxis,
    /// The flow through each face per difference of the pressures of its ends. It is zero where there is no face.
    conductance: Vec<f64>,
    /// One over the sum of the conductances of each cell; zero for cells that carry nothing.
    inverse: Vec<f64>,
}

impl Network {
    /// The network of cells with the conductivities `k >= 0`, for flow along an axis on a grid that is cut open there.
    ///
    /// The conductance of a face is the harmonic mean of the conductivities of its cells, times its width and over the distance of
    /// the cells. A side lies half a spacing from the first or last cells.
    pub(crate) fn new(grid: &Grid, along: FlowAxis, mut conductivity: Vec<f64>) -> Self {
        leave_connected(grid, along, &mut conductivity);
        let spacing = grid.spacing();
        let ratio = spacing[1 - along.index()] / spacing[along.index()];
        let cells = grid.len();
        let mut network = Self { shape: grid.shape(), along, conductance: Vec::new(), inverse: Vec::new() };
        let faces = 2 * (cells + network.cells_of_side());
        let conductance = |face: usize| match network.ends(face) {
            [from, to] if from < cells && to < cells => {
                let stretch = if network.axis(face) == along { ratio } else { 1.0 / ratio };
                let is_there = from < to || from > to && grid.periodic()[network.axis(face).index()];
                if is_there { stretch * harmonic_mean(conductivity[from], conductivity[to]) } else { 0.0 }
            }
            [from, to] => 2.0 * ratio * conductivity[from.min(to)],
        };
        network.conductance = (0..faces).map(conductance).collect();
        let mut sums = chunks::touched(cells + 2);
        for (face, conductance) in network.conductance.iter().enumerate() {
            network.ends(face).into_iter().for_each(|end| sums[end] += conductance);
        }
        network.inverse = sums[..cells].iter().map(|sum| if *sum > 0.0 { 1.0 / sum } else { 0.0 }).collect();
        network
    }

    /// Whether nothing flows.
    pub(crate) fn is_sealed(&self) -> bool {
        !(0..self.cells()).any(|cell| self.carries(cell))
    }

    /// The number of faces, also of those without a conductance.
    pub(crate) fn faces(&self) -> usize {
        self.conductance.len()
    }

    /// Whether anything flows through a cell.
    pub(crate) fn carries(&self, cell: usize) -> bool {
        self.inverse[cell] > 0.0
    }

    /// The conductance of a face.
    pub(crate) fn conductance(&self, face: usize) -> f64 {
        self.conductance[face]
    }

    /// The axis along which a face is passed.
    pub(crate) fn axis(&self, face: usize) -> FlowAxis {
        match face / self.cells() {
            0 => FlowAxis::Y,
            1 => FlowAxis::X,
            _ => self.along,
        }
    }

    /// The cells before and behind a face. After the last cell come the inlet and the outlet.
    pub(crate) fn ends(&self, face: usize) -> [usize; 2] {
        let ([ny, nx], cells) = (self.shape, self.cells());
        if face < cells {
            return [face, if face + nx < cells { face + nx } else { face + nx - cells }];
        }
        if face < 2 * cells {
            let (cell, next) = (face - cells, face - cells + 1);
            return [cell, if next.is_multiple_of(nx) { next - nx } else { next }];
        }
        let (stride, last) = match self.along {
            FlowAxis::X => (nx, nx - 1),
            FlowAxis::Y => (1, (ny - 1) * nx),
        };
        match (face - 2 * cells).checked_sub(self.cells_of_side()) {
            None => [cells, (face - 2 * cells) * stride],
            Some(place) => [last + place * stride, cells + 1],
        }
    }

    /// The number of cells at the inlet, which is that at the outlet.
    fn cells_of_side(&self) -> usize {
        self.shape[1 - self.along.index()]
    }

    /// The pressure of each cell if it falls linearly, from 1 at the inlet to 0 at the outlet.
    pub(crate) fn linear(&self) -> Vec<f64> {
        let points = self.shape[self.along.index()];
        let pressures: Vec<f64> = (0..points).map(|place| 1.0 - (place as f64 + 0.5) / points as f64).collect();
        let place = |cell| [cell / self.shape[1], cell % self.shape[1]][self.along.index()];
        (0..self.cells()).map(|cell| pressures[place(cell)]).collect()
    }

    /// The flow through each face from its first end to the second one.
    pub(crate) fn flux(&self, pressure: &[f64]) -> Vec<f64> {
        let at = |end: usize| match end.checked_sub(self.cells()) {
            None => pressure[end],
            Some(0) => 1.0,
            Some(_) => 0.0,
        };
        let flux = |(face, conductance): (usize, &f64)| {
            let [from, to] = self.ends(face);
            conductance * (at(from) - at(to))
        };
        self.conductance.iter().enumerate().map(flux).collect()
    }

    /// Inflow less outflow of each cell.
    pub(crate) fn surplus(&self, flux: &[f64]) -> Vec<f64> {
        let mut surplus = chunks::touched(self.cells() + 2);
        for (face, flux) in flux.iter().enumerate() {
            let [from, to] = self.ends(face);
            surplus[from] -= flux;
            surplus[to] += flux;
        }
        surplus.truncate(self.cells());
        surplus
    }

    /// The power that a flow dissipates.
    pub(crate) fn power(&self, flux: &[f64]) -> f64 {
        let power =
            |(conductance, flux): (&f64, &f64)| if *conductance > 0.0 { flux * flux / conductance } else { 0.0 };
        self.conductance.iter().zip(flux).map(power).sum()
    }

    /// What flows in at the inlet.
    pub(crate) fn inflow(&self, flux: &[f64]) -> f64 {
        flux[2 * self.cells()..][..self.cells_of_side()].iter().sum()
    }

    /// A row of one value for each cell.
    fn row<'v>(&self, values: &'v [f64], row: usize) -> &'v [f64] {
        &values[row * self.shape[1]..][..self.shape[1]]
    }

    /// The rows above and below a row, each with the conductances of the faces to it; a row that is its own neighbour has none.
    fn rows_beside(&self, row: usize) -> impl Iterator<Item = (usize, &[f64])> {
        let ny = self.shape[0];
        let above = (row + ny - 1) % ny;
        let beside =
            [(above, above), ((row + 1) % ny, row)].map(|(other, faces)| (other, self.row(&self.conductance, faces)));
        beside.into_iter().filter(move |(other, _)| *other != row)
    }

    /// The conductances of the faces between each cell of a row and the next one; the last one leads to the first cell.
    fn along_row(&self, row: usize) -> &[f64] {
        self.row(&self.conductance[self.cells()..], row)
    }
}

impl Balance for Network {
    fn cells(&self) -> usize {
        self.shape[0] * self.shape[1]
    }

    fn to_sides(&self, cell: usize) -> f64 {
        let [nx, along] = [self.shape[1], self.along.index()];
        let place = [cell / nx, cell % nx];
        let across = place[1 - along];
        let at = |side: usize| self.conductance[2 * self.cells() + side * self.cells_of_side() + across];
        let is_at = [place[along] == 0, place[along] + 1 == self.shape[along]];
        (0..2).filter(|&side| is_at[side]).map(at).sum()
    }

    fn links(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> + Clone {
        let ([_, nx], cells) = (self.shape, self.cells());
        let left = if cell.is_multiple_of(nx) { cell + nx - 1 } else { cell - 1 };
        let above = if cell < nx { cell + cells - nx } else { cell - nx };
        let [below, right] = [self.ends(cell)[1], self.ends(cells + cell)[1]];
        let links = [(above, above), (left, cells + left), (right, cells + cell), (below, cell)];
        links.map(|(other, face)| (other, self.conductance[face])).into_iter().filter(|link| link.1 > 0.0)
    }

    fn apply(&self, x: &[f64], product: &mut [f64]) {
        let nx = self.shape[1];
        chunks::rows_mut(product, nx, |row, product| {
            let (here, next) = (self.row(x, row), self.along_row(row));
            product.fill(0.0);
            for (other, faces) in self.rows_beside(row) {
                add_flows(product, faces, here, self.row(x, other));
            }
            add_flows(product, next, here, &here[1..]);
            add_flows(&mut product[1..], next, &here[1..], here);
            let wrapped = wrapped(next) * (here[0] - here[nx - 1]);
            product[0] += wrapped;
            product[nx - 1] -= wrapped;
        });
        for face in 2 * self.cells()..self.faces() {
            let [from, to] = self.ends(face);
            product[from.min(to)] += self.conductance[face] * x[from.min(to)];
        }
    }

    fn sweep_from_zero(&self, b: &[f64], x: &mut [f64]) {
        let [ny, nx] = self.shape;
        for row in 0..ny {
            let (above, here) = x.split_at_mut(row * nx);
            let (here, next, inverse) = (&mut here[..nx], self.along_row(row), self.row(&self.inverse, row));
            here.copy_from_slice(self.row(b, row));
            for (other, faces) in self.rows_beside(row).filter(|beside| beside.0 < row) {
                add_products(here, faces, self.row(above, other));
            }
            let mut last = here[0] * inverse[0];
            here[0] = last;
            here[nx - 1] += wrapped(next) * last;
            for ((x, inverse), c) in here[1..].iter_mut().zip(&inverse[1..]).zip(next) {
                last = *x * inverse + (c * inverse) * last;
                *x = last;
            }
        }
    }

    fn add_rest_of_sweep(&self, x: &[f64], groups: &[u32], sums: &mut [f64]) {
        let [ny, nx] = self.shape;
        let mut rest = vec![0.0; nx];
        for row in 0..ny {
            let (here, next) = (self.row(x, row), self.along_row(row));
            rest.fill(0.0);
            add_products(&mut rest, next, &here[1..]);
            rest[0] += wrapped(next) * here[nx - 1];
            for (other, faces) in self.rows_beside(row).filter(|beside| beside.0 > row) {
                add_products(&mut rest, faces, self.row(x, other));
            }
            rest.iter().zip(&groups[row * nx..]).for_each(|(rest, &group)| sums[group as usize] += rest);
        }
    }

    fn sweep_back(&self, b: &[f64], x: &mut [f64]) {
        let [ny, nx] = self.shape;
        let mut sums = vec![0.0; nx];
        for row in (0..ny).rev() {
            let (here, next, inverse) = (self.row(x, row), self.along_row(row), self.row(&self.inverse, row));
            sums.copy_from_slice(self.row(b, row));
            for (other, faces) in self.rows_beside(row) {
                add_products(&mut sums, faces, self.row(x, other));
            }
            add_products(&mut sums[1..], next, here);
            sums[nx - 1] += wrapped(next) * here[0];
            let mut last = sums[nx - 1] * inverse[nx - 1];
            sums[0] += wrapped(next) * last;
            let here = &mut x[row * nx..][..nx];
            here[nx - 1] = last;
            for (((x, sum), inverse), c) in here.iter_mut().zip(&sums).zip(inverse).zip(next).rev().skip(1) {
                last = sum * inverse + (c * inverse) * last;
                *x = last;
            }
        }
    }
}

/// Adds `c x` to each sum, as far as there are factors.
fn add_products(sums: &mut [f64], c: &[f64], x: &[f64]) {
    sums.iter_mut().zip(c).zip(x).for_each(|((sum, c), x)| *sum += c * x);
}

/// Adds `c (x - y)` to each sum, as far as there are factors.
fn add_flows(sums: &mut [f64], c: &[f64], x: &[f64], y: &[f64]) {
    sums.iter_mut().zip(c).zip(x.iter().zip(y)).for_each(|((sum, c), (x, y))| *sum += c * (x - y));
}

/// The conductance of the face between the last cell of a row and the first one.
fn wrapped(next: &[f64]) -> f64 {
    next[next.len() - 1]
}

/// The mean `2 / (1/a + 1/b)` of values that are not negative, also where they are tiny.
fn harmonic_mean(a: f64, b: f64) -> f64 {
    let (small, large) = (a.min(b), a.max(b));
    if small > 0.0 { 2.0 * small / (1.0 + small / large) } else { 0.0 }
}

/// Leaves a conductivity to cells only that are connected to both sides.
fn leave_connected(grid: &Grid, along: FlowAxis, conductivity: &mut [f64]) {
    let mut forest = Forest::new(grid.len());
    let conducts = |node: usize| conductivity[node] > 0.0;
    for node in (0..grid.len()).filter(|&node| conducts(node)) {
        let [next, _, below, _] = grid.neighbours(node);
        [next, below].into_iter().filter(|&other| conducts(other)).for_each(|other| _ = forest.join(node, other));
    }
    let mut reaches = vec![[false; 2]; grid.len()];
    for node in (0..grid.len()).filter(|&node| conducts(node)) {
        let (root, sides) = (forest.root(node), along.sides(grid, node));
        (0..2).for_each(|side| reaches[root][side] |= sides[side]);
    }
    for (node, conductivity) in conductivity.iter_mut().enumerate() {
        if reaches[forest.root(node)] != [true; 2] {
            *conductivity = 0.0;
        }
    }
}
