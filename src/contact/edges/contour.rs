//! The outline of a contact: segments of a line, the contour of a surface.

use super::STEPS;
use crate::contact::{Edge, Edges};

impl<G: Fn(usize) -> f64 + Sync> Edges<'_, G> {
    /// The segments of contact along a line (of a surface, along its first row), from left to right, as their first and
    /// last position, lengths; a segment across the period ends beyond it, and a segment at a free rim ends half a
    /// spacing beyond its node. A line in full contact is one segment. A segment whose length would be negative is left
    /// out.
    pub fn segments(&self) -> Vec<[f64; 2]> {
        let nx = self.grid.shape()[1];
        let spacing = self.grid.spacing()[1];
        let Some(first_gap) = (0..nx).find(|&node| !self.touches(node)) else {
            return vec![[0.0, nx as f64 * spacing]];
        };
        let mut segments = Vec::new();
        let mut start = f64::NAN;
        if !self.grid.is_periodic() {
            return self.free_segments();
        }
        for step in 1..=nx {
            let (node, position) = ((first_gap + step) % nx, (first_gap + step) as f64);
            for edge in self.around(node).filter(|edge| edge.towards[0] == 0) {
                if edge.towards[1] < 0 {
                    start = position - edge.place;
                }
            }
            for edge in self.around(node).filter(|edge| edge.towards[1] > 0) {
                segments.push([start, position + edge.place].map(|position| position * spacing));
            }
        }
        segments.retain(|[start, end]| end > start);
        segments.iter_mut().filter(|[start, _]| *start >= nx as f64 * spacing).for_each(|ends| {
            ends.iter_mut().for_each(|position| *position -= nx as f64 * spacing);
        });
        segments.sort_by(|a, b| a[0].total_cmp(&b[0]));
        segments
    }

    /// The segments of a line that ends at both rims.
    fn free_segments(&self) -> Vec<[f64; 2]> {
        let (nx, spacing) = (self.grid.shape()[1], self.grid.spacing()[1]);
        let mut segments = Vec::new();
        let mut start = -0.5;
        for node in (0..nx).filter(|&node| self.touches(node)) {
            let edge = |step: isize| self.around(node).find(|edge| edge.towards == [0, step]);
            if let Some(edge) = edge(-1) {
                start = node as f64 - edge.place;
            }
            let end = edge(1).map(|edge| edge.place).or((node + 1 == nx).then_some(0.5));
            segments.extend(end.map(|place| [start, node as f64 + place].map(|position| position * spacing)));
        }
        segments.retain(|[start, end]| end > start);
        segments
    }

    /// The contour of the contact of a surface, as lines within cells of four nodes: positions along y and x of both ends of each, in
    /// nodes from the first one on. Cells across the period are left out.
    pub fn contour(&self) -> Vec<[[f64; 2]; 2]> {
        self.contour_of(&self.all())
    }

    /// The contour of a contact of which [`Edges::all`] are known.
    pub(crate) fn contour_of(&self, all: &[Edge]) -> Vec<[[f64; 2]; 2]> {
        let [ny, nx] = self.grid.shape();
        let row = |y: usize| {
            let [start, end] = [y, y + 1].map(|y| all.partition_point(|edge| edge.node < y * nx));
            &all[start..end]
        };
        let mut lines = Vec::new();
        for y in 0..ny.saturating_sub(1) {
            let both = [row(y), row(y + 1)];
            if both.iter().all(|edges| edges.is_empty()) {
                continue;
            }
            for x in 0..nx - 1 {
                let corners = CORNERS.map(|[dy, dx]| (y + dy) * nx + x + dx);
                let touching = corners.iter().filter(|&&node| self.touches(node)).count();
                if (1..4).contains(&touching) {
                    self.cut(corners, both, &mut lines);
                }
            }
        }
        lines
    }

    /// Adds the lines of a cell, the corners of which are given around it, and the edges by the rows of their nodes: those of its first row, and
    /// those of its second. Where two opposite corners touch, each of them is a contact of its own, as in [`crate::contact::Patches`].
    fn cut(&self, corners: [usize; 4], edges: [&[Edge]; 2], lines: &mut Vec<[[f64; 2]; 2]>) {
        let touches = corners.map(|node| self.touches(node));
        // contact begins at the corner after a gap, and the line runs from there to where it ends
        for from in (0..4).filter(|&i| touches[i] && !touches[(i + 3) % 4]) {
            let Some(to) = (from..from + 4).find(|&i| !touches[(i + 1) % 4]) else { continue };
            // the corners 2 and 3 lie in the second row
            let [begin, end] = [[from, (from + 3) % 4], [to % 4, (to + 1) % 4]]
                .map(|link| self.crossing(link.map(|i| corners[i]), edges[link[0] / 2]));
            lines.extend(begin.zip(end).map(|(begin, end)| [begin, end]));
        }
    }

    /// The place of the edge on the link from a node in contact to a neighbour that is not, kept on the link: one of `edges`, which are those of the row of the node.
    fn crossing(&self, [node, next]: [usize; 2], edges: &[Edge]) -> Option<[f64; 2]> {
        let nx = self.grid.shape()[1];
        let mut links = self.grid.neighbours(node).into_iter().zip(STEPS);
        let (_, towards) = links.find(|(other, _)| *other == next)?;
        let first = edges.partition_point(|edge| edge.node < node);
        let edge = edges[first..].iter().find(|edge| edge.node == node && edge.towards == towards)?;
        let [dy, dx] = edge.towards.map(|step| step as f64 * edge.place.clamp(0.0, 1.0));
        Some([(node / nx) as f64 + dy, (node % nx) as f64 + dx])
    }
}

/// The corners of a cell, around it.
const CORNERS: [[usize; 2]; 4] = [[0, 0], [0, 1], [1, 1], [1, 0]];
