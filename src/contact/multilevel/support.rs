//! Vectors that live on the contact set.

use crate::chunks;
use crate::contact::{Ceiling, Problem, feasible};
use crate::fourier::Real;
use std::ops::Range;

/// A set of nodes, as runs along the rows in which a half-space takes its fields. Values on it are vectors with one entry per
/// node, in the order of the nodes.
#[derive(Clone, PartialEq)]
pub(in crate::contact) struct Support {
    /// Length of a row.
    width: usize,
    /// Runs of nodes, by their columns.
    runs: Vec<Range<usize>>,
    /// The first run and the first node of each row, and those beyond the last row.
    rows: Vec<RowStart>,
}

#[derive(Clone, Copy, PartialEq)]
struct RowStart {
    run: usize,
    node: usize,
}

/// The nodes of one row, put in from left to right.
#[derive(Default)]
pub(in crate::contact) struct RowOfNodes {
    runs: Vec<Range<usize>>,
    nodes: usize,
}

impl RowOfNodes {
    /// Adds a node.
    pub(crate) fn push(&mut self, column: usize) {
        match self.runs.last_mut() {
            Some(run) if run.end == column => run.end += 1,
            _ => self.runs.push(column..column + 1),
        }
        self.nodes += 1;
    }
}

/// The nodes of one row with their values, put in from left to right.
#[derive(Default)]
pub(in crate::contact) struct RowOfValues {
    nodes: RowOfNodes,
    values: Vec<f64>,
}

impl RowOfValues {
    /// Adds a node.
    pub(crate) fn push(&mut self, column: usize, value: f64) {
        self.nodes.push(column);
        self.values.push(value);
    }
}

impl Support {
    /// The nodes that `choose` puts into each of `count` rows of `width` nodes.
    pub(crate) fn choose([count, width]: [usize; 2], choose: impl Fn(usize, &mut RowOfNodes) + Sync) -> Self {
        let rows = chunks::rows(count, width, |row| {
            let mut nodes = RowOfNodes::default();
            choose(row, &mut nodes);
            nodes
        });
        Self::of_rows(width, rows)
    }

    /// The nodes that `choose` puts into each of `count` rows of `width` nodes, and their values.
    pub(crate) fn choose_values(
        [count, width]: [usize; 2],
        choose: impl Fn(usize, &mut RowOfValues) + Sync,
    ) -> (Self, Vec<f64>) {
        let rows = chunks::rows(count, width, |row| {
            let mut row_of_values = RowOfValues::default();
            choose(row, &mut row_of_values);
            row_of_values
        });
        let (rows, values): (Vec<_>, Vec<_>) = rows.into_iter().map(|row| (row.nodes, row.values)).unzip();
        (Self::of_rows(width, rows), values.concat())
    }

    fn of_rows(width: usize, rows: Vec<RowOfNodes>) -> Self {
        let runs = Vec::with_capacity(rows.iter().map(|row| row.runs.len()).sum());
        let mut support = Self { width, runs, rows: Vec::with_capacity(rows.len() + 1) };
        let mut node = 0;
        for row in rows {
            support.rows.push(RowStart { run: support.runs.len(), node });
            support.runs.extend(row.runs);
            node += row.nodes;
        }
        support.rows.push(RowStart { run: support.runs.len(), node });
        support
    }

    /// The first node.
    pub(crate) fn first(&self) -> Option<usize> {
        let row = self.rows.iter().rposition(|start| start.node == 0)?;
        self.runs.first().map(|run| row * self.width + run.start)
    }

