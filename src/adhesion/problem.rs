//! The problem of a contact with adhesion.

use super::attraction::Attraction;
use super::control::AdhesiveControl;
use super::method::AdhesiveMethod;
use super::scales::AdhesionScales;
use super::search::StateSearch;
use super::state::{AdhesiveMotion, AdhesiveOutcome, AdhesiveState};
use crate::contact::{Law, Load, Observer, Problem, Stop};
use crate::error::{AdhesionError, ProblemError};
use crate::grid::Grid;
use std::sync::OnceLock;

/// Process zones below this many spacings hold the edges of contacts fast: refused.
const FEWEST_SPACINGS: f64 = 2.0;

/// The largest gap or approach over the range of the attraction and the highest peak: farther away nothing is felt, and lengths would overflow.
const FARTHEST: f64 = 1e8;

/// A reduced pressure for problems whose load is not used.
const ANY: f64 = 0.01;

/// A contact with adhesion: a [`Problem`] with an [`Attraction`].
///
/// Find `g >= 0` and `p_c >= 0` with `p_c g = 0` such that the solid, under `p = p_c - sigma(g)`, has the displacement `u = A p = g + h - d`.
/// Given is the mean pressure `P = <p_c> - <sigma>`, the mean gap or the approach. The solutions are the stationary points of
///
/// `E(g) = 1/2 <p u> + <V(g)> [+ P d under a mean pressure]`.
///
/// # Methods
/// The **safe** method holds the attraction `sigma_k` fast and solves the contact without adhesion of the heights `h + A sigma_k`. The energy
/// falls in each step, since `V` is concave. Anderson's method shortens the sequence. The **fast** method takes projected Newton steps in
/// the gap by conjugate gradients, on periodic grids; where no step lowers the energy, safe steps follow. The method **gfmd** moves the surface by
/// damped dynamics on periodic grids, with the attraction as a force: see [`AdhesiveProblem::motion`].
///
/// # What is claimed
/// Each state has the largest violation of equilibrium, and on periodic grids the least curvature of the energy: a state is *stable*,
/// *marginal* or a *saddle*. It is *the solution* only at a given mean gap or approach where the attraction is less steep than the softest
/// wave of the solid is stiff, since the energy is convex then.
///
/// ```
/// use asperity::adhesion::{AdhesiveControl, AdhesiveMethod, AdhesiveOutcome, AdhesiveProblem, Attraction, AttractionForm};
/// use asperity::contact::{ContactModulus, Load, ResultClaim};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// // a sine that sticks without load: Johnson's alpha is 0.2
/// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(512, 1.0)?)?;
/// let full = std::f64::consts::PI * 0.01;
/// let work = 0.04 * 0.01 * full * std::f64::consts::FRAC_PI_2;
/// let attraction = Attraction::new(AttractionForm::Exponential, work, 1e-3)?;
/// let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(full))?;
/// let problem = AdhesiveProblem::new(problem, attraction)?;
/// let control = AdhesiveControl::MeanPressure(0.0);
/// let found = problem.solve(control, None, AdhesiveMethod::Fast, &Stop::default(), &mut ())?;
/// let AdhesiveOutcome::State(state) = found else { panic!("it sticks") };
/// assert_eq!(state.claim, ResultClaim::Stable);
/// // in the limit of a short range 0.2273 touches (Johnson 1995); at this range somewhat less
/// let part = state.relative_area() / 0.2273;
/// assert!(part > 0.8 && part < 1.0 && state.residual <= 1e-8, "{part} {}", state.residual);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct AdhesiveProblem {
    problem: Problem,
    attraction: Attraction,
    scales: AdhesionScales,
    /// The problem under a load of the other kind: an approach, or none.
    other: OnceLock<Result<Problem, ProblemError>>,
}

