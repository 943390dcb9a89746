//! The problem that all solvers solve.

use crate::contact::{Ceiling, Law, Load, chunks, feasible};
use crate::elastic::{Compliance, ElasticSolid, HalfSpace, Response};
use crate::error::ProblemError;
use crate::surface::{Field, Surface};
use std::sync::{Arc, OnceLock};

/// Per reduced pressure, the mean gap of rough surfaces near full contact falls by this power of e: 5 to 6, as measured.
const GAP_DECAY: f64 = 5.5;

/// At a mean gap, the initial pressure is at most this multiple of the expected one.
const FARTHEST: f64 = 1e6;

/// Largest initial pressure at a mean gap, as a fraction of the hardness.
const OF_HARDNESS: f64 = 0.5;

/// A rigid surface that is pressed on an elastic solid, without friction and adhesion, under a given pressure or force,
/// or at a given mean gap or approach.
///
/// Find `p >= 0` and a datum `d` such that the gap `g = u(p) - h + d >= 0` and `p g = 0`, with `u(p)` from
/// [`crate::elastic::Response`]. Under a [`Law`] with a hardness `H_c`, `p <= H_c` as well, and `g <= 0` where `p =
/// H_c`: there the softer body yields, and the surfaces overlap by `-g`. The gap of a [`crate::contact::Contact`] is then `max(g, 0)`, and a
/// prescribed mean gap `D` that of `g`, the distance of the mean planes, which is the mean gap of the contact less its mean overlap. Heights have zero mean except for rounding,
/// and so have displacements on a periodic grid. So the datum is the mean gap there, plus the mean of the heights, if
/// any.
///
/// | prescribed      | minimises over `p >= 0`                        | found                                   |
/// |-----------------|------------------------------------------------|-----------------------------------------|
/// | `<p>`           | `f(p) = 1/2 <p, u(p)> - <p, h>`, `<p>` as given | `d`, minus the mean of `u - h` weighted by `p` |
/// | mean gap `D`    | `f(p) + D <p>`                                 | `<p>`, with `d = D`                     |
/// | approach        | the same, with what a uniform pressure displaces kept | `<p>`, with `d` the highest peak less it |
///
/// | quantity                  | symbol  | unit     |
/// |---------------------------|---------|----------|
/// | heights                   | `h`     | length   |
/// | contact modulus           | `E*`    | pressure |
/// | mean pressure             | `<p>`   | pressure |
/// | mean gap, approach        | `D`     | length   |
///
/// Any consistent set of units can be used; tolerances are dimensionless.
///
/// ```
/// use asperity::contact::{ContactModulus, Load, PolonskyKeer, Solver};
/// use asperity::{Grid, Problem, Stop, surface::Indenter};
/// let sine = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(1024, 1.0)?)?;
/// let pressed = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(2.0))?;
/// let contact = PolonskyKeer.solve(&pressed, &Stop::default(), &mut ())?.converged()?;
/// let apart = pressed.with_load(Load::MeanGap(contact.mean_gap()))?;
/// let contact = PolonskyKeer.solve(&apart, &Stop::default(), &mut ())?.converged()?;
/// assert!((contact.mean_pressure() - 2.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Problem {
    pub(super) surface: Arc<Surface>,
    pub(super) compliance: Arc<Compliance>,
    pub(super) law: Law,
    pub(super) ceiling: Ceiling,
    pub(super) load: Load,
    /// The prescribed mean pressure, if the load determines it.
    pub(super) mean_pressure: Option<f64>,
    pub(super) expected_mean_pressure: f64,
    pub(super) rms_height: f64,
    /// Mean of the heights that a surface keeps, which is at most rounding.
    pub(super) mean_height: f64,
    pub(super) highest: f64,
    pub(super) rms_gradient: OnceLock<f64>,
    pub(super) yielded: Option<Yielded>,
    /// Mean of the heights above the mean plane of the surface that the problem was first posed for, a length.
    pub(super) shift: f64,
}

