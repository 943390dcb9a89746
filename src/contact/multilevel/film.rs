//! The long waves of a thin bonded layer, on a contact set.
//!
//! The compliance of a layer on a rigid base is `c0 + c2 q^2` for waves that are long compared with its thickness `t`. Where the layer
//! can hardly be compressed, `c0` is small, and the pressure under a patch is that of a membrane, `c0 p - c2 lap p = u` with `p = 0`
//! beyond the rim. No extension of `u` off the patches tells its solution. So the stiffness is split into two in parallel,
//!
//! `K = K_s + K_l`, `K_l(q) = 1 / (c0 + c2 q^2)`, `K_s = max(K - K_l, 0)`,
//!
//! and the preconditioner is `E' (K_s + (c0 - c2 lap_F)^-1) E`, with the Laplacian `lap_F` on the film `F` that is zero at the nodes
//! around it. What is shorter than `t` belongs to `K_s`. So the film is the contact set with its gaps up to `t`, and the extension `E` over
//! these gaps has no cells larger than `t / 2`. With larger or smaller ones conjugate gradients need more steps.
//!
//! # Source
//! The membrane: Johnson, *Contact Mechanics* (1985), section 5.8. The inverse of a sum of compliances on a set is at most the parallel
//! sum of their inverses on the set: Anderson & Duffin, J. Math. Anal. Appl. 26, 576 (1969). Its use as a preconditioner is this
//! crate's own.

use super::membrane::Membrane;
use super::support::Support;
use crate::contact::Problem;
use crate::elastic::LongWaves;
use crate::fourier::Real;
use std::ops::Range;

/// Layers thinner than this part of the cell are films.
const THINNEST: f64 = 0.03;

/// The film under a contact set.
pub(super) struct Film<T> {
    waves: LongWaves,
    /// `unit c0`, and `unit c2 / dy^2` and `unit c2 / dx^2`, with the unit of stiffness of the operator.
    foundation: f64,
    links: [f64; 2],
    /// The thickness in nodes along each axis.
    range: [f64; 2],
    shape: [usize; 2],
    place: FilmPlace<T>,
}

/// Where a film lies.
enum FilmPlace<T> {
    Nowhere,
    Line(FilmSegments<T>),
    Surface(Membrane<T>),
}

impl<T: Real> Film<T> {
    /// The film of a problem, if its solid is thin on a periodic grid.
    pub(crate) fn new(problem: &Problem, unit: f64) -> Option<Self> {
        let grid = problem.surface().grid();
        let waves = problem.compliance().solid().long_waves()?;
        let is_thin = waves.thickness < THINNEST * grid.longest_wavelength();
        let spacing = grid.spacing();
        (is_thin && grid.is_periodic()).then(|| Self {
            waves,
            foundation: unit * waves.longest,
            links: spacing.map(|spacing| unit * waves.square / (spacing * spacing)),
            range: spacing.map(|spacing| waves.thickness / spacing),
            shape: grid.shape(),
            place: FilmPlace::Nowhere,
        })
    }

    /// `K_l` of a wave.
    pub(crate) fn stiffness(&self, q: f64) -> f64 {
        self.waves.stiffness(q)
    }

    /// The nodes along each side of the largest cells of the extension.
    pub(crate) fn largest_cell(&self) -> f64 {
        0.5 * if self.shape[0] == 1 { self.range[1] } else { self.range[0].min(self.range[1]) }
    }

    /// Lies under a set.
    pub(crate) fn prepare(&mut self, support: &Support) {
        // the memory of an earlier one is free for this one
        self.place = FilmPlace::Nowhere;
        let gaps = self.range.map(|range| range as usize);
        self.place = if self.shape[0] == 1 {
            FilmPlace::Line(FilmSegments::new(segments(support, gaps[1]), self.foundation, self.links[1]))
        } else {
            FilmPlace::Surface(Membrane::new(&patches(support, gaps), self.shape, self.foundation, self.links))
        };
    }

    /// Takes the pressure on the film from a displacement at all nodes.
    pub(crate) fn press(&mut self, field: &[T]) {
        match &mut self.place {
            FilmPlace::Nowhere => {}
            FilmPlace::Line(segments) => segments.press(field),
            FilmPlace::Surface(membrane) => membrane.press(field),
        }
    }

    /// Adds the pressure to a field.
    pub(crate) fn add_to(&self, field: &mut [T]) {
        match &self.place {
            FilmPlace::Nowhere => {}
            FilmPlace::Line(segments) => segments.add_to(field),
            FilmPlace::Surface(membrane) => membrane.add_to(field),
        }
    }
}

/// The inverse of `c0 - c2 lap` on segments of a line, zero at the nodes around them.
struct FilmSegments<T> {
    link: f64,
    /// Nodes, on beyond the end of the line where they go around it.
    segments: Vec<Range<usize>>,
    /// `1 / D` of the factors `L D L'` of a segment, as long as the longest.
    pivots: Vec<f64>,
    /// The pressure on the segments.
    pressure: Vec<T>,
}

