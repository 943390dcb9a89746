//! The compliance of a solid on a grid.

use super::free::FreeTable;
use super::solid::stiffness;
use super::{ElasticSolid, HalfSpace};
use crate::error::GridError;
use crate::fourier::Filter;
use crate::grid::Grid;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Wavenumbers between the longest and the shortest wave at which a stiffness is looked at for its range.
const SAMPLES: usize = 512;

/// The compliance of a solid on a grid: the factors of the waves in [`crate::elastic::Response`], which are shared by
/// all responses of the same kind.
///
/// Memory: nothing for a periodic half-space, half a field on a line and a quarter on a surface for another periodic solid, and twice
/// as much for each free axis.
#[derive(Debug, Clone)]
pub struct Compliance {
    pub(super) grid: Grid,
    pub(super) solid: Arc<dyn ElasticSolid>,
    pub(super) kind: ComplianceKind,
    range: [f64; 2],
}

/// How the compliance is kept.
#[derive(Debug, Clone)]
pub(super) enum ComplianceKind {
    /// Stiffness `modulus q / 2`.
    HalfSpace { modulus: f64 },
    /// Stiffness by the places of the filter.
    Table(Vec<f64>),
    /// A boundary without images.
    Free(FreeTable),
}

impl Compliance {
    /// The compliance of a solid over a periodic or free grid. `with_uniform` includes the displacement by a uniform
    /// pressure on a periodic grid, if the solid has one. Otherwise displacements have zero mean there.
    ///
    /// # Errors
    /// [`GridError::FreeSolid`] for a solid other than a half-space on a grid that is not periodic, and [`GridError::TooManyPoints`] if
    /// what a free boundary adds is too much.
    pub fn new(grid: &Grid, solid: Arc<dyn ElasticSolid>, with_uniform: bool) -> Result<Self, GridError> {
        let modulus = solid.contact_modulus();
        let (kind, range) = if !grid.is_periodic() {
            let table = FreeTable::new(grid, solid.as_ref())?;
            let range = [table.softest(), periodic_range(grid, solid.as_ref())[1]];
            (ComplianceKind::Free(table), range)
        } else if solid.is_half_space() {
            (ComplianceKind::HalfSpace { modulus }, periodic_range(grid, solid.as_ref()))
        } else {
            let uniform = solid.uniform_compliance().filter(|_| with_uniform).map_or(0.0, f64::recip);
            let uniform = if uniform.is_finite() { uniform } else { 0.0 };
            let mut range = periodic_range(grid, solid.as_ref());
            if uniform > 0.0 {
                range = [range[0].min(uniform), range[1].max(uniform)];
            }
            (ComplianceKind::Table(table(grid, solid.as_ref(), uniform)), range)
        };
        Ok(Self { grid: *grid, solid, kind, range })
    }

    /// The compliance of a half-space for tractions along `x`: the displacement along `x`, with no traction across.
    ///
    /// `u_q = (2 / (E* |q|)) (1 + m q_y^2/q^2) tau_q` with `m = sum (nu/G) / sum ((1 - nu)/G)` over the elastic bodies, which is
    /// `nu/(1 - nu)` for one of them. On a line it is the compliance for pressures.
    ///
    /// # Errors
    /// [`GridError::ShearedSolid`] for a solid other than a half-space, and on a surface that is free along one axis only if `m` is not zero; the
    /// errors of [`Compliance::new`].
    ///
    /// # Source
    /// Johnson, *Contact Mechanics* (1985), Eq. 3.75, as waves.
    pub fn tangential(grid: &Grid, solid: Arc<dyn ElasticSolid>, m: f64) -> Result<Self, GridError> {
        if !solid.is_half_space() {
            return Err(GridError::ShearedSolid { solid: solid.description() });
        }
        if grid.is_line() || m == 0.0 {
            return Self::new(grid, solid, false);
        }
        let [ly, lx] = grid.size();
        let [longest, shortest] = periodic_range(grid, solid.as_ref());
        let range = [longest / (1.0 + m), shortest];
        let sheared = |[ky, kx]: [usize; 2]| {
            let [qy, qx] = [TAU * ky as f64 / ly, TAU * kx as f64 / lx];
            let q = qx.hypot(qy);
            if q > 0.0 { stiffness(solid.as_ref(), q) / (1.0 + m * (qy / q).powi(2)) } else { 0.0 }
        };
        let (kind, range) = match grid.periodic() {
            [true, true] => (ComplianceKind::Table(Filter::places(grid).into_iter().map(sheared).collect()), range),
            [false, false] => {
                let table = FreeTable::sheared(grid, solid.as_ref(), m)?;
                let range = [table.softest(), range[1]];
                (ComplianceKind::Free(table), range)
            }
            _ => return Err(GridError::ShearedSolid { solid: "a half-space that is free along one axis".into() }),
        };
        Ok(Self { grid: *grid, solid, kind, range })
    }

