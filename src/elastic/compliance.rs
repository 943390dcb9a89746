//! The compliance of a solid on a grid.

use super::directed::{DirectedTable, SteadyMotion, rolling_strip};
use super::ewald::EwaldTables;
use super::free::{FreeTable, datum};
use super::solid::stiffness;
use super::{ElasticSolid, HalfSpace};
use crate::error::{GridError, ProblemError};
use crate::fourier::{Complex, Filter};
use crate::grid::Grid;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Wavenumbers between the longest and the shortest wave at which a stiffness is looked at for its range.
const SAMPLES: usize = 512;
/// Relative rounding of wavenumbers.
const ROUNDING: f64 = 1e-9;

/// The compliance of a solid on a grid: the factors of the waves in [`crate::elastic::Response`], which are shared by
/// all responses of the same kind.
///
/// Memory: nothing for a periodic half-space, half a field on a line and a quarter on a surface for another periodic solid, and twice
/// as much for each free axis. Of a large free surface it is a third of a field in each precision, made on first use.
#[derive(Debug, Clone)]
pub struct Compliance {
    pub(super) grid: Grid,
    pub(super) solid: Arc<dyn ElasticSolid>,
    pub(super) kind: ComplianceKind,
    range: [f64; 2],
    /// The softest real part of the stiffness.
    least_stiffness: f64,
    motion: Option<SteadyMotion>,
}

/// How the compliance is kept.
#[derive(Debug, Clone)]
pub(super) enum ComplianceKind {
    /// Stiffness `modulus q / 2`.
    HalfSpace { modulus: f64 },
    /// Stiffness by the places of the filter.
    Table(Vec<f64>),
    /// A boundary without images, as a whole.
    Free(FreeTable),
    /// A boundary without images, in two parts.
    Ewald(Box<EwaldTables>),
    /// A contact that moves over the solid.
    Directed { base: Box<ComplianceKind>, table: DirectedTable },
}

impl ComplianceKind {
    /// Points of the grids whose transforms make a displacement.
    fn points(&self, grid: &Grid) -> usize {
        match self {
            Self::HalfSpace { .. } | Self::Table(_) => grid.len(),
            Self::Free(table) => table.points(),
            Self::Ewald(tables) => tables.points(),
            Self::Directed { base, .. } => base.points(grid),
        }
    }
}

impl Compliance {
    /// The compliance of a solid over a periodic or free grid. `with_uniform` includes the displacement by a uniform
    /// pressure on a periodic grid, if the solid has one. Otherwise displacements have zero mean there.
    ///
    /// # Errors
    /// [`GridError::FreeSolid`] for a solid other than a half-space on a grid that is not periodic, [`GridError::UnknownWaves`] for a
    /// grid with waves for which the solid is not known, and [`GridError::TooManyPoints`] if what a free boundary adds is too much.
    pub fn new(grid: &Grid, solid: Arc<dyn ElasticSolid>, with_uniform: bool) -> Result<Self, GridError> {
        check_known(grid, solid.as_ref())?;
        let modulus = solid.contact_modulus();
        let (kind, range) = if let Some(tables) = EwaldTables::new(grid, solid.as_ref()) {
            let range = [tables.softest(), periodic_range(grid, solid.as_ref())[1]];
            (ComplianceKind::Ewald(tables.into()), range)
        } else if !grid.is_periodic() {
            let table = FreeTable::new(grid, solid.as_ref())?;
            let range = [table.softest(), periodic_range(grid, solid.as_ref())[1]];
            (ComplianceKind::Free(table), range)
        } else if solid.is_half_space() {
            (ComplianceKind::HalfSpace { modulus }, periodic_range(grid, solid.as_ref()))
        } else {
            let uniform = solid.uniform_compliance().filter(|_| with_uniform).map_or(0.0, f64::recip);
            let uniform = if uniform.is_finite() { uniform } else { 0.0 };
            let table = table(grid, solid.as_ref(), uniform);
            let stiffest = |[low, high]: [f64; 2], &k: &f64| [f64::min(low, k), f64::max(high, k)];
            let range = table.iter().filter(|k| **k > 0.0).fold([f64::INFINITY, 0.0], stiffest);
            (ComplianceKind::Table(table), range)
        };
        Ok(Self { grid: *grid, solid, kind, range, least_stiffness: range[0], motion: None })
    }

