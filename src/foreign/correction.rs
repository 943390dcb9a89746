//! A possible mistake in a result, and the result without it.

use super::arrangement::Arrangement;
use super::claim::{Claim, ClaimedState};
use super::given_field::GivenField;
use super::wave_stiffness::WaveStiffness;
use crate::contact::Load;
use crate::grid::Grid;
use crate::surface::Surface;

/// A kind of common error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum MistakeKind {
    /// The nodes are in another order.
    Arrangement(Arrangement),
    /// A gap was taken for a displacement, or the reverse.
    Quantity,
    /// The field has the other sign.
    Sign,
    /// The peaks point the other way.
    Heights,
    /// The modulus is wrong by a factor, or the size or a unit.
    Modulus,
    /// The pressures are off by a factor.
    #[strum(serialize = "pressure-factor")]
    Scale,
    /// The pressures carry another load than the prescribed one.
    Load,
    /// The cell is periodic where it is meant to be free, or free where it is meant to be periodic.
    Boundary,
    /// The stiffness of the waves is by `|qx| + |qy|` and not by `|q|`.
    Kernel,
}

/// The correction of an error of some kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ClaimCorrection {
    pub kind: MistakeKind,
    /// What the pressures, or 1 over the modulus, must be multiplied with; 1 for other kinds.
    pub factor: f64,
}

/// The smallest factor, above 1, that is an error and not a lack of convergence.
const LEAST_FACTOR: f64 = 0.03;
/// The smallest relative error of a load that is told.
const LEAST_LOAD: f64 = 1e-6;

impl MistakeKind {
    /// All kinds that there can be on a grid, in the order in which one can follow another.
    pub(crate) fn all(grid: &Grid) -> Vec<Self> {
        let others =
            [Self::Quantity, Self::Sign, Self::Heights, Self::Modulus, Self::Scale, Self::Load, Self::Boundary];
        // all waves of a line are along one axis
        let kernel = (!grid.is_line() && grid.is_periodic()).then_some(Self::Kernel);
        Arrangement::on(grid).map(Self::Arrangement).chain(others).chain(kernel).collect()
    }

    /// A short name.
    pub(crate) fn name(self) -> &'static str {
        self.into()
    }

    /// Whether an error of this kind may come with one of the other kind, which stands further on in the order.
    pub(crate) fn goes_with(self, other: Self) -> bool {
        let rank = |kind: Self| match kind {
            Self::Arrangement(_) => 0,
            Self::Quantity => 1,
            Self::Sign => 2,
            Self::Heights => 3,
            Self::Modulus | Self::Scale | Self::Load | Self::Boundary | Self::Kernel => 4,
        };
        rank(self) < rank(other)
    }

    /// The claim without an error of this kind; none where it makes no difference.
    pub(crate) fn undone(self, claim: &Claim) -> Option<(Claim, ClaimCorrection)> {
        let mut better = claim.clone();
        let mut factor = 1.0;
        match self {
            Self::Arrangement(arrangement) => better.values = arrangement.apply(&claim.values, claim.surface.grid()),
            Self::Quantity => better.quantity = other_length(claim)?,
            Self::Sign => better.values.iter_mut().for_each(|value| *value = -*value),
            Self::Heights => better.surface = upside_down(&claim.surface)?.into(),
            Self::Modulus => {
                factor = fitted(claim)?;
                better.contact_modulus /= factor;
            }
            Self::Load => better.load = other_load(claim)?,
            Self::Kernel => better.kernel = WaveStiffness::Sum,
            Self::Boundary => better.surface = other_boundary(&claim.surface)?.into(),
            Self::Scale => {
                factor = fitted(claim).filter(|_| claim.quantity == GivenField::Pressure)?;
                better.values.iter_mut().for_each(|value| *value *= factor);
            }
        }
        Some((better, ClaimCorrection { kind: self, factor }))
    }
}

/// The displacement or gap that the gap or displacement may be.
fn other_length(claim: &Claim) -> Option<GivenField> {
    match claim.quantity {
        GivenField::Gap if claim.load.is_some() => Some(GivenField::Displacement),
        GivenField::Displacement => Some(GivenField::Gap),
        _ => None,
    }
}

/// No load, so that it is that of the pressures, where these carry another one than is prescribed.
fn other_load(claim: &Claim) -> Option<Option<Load>> {
    let prescribed = claim.problem().ok()?.mean_pressure().filter(|_| claim.quantity == GivenField::Pressure)?;
    ((claim.mean() / prescribed - 1.0).abs() > LEAST_LOAD).then_some(None)
}

/// The surface with free boundaries for periodic ones, or the reverse.
fn other_boundary(surface: &Surface) -> Option<Surface> {
    let grid = surface.grid();
    let periodic = if grid.is_periodic() { [grid.is_line(), false] } else { [true, true] };
    Surface::new(grid.with_periodic(periodic), surface.heights_as_given()).ok()
}

fn upside_down(surface: &Surface) -> Option<Surface> {
    Surface::new(*surface.grid(), -surface.heights_as_given()).ok()
}

/// The factor by which the displacements that the pressures make must be multiplied to fit, if it differs from 1.
fn fitted(claim: &Claim) -> Option<f64> {
    let state = claim.state().ok()?;
    let factor = match claim.quantity {
        GivenField::Pressure => level(&state),
        GivenField::Gap | GivenField::Displacement => workless(&state)?,
    };
    let is_error = factor.is_finite() && factor > 0.0 && (factor - 1.0).abs() > LEAST_FACTOR;
    is_error.then_some(factor)
}

/// The factor `c` with which `c u - h` is as level as can be where there is pressure: that of least squares, weighted by the
/// pressure.
fn level(ClaimedState { problem, pressure, displacement, .. }: &ClaimedState) -> f64 {
    let height = problem.height();
    let weight = |i: usize| pressure[i].max(0.0);
    let mean = |of: &dyn Fn(usize) -> f64| {
        let nodes = 0..pressure.len();
        nodes.clone().map(|i| weight(i) * of(i)).sum::<f64>() / nodes.map(weight).sum::<f64>()
    };
    let (mean_u, mean_h) = (mean(&|i| displacement[i]), mean(&|i| height[i]));
    mean(&|i| (displacement[i] - mean_u) * (height[i] - mean_h)) / mean(&|i| (displacement[i] - mean_u).powi(2))
}

/// The factor `c` with which the pressure `K u / c + <p>` of a surface in place does no work on its gap; none where no mean pressure
/// is prescribed.
fn workless(ClaimedState { problem, pressure, displacement, .. }: &ClaimedState) -> Option<f64> {
    let mean = problem.mean_pressure()?;
    let apart: Vec<f64> = displacement.iter().zip(problem.height()).map(|(u, h)| u - h).collect();
    let lowest = apart.iter().copied().fold(f64::INFINITY, f64::min);
    let work: f64 = apart.iter().zip(pressure).map(|(v, p)| (v - lowest) * p).sum();
    let gap: f64 = apart.iter().map(|v| v - lowest).sum();
    Some(1.0 - work / (mean * gap))
}
