//! Partial slip with a history.

use super::discs::{Discs, Pair};
use super::slip_coupling::{SlipCoupling, SlipRounds};
use super::slip_round::{SlipRound, SlipTask, values};
use super::slip_state::SlipState;
use super::slip_traction::{Traction, better_shift, sliding_length};
use super::slip_vector::VectorStep;
use crate::chunks;
use crate::clock::Instant;
use crate::contact::{Certificate, Contact, Load, Observer, Problem, ResultClaim, Solver, Status, Stop, Work};
use crate::elastic::{Compliance, Coupling, Response, ShearCompliance, ShearResponse};
use crate::error::SlipError;
use crate::surface::{Field, Surface};
use std::sync::Arc;

/// A contact with Coulomb friction under normal and tangential loads, one pair after the other: the traction after a step depends on
/// those before.
///
/// A step finds the pressure `p` under the normal load, and then the traction `tau` with the given mean, from the traction `tau_0` before
/// the step:
///
/// ```text
/// slip   s = A_t (tau - tau_0) - beta S (p - p_0) - delta
/// law    |tau| <= mu p,   s = 0 where |tau| < mu p,   s against tau elsewhere
/// ```
///
/// For a given `p` these are the conditions of the minimum of `1/2 <tau A_t tau> - <tau w_0>` over `|tau| <= mu p` with `<tau>` given, where
/// `w_0 = A_t tau_0 + beta S (p - p_0)`.
///
/// | grid                       | traction       | the step is solved                                                        |
/// |----------------------------|----------------|---------------------------------------------------------------------------|
/// | line                       | along `x`      | by the solver of the history                                              |
/// | surface with `m = 0`       | along `x`, until a load across is given | by the solver of the history                     |
/// | other surface              | along `x`, `y` | by Newton steps on the nodes that stick and slip                          |
///
/// **Along `x` alone**, `t = tau + mu p` is the pressure of a [`Problem`] with the heights `w_0 + mu A_t p`, below a
/// [ceiling](crate::contact::Ceiling) `2 mu p` of each node. Every solver that takes a hardness solves it. `A_t` is
/// [`Compliance::tangential`].
///
/// **Along both axes**, the traction of each node lies in a disc, and `A_t` is that of [`ShearCompliance`]. A node that sticks has two unknowns.
/// One that slips has the angle of `tau = mu p (cos a, sin a)`; its equation says that the slip has no part across the traction, and
/// `|s|/(mu p)` is added to the diagonal of `A_t`. Sets of nodes are exchanged as a whole. The linear equations of a set are solved by
/// conjugate gradients, with the shift as the multiplier of the mean. Where the energy does not fall, or the certificate falls too slowly, a
/// step goes along the projected gradient to the least energy on its chord. These steps alone converge, since the energy is convex.
///
/// Both kinds of steps have a [`SlipCertificate`](crate::history::SlipCertificate). A step must end where the tangential load turns. Where
/// the pressure of a node falls to zero, its traction is lost.
///
/// # Coupling
/// With Dundurs' `beta = 0`, as for two bodies of the same material, the normal contact is solved once in a step. A path along which every node
/// slips in one direction only is then solved exactly in one step. Otherwise the pressure displaces the surface along `x` and `y` by `-beta S p`,
/// and the traction displaces it into the solid by `beta S tau`, see [`Coupling`] and [`SlipHistory::with_coupling`]. Pressure and traction
/// are solved in turn (Panagiotopoulos 1975), until the pressure fits the heights with the last traction to the tolerance. No bound of the
/// joint error is known. Normal loads cause slip as well, so a path needs steps: a node that comes into contact sticks where it is then.
///
/// # Source
/// Cattaneo (1938); Mindlin & Deresiewicz, J. Appl. Mech. 20, 327 (1953); the minimum is that of Kalker, *Three-Dimensional Elastic Bodies
/// in Rolling Contact* (1990), chapter 4. The Newton step on discs is derived here.
///
/// ```
/// use asperity::contact::{ContactModulus, Load, Multilevel};
/// use asperity::history::SlipHistory;
/// use asperity::{Grid, Indenter, Problem, Stop};
/// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(2048, 4.0)?.with_periodic([false; 2]))?;
/// let load = Load::MeanPressure(1e-3);
/// let problem = Problem::new(cylinder, ContactModulus(1.0), load)?;
/// let mut history = SlipHistory::new(problem, 0.5, &Multilevel, Stop::default())?;
/// // pull, push back, pull again, by half of what friction can carry
/// let pulls = [0.25e-3, -0.25e-3, 0.25e-3];
/// let states = pulls.map(|pull| history.step(load, pull, &mut ()));
/// let [_, back, again] = states.map(|state| state.unwrap());
/// // friction dissipates the same energy on both ways of a cycle, and the width that sticks is that of Mindlin
/// assert!((back.dissipated / again.dissipated - 1.0).abs() < 1e-6);
/// assert!((back.stick_share() - 0.5f64.sqrt()).abs() < 0.03);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct SlipHistory<'s> {
    problem: Problem,
    coefficient: f64,
    compliance: Arc<Compliance>,
    solver: &'s dyn Solver,
    stop: Stop,
    m: f64,
    /// What makes steps along both axes.
    shear: Option<ShearResponse>,
    /// The contact of the last step, with the displacement `A_t p` along `x` by tractions `p` along `x`.
    pressed: Option<(Contact, Vec<f64>)>,
    /// The traction along `x` and `y`; the second one is empty in steps along `x` alone.
    traction: [Vec<f64>; 2],
    /// The displacement along `x` and `y` by the traction and, with coupling, by the pressure.
    displaced: [Vec<f64>; 2],
    coupling: Option<SlipCoupling>,
}

