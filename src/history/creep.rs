//! The contact of a viscoelastic solid, step by step in time.

use super::apart::apart;
use super::creep_state::{Carried, CreepEnergy, CreepState, ErrorBounds};
use super::profile::{MeanStrain, StepProfile};
use super::time_step::TimeStep;
use super::warm_start::{signed_pressure, warm_start, without_traces};
use crate::chunks;
use crate::clock::Instant;
use crate::contact::{Contact, Feels, Law, Load, Observer, Problem, Quantity, Solver, StateValues, Stop, Work};
use crate::elastic::{Prony, PronyTerm, Response};
use crate::error::CreepError;
use crate::surface::Field;

/// The contact of a viscoelastic solid in time: a process that makes the next state from the last one.
///
/// The solid is that of the problem, whose modulus is the glassy one, with the memory of a [`Prony`] series. In relaxation form, with
/// `g_k`, `rho_k` and `g = 1 - sum g_k`, the effective pressure `p_e` displaces the glassy solid, `u = A p_e`, and
///
/// ```text
/// p = g p_e + sum_k y_k,    rho_k dy_k/dt + y_k = g_k rho_k d p_e/dt
/// ```
///
/// The fields `y_k` are the memory: what each element still holds. Over a step, `p_e` goes from its old value to the new one by one profile
/// `phi(s)` in all nodes, and everything else is integrated exactly. With `e_k = exp(-dt/rho_k)` and
/// `psi_k = int exp(-(dt - s)/rho_k) phi'(s) ds`,
///
/// ```text
/// y_k <- e_k y_k + g_k psi_k (p_e - p_e0),    p_e = m p + hist,
/// m = 1 / (g + sum g_k psi_k),    hist = m sum (g_k psi_k p_e0 - e_k y_k)
/// ```
///
/// So a step is an elastic contact: the heights are `h - A hist`, the pressure is `p' = m p` on the same solid under the
/// load `m P`, or at the same mean gap or approach, with the hardness `m H_c`. It is convex, and its certificate bounds the error
/// of the pressure. Compliance and plans are those of the problem for all steps. Each solve starts where the last states point to. The
/// displacements `A y_k` follow from those of the states, without transforms.
///
/// **The profile.** At a mean gap or an approach it is a straight line. Under a load it is the course of the mean effective pressure,
/// which follows from the load alone; where that turns within the step, it is a straight line too. So a step of any length is exact
/// where the contact keeps its shape, `p_e(t) = p_e0 + phi(t) D`: at a held gap, in full contact, and where only the mean matters. The
/// effective pressure is exact under any load that never falls (Lee & Radok, J. Appl. Mech. 27, 438, 1960). Everything else has an error of
/// second order in the step.
///
/// A hardness limits the pressure, but the surface does not keep what has yielded: its heights recover when the load
/// falls.
///
/// Storage: two fields for each term, and about six fields for the contact and the start of the next one.
///
/// # Source
/// The integration of elements over a step is that of Taylor, Pister & Goudreau, Int. J. Numer. Meth. Eng. 2, 45 (1970); as a contact problem
/// with other heights, and with the profile of the load, it is this crate's own.
///
/// ```
/// use asperity::contact::{ContactModulus, Load, Multilevel, Stop};
/// use asperity::elastic::{Prony, PronyTerm};
/// use asperity::history::Creep;
/// use asperity::{Grid, Indenter, Problem};
/// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(1024, 4.0)?)?;
/// let load = Load::MeanPressure(1e-3);
/// let problem = Problem::new(cylinder, ContactModulus(1.0), load)?;
/// let prony = Prony::new(vec![PronyTerm { ratio: 9.0, time: 1.0 }])?;
/// let mut creep = Creep::new(problem, prony.clone());
/// // a load at time 0, then two steps under it
/// let (solver, stop) = (Multilevel, Stop::default());
/// let mut state = creep.step(&creep.start(), 0.0, load, &solver, &stop, &mut ())?;
/// let first = state.resolved().relative_area;
/// for _ in 0..2 {
///     state = creep.step(&state, 0.5, load, &solver, &stop, &mut ())?;
/// }
/// // the contact of a cylinder widens with the root of the compliance
/// let growth = state.resolved().relative_area / first;
/// assert!((growth / prony.creep(1.0).sqrt() - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Creep {
    /// The problem on a hard wall, under the last load that it could be posed for.
    problem: Problem,
    law: Law,
    prony: Prony,
    /// The same solid in relaxation form.
    relaxation: Vec<PronyTerm>,
    response: Response,
}

