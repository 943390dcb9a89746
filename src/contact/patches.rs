//! Contact patches: connected sets of nodes in contact.

use petgraph::unionfind::UnionFind;
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
        let rows: Vec<Vec<Range<usize>>> = pressure.chunks_exact(nx).map(runs).collect();
        let first: Vec<usize> = rows
            .iter()
            .scan(0, |count, row| {
                let first = *count;
                *count += row.len();
                Some(first)
            })
            .collect();
        let mut union = UnionFind::new(rows.iter().map(Vec::len).sum());
        for (row, &at) in rows.iter().zip(&first) {
            if let [head, .., tail] = row.as_slice()
                && head.start == 0
                && tail.end == nx
            {
                union.union(at, at + row.len() - 1);
            }
        }
        for y in 0..if ny > 1 { ny } else { 0 } {
            let next = (y + 1) % ny;
            for (a, b) in overlaps(&rows[y], &rows[next]) {
                union.union(first[y] + a, first[next] + b);
            }
        }
        let mut sizes = vec![0; union.len()];
        for (run, nodes) in rows.iter().flatten().map(Range::len).enumerate() {
            sizes[union.find_mut(run)] += nodes;
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

/// Runs of positive values.
fn runs(row: &[f64]) -> Vec<Range<usize>> {
    let mut runs = Vec::new();
    let mut start = None;
    for (i, &p) in row.iter().enumerate() {
        match (p > 0.0, start) {
            (true, None) => start = Some(i),
            (false, Some(s)) => {
                runs.push(s..i);
                start = None;
            }
            _ => {}
        }
    }
    runs.extend(start.map(|s| s..row.len()));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn patches(rows: &[&str]) -> Vec<usize> {
        let field: Vec<f64> = rows.iter().flat_map(|r| r.chars()).map(|c| if c == '#' { 1.0 } else { 0.0 }).collect();
        Patches::of(&field, [rows.len(), rows[0].len()]).sizes().to_vec()
    }

    #[test]
    fn patches_join_across_rows_columns_and_periods() {
        assert_eq!(patches(&["##..#..#"]), [3, 1]);
        assert!(patches(&["........"]).is_empty());
        assert_eq!(patches(&["########"]), [8]);
        assert_eq!(patches(&["#..#", ".##.", "....", "#..#"]), [4, 2]);
        assert_eq!(patches(&["#.#.", "###.", "#.#.", "...."]), [7]);
        assert_eq!(patches(&["#...", ".#..", "..#.", "...#"]), [1, 1, 1, 1]);
    }
}