impl<'s> SlipHistory<'s> {
    /// A history that begins without any load. The load of `problem` is not used. The coefficient of friction `mu` may be zero.
    ///
    /// # Errors
    /// [`SlipError::Coefficient`] for a coefficient that is negative or not finite, [`SlipError::Yielding`] for a problem with a hardness,
    /// and the errors of [`Compliance::tangential`].
    pub fn new(problem: Problem, coefficient: f64, solver: &'s dyn Solver, stop: Stop) -> Result<Self, SlipError> {
        Self::sheared(problem, coefficient, 0.0, solver, stop)
    }

    /// The history on bodies of the ratio `m = sum (nu/G) / sum ((1 - nu)/G)`, which matters on surfaces: see
    /// [`ShearCompliance`].
    ///
    /// # Errors
    /// The errors of [`SlipHistory::new`] and of [`ShearCompliance::new`].
    pub fn sheared(
        problem: Problem,
        coefficient: f64,
        m: f64,
        solver: &'s dyn Solver,
        stop: Stop,
    ) -> Result<Self, SlipError> {
        if !(coefficient >= 0.0 && coefficient.is_finite()) {
            return Err(SlipError::Coefficient { value: coefficient });
        }
        if !problem.law().is_hard_wall() {
            return Err(SlipError::Yielding);
        }
        let compliance = Compliance::tangential(problem.surface().grid(), problem.solid().clone(), m)?;
        let zeros = || vec![0.0; problem.nodes()];
        let compliance = Arc::new(compliance);
        let [traction, displaced] = [[zeros(), Vec::new()], [zeros(), Vec::new()]];
        let (shear, pressed, coupling) = (None, None, None);
        let mut history =
            Self { problem, coefficient, compliance, solver, stop, m, shear, pressed, traction, displaced, coupling };
        if m != 0.0 && !history.problem.surface().grid().is_line() {
            history.take_both_axes()?;
        }
        Ok(history)
    }

