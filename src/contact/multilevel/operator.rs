//! The compliance on contact sets, and its preconditioner.

use super::extension::Extension;
use super::film::Film;
use super::support::Support;
use crate::chunks;
use crate::contact::Problem;
use crate::elastic::{Compliance, Convolution};
use crate::fourier::{Real, smooth};
use crate::grid::Grid;
use std::sync::Arc;

/// The part to which an inner iteration brings the certificate, in units of the rounding of its numbers: 1e-4 in single precision,
/// well above the rounding of its displacements.
const ACCURACY: f64 = 1e-4 / f32::EPSILON as f64;

/// The margin along a free axis, in lengths of the grid.
const MARGIN: f64 = 0.25;

/// The compliance of a solid, applied to vectors on contact sets.
///
/// Inner steps use it. What it loses in precision is made up for by outer steps, whose displacements are computed in double precision
/// by [`crate::elastic::Response`].
pub(in crate::contact) trait SetOperator {
    /// Writes the displacement at the nodes of `to` under a pressure on the nodes of `from`.
    fn comply(&mut self, from: &Support, pressure: &[f64], to: &Support, displacement: &mut [f64]);

    /// Prepares [`SetOperator::precondition`] for a set.
    fn prepare(&mut self, support: &Support);

    /// Writes an approximate inverse of the compliance on the set applied to a residual; it is symmetric and positive if the compliance is.
    fn precondition(&mut self, support: &Support, residual: &[f64], pressure: &mut [f64]);

    /// Whether [`SetOperator::precondition`] sees the mean of the residual.
    fn sees_mean(&self) -> bool {
        false
    }

    /// The part to which an inner iteration can bring the certificate before the error of displacements shows.
    fn accuracy(&self) -> f64;

    /// Frees memory until the operator is used again.
    fn release(&mut self);

    /// Transforms so far, in those of the whole grid.
    fn transforms(&self) -> f64;
}

/// The compliance by transforms of the whole grid, in the precision `T`.
///
/// The preconditioner is `E' K E` with the stiffness `K`, the inverse of the compliance `A` on the whole plane, and the [`Extension`]
/// `E`: restricted to the set, the inverse of `A` is `E' K E` for the extension of least energy (the Schur complement of `K`). Along a
/// free axis vectors are extended to a margin beyond the grid. Without it the stiffness would be that of images that touch, and
/// conjugate gradients would need two or three times as many steps.
///
/// For thin bonded layers it is that of a [`Film`].
///
/// Memory: a half spectrum, a field, and the extension, all of the precision `T`, and the film.
pub(in crate::contact) struct Spectral<T: Real> {
    waves: Convolution<T>,
    /// The waves over the grid with margins, where there are any.
    with_margins: Option<Convolution<T>>,
    shape: [usize; 2],
    /// Shape with margins.
    wide: [usize; 2],
    /// The unit of stiffness of `waves`.
    unit: f64,
    extension: Option<Extension<T>>,
    film: Option<Film<T>>,
    /// A vector extended to all nodes, or the pressure on them.
    field: Vec<T>,
    transforms: u64,
}

/// The unit of stiffness of the operator of a compliance.
fn unit_of(compliance: &Compliance) -> f64 {
    power_of_two(compliance.stiffness_range()[0])
}

/// The grid that the preconditioner extends vectors to: with margins along free axes.
pub(super) fn with_margins(grid: &Grid) -> Grid {
    let (shape, periodic) = (grid.shape(), grid.periodic());
    let wide = [0, 1].map(|axis| {
        let n = shape[axis];
        if periodic[axis] { n } else { smooth(n + (MARGIN * n as f64) as usize) }
    });
    let spacing = grid.spacing();
    let size = [0, 1].map(|axis| wide[axis] as f64 * spacing[axis]);
    let wide = if grid.is_line() { Grid::line(wide[1], size[1]) } else { Grid::surface(wide, size) };
    wide.expect("a grid with margins is a grid")
}

impl<T: Real> Spectral<T> {
    pub(crate) fn new(problem: &Problem) -> Self {
        let unit = unit_of(problem.shared_compliance());
        let film = if problem.is_moving() { None } else { Film::new(problem, unit) };
        Self { film, ..Self::from_compliance(problem.shared_compliance(), problem.surface().grid()) }
    }