    /// The compliance of a viscoelastic solid below a contact that slides steadily at a `speed` `V`, a length per time, towards `+x`
    /// (towards `-x` if it is negative) over a periodic grid. The compliance of a wave is
    ///
    /// `A_q (1 + sum_j f_j / (1 - i q_x V tau_j))`
    ///
    /// with the compliance `A_q` of the `solid`, whose modulus is that of fast loads, and for each of the `terms` `(f, tau)` the creep
    /// `f`, which adds `f A` to the compliance after a long time, and the retardation time `tau`. At the Nyquist wave along `x` it is the
    /// real part.
    ///
    /// The factor follows from `tau_j d eps_j/dt + eps_j = f_j p`, `u = A (p + sum eps_j)` of the material, which moves towards `-x` in
    /// the frame of the surface, where `d/dt = -V d/dx`.
    ///
    /// # Errors
    /// [`ProblemError::NeedsPeriodic`] for a free boundary, [`ProblemError::NotFinite`] for a speed that is not finite,
    /// [`ProblemError::Negative`] for a creep or a time that is negative or not finite, and the errors of [`Compliance::new`].
    ///
    /// ```
    /// use asperity::Grid;
    /// use asperity::elastic::{Compliance, HalfSpace, Response};
    /// use std::f64::consts::TAU;
    /// let grid = Grid::line(64, TAU)?; // wavenumbers 0, 1, 2, ...
    /// let moving = Compliance::sliding(&grid, HalfSpace::new(2.0).into(), false, 0.5, &[(3.0, 2.0)])?;
    /// assert!(!moving.is_symmetric());
    /// let pressure: Vec<f64> = grid.x().map(f64::cos).collect();
    /// let mut displacement = vec![0.0; 64];
    /// Response::from_compliance(moving.into()).displacement(&pressure, &mut displacement);
    /// // q V tau = 1: the weight is 1 + 3 / (1 - i) = 2.5 + 1.5 i
    /// for (x, u) in grid.x().zip(displacement) {
    ///     assert!((u - 2.5 * x.cos() + 1.5 * x.sin()).abs() < 1e-14);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sliding(
        grid: &Grid,
        solid: Arc<dyn ElasticSolid>,
        with_uniform: bool,
        speed: f64,
        terms: &[(f64, f64)],
    ) -> Result<Self, ProblemError> {
        if !grid.is_periodic() {
            return Err(ProblemError::NeedsPeriodic);
        }
        if !speed.is_finite() {
            return Err(ProblemError::NotFinite { name: "speed", value: speed });
        }
        for &(ratio, time) in terms {
            for (name, value) in [("creep of a Prony term", ratio), ("retardation time", time)] {
                if !(value.is_finite() && value >= 0.0) {
                    return Err(ProblemError::Negative { name, value });
                }
            }
        }
        let motion = SteadyMotion::Sliding { speed, terms: terms.to_vec() };
        let at_rest = Self::new(grid, solid, with_uniform)?;
        let table = at_rest.moved(&motion);
        Ok(at_rest.directed(table, motion))
    }

    /// The tangential compliance of lines that roll steadily towards `+x`, with the `step` `dq`, a length:
    ///
    /// `(B t)(x) = (A t)(x) - (A t)(x + dq)`
    ///
    /// with the compliance `A` of a half-space, which is the same in the normal and the tangential direction of a line. What is at `x` now
    /// was at `x + dq` one step ago: so `B t` is what a traction adds to the slip in a step. On a periodic line the weight of a wave is
    /// `A_q (1 - e^(i q dq))`; on a free line it is made of the displacements by uniform tractions on the elements.
    ///
    /// # Errors
    /// [`ProblemError::NeedsLine`] for a surface, [`ProblemError::NotPositive`] for a step that is not positive and finite, and the
    /// errors of [`Compliance::new`].
    ///
    /// ```
    /// use asperity::Grid;
    /// use asperity::elastic::{Compliance, HalfSpace, Response};
    /// let grid = Grid::line(32, 1.0)?.with_periodic([true, false]);
    /// let solid = || HalfSpace::new(1.0).into();
    /// let [mut rest, mut rolling] =
    ///     [Compliance::new(&grid, solid(), true)?, Compliance::rolling(&grid, solid(), grid.spacing()[1])?]
    ///         .map(|compliance| Response::from_compliance(compliance.into()));
    /// let traction: Vec<f64> = (0..32).map(|i| (i * i % 7) as f64).collect();
    /// let mut fields = [vec![0.0; 32], vec![0.0; 32]];
    /// rest.displacement(&traction, &mut fields[0]);
    /// rolling.displacement(&traction, &mut fields[1]);
    /// // a step of one spacing is a difference of neighbours
    /// assert!((0..31).all(|i| (fields[1][i] - (fields[0][i] - fields[0][i + 1])).abs() < 1e-13));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn rolling(grid: &Grid, solid: Arc<dyn ElasticSolid>, step: f64) -> Result<Self, ProblemError> {
        check_line(grid, step)?;
        let motion = SteadyMotion::Rolling { step };
        let at_rest = Self::new(grid, solid, false)?;
        let table = if grid.is_periodic() {
            at_rest.moved(&motion)
        } else {
            let solid = at_rest.solid.as_ref();
            let strip = [grid.spacing()[1], datum(solid, grid.size()[1]), solid.contact_modulus()];
            DirectedTable::free(grid, |x| rolling_strip(x, step, strip))?
        };
        Ok(at_rest.directed(table, motion))
    }

    /// The weights of the waves of this compliance on a periodic grid times the factor of a motion.
    fn moved(&self, motion: &SteadyMotion) -> DirectedTable {
        let uniform = match &self.kind {
            ComplianceKind::Table(stiffness) if stiffness[0] > 0.0 => stiffness[0].recip(),
            _ => 0.0,
        };
        DirectedTable::periodic(&self.grid, |[qy, qx]| {
            let q = qy.hypot(qx);
            let at_rest = if q > 0.0 { stiffness(self.solid.as_ref(), q).recip() } else { uniform };
            motion.factor(qx) * at_rest
        })
    }

    /// The compliance with other weights.
    fn directed(self, table: DirectedTable, motion: SteadyMotion) -> Self {
        let (range, least_stiffness) = table.range();
        let kind = ComplianceKind::Directed { base: Box::new(self.kind), table };
        Self { grid: self.grid, solid: self.solid, kind, range, least_stiffness, motion: Some(motion) }
    }

    /// The same solid in the same motion over another grid.
    ///
    /// # Errors
    /// The errors of the constructor that it was made by.
    pub(crate) fn on_grid(&self, grid: &Grid, with_uniform: bool) -> Result<Self, ProblemError> {
        let solid = self.solid.clone();
        match &self.motion {
            None => Ok(Self::new(grid, solid, with_uniform)?),
            Some(SteadyMotion::Sliding { speed, terms }) => Self::sliding(grid, solid, with_uniform, *speed, terms),
            Some(SteadyMotion::Rolling { step }) => Self::rolling(grid, solid, off_shortest_wave(*step, grid)),
        }
    }

    /// The sum of the creep `f` of a viscoelastic solid under a contact that slides.
    pub(crate) fn creep(&self) -> Option<f64> {
        match &self.motion {
            Some(SteadyMotion::Sliding { terms, .. }) => Some(terms.iter().map(|(ratio, _)| ratio).sum()),
            _ => None,
        }
    }

    /// How far a contact that slides moves within the longest retardation time of the solid, a length.
    pub(crate) fn trail(&self) -> Option<f64> {
        match &self.motion {
            Some(SteadyMotion::Sliding { speed, terms }) => {
                let times = terms.iter().filter(|(ratio, _)| *ratio > 0.0).map(|(_, time)| *time);
                Some(speed.abs() * times.fold(0.0, f64::max))
            }
            _ => None,
        }
    }

    /// That of a contact that slides, with `extra` times the compliance of fast loads added.
    pub(crate) fn softened(&self, extra: f64) -> Result<Self, ProblemError> {
        match &self.motion {
            Some(SteadyMotion::Sliding { speed, terms }) => {
                let terms: Vec<_> = terms.iter().copied().chain([(extra, 0.0)]).collect();
                Self::sliding(&self.grid, self.solid.clone(), self.has_uniform(), *speed, &terms)
            }
            _ => Err(ProblemError::NeedsPeriodic),
        }
    }

    /// The motion of the contact over the solid.
    pub(crate) fn motion(&self) -> Option<&SteadyMotion> {
        self.motion.as_ref()
    }

    /// Displacement over pressure of each wave of a periodic grid, in the order of [`Grid::wavenumbers`], if the compliance is not
    /// symmetric. The mean is zero where it is a datum.
    pub fn weights(&self) -> Option<&[Complex]> {
        match &self.kind {
            ComplianceKind::Directed { table, .. } if table.is_periodic() => Some(&table.weights),
            _ => None,
        }
    }

    /// Whether `<p u(q)> = <q u(p)>` for all pressures, as for every elastic solid at rest. Otherwise no energy belongs to the
    /// compliance, and only [`crate::contact::MonotoneSets`] solves its contacts.
    pub fn is_symmetric(&self) -> bool {
        self.motion.is_none()
    }

    /// The smallest real part of the stiffness of a wave; the softest stiffness if the compliance is symmetric.
    pub(crate) fn least_stiffness(&self) -> f64 {
        self.least_stiffness
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
        Ok(Self { grid: *grid, solid, kind, range, least_stiffness: range[0], motion: None })
    }

    /// The compliance of a periodic half-space of contact modulus `E*`.
    ///
    /// # Panics
    /// If the grid is not periodic.
    pub fn half_space(grid: &Grid, contact_modulus: f64) -> Self {
        Self::new(grid, HalfSpace::new(contact_modulus).into(), false).expect("the grid is periodic")
    }

    /// Fields of doubles that the response of a solid over a grid holds beyond that of a periodic half-space: its table and, on a free
    /// boundary, the half spectrum of the padded grid, of a surface without the rows of padding; of a line a field as well. Large free
    /// surfaces need the spectra and tables of two parts instead.
    pub fn fields(grid: &Grid, solid: &dyn ElasticSolid) -> f64 {
        let padded: f64 = grid.periodic().into_iter().map(|is_periodic| if is_periodic { 1.0 } else { 2.0 }).product();
        let table = padded * if grid.is_line() { 0.5 } else { 0.25 };
        match (grid.is_periodic(), solid.is_half_space()) {
            (true, true) => 0.0,
            (true, false) => table,
            (false, _) if grid.is_line() => 1.0 + padded + table,
            (false, _) => EwaldTables::new(grid, solid).map_or(2.0 + table, |tables| tables.fields()),
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
            ComplianceKind::Free(_) | ComplianceKind::Ewald(_) => true,
            ComplianceKind::Directed { table, .. } => table.has_uniform(),
        }
    }

    /// Stiffness of the softest and of the stiffest wave, a pressure per length; the uniform pressure counts where it displaces. If
    /// the compliance is not symmetric, it is that of its symmetric part: the inverse of the real part of the weights.
    pub fn stiffness_range(&self) -> [f64; 2] {
        self.range
    }

    /// Points of the grids whose transforms make a displacement.
    pub(crate) fn transformed_points(&self) -> usize {
        self.kind.points(&self.grid)
    }

    /// Whether waves are independent, as on periodic grids.
    pub fn is_diagonal(&self) -> bool {
        match &self.kind {
            ComplianceKind::Free(_) | ComplianceKind::Ewald(_) => false,
            ComplianceKind::Directed { table, .. } => table.is_periodic(),
            ComplianceKind::HalfSpace { .. } | ComplianceKind::Table(_) => true,
        }
    }
}

