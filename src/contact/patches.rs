//! Contact patches: connected sets of nodes in contact.

use crate::chunks;
use std::ops::Range;

/// The contact patches of a pressure field: sets of nodes with `p > 0` that touch along rows or columns, across the period.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Patches {
    sizes: Vec<usize>,
}

impl Patches {
    /// Finds the patches of `pressure` (row by row) on a grid of `[ny, nx]` nodes.
    ///
    /// Runs of contact along rows are joined with those they overlap in the next row, so the cost beyond one pass is that
    /// of the runs.
    pub fn of(pressure: &[f64], [ny, nx]: [usize; 2]) -> Self {
        let rows: Vec<Vec<Range<usize>>> = chunks::rows(ny, nx, |y| runs(&pressure[y * nx..][..nx]));
        let count_before = |count: &mut usize, row: &Vec<Range<usize>>| {
            *count += row.len();
            Some(*count - row.len())
        };
        let first: Vec<usize> = rows.iter().scan(0, count_before).collect();
        let mut forest = Forest::new(rows.iter().map(Vec::len).sum());
        for (row, &at) in rows.iter().zip(&first) {
            if let [head, .., tail] = row.as_slice()
                && head.start == 0
                && tail.end == nx
            {
                forest.join(at, at + row.len() - 1);
            }
        }
        for y in 0..if ny > 1 { ny } else { 0 } {
            let next = (y + 1) % ny;
            for (a, b) in overlaps(&rows[y], &rows[next]) {
                forest.join(first[y] + a, first[next] + b);
            }
        }
        let mut sizes = vec![0; forest.parent.len()];
        for (run, nodes) in rows.iter().flatten().map(Range::len).enumerate() {
            sizes[forest.root(run)] += nodes;
        }
        sizes.retain(|&nodes| nodes > 0);
        sizes.sort_unstable_by(|a, b| b.cmp(a));
        Self { sizes }
    }

    /// Number of patches.
    pub fn count(&self) -> usize {
        self.sizes.len()
    }

    /// Nodes of each patch, largest first.
    pub fn sizes(&self) -> &[usize] {
        &self.sizes
    }
}

/// Disjoint sets of items, each set a tree whose root stands for it.
struct Forest {
    parent: Vec<usize>,
}

impl Forest {
    fn new(items: usize) -> Self {
        Self { parent: (0..items).collect() }
    }

    /// The root over an item; the path there is halved on the way, so that later searches are short.
    fn root(&mut self, mut item: usize) -> usize {
        while self.parent[item] != item {
            self.parent[item] = self.parent[self.parent[item]];
            item = self.parent[item];
        }
        item
    }

    /// Joins the sets of two items under the earlier root.
    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b)] = a.min(b);
    }
}

/// Runs of positive values.
fn runs(row: &[f64]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for place in chunks::positive(row, 0..row.len()) {
        match runs.last_mut() {
            Some(run) if run.end == place => run.end += 1,
            _ => runs.push(place..place + 1),
        }
    }
    runs
}

/// Pairs of runs that share a column, both lists being in order.
fn overlaps(a: &[Range<usize>], b: &[Range<usize>]) -> Vec<(usize, usize)> {
    let (mut i, mut j) = (0, 0);
    let mut pairs = Vec::new();
    while i < a.len() && j < b.len() {
        if a[i].start < b[j].end && b[j].start < a[i].end {
            pairs.push((i, j));
        }
        if a[i].end < b[j].end { i += 1 } else { j += 1 }
    }
    pairs
}