/// The history of a surface that has yielded and is elastic now.
#[derive(Debug, Clone, Copy)]
pub(super) struct Yielded {
    /// Mean of what was flattened, a length.
    pub overlap: f64,
    /// The hardness that it yielded under, a pressure.
    pub hardness: f64,
}

/// The contact modulus `E* = E / (1 - nu^2)` of an elastic half-space, a pressure: the simplest solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactModulus(pub f64);

impl From<ContactModulus> for Arc<dyn ElasticSolid> {
    fn from(ContactModulus(contact_modulus): ContactModulus) -> Self {
        HalfSpace::new(contact_modulus).into()
    }
}

impl Problem {
    /// Makes the problem of a surface that is pressed by a load on a solid: a half-space of a [`ContactModulus`], or
    /// any other [`ElasticSolid`]. A mean gap must lie between 0 and the highest peak above the mean height.
    ///
    /// # Errors
    /// [`ProblemError::NotPositive`] for a modulus or load that is not positive and finite, [`ProblemError::Flat`] if all
    /// heights are equal, [`ProblemError::OutOfRange`] for magnitudes whose squares leave the range of doubles,
    /// [`ProblemError::NothingTouches`] or [`ProblemError::EverythingTouches`] for a mean gap at which there is nothing to
    /// solve, [`ProblemError::GapOfFree`] or [`ProblemError::ApproachOfHalfSpace`] for a load that the boundary leaves without a
    /// datum, and [`ProblemError::Grid`] for a solid that cannot be below this grid.
    pub fn new(
        surface: impl Into<Arc<Surface>>,
        solid: impl Into<Arc<dyn ElasticSolid>>,
        load: Load,
    ) -> Result<Self, ProblemError> {
        let (surface, solid) = (surface.into(), solid.into());
        check_magnitude("contact modulus", solid.contact_modulus())?;
        let rms_height = checked_rms_height(&surface)?;
        let compliance = Compliance::new(surface.grid(), solid, load.keeps_uniform())?;
        Self::posed(surface, rms_height, compliance.into(), load)
    }

    /// The problem of a surface on a solid whose compliance on its grid is given.
    pub(crate) fn of_compliance(
        surface: Arc<Surface>,
        compliance: Arc<Compliance>,
        load: Load,
    ) -> Result<Self, ProblemError> {
        let rms_height = checked_rms_height(&surface)?;
        Self::posed(surface, rms_height, compliance, load)
    }

    /// The problem of a surface with its rms height.
    fn posed(
        surface: Arc<Surface>,
        rms_height: f64,
        compliance: Arc<Compliance>,
        load: Load,
    ) -> Result<Self, ProblemError> {
        let height = surface.heights();
        let mean_height = chunks::compensated_mean(height);
        let highest = height.iter().fold(0.0, |highest: f64, &h| highest.max(h)) - mean_height;
        let (mean_pressure, expected_mean_pressure, rms_gradient) = (None, f64::NAN, OnceLock::new());
        for stiffness in compliance.stiffness_range().into_iter().filter(|_| !compliance.solid().is_half_space()) {
            check_magnitude("stiffness of the solid for a wave", stiffness)?;
        }
        Self {
            surface,
            compliance,
            law: Law::HardWall,
            ceiling: Ceiling::Uniform(f64::INFINITY),
            load,
            mean_pressure,
            expected_mean_pressure,
            rms_height,
            mean_height,
            highest,
            rms_gradient,
            yielded: None,
            shift: 0.0,
        }
        .with_load(load)
    }