    /// The operator of a compliance over a grid, without a film. That of a contact that moves takes the complex stiffness for `K`.
    pub(crate) fn from_compliance(compliance: &Arc<Compliance>, grid: &Grid) -> Self {
        let unit = unit_of(compliance);
        let wide = with_margins(grid);
        let on_margins =
            || compliance.on_grid(&wide, false).expect("a solid that has a free boundary has a periodic one");
        Self {
            waves: Convolution::new(compliance.clone(), unit),
            with_margins: (!grid.is_periodic()).then(|| Convolution::new(Arc::new(on_margins()), unit)),
            shape: grid.shape(),
            wide: wide.shape(),
            unit,
            extension: None,
            film: None,
            field: Vec::new(),
            transforms: 0,
        }
    }
}

impl<T: Real> SetOperator for Spectral<T> {
    fn comply(&mut self, from: &Support, pressure: &[f64], to: &Support, displacement: &mut [f64]) {
        self.transforms += 2;
        let largest = power_of_two(largest(pressure));
        let (down, up) = (largest.recip(), largest / self.unit);
        self.waves.displace(
            |row, cause| {
                cause.fill(T::zero());
                from.scatter(row, pressure, down, cause);
            },
            &mut to.pieces(displacement),
            |row, effect, piece| to.gather(row, effect, up, piece),
        );
    }

    fn prepare(&mut self, support: &Support) {
        if self.field.is_empty() {
            self.field = vec![T::zero(); self.wide[0] * self.wide[1]];
        }
        let largest = self.film.as_ref().map_or(f64::INFINITY, Film::largest_cell);
        // the memory of an earlier one is free for this one
        self.extension = None;
        self.extension = Some(Extension::new(support, [self.shape, self.wide], 2, largest));
        self.film.iter_mut().for_each(|film| film.prepare(support));
    }

    fn precondition(&mut self, support: &Support, residual: &[f64], pressure: &mut [f64]) {
        let Self { waves, with_margins, extension, film, field, shape, wide, .. } = self;
        let extension = extension.as_mut().expect("the operator is prepared for the set");
        self.transforms += 2;
        let largest = power_of_two(largest(residual));
        let (down, up) = (largest.recip(), largest * self.unit);
        extension.extend(support, |node| T::from_double(down * residual[node]));
        let [count, width] = support.shape();
        // rows of nodes, or pieces of a line, begin with the nodes of the set
        let length = if shape[0] > 1 { wide[1] } else { width };
        let stiffness = with_margins.as_mut().unwrap_or(waves);
        let piece = stiffness.rows()[1];
        chunks::rows_mut(field, piece, |row, to| extension.fill(row, to));
        chunks::rows_mut(&mut field[..count * length], length, |row, to| support.scatter(row, residual, down, to));
        film.iter_mut().for_each(|film| film.press(field));
        stiffness.press(field, |q| film.as_ref().map_or(0.0, |film| film.stiffness(q)));
        film.iter().for_each(|film| film.add_to(field));
        let mut sinks: Vec<_> = field.chunks_exact_mut(length).zip(support.pieces(pressure)).collect();
        chunks::each(&mut sinks, width, |row, (field, on_set)| {
            support.gather(row, field, up, on_set);
            support.runs(row).for_each(|(run, _)| field[run].fill(T::zero()));
        });
        extension.restrict(field, support, pressure, up);
    }

    fn release(&mut self) {
        self.waves.release();
        self.with_margins.iter_mut().for_each(Convolution::release);
        (self.field, self.extension) = (Vec::new(), None);
    }

    fn sees_mean(&self) -> bool {
        self.film.is_some()
    }

    fn accuracy(&self) -> f64 {
        ACCURACY * T::EPSILON
    }

    fn transforms(&self) -> f64 {
        self.transforms as f64
    }
}

/// The largest magnitude of some values.
pub(super) fn largest(values: &[f64]) -> f64 {
    let parts = chunks::visit(values.len(), |range| values[range].iter().fold(0.0, |most: f64, v| most.max(v.abs())));
    parts.into_iter().fold(0.0, f64::max)
}

/// The next power of two above a positive value, by which numbers are scaled without rounding; 1 for other values.
pub(super) fn power_of_two(value: f64) -> f64 {
    if value.is_normal() && value > 0.0 { value.log2().ceil().clamp(-1000.0, 1000.0).exp2() } else { 1.0 }
}
