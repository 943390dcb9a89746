//! Partial slip under a tangential load.

use crate::contact::{Contact, Load, Observer, Problem, Resolved, Solver, Stop};
use crate::error::SlipError;
use crate::surface::Field;
use serde::{Deserialize, Serialize};

/// A tangential load and the friction that carries it.
///
/// ```
/// use asperity::contact::{Friction, Load};
/// let friction = Friction { coefficient: 0.5, tangential: 0.3 };
/// assert_eq!(friction.ratio(Load::MeanPressure(1.0))?, 0.6);
/// assert!(friction.ratio(Load::MeanPressure(0.6)).is_err()); // it slides
/// # Ok::<(), asperity::error::SlipError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Friction {
    /// Coulomb's coefficient of friction `mu`.
    pub coefficient: f64,
    /// The tangential load `Q`, of the same kind as the normal one: a mean traction with a mean pressure, a mean
    /// traction divided by `gbar E*` with a reduced pressure, and a force (for a line, per length) with a force.
    /// Zero where a history has its own.
    #[serde(default, skip_serializing_if = "is_zero", deserialize_with = "crate::quantity::pressure")]
    pub tangential: f64,
}

fn is_zero(tangential: &f64) -> bool {
    *tangential == 0.0
}

impl Friction {
    /// Checks that both are positive and finite.
    ///
    /// # Errors
    /// [`SlipError::Coefficient`] and [`SlipError::NotPositive`].
    pub fn check(&self) -> Result<(), SlipError> {
        self.check_coefficient()?;
        let value = self.tangential;
        if value > 0.0 && value.is_finite() {
            return Ok(());
        }
        Err(SlipError::NotPositive { name: "tangential load", value })
    }

    /// Checks that the coefficient is positive and finite.
    ///
    /// # Errors
    /// [`SlipError::Coefficient`].
    pub fn check_coefficient(&self) -> Result<(), SlipError> {
        let value = self.coefficient;
        if value > 0.0 && value.is_finite() { Ok(()) } else { Err(SlipError::Coefficient { value }) }
    }

    /// The ratio `Q/(mu P)` of the tangential load to that at which everything slides.
    ///
    /// # Errors
    /// The errors of [`Friction::check`], [`SlipError::NeedsPressure`] for a load that is no pressure, and [`SlipError::Sliding`]
    /// for a tangential load that friction cannot carry.
    pub fn ratio(&self, load: Load) -> Result<f64, SlipError> {
        self.check()?;
        if !load.is_pressure() {
            return Err(SlipError::NeedsPressure { load: load.to_string() });
        }
        let Self { coefficient, tangential } = *self;
        let limit = coefficient * load.value();
        if tangential < limit { Ok(tangential / limit) } else { Err(SlipError::Sliding { tangential, limit }) }
    }
}

/// A contact under the normal load `P` and then the tangential load `Q < mu P` along `x`: a part of it sticks, the rest
/// slips.
///
/// By Ciavarella and by Jäger, the traction is the difference of two normal contacts,
///
/// `tau = mu [p(P) - p(P - Q/mu)]`,
///
/// and the stick area is the contact area under the smaller load: there the traction is below `mu p`. In the slip area
/// `tau = mu p`.
///
/// | grid    | it is exact                                                                                             |
/// |---------|---------------------------------------------------------------------------------------------------------|
/// | line    | if normal and tangential loads do not couple (Dundurs' `beta = 0`): bodies of the same material, or both incompressible, or one of them beside a rigid one |
/// | surface | if Poisson's ratio is 0 as well; else it leaves out tractions across `Q`, which are small               |
///
/// On a half-space of Poisson's ratio `nu` below a rigid surface `beta = (1 - 2 nu)/(2 (1 - nu))`, which is 0.29 at `nu = 0.3`; the
/// solution is that of the usual uncoupled theory then.
///
/// # Source
/// Ciavarella, J. Appl. Mech. 65, 998 (1998); Jäger, J. Tribol. 120, 677 (1998); Cattaneo (1938) and Mindlin (1949) for circles.
///
/// ```
/// use asperity::contact::{ContactModulus, Friction, Load, Multilevel, PartialSlip, Solver};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(4096, 4.0)?)?;
/// let problem = Problem::new(cylinder, ContactModulus(1.0), Load::MeanPressure(1e-3))?;
/// let pressed = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
/// let friction = Friction { coefficient: 0.5, tangential: 0.36e-3 };
/// let slip = PartialSlip::solve(pressed, friction, &Multilevel, &Stop::default(), &mut ())?;
/// // Cattaneo and Mindlin: the width that sticks is sqrt(1 - Q/(mu P)) of the width that touches
/// assert!((slip.stick().relative_area / slip.touching().relative_area - 0.28f64.sqrt()).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct PartialSlip {
    /// Friction and tangential load.
    pub friction: Friction,
    /// The tangential load divided by that at which everything slides, `Q/(mu P)`.
    pub ratio: f64,
    /// The contact under the normal load `P`.
    pub pressed: Contact,
    /// The contact under the smaller load `P - Q/mu`: it touches where the other one sticks.
    pub stuck: Contact,
}

impl PartialSlip {
    /// Solves the contact under the smaller load from the one under the normal load.
    ///
    /// # Errors
    /// The errors of [`Friction::ratio`], of [`Problem::with_load`] and of [`Solver::solve_from`].
    pub fn solve(
        pressed: Contact,
        friction: Friction,
        solver: &dyn Solver,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Self, SlipError> {
        let load = pressed.problem.load();
        let ratio = friction.ratio(load)?;
        let lighter: Problem = pressed.problem.clone().with_load(load.with_value(load.value() * (1.0 - ratio)))?;
        let stuck = solver.solve_from(Some(&pressed.pressure), &lighter, stop, observer)?;
        Ok(Self { friction, ratio, pressed, stuck })
    }

    /// The traction `tau` along `x` on the surface of the solid, shape `(ny, nx)`; its mean is the tangential load.
    pub fn traction(&self) -> Field {
        (&self.pressed.pressure - &self.stuck.pressure) * self.friction.coefficient
    }

    /// Nodes that stick.
    pub fn sticks(&self) -> ndarray::Array2<bool> {
        self.stuck.mask()
    }

    /// Area and gradient of the stick area, with edges interpolated between the nodes.
    pub fn stick(&self) -> Resolved {
        self.stuck.resolved()
    }

    /// Area and gradient of the whole contact, with edges interpolated between the nodes.
    pub fn touching(&self) -> Resolved {
        self.pressed.resolved()
    }

    /// The slip area divided by the area of the cell.
    pub fn slip_area(&self) -> f64 {
        self.touching().relative_area - self.stick().relative_area
    }
}