    /// Number of nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.rows.last().map_or(0, |end| end.node)
    }

    /// Number of rows and their length.
    pub(crate) fn shape(&self) -> [usize; 2] {
        [self.rows.len() - 1, self.width]
    }

    /// The runs of a row, each with the range of its values.
    pub(crate) fn runs(&self, row: usize) -> impl Iterator<Item = (Range<usize>, Range<usize>)> {
        let [start, end] = [self.rows[row], self.rows[row + 1]];
        self.runs[start.run..end.run].iter().scan(start.node, |node, run| {
            let values = *node..*node + run.len();
            *node = values.end;
            Some((run.clone(), values))
        })
    }

    /// Writes `values` times `scale` to the nodes of a row and leaves the others.
    pub(crate) fn scatter<T: Real>(&self, row: usize, values: &[f64], scale: f64, to: &mut [T]) {
        for (run, at) in self.runs(row) {
            to[run].iter_mut().zip(&values[at]).for_each(|(to, value)| *to = T::from_double(scale * value));
        }
    }

    /// Takes the values of a row at its nodes, times `scale`, to the piece of a vector, see [`Support::pieces`].
    pub(crate) fn gather<T: Real>(&self, row: usize, from: &[T], scale: f64, piece: &mut [f64]) {
        let first = self.rows[row].node;
        for (run, at) in self.runs(row) {
            let to = &mut piece[at.start - first..at.end - first];
            to.iter_mut().zip(&from[run]).for_each(|(to, from)| *to = scale * from.to_double());
        }
    }

    /// The values of a field on the set.
    pub(crate) fn of_field(&self, field: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; self.nodes()];
        chunks::each(&mut self.pieces(&mut values), self.width, |row, piece| {
            self.gather(row, &field[row * self.width..][..self.width], 1.0, piece);
        });
        values
    }

    /// The ceilings of the nodes of the set, in their order.
    pub(crate) fn ceiling(&self, ceiling: &Ceiling) -> Ceiling {
        ceiling.chosen(|field| self.of_field(field))
    }

    /// The nodes that `keep` keeps of this set, by their places in its vectors.
    pub(crate) fn filter(&self, keep: impl Fn(usize) -> bool + Sync) -> Self {
        let choose = |row: usize, nodes: &mut RowOfNodes| {
            for (run, at) in self.runs(row) {
                run.zip(at).filter(|(_, node)| keep(*node)).for_each(|(x, _)| nodes.push(x));
            }
        };
        Self::choose(self.shape(), choose)
    }

    /// The values of this set at the nodes of another one, zero where this set has none, written to `result`.
    pub(crate) fn transfer(&self, values: &[f64], to: &Self, result: &mut [f64]) {
        chunks::each(&mut to.pieces(result), self.width, |row, piece| {
            piece.fill(0.0);
            let first = to.rows[row].node;
            let mut sources = self.runs(row).peekable();
            for (run, at) in to.runs(row) {
                while sources.next_if(|(source, _)| source.end <= run.start).is_some() {}
                while let Some((source, node)) = sources.peek() {
                    let (start, end) = (source.start.max(run.start), source.end.min(run.end));
                    if start < end {
                        let to = &mut piece[at.start - first + start - run.start..][..end - start];
                        to.copy_from_slice(&values[node.start + start - source.start..][..end - start]);
                    }
                    if source.end > run.end || start >= end {
                        break;
                    }
                    sources.next();
                }
            }
        });
    }

    /// A vector, row by row.
    pub(crate) fn pieces<'v>(&self, values: &'v mut [f64]) -> Vec<&'v mut [f64]> {
        let mut rest = values;
        let lengths = self.rows.windows(2).map(|pair| pair[1].node - pair[0].node);
        lengths.map(|length| rest.split_off_mut(..length).expect("one value per node")).collect()
    }

    /// A vector, with zeros where no nodes are.
    pub(crate) fn spread(&self, values: &[f64]) -> Vec<f64> {
        let [count, width] = self.shape();
        let mut field = vec![0.0; count * width];
        chunks::rows_mut(&mut field, width, |row, field| self.scatter(row, values, 1.0, field));
        field
    }
}

/// A pressure and its support.
#[derive(Clone, PartialEq)]
pub(in crate::contact) struct SparsePressure {
    pub support: Support,
    pub values: Vec<f64>,
}

impl SparsePressure {
    /// The pressure of a whole field.
    pub(crate) fn from_field(field: &[f64], rows: [usize; 2]) -> Self {
        let (support, values) = Support::choose_values(rows, |row, nodes| {
            let pressures = field[row * rows[1]..][..rows[1]].iter().enumerate();
            pressures.filter(|(_, p)| **p > 0.0).for_each(|(column, &p)| nodes.push(column, p));
        });
        Self { support, values }
    }

