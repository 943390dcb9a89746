//! Plateaus: nodes of the same height as their neighbours.

use super::Surface;
use super::plateau::Plateaus;
use std::sync::Arc;

impl Surface {
    /// Whether a node, counted row by row, lies on a plateau: along each axis, one of its neighbours is exactly as
    /// high. Heights that are rounded to few values, and peaks that are worn or clipped, have such nodes; smooth and
    /// rough ones have none. The two highest nodes of a symmetric crest do not count as a plateau, nor does the face of
    /// a punch, whose shape between the nodes is known. Heights that were interpolated on a finer grid keep the
    /// plateaus that they had before. The function panics where there is no node.
    ///
    /// ```
    /// use asperity::Surface;
    /// let surface = Surface::line(ndarray::arr1(&[0.0, 1.0, 2.0, 2.0, 2.0, 1.0, 3.0, 4.0, 4.0, 3.0]).view(), 1.0)?;
    /// let is_level = surface.is_level();
    /// assert_eq!((0..10).filter(|&node| is_level(node)).collect::<Vec<_>>(), [2, 3, 4]);
    /// # Ok::<(), asperity::error::SurfaceError>(())
    /// ```
    pub fn is_level(&self) -> impl Fn(usize) -> bool + Sync {
        let (h, grid) = (self.heights(), &self.grid);
        let axes: &[[isize; 2]] = if grid.is_line() { &[[0, 1]] } else { &[[0, 1], [1, 0]] };
        // as high as the next node, and not the two highest or lowest ones of a symmetric crest
        let is_tied = move |node: usize, [dy, dx]: [isize; 2]| {
            let [before, next, after] = [-1, 1, 2].map(|steps| grid.neighbour(node, [steps * dy, steps * dx]));
            next != node && h[next] == h[node] && !(h[before] == h[after] && h[before] != h[node])
        };
        move |node| match &self.plateaus {
            Some(plateaus) => plateaus.has(grid, node),
            None if !grid.neighbours(node).iter().any(|&next| next != node && h[next] == h[node]) => false,
            None => axes.iter().all(|&[dy, dx]| is_tied(node, [dy, dx]) || is_tied(node, [-dy, -dx])),
        }
    }

    /// The plateaus to keep when the heights are interpolated on a grid that is `factor` times finer; none if there are
    /// no plateaus.
    pub(super) fn plateaus_on(&self, factor: usize) -> Option<Plateaus> {
        if let Some(earlier) = &self.plateaus {
            return Some(Plateaus { factor: earlier.factor * factor, ..earlier.clone() });
        }
        let nodes: Arc<[bool]> = (0..self.grid.len()).map(self.is_level()).collect();
        nodes.contains(&true).then(|| Plateaus { shape: self.grid.shape(), factor, nodes })
    }
}