impl AdhesiveProblem {
    /// The problem of a surface and a solid with an attraction between them. The load of `problem` is not used.
    ///
    /// # Errors
    /// [`AdhesionError::NotElastic`] for a hardness or a contact that moves, and [`AdhesionError::Coarse`] for a process zone below two
    /// spacings.
    pub fn new(problem: Problem, attraction: Attraction) -> Result<Self, AdhesionError> {
        if problem.law() != Law::HardWall {
            return Err(AdhesionError::NotElastic { what: "hardness" });
        }
        if problem.is_moving() {
            return Err(AdhesionError::NotElastic { what: "speed" });
        }
        Self::check_grid(problem.surface().grid(), problem.contact_modulus(), &attraction)?;
        let scales = AdhesionScales::new(&problem, &attraction);
        Ok(Self { problem, attraction, scales, other: OnceLock::new() })
    }

    /// Refuses a grid on which the process zone of an attraction is below two spacings, for a solid of a contact modulus.
    ///
    /// # Errors
    /// [`AdhesionError::Coarse`], with the number of points that would do.
    pub fn check_grid(grid: &Grid, contact_modulus: f64, attraction: &Attraction) -> Result<(), AdhesionError> {
        let [zone, spacings] = AdhesionScales::zone(grid, contact_modulus, attraction);
        if spacings < FEWEST_SPACINGS {
            let points = (grid.shape()[1] as f64 * 2.0 * FEWEST_SPACINGS / spacings).ceil() as usize;
            return Err(AdhesionError::Coarse { zone, spacings, points });
        }
        Ok(())
    }

    /// The problem without adhesion.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The attraction.
    pub fn attraction(&self) -> &Attraction {
        &self.attraction
    }

    /// How the attraction compares with surface and solid.
    pub fn scales(&self) -> &AdhesionScales {
        &self.scales
    }