    /// The history before its first step on bodies of Dundurs' constant `beta`, between -0.5 and 0.5, which is
    /// `(1 - 2 nu)/(2 (1 - nu))` for a body below a rigid surface. A surface takes steps along both axes then.
    ///
    /// # Errors
    /// [`SlipError::Beta`] for a constant out of range, and the errors of [`Coupling::new`] and of [`ShearCompliance::new`].
    ///
    /// ```
    /// use asperity::contact::{ContactModulus, Load, Multilevel, ResultClaim};
    /// use asperity::history::SlipHistory;
    /// use asperity::{Grid, Indenter, Problem, Stop};
    /// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(256, 1.0)?.with_periodic([false; 2]))?;
    /// let load = Load::MeanPressure(0.01);
    /// let problem = Problem::new(cylinder, ContactModulus(1.0), load)?;
    /// let mut history = SlipHistory::new(problem, 0.2, &Multilevel, Stop::default())?.with_coupling(0.3)?;
    /// // the pressure alone draws the solid towards the middle, and friction holds it on both sides
    /// let state = history.step(load, 0.0, &mut ())?;
    /// assert!(state.traction[[0, 118]] < 0.0 && state.traction[[0, 138]] > 0.0);
    /// assert_eq!(state.claim, ResultClaim::RoundsConverged);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_coupling(mut self, beta: f64) -> Result<Self, SlipError> {
        if !(-0.5..=0.5).contains(&beta) {
            return Err(SlipError::Beta { value: beta });
        }
        if beta == 0.0 {
            return Ok(self);
        }
        let grid = *self.problem.surface().grid();
        if !grid.is_line() && self.shear.is_none() {
            self.take_both_axes()?;
        }
        let coupling = Coupling::new(&grid, self.problem.solid().as_ref())?;
        self.coupling = Some(SlipCoupling::new(beta, coupling, grid.len()));
        Ok(self)
    }

    /// Takes steps along both axes from now on.
    fn take_both_axes(&mut self) -> Result<(), SlipError> {
        let (grid, solid) = (self.problem.surface().grid(), self.problem.solid().clone());
        self.shear = Some(ShearResponse::new(Arc::new(ShearCompliance::new(grid, solid, self.m)?)));
        let nodes = self.problem.nodes();
        self.traction[1].resize(nodes, 0.0);
        self.displaced[1].resize(nodes, 0.0);
        Ok(())
    }

    /// The next state: under the normal load `load` and the tangential load `tangential` along `x`, of the same kind as the normal one
    /// and of any sign, with no load along `y`. The observer sees the steps of the normal solve, and those of the traction where it is along
    /// `x` alone.
    ///
    /// # Errors
    /// The errors of [`SlipHistory::step_towards`].
    pub fn step(&mut self, load: Load, tangential: f64, observer: &mut dyn Observer) -> Result<SlipState, SlipError> {
        self.step_towards(load, [tangential, 0.0], observer)
    }

    /// The next state, with a tangential load along `x` and one along `y`, of the same kind as the normal one.
    ///
    /// # Errors
    /// [`SlipError::NeedsPressure`] for a normal load that is no pressure, [`SlipError::Sliding`] for a tangential load that friction cannot
    /// carry, the errors of [`ShearCompliance::new`] for a load along `y` on a line, and those of [`Problem::with_load`] and of
    /// [`Solver::solve_from`]. After an error the history is as it was before the step.
    ///
    /// ```
    /// use asperity::contact::{ContactModulus, Load, Multilevel};
    /// use asperity::history::SlipHistory;
    /// use asperity::{Grid, Indenter, Problem, Stop};
    /// let grid = Grid::surface([32, 32], [2.0, 2.0])?.with_periodic([false; 2]);
    /// let load = Load::Force(1.0);
    /// let problem = Problem::new(Indenter::Sphere { radius: 1.0 }.surface(grid)?, ContactModulus(2.0), load)?;
    /// // one body of Poisson's ratio 1/3: m = 1/2. Pulled along x, then along y
    /// let mut history = SlipHistory::sheared(problem, 0.5, 0.5, &Multilevel, Stop::default())?;
    /// let first = history.step_towards(load, [0.3, 0.0], &mut ())?;
    /// let turned = history.step_towards(load, [0.0, 0.3], &mut ())?;
    /// assert!(first.shift > 0.0 && first.shift_across.abs() < 1e-6 * first.shift);
    /// assert!(turned.shift < 0.0 && turned.shift_across > 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn step_towards(
        &mut self,
        load: Load,
        tangential: [f64; 2],
        observer: &mut dyn Observer,
    ) -> Result<SlipState, SlipError> {
        let share = self.share(load, tangential)?;
        if tangential[1] != 0.0 && self.shear.is_none() {
            self.take_both_axes()?;
        }
        let mut rounds = SlipRounds::new(self.coefficient, self.coupling.as_ref());
        let mut last: Option<SlipRound> = None;
        let mut work = Work::default();
        loop {
            let mut round = self.round(load, share, (&rounds, last.as_ref()), observer)?;
            work += round.work;
            let Some(coupling) = &mut self.coupling else { return Ok(self.take(round, (rounds.number(), work))) };
            let raised = coupling.by_traction(&round.found.values);
            let problem = self.problem.clone().with_load(load)?;
            let certificate = Certificate::new(&posed(&problem, &raised)?, values(&round.contact.pressure));
            let number = rounds.number();
            let fits = certificate.eta <= self.stop.tolerance() || !round.contact.is_converged();
            if fits || !rounds.advance(&raised) {
                round.contact = round.contact.displaced_by(problem, &raised, certificate);
                if !fits {
                    round.contact.status = Status::Stalled;
                }
                coupling.keep(raised);
                return Ok(self.take(round, (number, work)));
            }
            last = Some(round);
        }
    }

    /// When a solve of a round ends: with coupling before the tolerance of the step, so that the last rounds do not end with the old pressure.
    fn round_stop(&self) -> Stop {
        if self.coupling.is_some() { finer(self.stop, ROUND) } else { self.stop }
    }

    /// The pressure under the heights of a round, and the traction under this pressure.
    fn round(
        &mut self,
        load: Load,
        share: Pair,
        (rounds, last): (&SlipRounds, Option<&SlipRound>),
        observer: &mut dyn Observer,
    ) -> Result<SlipRound, SlipError> {
        let (mut contact, pressed, pressing) = self.press(load, rounds, last, observer)?;
        let mut before = self.displaced.clone();
        if let Some(coupling) = &mut self.coupling {
            coupling.add_by_pressure(values(&contact.pressure), &mut before, 1.0);
        }
        let full = self.coefficient * contact.mean_pressure();
        let target = share.map(|share| share * full);
        let start = last.map_or(&self.traction, |round| &round.found.values).clone();
        let task = SlipTask { contact: &contact, pressed: &pressed, target, before: &before, start: &start };
        let found = match self.coefficient {
            0.0 => Traction::none(self.traction.each_ref().map(Vec::len)),
            _ if self.shear.is_some() => self.pull_towards(&task, observer),
            _ => self.pull(&task, observer)?,
        };
        let work = pressing + found.work;
        if found.status != Status::Converged && contact.is_converged() {
            contact.status = found.status;
        }
        Ok(SlipRound { contact, pressed, before, found, target, work })
    }

    /// Ends a step with its last round, after which this history goes on from it.
    fn take(&mut self, round: SlipRound, (rounds, mut work): (usize, Work)) -> SlipState {
        work.transforms += self.coupling.as_mut().map_or(0, SlipCoupling::transforms);
        let earlier = self.pressed.as_ref().map(|(contact, _)| contact);
        let claim = if self.coupling.is_some() { ResultClaim::RoundsConverged } else { ResultClaim::Solution };
        let state = round.state(self.coefficient, earlier, claim, (rounds, work));
        self.displaced = round.found.displacement;
        if let Some(coupling) = &mut self.coupling {
            coupling.add_by_pressure(values(&round.contact.pressure), &mut self.displaced, -1.0);
        }
        self.traction = round.found.values;
        self.pressed = Some((round.contact, round.pressed));
        state
    }

    /// The shares `Q / (mu P)` of the load at which everything slides, with their signs.
    fn share(&self, load: Load, tangential: [f64; 2]) -> Result<[f64; 2], SlipError> {
        if !load.is_pressure() {
            return Err(SlipError::NeedsPressure { load: load.to_string() });
        }
        let (limit, most) = (self.coefficient * load.value(), tangential[0].hypot(tangential[1]));
        let is_carried = most < limit || most == 0.0;
        if !is_carried {
            let tangential = if tangential[1] == 0.0 { tangential[0] } else { most };
            return Err(SlipError::Sliding { tangential, limit });
        }
        Ok(tangential.map(|tangential| if tangential == 0.0 { 0.0 } else { tangential / limit }))
    }

    /// The contact under a normal load, with `A_t` of its pressure: that of the last step if load and heights are the same.
    fn press(
        &self,
        load: Load,
        rounds: &SlipRounds,
        last: Option<&SlipRound>,
        observer: &mut dyn Observer,
    ) -> Result<(Contact, Vec<f64>, Work), SlipError> {
        let before = self.pressed.as_ref();
        let is_coupled = self.coupling.is_some();
        if let Some((contact, pressed)) = before.filter(|(it, _)| !is_coupled && it.problem.load() == load) {
            let mut contact = contact.clone();
            contact.work = Work::default();
            return Ok((contact, pressed.clone(), Work::default()));
        }
        let problem = posed(&self.problem.clone().with_load(load)?, rounds.raised())?;
        let start = last.map(|round| &round.contact).or(before.map(|(contact, _)| contact));
        let start = start.map(|contact| &contact.pressure);
        let contact = self.solver.solve_from(start, &problem, &self.round_stop(), observer)?;
        let mut pressed = vec![0.0; self.problem.nodes()];
        Response::from_compliance(self.compliance.clone()).displacement(values(&contact.pressure), &mut pressed);
        let work = contact.work + Work { transforms: 2, ..Work::default() };
        Ok((contact, pressed, work))
    }

    /// The traction with the mean `target` under the pressure of a contact.
    ///
    /// With the sign of the target, `t = mu p + tau` or `mu p - tau`, whose mean is not below `mu <p>`.
    fn pull(&self, task: &SlipTask<'_>, observer: &mut dyn Observer) -> Result<Traction, SlipError> {
        let &SlipTask { contact, pressed, target: [target, _], before, start } = task;
        let (mu, sign) = (self.coefficient, if target < 0.0 { -1.0 } else { 1.0 });
        let (grid, p) = (*contact.problem.surface().grid(), values(&contact.pressure));
        let field =
            |of: &dyn Fn(usize) -> f64| Field::from_shape_fn(grid.shape(), |(y, x)| of(y * grid.shape()[1] + x));
        let load = Load::MeanPressure(mu * contact.mean_pressure() + target.abs());
        let yardstick = Surface::new(grid, field(&|i| mu * pressed[i])).map_err(SlipError::Surface)?;
        let heights = field(&|i| sign * before[0][i] + mu * pressed[i]);
        let ceilings: Vec<f64> = p.iter().map(|p| 2.0 * mu * p).collect();
        let problem = Problem::of_compliance(yardstick.into(), self.compliance.clone(), load)?;
        let problem = problem.with_heights(heights)?.with_ceilings(ceilings)?;
        let start = field(&|i| (sign * start[0][i] + mu * p[i]).clamp(0.0, 2.0 * mu * p[i]));
        let stop = finer(self.round_stop(), PULL);
        let found = self.solver.solve_from(Some(&start), &problem, &stop, observer)?;
        let t = values(&found.pressure);
        // nodes that stick lie at minus the datum of the heights as they were given
        let level = -(datum(&found) + problem.shift());
        let traction: Vec<f64> = t.iter().zip(p).map(|(t, p)| sign * (t - mu * p)).collect();
        let displacement = values(&found.displacement).iter().zip(pressed);
        let displacement: Vec<f64> = displacement.map(|(u, p)| sign * (u - mu * p)).collect();
        let moved: Vec<f64> = displacement.iter().zip(&before[0]).map(|(now, before)| now - before).collect();
        let shift = better_shift(mu, p, [&traction, &moved], sign * level);
        Ok(Traction {
            values: [traction, Vec::new()],
            displacement: [displacement, Vec::new()],
            shift: [shift, 0.0],
            status: found.status,
            work: found.work,
        })
    }

    /// The traction along both axes with the mean `target` under the pressure of a contact.
    fn pull_towards(&mut self, task: &SlipTask<'_>, observer: &mut dyn Observer) -> Traction {
        let &SlipTask { contact, pressed, target, before, start } = task;
        let start_of_work = Instant::now();
        let (mu, p) = (self.coefficient, values(&contact.pressure));
        let places: Vec<usize> = chunks::positive(p, 0..p.len()).collect();
        let at = |fields: &[Vec<f64>; 2]| places.iter().map(|&i| [fields[0][i], fields[1][i]]).collect::<Vec<Pair>>();
        let (start, before) = (at(start), at(before));
        let radii: Vec<f64> = places.iter().map(|&i| mu * p[i]).collect();
        let discs = Discs { radii, total: target.map(|target| target * p.len() as f64) };
        let stop = self.round_stop();
        let response = self.shear.as_mut().expect("the history takes both axes");
        let transforms = response.transforms();
        let mut step = VectorStep::new(response, places.clone(), discs, before, sliding_length(mu, pressed));
        let found = step.solve(&start, &stop, observer);
        let zeros = || [vec![0.0; p.len()], vec![0.0; p.len()]];
        let (mut traction, mut displacement) = (zeros(), zeros());
        for (axis, field) in traction.iter_mut().enumerate() {
            places.iter().zip(&found.tau).for_each(|(&i, tau)| field[i] = tau[axis]);
        }
        response.displacement(traction.each_ref().map(Vec::as_slice), displacement.each_mut().map(Vec::as_mut_slice));
        let transforms = response.transforms() - transforms;
        let work = Work { iterations: found.iterations, transforms, seconds: start_of_work.elapsed().as_secs_f64() };
        Traction { values: traction, displacement, shift: found.shift, status: found.status, work }
    }
}