/// Checks that a solid is known for all waves of a grid, but for rounding of their wavenumbers.
fn check_known(grid: &Grid, solid: &dyn ElasticSolid) -> Result<(), GridError> {
    let (Some([first, last]), [longest, shortest]) = (solid.known_waves(), wavenumbers(grid)) else { return Ok(()) };
    match longest * (1.0 + ROUNDING) >= first && shortest * (1.0 - ROUNDING) <= last {
        true => Ok(()),
        false => Err(GridError::UnknownWaves { first, last, longest, shortest }),
    }
}

/// The wavenumbers of the longest and of the shortest wave of a grid.
fn wavenumbers(grid: &Grid) -> [f64; 2] {
    let [dy, dx] = grid.spacing().map(|spacing| PI / spacing);
    [TAU / grid.longest_wavelength(), if grid.is_line() { dx } else { dx.hypot(dy) }]
}

/// Checks the grid and the step of a contact that rolls.
fn check_line(grid: &Grid, step: f64) -> Result<(), ProblemError> {
    if !grid.is_line() {
        return Err(ProblemError::NeedsLine { shape: grid.shape() });
    }
    if step.is_finite() && step > 0.0 {
        return Ok(());
    }
    Err(ProblemError::NotPositive { name: "step of rolling", value: step })
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

/// A step of rolling that is no even multiple of the spacing. Solids over other grids only precondition, and a periodic grid does not displace
/// its shortest wave in a step of two spacings, so that its stiffness would be infinite.
fn off_shortest_wave(step: f64, grid: &Grid) -> f64 {
    let pairs = step / (2.0 * grid.spacing()[1]);
    let nearest = pairs.round();
    if nearest > 0.0 && (pairs - nearest).abs() < LEAST_OFF { step * (nearest - LEAST_OFF) / pairs } else { step }
}

/// How far the step of a preconditioner stays off a multiple of two spacings, over these. Steps of 1.999 and 2.001 spacings converge as well.
const LEAST_OFF: f64 = 0.01;

/// Stiffness of the softest and of the stiffest wave of a periodic grid.
fn periodic_range(grid: &Grid, solid: &dyn ElasticSolid) -> [f64; 2] {
    let modulus = solid.contact_modulus();
    let [longest, shortest] = wavenumbers(grid);
    if solid.is_half_space() {
        return [PI * modulus / grid.longest_wavelength(), 0.5 * modulus * shortest];
    }
    let step = (shortest / longest).ln() / SAMPLES as f64;
    let sampled = (0..=SAMPLES).map(|i| stiffness(solid, longest * (step * i as f64).exp()));
    sampled.fold([f64::INFINITY, 0.0], |[low, high], k| [low.min(k), high.max(k)])
}