    /// The problem of the same surface and solid under another load.
    ///
    /// # Errors
    /// The errors of [`Problem::new`] that concern the load, and [`ProblemError::AboveHardness`].
    pub fn with_load(mut self, load: Load) -> Result<Self, ProblemError> {
        if load.keeps_uniform() != self.load.keeps_uniform() {
            self.compliance = Arc::new(self.compliance.on_grid(self.surface.grid(), load.keeps_uniform())?);
        }
        let mean_pressure = match load {
            Load::MeanPressure(mean_pressure) => Some(mean_pressure),
            Load::ReducedPressure(reduced_pressure) => {
                check_magnitude("reduced pressure", reduced_pressure)?;
                Some(reduced_pressure * self.rms_gradient() * self.contact_modulus())
            }
            Load::Force(force) => {
                check_magnitude("force", force)?;
                Some(force / self.surface.grid().area())
            }
            Load::MeanGap(mean_gap) => {
                self.check_mean_gap(mean_gap)?;
                None
            }
            Load::Approach(approach) => {
                self.check_approach(approach)?;
                None
            }
        };
        mean_pressure.map_or(Ok(()), |mean_pressure| check_magnitude("mean pressure", mean_pressure))?;
        Self { load, mean_pressure, ..self }.below_ceiling()
    }

    /// The problem with another compliance on the same grid.
    pub(super) fn with_compliance(self, compliance: Compliance) -> Result<Self, ProblemError> {
        for stiffness in compliance.stiffness_range() {
            check_magnitude("stiffness of the solid for a wave", stiffness)?;
        }
        Ok(Self { compliance: Arc::new(compliance), ..self })
    }

    /// The problem with the expected mean pressure, which the law must allow. A mean pressure that is above the hardness by rounding
    /// alone is the hardness.
    pub(super) fn below_ceiling(self) -> Result<Self, ProblemError> {
        let hardness = self.ceiling.mean(self.nodes());
        let mean_pressure = match self.mean_pressure {
            Some(mean_pressure) if Ceiling::excess(mean_pressure / hardness) > 0.0 => {
                return Err(ProblemError::AboveHardness { mean_pressure, hardness });
            }
            mean_pressure => mean_pressure.map(|it| it.min(hardness)),
        };
        let expected_mean_pressure = match mean_pressure {
            Some(mean_pressure) => mean_pressure,
            None => self.datum().map_or(f64::NAN, |datum| self.pressure_at(datum)).min(OF_HARDNESS * hardness),
        };
        Ok(Self { mean_pressure, expected_mean_pressure, ..self })
    }

    fn check_approach(&self, approach: f64) -> Result<(), ProblemError> {
        let is_half_space = self.solid().uniform_compliance().is_none();
        if self.surface.grid().is_periodic() && is_half_space {
            return Err(ProblemError::ApproachOfHalfSpace { approach });
        }
        check_magnitude("approach", approach)?;
        // a layer that cannot be compressed keeps its volume, so that the approach is a mean gap
        let (mean_gap, highest) = (self.highest - approach, self.highest);
        match self.compliance.has_uniform() || mean_gap > 0.0 {
            true => Ok(()),
            false => Err(ProblemError::EverythingTouches { mean_gap, highest }),
        }
    }

    fn check_mean_gap(&self, mean_gap: f64) -> Result<(), ProblemError> {
        let highest = self.highest;
        if !self.surface.grid().is_periodic() {
            return Err(ProblemError::GapOfFree { mean_gap });
        }
        if mean_gap.is_finite() && mean_gap <= 0.0 {
            return Err(ProblemError::EverythingTouches { mean_gap, highest });
        }
        check_magnitude("mean gap", mean_gap)?;
        if mean_gap < highest { Ok(()) } else { Err(ProblemError::NothingTouches { mean_gap, highest }) }
    }

    /// A rough estimate of the mean pressure at a mean gap, or another datum of the gap. Far apart, half of the nodes above it touch, and the share of the
    /// area that touches is twice the reduced pressure. Close together, the gap falls exponentially with the pressure, as
    /// measured on rough lines and surfaces down to a thousandth of the rms height.
    fn pressure_at(&self, mean_gap: f64) -> f64 {
        let above = self.height().iter().filter(|&&h| h > mean_gap).count();
        let far = 0.25 * above as f64 / self.nodes() as f64;
        let close = (self.rms_height / mean_gap).ln() / GAP_DECAY;
        far.max(close) * self.rms_gradient() * self.contact_modulus()
    }