/// A traction along `x` is solved to this part of the tolerance: its certificate is over `mu <p>`, and not over the mean of `t`, which may be
/// twice as large, and is taken with the shift of the nodes that stick, and not with the best one.
const PULL: f64 = 0.1;

/// With coupling, pressure and traction of a round are solved to this part of the tolerance. Large friction needs it: at `mu beta = 2` and near
/// sliding, what a solve leaves open becomes so large in the next ones that rounds of a tenth do not always converge.
const ROUND: f64 = 0.005;

/// No part of a tolerance is below this one, which rounding allows.
const FINEST: f64 = 2e-15;

/// A part of a tolerance.
fn finer(stop: Stop, part: f64) -> Stop {
    let tolerance = stop.tolerance();
    Stop::new((part * tolerance).max(FINEST).min(tolerance), stop.max_iterations()).unwrap_or(stop)
}

/// The problem with heights that are less by what a traction displaces.
fn posed(problem: &Problem, raised: &[f64]) -> Result<Problem, SlipError> {
    if raised.iter().all(|u| *u == 0.0) {
        return Ok(problem.clone());
    }
    let mut height = problem.surface().height().clone();
    height.iter_mut().zip(raised).for_each(|(h, u)| *h -= u);
    Ok(problem.with_heights(height)?)
}

/// The datum of the gap of a contact, by one node: `g - (u - h)`.
fn datum(contact: &Contact) -> f64 {
    contact.gap[[0, 0]] - (contact.displacement[[0, 0]] - contact.problem.height()[0])
}
