//! The waves of a solid over a grid, multiplied in Fourier space.

use super::Compliance;
use super::compliance::ComplianceKind;
use super::directed::DirectedConvolution;
use super::ewald::{EwaldConvolution, EwaldTables};
use super::free::{FreeConvolution, FreeTable};
use crate::fourier::{Filter, Real, Wave};
use std::sync::Arc;

/// The compliance of a solid and its approximate inverse, applied to fields of the precision `T`.
///
/// A field is multiplied by `unit` times the compliance, or by the stiffness over `unit`, so that single precision has the
/// range that it needs in any system of units.
pub(crate) struct Convolution<T: Real> {
    compliance: Arc<Compliance>,
    unit: f64,
    rows: [usize; 2],
    /// Made on first use: a free boundary rarely needs the first, and nothing else the second.
    filter: Option<Filter<T>>,
    padded: Option<FreeConvolution<T>>,
    ewald: Option<EwaldConvolution<T>>,
    directed: Option<DirectedConvolution<T>>,
}

impl<T: Real> Convolution<T> {
    /// The waves of a solid; transforms are planned on first use.
    pub(crate) fn new(compliance: Arc<Compliance>, unit: f64) -> Self {
        let rows = Filter::rows_of(&compliance.grid);
        Self { unit, rows, filter: None, padded: None, ewald: None, directed: None, compliance }
    }

    pub(crate) fn compliance(&self) -> &Arc<Compliance> {
        &self.compliance
    }

    /// The number of rows in which fields are taken and given, and their length: the rows of a surface, or pieces of a line that
    /// follow each other.
    pub(crate) fn rows(&self) -> [usize; 2] {
        self.rows
    }

    /// Frees the memory of the transforms until they are used again.
    pub(crate) fn release(&mut self) {
        (self.filter, self.padded, self.ewald, self.directed) = (None, None, None, None);
    }

    /// `unit` times the displacement under a pressure, for fields that need not exist as a whole.
    ///
    /// `fill(r, row)` writes row `r` of the pressure to `row`, whose content is undefined before; `store(r, row, sink)` takes row
    /// `r` of the displacement with the sink of that row, one of [`Convolution::rows`].
    pub(crate) fn displace<S: Send>(
        &mut self,
        fill: impl Fn(usize, &mut [T]) + Sync,
        sinks: &mut [S],
        store: impl Fn(usize, &[T], &mut S) + Sync,
    ) {
        let (unit, rows) = (self.unit, self.rows);
        match &self.compliance.kind {
            ComplianceKind::Free(table) => {
                let padded = self.padded.get_or_insert_with(|| FreeConvolution::new(&self.compliance.grid, table));
                padded.convolve(table, unit, rows, fill, sinks, store);
            }
            ComplianceKind::Ewald(tables) if EwaldTables::ARE_MADE => {
                let (table, shape) = (tables.at_precision::<T>(), self.compliance.grid.shape());
                let ewald = self.ewald.get_or_insert_with(|| EwaldConvolution::new(shape, table));
                ewald.convolve(table, unit, fill, sinks, store);
            }
            ComplianceKind::Directed { table, .. } => {
                let grid = &self.compliance.grid;
                let directed = self.directed.get_or_insert_with(|| DirectedConvolution::new(grid, table));
                directed.displace(table, unit, rows, fill, sinks, store);
            }
            _ => self.multiply(|k| if k > 0.0 { unit / k } else { 0.0 }, true, fill, sinks, store),
        }
    }

    /// The inverse of [`Convolution::displace`] on a periodic grid, with zero mean, of a field that becomes the pressure. The stiffness
    /// of each wave is lowered by `less(q)`, but not below zero; nothing is lowered where the contact moves over the solid.
    pub(crate) fn press(&mut self, field: &mut [T], less: impl Fn(f64) -> f64 + Sync) {
        let (per_unit, width) = (self.unit.recip(), self.rows[1]);
        if let ComplianceKind::Directed { table, .. } = &self.compliance.kind
            && table.is_periodic()
        {
            let grid = &self.compliance.grid;
            let directed = self.directed.get_or_insert_with(|| DirectedConvolution::new(grid, table));
            return directed.press(table, per_unit, field);
        }
        let filter = self.filter.get_or_insert_with(|| Filter::new(&self.compliance.grid));
        filter.load(|r, row| row.copy_from_slice(&field[r * width..][..width]));
        scale(filter, &self.compliance.kind, |q, k| per_unit * (k - less(q)).max(0.0), false);
        let mut rows: Vec<_> = field.chunks_exact_mut(width).collect();
        filter.store(&mut rows, |_, row, to| to.copy_from_slice(row));
    }

    /// Multiplies the modes by `factor(k)`; the mean has the stiffness of a uniform pressure if `with_uniform`, or else zero.
    pub(crate) fn multiply<S: Send>(
        &mut self,
        factor: impl Fn(f64) -> f64 + Sync,
        with_uniform: bool,
        fill: impl Fn(usize, &mut [T]) + Sync,
        sinks: &mut [S],
        store: impl Fn(usize, &[T], &mut S) + Sync,
    ) {
        let filter = self.filter.get_or_insert_with(|| Filter::new(&self.compliance.grid));
        filter.load(fill);
        scale(filter, &self.compliance.kind, |_, k| factor(k), with_uniform);
        filter.store(sinks, |r, row, sink| store(r, row, sink));
    }
}

/// Multiplies the modes in a filter by `factor(q, k)`, as [`Convolution::multiply`] has it.
fn scale<T: Real>(
    filter: &mut Filter<T>,
    kind: &ComplianceKind,
    factor: impl Fn(f64, f64) -> f64 + Sync,
    with_uniform: bool,
) {
    let kind = if let ComplianceKind::Directed { base, .. } = kind { base } else { kind };
    let half_space = |filter: &mut Filter<T>, modulus: f64| filter.scale(|Wave { q, .. }| factor(q, 0.5 * modulus * q));
    match kind {
        &ComplianceKind::HalfSpace { modulus } | &ComplianceKind::Free(FreeTable { modulus, .. }) => {
            half_space(filter, modulus);
        }
        ComplianceKind::Ewald(tables) => half_space(filter, tables.modulus),
        ComplianceKind::Directed { .. } => unreachable!("a solid without motion is not directed"),
        ComplianceKind::Table(table) => {
            filter.scale(|Wave { q, place }| factor(q, if q > 0.0 || with_uniform { table[place] } else { 0.0 }));
        }
    }
}