    /// The pressure to start from without a better one: the uniform one, or the same share of the ceiling of each node; at a given
    /// mean gap, none.
    pub(crate) fn first(problem: &Problem, [count, width]: [usize; 2]) -> Self {
        let (mean_pressure, ceiling) = (problem.mean_pressure(), problem.ceiling());
        let highest = ceiling.mean(problem.nodes());
        let of_node = |node: usize, mean: f64| match ceiling {
            Ceiling::Uniform(_) => mean,
            Ceiling::Field(ceilings) => mean / highest * ceilings[node],
        };
        let (support, values) = Support::choose_values([count, width], |row, nodes| {
            let Some(mean) = mean_pressure else { return };
            let of_column = |column: usize| (column, of_node(row * width + column, mean));
            (0..width).map(of_column).filter(|(_, p)| *p > 0.0).for_each(|(column, p)| nodes.push(column, p));
        });
        Self { support, values }
    }

    /// The whole field.
    pub(crate) fn spread(&self) -> Vec<f64> {
        self.support.spread(&self.values)
    }

    /// Whether a node has reached the `ceiling` of the field.
    pub(crate) fn reaches(&self, ceiling: &Ceiling) -> bool {
        ceiling.is_finite() && self.reaches_on_set(&self.support.ceiling(ceiling))
    }

    /// Whether a node has reached the `ceiling` of the set.
    pub(crate) fn reaches_on_set(&self, ceiling: &Ceiling) -> bool {
        ceiling.is_finite() && self.values.iter().enumerate().any(|(i, &p)| p >= ceiling.at(i))
    }

    /// Scales it to the mean pressure of `problem`, if that is given, and cuts it at the ceiling if there is one.
    pub(crate) fn carry(&mut self, problem: &Problem) {
        if problem.ceiling().is_finite() {
            return self.carry_below(problem);
        }
        let Some(mean_pressure) = problem.mean_pressure() else { return };
        let scale = mean_pressure * problem.nodes() as f64 / chunks::sum(self.values.len(), |i| self.values[i]);
        chunks::update(&mut self.values, |_, p| p.iter_mut().for_each(|p| *p *= scale));
    }

    /// Makes it carry the load of `problem` below a ceiling, on all nodes if its own cannot.
    fn carry_below(&mut self, problem: &Problem) {
        let ceiling = self.support.ceiling(problem.ceiling());
        let Some(mean_pressure) = problem.mean_pressure() else {
            let values = &mut self.values;
            chunks::update(values, |range, p| range.zip(p).for_each(|(i, p)| *p = p.min(ceiling.at(i))));
            return;
        };
        let load = mean_pressure * problem.nodes() as f64;
        if ceiling.total(self.values.len()) >= load {
            feasible::carry(&mut self.values, load, &ceiling);
            return;
        }
        let mut field = self.spread();
        feasible::carry(&mut field, load, problem.ceiling());
        *self = Self::from_field(&field, self.support.shape());
    }

    /// The nodes that are free, whose pressure is below the `ceiling` of the set; none if all of them are.
    pub(crate) fn free(&self, ceiling: &Ceiling) -> Option<Support> {
        if !self.reaches_on_set(ceiling) {
            return None;
        }
        Some(self.support.filter(|i| self.values[i] < ceiling.at(i)))
    }
}

/// The values below the `ceiling` of the set with `delta` added, one entry for each; the others as they are.
pub(super) fn corrected(values: &[f64], delta: &[f64], ceiling: &Ceiling) -> Vec<f64> {
    let mut delta = delta.iter();
    let mut next = |i: usize, p: f64| if p < ceiling.at(i) { delta.next().map_or(p, |delta| p + delta) } else { p };
    values.iter().enumerate().map(|(i, &p)| next(i, p)).collect()
}

impl From<SparsePressure> for Vec<f64> {
    fn from(pressure: SparsePressure) -> Self {
        pressure.spread()
    }
}