impl<T: Real> FilmSegments<T> {
    fn new(segments: Vec<Range<usize>>, foundation: f64, link: f64) -> Self {
        let longest = segments.iter().map(Range::len).max().unwrap_or(0);
        let next = |before: &f64| Some((foundation + link * (2.0 - link * before)).recip());
        let pivots = std::iter::successors(next(&0.0), next).take(longest).collect();
        Self { link, segments, pivots, pressure: Vec::new() }
    }

    /// Goes forwards and backwards through each segment.
    fn press(&mut self, field: &[T]) {
        let Self { link, segments, pivots, pressure } = self;
        pressure.clear();
        for segment in &*segments {
            let (first, mut before) = (pressure.len(), 0.0);
            for (node, pivot) in segment.clone().zip(&*pivots) {
                before = pivot * (field[node % field.len()].to_double() + *link * before);
                pressure.push(T::from_double(before));
            }
            let mut after = 0.0;
            for (p, pivot) in pressure[first..].iter_mut().zip(&*pivots).rev() {
                after = p.to_double() + *link * pivot * after;
                *p = T::from_double(after);
            }
        }
    }

    fn add_to(&self, field: &mut [T]) {
        let nodes = self.segments.iter().cloned().flatten();
        let points = field.len();
        nodes.zip(&self.pressure).for_each(|(node, &p)| field[node % points] = field[node % points] + p);
    }
}

/// The nodes of a set on a surface, with gaps of at most `gaps` nodes along rows, and then along columns.
fn patches(support: &Support, [along_y, along_x]: [usize; 2]) -> Vec<bool> {
    let [ny, nx] = support.shape();
    let mut inside = vec![false; ny * nx];
    for row in 0..ny {
        support.runs(row).for_each(|(run, _)| inside[row * nx + run.start..row * nx + run.end].fill(true));
    }
    (0..ny).for_each(|y| close_gaps(&mut inside, nx, along_x, |x| y * nx + x));
    (0..nx).for_each(|x| close_gaps(&mut inside, ny, along_y, |y| y * nx + x));
    inside
}

/// Closes the gaps of at most `most` among the places `at(0)..at(count)`, also around the end.
fn close_gaps(inside: &mut [bool], count: usize, most: usize, at: impl Fn(usize) -> usize) {
    let Some(first) = (0..count).find(|&i| inside[at(i)]) else { return };
    let mut last = first;
    for i in first + 1..=first + count {
        if inside[at(i % count)] {
            if i - last - 1 <= most {
                (last + 1..i).for_each(|i| inside[at(i % count)] = true);
            }
            last = i;
        }
    }
}

/// The runs of a set on a line, joined over gaps of at most `gap` nodes and around the end of the line.
fn segments(support: &Support, gap: usize) -> Vec<Range<usize>> {
    let [count, width] = support.shape();
    let points = count * width;
    let mut segments: Vec<Range<usize>> = Vec::new();
    for (row, (run, _)) in (0..count).flat_map(|row| support.runs(row).map(move |run| (row, run))) {
        let run = row * width + run.start..row * width + run.end;
        match segments.last_mut() {
            Some(last) if run.start - last.end <= gap => last.end = run.end,
            _ => segments.push(run),
        }
    }
    if let [first, .., last] = &mut segments[..] {
        if first.start + points - last.end <= gap {
            last.end = first.end + points;
            segments.remove(0);
        }
    } else if let [all] = &mut segments[..]
        && all.start + points - all.end <= gap
    {
        all.end = all.start + points;
    }
    segments
}

#[cfg(test)]
mod tests {
    use super::super::operator::{SetOperator, Spectral};
    use super::super::support::RowOfNodes;
    use super::*;
    use crate::contact::Load;
    use crate::elastic::{Base, Layer};
    use crate::grid::Grid;
    use crate::surface::Surface;
    use ndarray::Array2;

    fn problem(grid: Grid, thickness: f64, poisson: f64) -> Problem {
        let layer = Layer { contact_modulus: 3.0, poisson, thickness, base: Base::Bonded };
        let waves = Array2::from_shape_fn(grid.shape(), |(y, x)| (0.3 * (y + 2 * x) as f64).sin());
        Problem::new(Surface::new(grid, waves).unwrap(), layer, Load::MeanPressure(0.1)).unwrap()
    }

    /// Patches of all sizes, one of them around the end.
    fn a_set(rows: [usize; 2]) -> Support {
        let is_inside = |row: usize, x: usize| (17.0 + 3.0 * row as f64 + (x * x / 40) as f64).sin() > 0.2;
        let choose = |row: usize, nodes: &mut RowOfNodes| {
            let inside = (0..rows[1]).filter(|&x| x < 3 || x + 2 >= rows[1] || is_inside(row, x));
            inside.for_each(|x| nodes.push(x));
        };
        Support::choose(rows, choose)
    }