    /// The rigid surface.
    pub fn surface(&self) -> &Arc<Surface> {
        &self.surface
    }

    /// Contact modulus `E*`.
    pub fn contact_modulus(&self) -> f64 {
        self.solid().contact_modulus()
    }

    /// The solid.
    pub fn solid(&self) -> &Arc<dyn ElasticSolid> {
        self.compliance.solid()
    }

    /// The law of the contact; a hard wall where each node has a ceiling of its own.
    pub fn law(&self) -> Law {
        self.law
    }

    /// The highest allowed pressure of each node.
    pub fn ceiling(&self) -> &Ceiling {
        &self.ceiling
    }

    /// Whether a node yields under a pressure, row by row; none does on a hard wall.
    pub(super) fn yields(&self, pressure: &[f64]) -> bool {
        self.law.hardness().is_some() && pressure.iter().any(|&p| self.law.yields(p))
    }

    /// The highest allowed pressure, or the one that was allowed when the surface yielded; infinite if nothing yields.
    pub(super) fn highest_pressure(&self) -> f64 {
        self.yielded.map_or(self.law.ceiling(), |it| it.hardness)
    }

    /// The decrease of the mean of the heights since the surface yielded, a length.
    pub(super) fn flattened_by(&self) -> f64 {
        self.yielded.map_or(0.0, |it| it.overlap)
    }

    /// The response of the solid on the grid, newly planned. Displacements on a periodic grid have no mean, unless the
    /// approach is prescribed.
    pub fn response(&self) -> Response {
        Response::from_compliance(self.compliance.clone())
    }

    /// The compliance of the solid on the grid, to be shared.
    pub(super) fn shared_compliance(&self) -> &Arc<Compliance> {
        &self.compliance
    }

    /// The compliance of the solid on the grid.
    pub fn compliance(&self) -> &Compliance {
        &self.compliance
    }

    /// The datum `d` of the gap `u - h + d`, where it is prescribed: the mean gap, or the highest peak less the approach, both from the
    /// mean of the heights.
    pub fn datum(&self) -> Option<f64> {
        match self.load {
            Load::MeanGap(mean_gap) => Some(mean_gap - self.shift + self.mean_height),
            Load::Approach(approach) => Some(self.highest - approach - self.shift + self.mean_height),
            Load::MeanPressure(_) | Load::ReducedPressure(_) | Load::Force(_) => None,
        }
    }

    /// The mean of the heights, which is at most rounding.
    pub(super) fn mean_height(&self) -> f64 {
        self.mean_height
    }

    /// Mean of the heights above the mean plane of the surface that the problem was first posed for.
    pub(crate) fn shift(&self) -> f64 {
        self.shift
    }

    /// The load, as it was given.
    pub fn load(&self) -> Load {
        self.load
    }

    /// The mean pressure, if it is prescribed directly, as a reduced pressure or as a force.
    pub fn mean_pressure(&self) -> Option<f64> {
        self.mean_pressure
    }

    /// The mean gap, if it is prescribed.
    pub fn mean_gap(&self) -> Option<f64> {
        match self.load {
            Load::MeanGap(mean_gap) => Some(mean_gap),
            _ => None,
        }
    }

    /// The mean pressure that is prescribed or, at a given mean gap or approach, that of `pressure`.
    pub fn mean_pressure_of(&self, pressure: &[f64]) -> f64 {
        self.mean_pressure.unwrap_or_else(|| chunks::sum(pressure.len(), |i| pressure[i]) / pressure.len() as f64)
    }