impl Creep {
    /// The contact of a problem on a solid with a memory. The load of the problem is not used, but its law is.
    pub fn new(problem: Problem, prony: Prony) -> Self {
        let (law, response) = (problem.law(), problem.response());
        let relaxation = prony.to_relaxation();
        Self { problem: without_law(problem), law, prony, relaxation, response }
    }

    /// The memory of the solid.
    pub fn prony(&self) -> &Prony {
        &self.prony
    }

    /// The state at time 0 without load and without memory. The highest peak just touches.
    pub fn start(&self) -> CreepState {
        let zero = || Field::zeros(self.problem.surface().grid().shape());
        let terms = self.relaxation.len();
        let contact = self.apart(zero(), Work::default(), None);
        let carried = Carried {
            effective: zero(),
            displaced: vec![zero(); terms],
            flowed: 0.0,
            moved: self.moved(&contact, 0.0),
            bounds: ErrorBounds::default(),
            before: None,
        };
        CreepState {
            time: 0.0,
            load: None,
            contact,
            memory: vec![zero(); terms],
            energy: CreepEnergy::default(),
            time_errors: None,
            carried,
        }
    }

    /// The state after a step `dt`, over which the load changes linearly from that of the last state. A step of length zero is a sudden
    /// change of the load. Where the load is a pressure or a force
    /// of zero, and where a mean gap or an approach leaves the surfaces apart, there is no pressure and the solid recovers.
    /// Mean gaps above the highest peak and approaches that are not positive are allowed.
    ///
    /// The solve starts from the last state and its change. The observer sees the steps of the convex problem: heights `h - A hist`, pressure
    /// `m p`.
    ///
    /// # Errors
    /// [`CreepError::Step`] for a step that is negative or not finite, [`CreepError::Problem`] for an impossible load, and
    /// [`CreepError::Solve`] for a problem that the solver cannot take on. A contact that has not converged is returned with its
    /// status.
    pub fn step(
        &mut self,
        state: &CreepState,
        dt: f64,
        load: Load,
        solver: &dyn Solver,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<CreepState, CreepError> {
        self.step_from(None, state, dt, load, solver, stop, observer)
    }

    /// The step with another start: an effective pressure near that of the end.
    #[expect(clippy::too_many_arguments, reason = "a step with its start")]
    pub(super) fn step_from(
        &mut self,
        near: Option<&Field>,
        state: &CreepState,
        dt: f64,
        load: Load,
        solver: &dyn Solver,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<CreepState, CreepError> {
        if !(dt.is_finite() && dt >= 0.0) {
            return Err(CreepError::Step { step: dt });
        }
        let clock = Instant::now();
        let placed = self.place(load)?;
        let counted = self.response.transforms();
        let before = self.displaced(state);
        let extra = self.response.transforms() - counted;
        let (step, posed) = self.posed_step(state, &before, dt, &placed)?;
        let hist = step.history(&state.carried.effective, &state.memory);
        let remembered = step.history(&before.effective, &before.memory);
        let solved = posed.map(|problem| {
            let start = match near {
                Some(near) => Some(near - &hist),
                None => warm_start(state, &hist, dt),
            };
            solver.solve_from(start.map(without_traces).as_ref(), &problem, stop, observer)
        });
        let solved = solved.transpose()?;
        let work =
            |work: Work| Work { transforms: work.transforms + extra, seconds: clock.elapsed().as_secs_f64(), ..work };
        let (contact, effective, error) = match solved {
            None => (self.apart(remembered, work(Work::default()), placed.datum), hist, 0.0),
            Some(solved) => {
                // the bound is that of m p, in the norm of the certificate
                let bound = solved.certificate.pressure_error_bound;
                let size = mean_product(&solved.pressure, &solved.displacement).max(0.0).sqrt();
                let error = if bound.is_finite() { bound * size } else { f64::INFINITY };
                let ceiling = self.law.ceiling();
                let pressure = solved.pressure.mapv(|p| (p / step.compliance).min(ceiling));
                let effective = &solved.pressure + &hist;
                let fields = [pressure, solved.displacement + remembered, solved.gap];
                let parts = (solved.certificate, work(solved.work), solved.status);
                let problem = self.problem.clone().with_law(self.law)?;
                let mut contact = Contact::from_parts(problem, fields, parts, solved.solver, solved.coarser)?;
                contact.failure = solved.failure;
                (contact, effective, error)
            }
        };
        Ok(self.next_state(state, &before, &step, load, contact, effective, error))
    }

    /// The state with its memory, energies and bounds, from the contact and the effective pressure.
    #[expect(clippy::too_many_arguments, reason = "the parts of a state")]
    fn next_state(
        &self,
        state: &CreepState,
        before: &Displaced,
        step: &TimeStep,
        load: Load,
        contact: Contact,
        effective: Field,
        error: f64,
    ) -> CreepState {
        let uniform = self.uniform();
        let mean = |x: &Field| x.mean().unwrap_or(0.0);
        let product = |x: &Field, pressure: &Field, u: &Field| mean_product(x, u) + uniform * mean(x) * mean(pressure);
        let change = &effective - &state.carried.effective;
        let moved_by = &contact.displacement - &before.effective;
        let square = product(&change, &change, &moved_by);
        let effective_square = product(&effective, &effective, &contact.displacement);
        let (mut lost, mut stored) = (state.energy.lost, 0.5 * step.left * effective_square);
        let mean_change = mean(&change);
        let mut pressure = step.left * (mean(&state.carried.effective) + 0.5 * mean_change);
        let (mut memory, mut displaced) = (Vec::new(), Vec::new());
        for (element, (old, old_u)) in step.elements.iter().zip(state.memory.iter().zip(&before.memory)) {
            let products = [product(old, old, old_u), product(old, &change, &moved_by), square];
            lost += element.dissipated(products);
            pressure += element.weighted(mean(old), mean_change);
            let next = |old: &Field, change: &Field| element.keep * old + element.share() * change;
            let (held, held_u) = (next(old, &change), next(old_u, &moved_by));
            stored += 0.5 * product(&held, &held, &held_u).max(0.0) / element.ratio;
            memory.push(held);
            displaced.push(held_u);
        }
        let effective_mean = mean(&effective);
        let moved = self.moved(&contact, effective_mean);
        let values = StateValues::new(Feels::MEMORY).with(Quantity::EffectivePressure, effective_mean);
        let contact = contact.with_values(values);
        let added = match step.dt {
            0.0 => stored - state.energy.stored,
            _ => pressure * (moved - state.carried.moved),
        };
        let carried = Carried {
            displaced,
            flowed: 1.0 - 1.0 / step.compliance,
            moved,
            bounds: state.carried.bounds.next(&step.elements, step.compliance, error),
            before: (step.dt > 0.0).then(|| (signed_pressure(state), step.dt)),
            effective,
        };
        CreepState {
            time: state.time + step.dt,
            load: Some(load),
            contact,
            memory,
            energy: CreepEnergy { stored, lost, work: state.energy.work + added },
            time_errors: None,
            carried,
        }
    }

    /// The step and the problem of its contact, none where nothing touches. Surfaces that stay apart carry no load, and the solid recovers
    /// by the profile of that.
    fn posed_step(
        &self,
        state: &CreepState,
        before: &Displaced,
        dt: f64,
        placed: &PlacedLoad,
    ) -> Result<(TimeStep, Option<Problem>), CreepError> {
        let first = state.contact.mean_pressure();
        let last = match placed.load {
            None => Some(0.0),
            Some(_) => self.problem.mean_pressure(),
        };
        let pose = |profile: &StepProfile| {
            let step = TimeStep::new(&self.relaxation, self.prony.relaxed_ratio(), profile);
            let remembered = step.history(&before.effective, &before.memory);
            let posed = self.posed(placed, &remembered, step.compliance)?;
            Ok::<_, CreepError>((step, posed))
        };
        let straight = StepProfile::straight(dt);
        let of_load = |last: f64| match dt {
            0.0 => None,
            _ => StepProfile::of_load(dt, [first, last], &self.mean_strains(state)),
        };
        if last.is_none()
            && first == 0.0
            && let Some(profile) = of_load(0.0)
        {
            let (step, posed) = pose(&profile)?;
            if posed.is_none() {
                return Ok((step, None));
            }
        }
        pose(&last.and_then(of_load).unwrap_or(straight))
    }

    /// The time after a state at which its mean effective pressure turns, on the way to a `load` that is reached after `dt`; none where it does
    /// not, and where loads do not prescribe it.
    pub(super) fn mean_turn(&self, state: &CreepState, dt: f64, load: Load) -> Option<f64> {
        let mean = |load: Load| match load.value() {
            0.0 => Some(0.0),
            _ => self.problem.clone().with_load(load).ok()?.mean_pressure(),
        };
        let loads = [state.load?, load];
        if !loads.iter().all(Load::is_pressure) {
            return None;
        }
        let [first, last] = loads.map(mean);
        StepProfile::turn_of_load(dt, [first?, last?], &self.mean_strains(state))
    }

    /// The mean strains of the Kelvin elements, from what the Maxwell elements hold:
    /// `eps_j = sum_k f_j rho_k/(tau_j - rho_k) (g_k p_e - y_k)`.
    fn mean_strains(&self, state: &CreepState) -> Vec<MeanStrain> {
        let effective = state.carried.effective.mean().unwrap_or(0.0);
        let held = state.memory.iter().map(|it| it.mean().unwrap_or(0.0));
        let flowed: Vec<f64> = held.zip(&self.relaxation).map(|(held, term)| term.ratio * effective - held).collect();
        let strain = |kelvin: &PronyTerm| {
            let share = |term: &PronyTerm| kelvin.ratio * term.time / (kelvin.time - term.time);
            self.relaxation.iter().zip(&flowed).map(|(term, flowed)| share(term) * flowed).sum()
        };
        let of = |kelvin: &PronyTerm| MeanStrain { ratio: kelvin.ratio, time: kelvin.time, strain: strain(kelvin) };
        self.prony.terms().iter().map(of).collect()
    }

    /// The displacements of a state's effective pressure and memory, in the convention of the present load.
    fn displaced(&mut self, state: &CreepState) -> Displaced {
        let has_uniform = |problem: &Problem| problem.compliance().has_uniform();
        if has_uniform(&self.problem) == has_uniform(&state.contact.problem) {
            let (effective, memory) = (state.contact.displacement.clone(), state.carried.displaced.clone());
            return Displaced { effective, memory };
        }
        let memory = state.memory.iter().map(|held| self.displacement(held)).collect();
        Displaced { effective: self.displacement(&state.carried.effective), memory }
    }

    /// Poses the problem under a load. A mean gap or an approach out of reach of the highest peak is brought into reach together with
    /// the heights.
    fn place(&mut self, load: Load) -> Result<PlacedLoad, CreepError> {
        let highest = self.problem.highest();
        let (reached, lowered) = match load {
            Load::MeanGap(gap) if gap.is_finite() && gap >= highest => {
                (Load::MeanGap(0.5 * highest), gap - 0.5 * highest)
            }
            Load::Approach(approach) if approach.is_finite() && approach <= 0.0 => {
                (Load::Approach(0.5 * highest), 0.5 * highest - approach)
            }
            load => (load, 0.0),
        };
        if load.is_pressure() && load.value() == 0.0 {
            return Ok(PlacedLoad { load: None, lowered, datum: None });
        }
        let problem = self.problem.clone().with_load(reached)?;
        if problem.compliance().has_uniform() != self.problem.compliance().has_uniform() {
            self.response = problem.response();
        }
        // the datum before the heights are lowered
        let datum = problem.datum().map(|datum| datum + lowered);
        self.problem = problem;
        Ok(PlacedLoad { load: Some(reached), lowered, datum })
    }

    /// The problem of a step, none where nothing touches.
    fn posed(&self, placed: &PlacedLoad, remembered: &Field, m: f64) -> Result<Option<Problem>, CreepError> {
        let Some(load) = placed.load else { return Ok(None) };
        let mut height = self.problem.surface().height() - remembered;
        if placed.lowered != 0.0 {
            height -= placed.lowered;
        }
        let problem = self.problem.with_heights(height)?;
        if let Some(datum) = problem.datum()
            && problem.height().iter().all(|&h| h <= datum)
        {
            return Ok(None);
        }
        let load = self.problem.mean_pressure().map_or(load, |mean| Load::MeanPressure(m * mean));
        let law = self.law.hardness().map_or(Law::HardWall, |hardness| Law::Hardness(m * hardness));
        Ok(Some(problem.with_load(load)?.with_law(law)?))
    }

    /// The displacement by a pressure: one transform pair, or none for no pressure.
    fn displacement(&mut self, pressure: &Field) -> Field {
        let mut displacement = Field::zeros(pressure.dim());
        if pressure.iter().any(|&p| p != 0.0) {
            let from = pressure.as_slice().expect("standard layout");
            self.response.displacement(from, displacement.as_slice_mut().expect("standard layout"));
        }
        displacement
    }

    /// The contact without pressure above a displaced solid: at a datum, or where the highest point of it just touches.
    fn apart(&self, displacement: Field, work: Work, datum: Option<f64>) -> Contact {
        let problem = self.problem.clone();
        let problem = problem.clone().with_law(self.law).unwrap_or(problem);
        apart(problem, displacement, work, datum)
    }

    /// How far the surface has moved, from a constant datum: the uniform displacement by the effective pressure is in it.
    fn moved(&self, contact: &Contact, effective_mean: f64) -> f64 {
        let n = contact.gap.len();
        let [displacement, height] = [&contact.displacement, self.problem.surface().height()]
            .map(|field| field.as_slice().expect("standard layout"));
        let datum = contact.separation() - chunks::sum(n, |i| displacement[i] - height[i]) / n as f64;
        self.uniform() * effective_mean - datum
    }

    /// The compliance of a uniform pressure that displacements leave out, a length per pressure.
    fn uniform(&self) -> f64 {
        let left_out = Some(()).filter(|()| !self.problem.compliance().has_uniform());
        left_out.and_then(|()| self.problem.solid().uniform_compliance()).unwrap_or(0.0)
    }
}

/// A load for the problem of a step, and how much its heights are lowered for it.
struct PlacedLoad {
    /// None for no pressure.
    load: Option<Load>,
    lowered: f64,
    /// The datum of the gap above the heights as they are.
    datum: Option<f64>,
}

fn without_law(problem: Problem) -> Problem {
    problem.with_law(Law::HardWall).expect("a hard wall bears any load")
}

/// The displacements by a state's effective pressure and by its memory.
struct Displaced {
    effective: Field,
    memory: Vec<Field>,
}

/// `<x u>`.
fn mean_product(x: &Field, u: &Field) -> f64 {
    let [x, u] = [x, u].map(|field| field.as_slice().expect("standard layout"));
    chunks::sum(x.len(), |i| x[i] * u[i]) / x.len() as f64
}
