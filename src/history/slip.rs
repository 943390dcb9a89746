//! Partial slip with a history.

use super::discs::Pair;
use super::slip_coupling::{SlipCoupling, SlipRounds, posed};
use super::slip_memory::SlipMemory;
use super::slip_pull::{SlipPull, finer};
use super::slip_round::{SlipRound, SlipTask, values};
use super::slip_shear::pull_towards;
use super::slip_state::SlipState;
use super::slip_traction::Traction;
use crate::contact::{Certificate, Contact, Load, Observer, Problem, ResultClaim, Solver, Status, Stop, Work};
use crate::elastic::{Compliance, Coupling, Response, ShearCompliance, ShearResponse};
use crate::error::SlipError;
use std::collections::VecDeque;
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
/// Both kinds of steps have a [`SlipCertificate`](crate::history::SlipCertificate). A step must end where the loads turn. Where
/// the pressure of a node falls to zero, its traction is lost.
///
/// # Coupling
/// With Dundurs' `beta = 0`, as for two bodies of the same material, the normal contact is solved once in a step. With tractions along `x` alone
/// one step is then exact under a normal load that stays. [`SlipProcess`](crate::history::SlipProcess) chooses the steps of other paths by an
/// estimated error. With `beta` the pressure displaces the surface along `x` and `y` by `-beta S p`,
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
    coupling: Option<SlipCoupling>,
    /// Whether the slip of a node that comes into contact in a step counts from where it touches, and not from the beginning of the step.
    counts_from_touch: bool,
    memory: SlipMemory,
    /// The last contacts under normal loads, which do not depend on tractions without coupling.
    known: VecDeque<(Contact, Vec<f64>)>,
}

