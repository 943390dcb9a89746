//! Links between nodes in contact and neighbours that are not.

use crate::chunks;
use crate::grid::Grid;
use std::ops::Range;

/// Calls `see` with each node of `range` that is in contact (`pressure > 0`), in order, and with the number of its links: its neighbours that are not in
/// contact. It finds runs of contact along rows first, so that it asks for neighbours along rows only at the ends of a run.
pub(crate) fn for_each_in_contact(
    grid: &Grid,
    pressure: &[f64],
    range: Range<usize>,
    mut see: impl FnMut(usize, usize),
) {
    let is_gap = |node: usize| usize::from(pressure[node] <= 0.0);
    for run in chunks::positive_runs(pressure, range) {
        for part in within_rows(run, grid.shape()[1]) {
            let (first, last) = (part.start, part.end - 1);
            // of a line, and at a free rim, a neighbour that is not there is the node itself
            let [_, left, below, above] = grid.neighbours(first);
            let right = grid.neighbours(last)[0];
            for node in part {
                let mut links = 0;
                if !grid.is_line() {
                    links += is_gap(below + node - first) + is_gap(above + node - first);
                }
                if node == first {
                    links += is_gap(left);
                }
                if node == last {
                    links += is_gap(right);
                }
                see(node, links);
            }
        }
    }
}

/// The parts of a run of nodes in rows of `width` nodes.
fn within_rows(run: Range<usize>, width: usize) -> impl Iterator<Item = Range<usize>> {
    let rows = run.start / width..run.end.div_ceil(width);
    rows.map(move |row| run.start.max(row * width)..run.end.min((row + 1) * width))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contact that crosses rims and periods, cut anywhere: each link is found once, at its node.
    #[test]
    fn links_are_those_of_the_neighbours() {
        let grids = [
            Grid::line(40, 1.0).unwrap(),
            Grid::line(40, 1.0).unwrap().with_periodic([false; 2]),
            Grid::surface([5, 8], [1.0, 1.0]).unwrap(),
            Grid::surface([5, 8], [1.0, 1.0]).unwrap().with_periodic([false; 2]),
        ];
        for (grid, pattern) in grids.iter().flat_map(|grid| [7_u32, 3, 40].map(|pattern| (grid, pattern))) {
            let pressure: Vec<f64> = (0..40_u32).map(|i| f64::from(i * i % pattern % 3)).collect();
            for cut in [0, 13, 40] {
                let mut found = Vec::new();
                for part in [0..cut, cut..40] {
                    for_each_in_contact(grid, &pressure, part, |node, links| found.push((node, links)));
                }
                let links = |node: usize| grid.neighbours(node).iter().filter(|&&next| pressure[next] <= 0.0).count();
                let touching = (0..40).filter(|&node| pressure[node] > 0.0);
                assert_eq!(found, touching.map(|node| (node, links(node))).collect::<Vec<_>>(), "{grid:?} {pattern}");
            }
        }
    }
}
