//! A part of a map.

use crate::formats::Scan;
use ndarray::{Array2, Slice};
use serde::{Deserialize, Serialize};

/// How far from all measured heights a void node is at least, in nodes along rows or columns, if its void is cropped away: a smooth fill of a
/// narrower one is as good as the heights beside it.
const DEEP: usize = 2;
/// The least share of the measured heights that a crop keeps: with less, the contact would be that of another surface.
const LEAST_KEPT: f64 = 0.25;
/// The fewest rows and columns that a crop leaves, where there are several.
const FEWEST: usize = 16;
/// The most times that voids which the new edge cuts are cropped away in turn.
const CROPS: usize = 4;

/// The rows and columns to keep, counted from 0: `[first, last + 1]` for a profile; for a map, first for the rows and
/// then for the columns.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Crop(pub Vec<usize>);

impl Crop {
    /// First and one beyond last of rows and columns; none for ranges that are empty or beyond the map.
    pub(super) fn ranges(&self, shape: [usize; 2]) -> Option<[[usize; 2]; 2]> {
        let ranges = match *self.0 {
            [first, beyond] if shape[0] == 1 => [[0, 1], [first, beyond]],
            [top, bottom, left, right] => [[top, bottom], [left, right]],
            _ => return None,
        };
        let is_in = |([first, beyond], n): ([usize; 2], usize)| first < beyond && beyond <= n;
        ranges.into_iter().zip(shape).all(is_in).then_some(ranges)
    }

    /// The largest rectangle of rows and columns without the wide voids that reach the edge of the map, and without edge lines that are all
    /// void; none where there are no such voids, or less than a quarter of the measured heights would be left.
    ///
    /// A fill has heights on one side of such a void only, so that it runs on as a smooth shelf at the level of the last heights, and a high one
    /// bears load that no measured height bears.
    pub(in crate::surface) fn to_measured(scan: &Scan) -> Option<Self> {
        let (whole, measured) = (scan.shape().map(|n| [0, n]), scan.height.len() - scan.voids());
        let mut ranges = whole;
        for _ in 0..CROPS {
            let part = Self::from_ranges(ranges).apply(scan)?;
            let inner = largest_rectangle(&edge_voids(&part.height));
            let next = [0, 1].map(|axis| inner[axis].map(|place| ranges[axis][0] + place));
            if next == ranges {
                break;
            }
            ranges = next;
        }
        let is_wide = [0, 1].iter().all(|&axis| ranges[axis][1] - ranges[axis][0] >= FEWEST.min(whole[axis][1]));
        let crop = Self::from_ranges(ranges);
        let kept = crop.apply(scan).map_or(0, |it| it.height.len() - it.voids());
        (ranges != whole && is_wide && kept as f64 >= LEAST_KEPT * measured as f64).then_some(crop)
    }

    /// The crop to ranges of rows and columns; those of a single row are that of a profile.
    fn from_ranges(ranges: [[usize; 2]; 2]) -> Self {
        let [[top, bottom], [left, right]] = ranges;
        Self(if bottom == 1 { vec![left, right] } else { vec![top, bottom, left, right] })
    }

    /// The part that this crop keeps of what another one has left.
    pub(crate) fn after(&self, first: &Self) -> Self {
        let lengths = first.0.len().min(self.0.len());
        Self((0..lengths).map(|i| first.0[i / 2 * 2] + self.0[i]).collect())
    }

    /// The part of the heights.
    pub fn apply(&self, scan: &Scan) -> Option<Scan> {
        let ranges = self.ranges(scan.shape())?;
        let slice = |axis: ndarray::AxisDescription| {
            let [first, beyond] = ranges[axis.axis.index()];
            Slice::from(first..beyond)
        };
        Some(Scan { height: scan.height.slice_each_axis(slice).to_owned(), ..*scan })
    }
}

/// The void nodes that are to be cropped away: those of edge lines that are all void, and of wide voids that reach the edge.
fn edge_voids(height: &Array2<f64>) -> Array2<bool> {
    let is_void = height.mapv(f64::is_nan);
    let mut found = edge_lines(&is_void);
    if !is_void.iter().any(|it| *it) {
        return found;
    }
    let (ny, nx) = is_void.dim();
    let deep = eroded(&is_void);
    let mut visited = Array2::from_elem((ny, nx), false);
    for (start, _) in is_void.indexed_iter().filter(|(_, it)| **it) {
        if visited[start] || !is_at_edge(start, (ny, nx)) {
            continue;
        }
        // all nodes of the void that begins at this node of the edge
        let (mut nodes, mut next) = (vec![start], 0);
        visited[start] = true;
        while next < nodes.len() {
            let (y, x) = nodes[next];
            next += 1;
            for place in [(y.wrapping_sub(1), x), (y + 1, x), (y, x.wrapping_sub(1)), (y, x + 1)] {
                if is_void.get(place) == Some(&true) && !visited[place] {
                    visited[place] = true;
                    nodes.push(place);
                }
            }
        }
        if nodes.iter().any(|node| deep[*node]) {
            nodes.into_iter().for_each(|node| found[node] = true);
        }
    }
    found
}

/// Whether a node is on the edge of a map; that of a profile is its ends.
fn is_at_edge((y, x): (usize, usize), (ny, nx): (usize, usize)) -> bool {
    x == 0 || x + 1 == nx || (ny > 1 && (y == 0 || y + 1 == ny))
}

/// The nodes of lines at the edge of a map that are all marked.
fn edge_lines(is_void: &Array2<bool>) -> Array2<bool> {
    let mut found = Array2::from_elem(is_void.dim(), false);
    for axis in [0, 1].map(ndarray::Axis) {
        let lines = is_void.len_of(axis);
        let is_all = |place: &usize| is_void.index_axis(axis, *place).iter().all(|it| *it);
        let ends = (0..lines).take_while(is_all).chain((0..lines).rev().take_while(is_all));
        ends.for_each(|place| found.index_axis_mut(axis, place).fill(true));
    }
    found
}

/// The marked nodes all of whose neighbours within some rows and columns on the map are marked.
fn eroded(marked: &Array2<bool>) -> Array2<bool> {
    let mut it = marked.clone();
    for axis in [0, 1].map(ndarray::Axis) {
        let before = it.clone();
        for (mut line, old) in it.lanes_mut(axis).into_iter().zip(before.lanes(axis)) {
            for place in 0..old.len() {
                let near = place.saturating_sub(DEEP)..(place + DEEP + 1).min(old.len());
                line[place] = near.into_iter().all(|i| old[i]);
            }
        }
    }
    it
}

/// First and one beyond last row and column of the largest rectangle without marked nodes, by the largest one below the histogram of free
/// nodes above each row, which a stack of rising columns finds in one pass.
fn largest_rectangle(marked: &Array2<bool>) -> [[usize; 2]; 2] {
    let (ny, nx) = marked.dim();
    let (mut best, mut most) = ([[0, ny], [0, nx]], 0);
    let mut free = vec![0usize; nx + 1];
    for y in 0..ny {
        let mut rising: Vec<(usize, usize)> = Vec::new();
        for x in 0..=nx {
            if x < nx {
                free[x] = if marked[[y, x]] { 0 } else { free[x] + 1 };
            }
            let mut first = x;
            while let Some((left, rows)) = rising.pop_if(|(_, rows)| *rows >= free[x]) {
                first = left;
                if rows * (x - left) > most {
                    most = rows * (x - left);
                    best = [[y + 1 - rows, y + 1], [left, x]];
                }
            }
            rising.push((first, free[x]));
        }
    }
    best
}