    /// The compliance of a periodic half-space of contact modulus `E*`.
    ///
    /// # Panics
    /// If the grid is not periodic.
    pub fn half_space(grid: &Grid, contact_modulus: f64) -> Self {
        Self::new(grid, HalfSpace::new(contact_modulus).into(), false).expect("the grid is periodic")
    }

    /// Fields of doubles that the response of a solid over a grid holds beyond that of a periodic half-space: its table and, on a free
    /// boundary, a field and the half spectrum of the padded grid.
    pub fn fields(grid: &Grid, solid: &dyn ElasticSolid) -> f64 {
        let padded: f64 = grid.periodic().into_iter().map(|is_periodic| if is_periodic { 1.0 } else { 2.0 }).product();
        let table = padded * if grid.is_line() { 0.5 } else { 0.25 };
        match (grid.is_periodic(), solid.is_half_space()) {
            (true, true) => 0.0,
            (true, false) => table,
            (false, _) => 1.0 + padded + table,
        }
    }

    /// The solid.
    pub fn solid(&self) -> &Arc<dyn ElasticSolid> {
        &self.solid
    }

    /// Whether a uniform pressure displaces the surface. Then the datum of displacements is determined.
    pub fn has_uniform(&self) -> bool {
        match &self.kind {
            ComplianceKind::HalfSpace { .. } => false,
            ComplianceKind::Table(stiffness) => stiffness[0] > 0.0,
            ComplianceKind::Free(_) => true,
        }
    }

    /// Stiffness of the softest and of the stiffest wave, a pressure per length; the uniform pressure counts where it displaces.
    pub fn stiffness_range(&self) -> [f64; 2] {
        self.range
    }

    /// Whether waves are independent, as on periodic grids.
    pub fn is_diagonal(&self) -> bool {
        !matches!(self.kind, ComplianceKind::Free(_))
    }
}

/// Stiffness of each place of the filter.
fn table(grid: &Grid, solid: &dyn ElasticSolid, uniform: f64) -> Vec<f64> {
    let [ly, lx] = grid.size();
    let at = |[ky, kx]: [usize; 2]| {
        let q = (TAU * kx as f64 / lx).hypot(TAU * ky as f64 / ly);
        if q > 0.0 { stiffness(solid, q) } else { uniform }
    };
    Filter::places(grid).into_iter().map(at).collect()
}

/// Stiffness of the softest and of the stiffest wave of a periodic grid.
fn periodic_range(grid: &Grid, solid: &dyn ElasticSolid) -> [f64; 2] {
    let modulus = solid.contact_modulus();
    let [dy, dx] = grid.spacing().map(|spacing| PI / spacing);
    let [longest, shortest] = [TAU / grid.longest_wavelength(), if grid.is_line() { dx } else { dx.hypot(dy) }];
    if solid.is_half_space() {
        return [PI * modulus / grid.longest_wavelength(), 0.5 * modulus * shortest];
    }
    let step = (shortest / longest).ln() / SAMPLES as f64;
    let sampled = (0..=SAMPLES).map(|i| stiffness(solid, longest * (step * i as f64).exp()));
    sampled.fold([f64::INFINITY, 0.0], |[low, high], k| [low.min(k), high.max(k)])
}