    /// The initial pressure of a run: `start`, or the uniform pressure. It is scaled to the mean pressure, if that is
    /// given; it is also scaled to the expected one, if it is so large that rounding would hide its displacement.
    /// Negative and non-finite values become 0, and none is above its ceiling.
    ///
    /// # Panics
    /// If the shape of `start` is not that of the grid.
    pub fn first_pressure(&self, start: Option<&Field>) -> Vec<f64> {
        let load = self.expected_mean_pressure;
        let mut pressure = start.map_or_else(|| vec![load; self.nodes()], |start| self.start_of(start));
        if matches!(self.ceiling, Ceiling::Field(_)) || start.is_some() && self.ceiling.is_finite() {
            let ceiling = &self.ceiling;
            chunks::update(&mut pressure, |range, p| range.zip(p).for_each(|(i, p)| *p = p.min(ceiling.at(i))));
            let load = self.mean_pressure.map(|mean| mean * pressure.len() as f64);
            load.map(|load| feasible::carry(&mut pressure, load, ceiling));
        }
        pressure
    }

    /// The pressure that a run on a hard wall starts from.
    fn start_of(&self, start: &Field) -> Vec<f64> {
        let load = self.expected_mean_pressure;
        assert_eq!(start.shape(), self.surface.grid().shape(), "the start must fit the grid");
        let pressure: Vec<f64> = start.iter().map(|&p| if p.is_finite() { p.max(0.0) } else { 0.0 }).collect();
        let highest = chunks::visit(pressure.len(), |range| range.fold(0.0, |high: f64, i| high.max(pressure[i])));
        let highest = highest.into_iter().fold(0.0, f64::max);
        if highest <= 0.0 {
            return vec![load; pressure.len()];
        }
        let mean = chunks::sum(pressure.len(), |i| pressure[i] / highest) / pressure.len() as f64;
        if self.mean_pressure.is_none() && highest * mean <= FARTHEST * load {
            return pressure;
        }
        pressure.into_iter().map(|p| p / highest * (load / mean)).collect()
    }

    /// The mean pressure to start from: the one that is prescribed or, at a given mean gap, an estimate that may be several
    /// times too large or small, but is positive and finite.
    pub fn expected_mean_pressure(&self) -> f64 {
        self.expected_mean_pressure
    }

    /// Heights about their mean, row by row: those of the surface.
    pub fn height(&self) -> &[f64] {
        self.surface.heights()
    }

    /// Root mean square of the heights about their mean.
    pub fn rms_height(&self) -> f64 {
        self.rms_height
    }

    /// The highest peak above the mean height. At a larger mean gap the surfaces do not touch.
    pub fn highest(&self) -> f64 {
        self.highest
    }

    /// Root-mean-square gradient `gbar` of the whole surface (before it yielded, if it has); computed on first use.
    pub fn rms_gradient(&self) -> f64 {
        *self.rms_gradient.get_or_init(|| self.surface.rms_gradient())
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.surface.grid().len()
    }
}

/// The rms height of a surface that is not flat, whose lengths are in range.
fn checked_rms_height(surface: &Surface) -> Result<f64, ProblemError> {
    let height = surface.heights();
    if height.iter().all(|&h| h == height[0]) {
        return Err(ProblemError::Flat { height: height[0] + surface.mean_height() });
    }
    let rms_height = (chunks::sum(height.len(), |i| height[i].powi(2)) / height.len() as f64).sqrt();
    check_magnitude("rms height", rms_height)?;
    check_magnitude("length of the cell", surface.grid().longest_wavelength())?;
    Ok(rms_height)
}

pub(super) fn check_magnitude(name: &'static str, value: f64) -> Result<(), ProblemError> {
    if !(value.is_finite() && value > 0.0) {
        return Err(ProblemError::NotPositive { name, value });
    }
    if (1e-100..=1e100).contains(&value) { Ok(()) } else { Err(ProblemError::OutOfRange { name, value }) }
}