    fn noise(nodes: usize, seed: f64) -> Vec<f64> {
        (0..nodes).map(|i| ((i * i % 1013) as f64 * seed).sin()).collect()
    }

    fn dot(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    #[test]
    fn the_preconditioner_is_symmetric_and_positive() {
        for grid in grids() {
            for (thickness, poisson) in [(1e-4, 0.5), (0.01, 0.5), (0.025, 0.45), (0.02, 0.1)] {
                let problem = problem(grid, thickness, poisson);
                let support = a_set(problem.response().rows());
                let mut operator = Spectral::<f64>::new(&problem);
                assert!(operator.sees_mean());
                operator.prepare(&support);
                let [a, b] = [0.7, 1.3].map(|seed| noise(support.nodes(), seed));
                let [pressed_a, pressed_b] = [&a, &b].map(|v| {
                    let mut pressed = vec![0.0; v.len()];
                    operator.precondition(&support, v, &mut pressed);
                    pressed
                });
                let energy = dot(&a, &pressed_a);
                assert!(energy > 0.0, "{grid:?}, {thickness}: {energy}");
                let difference = dot(&b, &pressed_a) - dot(&a, &pressed_b);
                assert!(difference.abs() < 1e-6 * energy, "{grid:?}, {thickness}: {difference} of {energy}");
            }
        }
    }

    /// `c0 p - c2 p''` with `p = 0` around each segment, of a film that goes around the end.
    #[test]
    fn the_film_of_a_line_is_solved_exactly() {
        let grid = Grid::line(200, 1.0).unwrap();
        let mut film = Film::<f64>::new(&problem(grid, 0.012, 0.45), 2.0).unwrap();
        film.prepare(&a_set([1, 200]));
        let FilmPlace::Line(FilmSegments { segments, .. }) = &film.place else { unreachable!("it is a line") };
        let segments = segments.clone();
        assert!(segments.last().unwrap().end > 200 && segments.len() > 4);
        let displacement = noise(200, 0.9);
        film.press(&displacement);
        let mut p = vec![0.0; 200];
        film.add_to(&mut p);
        for segment in &segments {
            for x in segment.clone() {
                let back = film.foundation * p[x % 200]
                    + film.links[1] * (2.0 * p[x % 200] - p[(x + 199) % 200] - p[(x + 1) % 200]);
                assert!((back - displacement[x % 200]).abs() < 1e-10);
            }
        }
        assert!(p.contains(&0.0));
    }

    #[test]
    fn gaps_up_to_the_thickness_belong_to_the_film() {
        let support = |columns: &[usize]| {
            Support::choose([2, 10], |row, nodes| {
                columns.iter().filter(|x| **x / 10 == row).for_each(|x| nodes.push(x % 10));
            })
        };
        let joined = |columns: &[usize], gap: usize| -> Vec<[usize; 2]> {
            segments(&support(columns), gap).into_iter().map(|segment| [segment.start, segment.end]).collect()
        };
        assert_eq!(joined(&[2, 3, 6, 9, 10], 0), [[2, 4], [6, 7], [9, 11]]);
        assert_eq!(joined(&[2, 3, 6, 9, 10], 2), [[2, 11]]);
        assert_eq!(joined(&[0, 3, 9, 18], 1), [[3, 4], [9, 10], [18, 21]]);
        assert_eq!(joined(&[4, 5], 17), [[4, 6]]);
        assert_eq!(joined(&[4, 5], 18), [[4, 24]]);
        assert_eq!(joined(&[], 3), [[0; 2]; 0]);
    }

    /// Along rows, then along columns, also around the end.
    #[test]
    fn gaps_of_a_surface_are_closed_along_both_axes() {
        let support = Support::choose([4, 5], |row, nodes| {
            let columns: &[usize] = [&[0, 2][..], &[], &[0, 4], &[]][row];
            columns.iter().for_each(|&x| nodes.push(x));
        });
        let closed = |gaps| -> Vec<usize> {
            let inside = patches(&support, gaps);
            (0..20).filter(|&i| inside[i]).collect()
        };
        assert_eq!(closed([0, 0]), [0, 2, 10, 14]);
        assert_eq!(closed([0, 1]), [0, 1, 2, 10, 14]);
        assert_eq!(closed([1, 0]), [0, 2, 5, 10, 14, 15]);
        assert_eq!(closed([1, 2]), [0, 1, 2, 3, 4, 5, 9, 10, 14, 15, 19]);
    }

    fn grids() -> Vec<Grid> {
        let lines = [300, 1 << 16].map(|points| Grid::line(points, 1.0).unwrap());
        let surfaces = [([48, 64], [1.0, 1.0]), ([33, 50], [1.0, 2.0])];
        lines.into_iter().chain(surfaces.map(|(shape, size)| Grid::surface(shape, size).unwrap())).collect()
    }
}