    /// The state under a control that is found from the last state, or, without one, from the contact without adhesion. The observer
    /// sees each step, with the contact pressure `p_c` as its pressure.
    ///
    /// The residual is at most the tolerance of `stop`, and at most 100 times as large with the safe method. Otherwise the state has the claim
    /// [`ResultClaim::NotConverged`](crate::contact::ResultClaim::NotConverged). The iterations of `stop` are those of the whole state, with the
    /// contacts without adhesion.
    ///
    /// # Errors
    /// [`AdhesionError::NotFinite`], [`AdhesionError::Far`], [`AdhesionError::MeanGap`] and [`AdhesionError::Control`] for a control that is impossible,
    /// [`AdhesionError::NotFound`] where there was no state at all, [`AdhesionError::FreeMotion`] for the method `gfmd` on a free boundary,
    /// [`AdhesionError::Stopped`] if the observer stopped the solve, and those of the contacts without adhesion.
    pub fn solve(
        &self,
        control: AdhesiveControl,
        from: Option<&AdhesiveState>,
        method: AdhesiveMethod,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveOutcome, AdhesionError> {
        let problem = self.under(control)?;
        StateSearch::new(problem, &self.attraction, control, *stop).run(from, method, observer)
    }

    /// The state under a control that the fast method finds from the last state. Its stability is not tested: it is claimed as stationary.
    ///
    /// # Errors
    /// The errors of [`AdhesiveProblem::solve`].
    pub(crate) fn probe(
        &self,
        control: AdhesiveControl,
        from: &AdhesiveState,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveOutcome, AdhesionError> {
        let problem = self.under(control)?;
        let search = StateSearch::new(problem, &self.attraction, control, *stop);
        search.without_stability().run(Some(from), AdhesiveMethod::Fast, observer)
    }

    /// The damped motion of the surface from the last state, or, without one, from the contact without adhesion, until it is at rest: the way
    /// by which [`AdhesiveMethod::Gfmd`] finds a state. Its frames show a jump as it happens.
    ///
    /// Each node is moved by the elastic force, the load and the attraction; nodes that touch and are pressed are held. Masses, time step and
    /// friction are those of [`Gfmd`](crate::contact::Gfmd).
    ///
    /// # Errors
    /// Those of [`AdhesiveProblem::solve`].
    ///
    /// ```
    /// use asperity::adhesion::{AdhesiveControl, AdhesiveMethod, AdhesiveOutcome, AdhesiveProblem, Attraction, AttractionForm};
    /// use asperity::contact::{ContactModulus, Load, ResultClaim};
    /// use asperity::{Grid, Indenter, Problem, Stop};
    /// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0)?)?;
    /// let attraction = Attraction::new(AttractionForm::Exponential, 2e-5, 1e-3)?;
    /// let problem = AdhesiveProblem::new(Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.01))?, attraction)?;
    /// let stop = Stop::default();
    /// // at a mean gap of 1.6 amplitudes nothing touches; at 1.1 amplitudes the surface jumps into contact
    /// let far = problem.solve(AdhesiveControl::MeanGap(0.016), None, AdhesiveMethod::Fast, &stop, &mut ())?;
    /// let AdhesiveOutcome::State(far) = far else { panic!("a mean gap holds the surfaces") };
    /// assert_eq!(far.relative_area(), 0.0);
    /// let motion = problem.motion(AdhesiveControl::MeanGap(0.011), Some(&far), &stop, &mut ())?;
    /// assert!(motion.frames.len() > 5 && motion.frames.iter().all(|frame| frame.claim == ResultClaim::Moving));
    /// let AdhesiveOutcome::State(near) = motion.outcome else { panic!("a mean gap holds the surfaces") };
    /// assert!(near.claim == ResultClaim::Stable && near.relative_area() > 0.08);
    /// // the jump loses energy all the way
    /// let energies: Vec<f64> = motion.frames.iter().chain([&near]).map(|state| state.potential()).collect();
    /// assert!(energies.is_sorted_by(|before, after| before > after), "{energies:?}");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn motion(
        &self,
        control: AdhesiveControl,
        from: Option<&AdhesiveState>,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveMotion, AdhesionError> {
        let problem = self.under(control)?;
        StateSearch::new(problem, &self.attraction, control, *stop).motion(from, observer)
    }

    /// The problem whose compliance suits a control: the displacement by a uniform pressure is a part of it at an approach only.
    fn under(&self, control: AdhesiveControl) -> Result<&Problem, AdhesionError> {
        let (name, value) = (control.name(), control.value());
        if !value.is_finite() {
            return Err(AdhesionError::NotFinite { name, value });
        }
        let problem = &self.problem;
        let most = FARTHEST * (self.attraction.range() + problem.highest().abs());
        if !matches!(control, AdhesiveControl::MeanPressure(_)) && value.abs() > most {
            return Err(AdhesionError::Far { name, value, most });
        }
        let is_periodic = problem.surface().grid().is_periodic();
        let refused = |reason| Err(AdhesionError::Control { control: name, reason });
        let load = match control {
            AdhesiveControl::MeanGap(_) if !is_periodic => {
                return refused("a mean gap has no meaning on a free boundary: give an approach");
            }
            AdhesiveControl::MeanGap(value) if value <= 0.0 => return Err(AdhesionError::MeanGap { value }),
            AdhesiveControl::Approach(_) if is_periodic && problem.solid().uniform_compliance().is_none() => {
                return refused("an approach has no meaning on a periodic half-space: give a mean gap");
            }
            AdhesiveControl::Approach(_) => Load::Approach(0.5 * problem.highest()),
            AdhesiveControl::MeanGap(_) | AdhesiveControl::MeanPressure(_) => Load::ReducedPressure(ANY),
        };
        let is_approach = |load: Load| matches!(load, Load::Approach(_));
        if is_approach(load) == is_approach(problem.load()) {
            return Ok(problem);
        }
        let other = self.other.get_or_init(|| problem.clone().with_load(load));
        other.as_ref().map_err(|error| error.clone().into())
    }
}