/// Contacts under normal loads that are kept: a step and its halves need three, and those of the step before it may come again.
const KEPT_CONTACTS: usize = 4;

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
        let memory =
            SlipMemory { pressed: None, traction, tangential: [0.0; 2], loads: [0.0; 2], displaced, raised: zeros() };
        let (shear, coupling, known, counts_from_touch) = (None, None, VecDeque::new(), false);
        let mut history = Self {
            problem,
            coefficient,
            compliance,
            solver,
            stop,
            m,
            shear,
            coupling,
            counts_from_touch,
            memory,
            known,
        };
        if m != 0.0 && !history.problem.surface().grid().is_line() {
            history.take_both_axes()?;
        }
        Ok(history)
    }

    /// The history before its first step whose steps count the slip of a node from where it touches, see [`SlipMemory::rate`]. With coupling nothing
    /// changes.
    pub(super) fn counting_from_touch(self) -> Self {
        Self { counts_from_touch: self.coupling.is_none(), ..self }
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
        self.coupling = Some(SlipCoupling::new(beta, coupling));
        Ok(self)
    }

    /// Takes steps along both axes from now on.
    fn take_both_axes(&mut self) -> Result<(), SlipError> {
        let (grid, solid) = (self.problem.surface().grid(), self.problem.solid().clone());
        self.shear = Some(ShearResponse::new(Arc::new(ShearCompliance::new(grid, solid, self.m)?)));
        let nodes = self.problem.nodes();
        self.memory.traction[1].resize(nodes, 0.0);
        self.memory.displaced[1].resize(nodes, 0.0);
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
        let state = self.step_by_rounds(load, share, observer)?;
        self.memory.loads = tangential;
        Ok(state)
    }

    /// The next state, by rounds between pressure and traction where there is coupling.
    fn step_by_rounds(&mut self, load: Load, share: Pair, observer: &mut dyn Observer) -> Result<SlipState, SlipError> {
        let mut rounds = SlipRounds::new(self.coefficient, self.coupling.as_ref(), &self.memory.raised);
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
                self.memory.raised = raised;
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
        let (contact, pressed, pressing) = self.press(load, rounds, last, observer)?;
        let full = self.coefficient * contact.mean_pressure();
        let target = share.map(|share| share * full);
        // the ratio of the tangential to the normal compliance: the mean over all directions of a wave, where it has several
        let ratio = if self.problem.surface().grid().is_line() { 1.0 } else { 1.0 + 0.5 * self.m };
        let rate = self.memory.rate(&contact, target, (self.coefficient, ratio)).filter(|_| self.counts_from_touch);
        let mut moved = self.memory.moved_before_touch(&contact, rate.unwrap_or_default());
        if let Some(coupling) = &mut self.coupling {
            coupling.add_by_pressure(values(&contact.pressure), &mut moved, 1.0);
        }
        let is_coupled = self.coupling.is_some();
        let start = last.map_or(&self.memory.traction, |round| &round.found.values).clone();
        let task = SlipTask { contact: &contact, pressed: &pressed, target, moved: &moved, start: &start, is_coupled };
        let found = match self.coefficient {
            0.0 => Traction::none(self.memory.traction.each_ref().map(Vec::len)),
            _ if self.shear.is_some() => self.pull_towards(&task, observer),
            _ => self.pull(&task, observer)?,
        };
        let work = pressing + found.work;
        let mut before = moved;
        for (before, displaced) in before.iter_mut().zip(&self.memory.displaced) {
            before.iter_mut().zip(displaced).for_each(|(before, displaced)| *before += displaced);
        }
        let mut round = SlipRound { contact, pressed, before, rate, found, target, work };
        // the goal of a weak pull may lie below what rounding allows: the tolerance of the step is what must be met
        let is_met = || round.certificate(self.coefficient).eta <= self.stop.tolerance();
        if round.found.status == Status::Stalled && is_met() {
            round.found.status = Status::Converged;
        }
        if round.found.status != Status::Converged && round.contact.is_converged() {
            round.contact.status = round.found.status;
        }
        Ok(round)
    }

    /// Ends a step with its last round, after which this history goes on from it.
    fn take(&mut self, round: SlipRound, (rounds, mut work): (usize, Work)) -> SlipState {
        work.transforms += self.coupling.as_mut().map_or(0, SlipCoupling::transforms);
        let earlier = self.memory.pressed.as_ref().map(|(contact, _)| contact);
        let claim = if self.coupling.is_some() { ResultClaim::RoundsConverged } else { ResultClaim::Solution };
        let state = round.state(self.coefficient, earlier, claim, (rounds, work));
        let memory = &mut self.memory;
        memory.displaced = round.found.displacement;
        if let Some(coupling) = &mut self.coupling {
            coupling.add_by_pressure(values(&round.contact.pressure), &mut memory.displaced, -1.0);
        }
        (memory.traction, memory.tangential) = (round.found.values, round.target);
        let pressed = (round.contact, round.pressed);
        if self.coupling.is_none() {
            self.known.truncate(KEPT_CONTACTS - 1);
            self.known.push_front(pressed.clone());
        }
        memory.pressed = Some(pressed);
        state
    }

    /// What the next step begins with.
    pub(super) fn memory(&self) -> &SlipMemory {
        &self.memory
    }
    /// Lets the next step begin with what another one began with, and gives what it would have begun with.
    pub(super) fn recall(&mut self, memory: SlipMemory) -> SlipMemory {
        std::mem::replace(&mut self.memory, memory)
    }

    /// Whether one step to a pair of loads is exact. Without coupling it is where tractions are along `x` alone and each node slips in one direction
    /// under its final pressure, as under a normal load that stays; and where all nodes stick, since the normal load grows so fast that friction
    /// carries what comes, if slip counts from touch.
    pub(super) fn is_exact_to(&self, load: Load, tangential: f64) -> bool {
        if self.coupling.is_some() {
            return false;
        }
        let Some((contact, _)) = &self.memory.pressed else { return self.shear.is_none() };
        let before = contact.problem.load();
        let [risen, pulled] = [load.value() - before.value(), tangential - self.memory.loads[0]];
        match self.shear {
            None if self.counts_from_touch && risen > 0.0 => pulled.abs() <= self.coefficient * risen,
            None => risen == 0.0 || risen > 0.0 && pulled == 0.0,
            Some(_) => risen >= 0.0 && pulled == 0.0,
        }
    }

    /// Whether there was a step.
    pub(super) fn has_begun(&self) -> bool {
        self.memory.pressed.is_some()
    }

    /// Refuses loads under which everything slides.
    pub(super) fn check(&self, (load, tangential): (Load, f64)) -> Result<(), SlipError> {
        self.share(load, [tangential, 0.0]).map(drop)
    }

    /// Whether pressure and traction displace the surface in each other's direction.
    pub(super) fn is_coupled(&self) -> bool {
        self.coupling.is_some()
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
        // without coupling the contact depends on the normal load alone
        if let Some((contact, pressed)) = self.known.iter().find(|(contact, _)| contact.problem.load() == load) {
            let mut contact = contact.clone();
            contact.work = Work::default();
            return Ok((contact, pressed.clone(), Work::default()));
        }
        let before = self.memory.pressed.as_ref();
        let problem = posed(&self.problem.clone().with_load(load)?, rounds.raised())?;
        let start = last.map(|round| &round.contact).or(before.map(|(contact, _)| contact));
        let start = start.map(|contact| &contact.pressure);
        let contact = self.solver.solve_from(start, &problem, &self.round_stop(), observer)?;
        let mut pressed = vec![0.0; self.problem.nodes()];
        Response::from_compliance(self.compliance.clone()).displacement(values(&contact.pressure), &mut pressed);
        let work = contact.work + Work { transforms: 2, ..Work::default() };
        Ok((contact, pressed, work))
    }

    /// The traction along `x` with the mean `target` under the pressure of a contact.
    fn pull(&self, task: &SlipTask<'_>, observer: &mut dyn Observer) -> Result<Traction, SlipError> {
        let pull = SlipPull {
            coefficient: self.coefficient,
            compliance: &self.compliance,
            solver: self.solver,
            stop: self.round_stop(),
            traction: &self.memory.traction[0],
            displaced: &self.memory.displaced[0],
        };
        pull.solve(task, observer)
    }

    /// The traction along both axes with the mean `target` under the pressure of a contact.
    fn pull_towards(&mut self, task: &SlipTask<'_>, observer: &mut dyn Observer) -> Traction {
        let stop = self.round_stop();
        let response = self.shear.as_mut().expect("the history takes both axes");
        pull_towards(response, &self.memory, task, (self.coefficient, stop), observer)
    }
}

/// With coupling, pressure and traction of a round are solved to this part of the tolerance. Large friction needs it: at `mu beta = 2` and near
/// sliding, what a solve leaves open becomes so large in the next ones that rounds of a tenth do not always converge.
const ROUND: f64 = 0.005;
