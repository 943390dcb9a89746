//! The contact of a viscoelastic solid, step by step in time.

use super::creep_state::{Carried, CreepEnergy, CreepState, ErrorBounds};
use super::kelvin::{CreepRule, KelvinProducts, KelvinStep};
use crate::chunks;
use crate::clock::Instant;
use crate::contact::{Certificate, Contact, Law, Load, Observer, Problem, Solver, Status, Stop, Work};
use crate::elastic::{Prony, Response};
use crate::error::CreepError;
use crate::surface::Field;

/// The stiffness of a node that comes into contact, in that of the shortest wave: it took the fewest transforms.
const GAP_STIFFNESS: f64 = 0.5;

/// The contact of a viscoelastic solid in time: a process that makes the next state from the last one.
///
/// The solid is that of the problem, whose modulus is the glassy one, with the memory of a [`Prony`] series. Over a step `dt`
/// with `e_j = exp(-dt/tau_j)` under a constant pressure,
///
/// ```text
/// eps_j <- e_j eps_j + f_j (1 - e_j) p
/// u      = A [m p + hist],    hist = sum e_j eps_j,    m = 1 + sum f_j (1 - e_j)
/// ```
///
/// So a step is an elastic contact: the heights are `h - A hist`, the pressure is `p' = m p` on the same solid under the
/// load `m P`, or at the same mean gap or approach, with the hardness `m H_c`. It is convex, and its certificate bounds the error
/// of the pressure. Compliance and plans are those of the problem for all steps. Each solve starts where the last states point to. With
/// several terms, or linear pressures, a step costs one transform pair besides.
///
/// A hardness limits the pressure, but the surface does not keep what has yielded: its heights recover when the load
/// falls.
///
/// Storage: a field for each term, and about five fields for the contact and the start of the next one.
///
/// # Source
/// The equations follow from the exact integral of the Kelvin elements over a step (Taylor, Pister & Goudreau, Int. J. Numer. Meth. Eng. 2,
/// 45, 1970); as a contact problem with other heights they are this crate's own.
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
    rule: CreepRule,
    response: Response,
}

impl Creep {
    /// The contact of a problem on a solid with a memory, under the rule of constant pressure. The load of the problem is not
    /// used, but its law is.
    pub fn new(problem: Problem, prony: Prony) -> Self {
        let (law, response) = (problem.law(), problem.response());
        Self { problem: without_law(problem), law, prony, rule: CreepRule::default(), response }
    }

    /// The same contact with another rule for the steps.
    pub fn with_rule(self, rule: CreepRule) -> Self {
        Self { rule, ..self }
    }

    /// The memory of the solid.
    pub fn prony(&self) -> &Prony {
        &self.prony
    }

    /// The state at time 0 without load and without memory. The highest peak just touches.
    pub fn start(&self) -> CreepState {
        let zero = || Field::zeros(self.problem.surface().grid().shape());
        let terms = self.prony.terms().len();
        let carried = Carried {
            products: vec![[0.0; 2]; terms],
            square: 0.0,
            moved: 0.0,
            has_jumped: true,
            bounds: ErrorBounds::default(),
            remembered: None,
            before: None,
        };
        let (contact, energy) = (self.apart(zero(), Work::default(), None), CreepEnergy::default());
        let moved = self.moved(&contact, 0.0);
        let carried = Carried { moved, ..carried };
        CreepState {
            time: 0.0,
            load: None,
            contact,
            memory: vec![zero(); terms],
            energy,
            time_error: f64::NAN,
            carried,
        }
    }

    /// The state after a step `dt` under a load. A step of length zero is a sudden change of the load. Where the load is a pressure or a force
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
        let is_constant = dt == 0.0 || state.carried.has_jumped;
        let rule = if is_constant { CreepRule::ConstantPressure } else { self.rule };
        let steps: Vec<_> = self.prony.terms().iter().map(|term| KelvinStep::new(term, dt, rule)).collect();
        let m = 1.0 + steps.iter().map(|step| step.after).sum::<f64>();
        let old = &state.contact.pressure;
        let mut memory = carried_on(&steps, &state.memory, old);
        let hist = memory.iter().fold(Field::zeros(old.dim()), |sum, eps| sum + eps);
        let counted = self.response.transforms();
        let remembered = self.remembered(&steps, state).unwrap_or_else(|| self.displacement(&hist));
        let extra = self.response.transforms() - counted;

        // the displacement by the memory of a single term, at the end of the step
        let mut own = (steps.len() == 1).then(|| remembered.clone());
        let contact = self.posed(&placed, &remembered, m)?.map(|problem| {
            let start = match near {
                Some(near) => Some(near - &hist),
                None => warm_start(state, &hist, dt),
            };
            solver.solve_from(start.as_ref(), &problem, stop, observer)
        });
        let solved = contact.transpose()?;
        let work =
            |work: Work| Work { transforms: work.transforms + extra, seconds: clock.elapsed().as_secs_f64(), ..work };
        let (contact, direct) = match solved {
            None => (self.apart(remembered, work(Work::default()), placed.datum), None),
            Some(solved) => {
                let ceiling = self.law.ceiling();
                let pressure = solved.pressure.mapv(|p| (p / m).min(ceiling));
                let direct = solved.displacement.mapv(|u| u / m);
                let fields = [pressure, solved.displacement + remembered, solved.gap];
                let parts = (solved.certificate, work(solved.work), solved.status);
                let problem = self.problem.clone().with_law(self.law)?;
                let mut contact = Contact::from_parts(problem, fields, parts, solved.solver, solved.coarser)?;
                contact.failure = solved.failure;
                (contact, Some(direct))
            }
        };
        if let (Some(own), Some(direct)) = (&mut own, &direct) {
            own.scaled_add(steps[0].after, direct);
        }
        for (eps, step) in memory.iter_mut().zip(&steps) {
            eps.zip_mut_with(&contact.pressure, |eps, p| *eps += step.after * p);
        }
        let mut next = self.next_state(state, dt, load, &steps, contact, direct, memory);
        next.carried.remembered = own;
        Ok(next)
    }

    /// The state with its energies and bounds, from the contact and the displacement `A p`, none without contact.
    #[expect(clippy::too_many_arguments, reason = "the parts of a state")]
    fn next_state(
        &self,
        state: &CreepState,
        dt: f64,
        load: Load,
        steps: &[KelvinStep],
        contact: Contact,
        direct: Option<Field>,
        memory: Vec<Field>,
    ) -> CreepState {
        let pressure = &contact.pressure;
        let (own, uniform) = (|x: &Field| direct.as_ref().map_or(0.0, |u| mean_product(x, u)), self.uniform());
        let mean = contact.mean_pressure();
        let product = |x: &Field| own(x) + uniform * x.mean().unwrap_or(0.0) * mean;
        let pressures = [state.carried.square, product(&state.contact.pressure), product(pressure)];
        let (mut products, mut lost) = (Vec::new(), state.energy.lost);
        let mut stored = 0.5 * pressures[2];
        let terms = self.prony.terms();
        for (((step, eps), term), &[square, with0]) in
            steps.iter().zip(&state.memory).zip(terms).zip(&state.carried.products)
        {
            let old = KelvinProducts { square, with: [with0, product(eps)] };
            lost += step.dissipated(old, pressures);
            let next = step.next(old, pressures);
            stored += 0.5 * next[0] / term.ratio;
            products.push(next);
        }
        let effective_mean = mean + memory.iter().map(|eps| eps.mean().unwrap_or(0.0)).sum::<f64>();
        let moved = self.moved(&contact, effective_mean);
        let added = match dt {
            0.0 => stored - state.energy.stored,
            _ => 0.5 * (state.contact.mean_pressure() + mean) * (moved - state.carried.moved),
        };
        let error = match (&direct, contact.certificate.pressure_error_bound) {
            (None, _) => 0.0,
            // the bound is that of m p, in the norm of the certificate
            (_, bound) if bound.is_finite() => bound * own(pressure).max(0.0).sqrt(),
            _ => f64::INFINITY,
        };
        let carried = Carried {
            products,
            square: pressures[2],
            moved,
            has_jumped: dt == 0.0,
            bounds: state.carried.bounds.next(steps, error),
            remembered: None,
            before: (dt > 0.0).then(|| (signed_pressure(state), dt)),
        };
        CreepState {
            time: state.time + dt,
            load: Some(load),
            contact,
            memory,
            energy: CreepEnergy { stored, lost, work: state.energy.work + added },
            time_error: f64::NAN,
            carried,
        }
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

    /// The displacement by what is left of the memory, from that of the last state, if it is known and nothing is added to it.
    fn remembered(&self, steps: &[KelvinStep], state: &CreepState) -> Option<Field> {
        let has_uniform = |problem: &Problem| problem.compliance().has_uniform();
        match (steps, &state.carried.remembered) {
            ([step], Some(before)) if step.before == 0.0 => {
                (has_uniform(&self.problem) == has_uniform(&state.contact.problem)).then(|| before * step.keep)
            }
            _ => None,
        }
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
        let height = self.problem.surface().height();
        let touch = || height.iter().zip(&displacement).fold(f64::NEG_INFINITY, |most, (h, u)| most.max(h - u));
        let datum = datum.unwrap_or_else(touch);
        let gap = &displacement - height + datum;
        let pressure = Field::zeros(height.dim());
        let parts = (EXACT, work, Status::Converged);
        let problem = self.problem.clone();
        let problem = problem.clone().with_law(self.law).unwrap_or(problem);
        Contact::from_parts(problem, [pressure, displacement, gap], parts, "none", None).expect("fields fit the grid")
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

/// The certificate of no pressure where there is no contact: nothing is off.
const EXACT: Certificate = Certificate {
    eta: 0.0,
    eta_gap: 0.0,
    pressure_error_bound: 0.0,
    mean_gap_error_bound: 0.0,
    load_error: 0.0,
    min_pressure: 0.0,
    above_hardness: 0.0,
    penetration: 0.0,
    rounding: 0.0,
};

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

/// What is left of the memory at the end of a step, without what the pressure of the end adds.
fn carried_on(steps: &[KelvinStep], memory: &[Field], old: &Field) -> Vec<Field> {
    let carry = |(step, eps): (&KelvinStep, &Field)| match step.before {
        0.0 => eps * step.keep,
        before => eps * step.keep + old * before,
    };
    steps.iter().zip(memory).map(carry).collect()
}

/// The pressure `m p` to start from: the signed pressure, as it went from the state before to this one, goes on for the step.
/// On rough surfaces with small steps it needs fewer transforms than the last pressure does, and never many more.
fn warm_start(state: &CreepState, hist: &Field, dt: f64) -> Option<Field> {
    state.contact.pressure.iter().any(|&p| p > 0.0).then(|| match &state.carried.before {
        Some((before, step)) if dt > 0.0 => {
            let growth = dt / step;
            let further = |now: &f64, before: &f64| now + growth * (now - before);
            let mut start = signed_pressure(state);
            start.zip_mut_with(before, |now, before| *now = further(now, before));
            start - hist
        }
        _ => state.effective_pressure() - hist,
    })
}

/// The effective pressure and, where a surface has a gap, that less the gap times a stiffness: the field goes on
/// through zero where a contact grows, so that it tells which nodes will touch and about how much they will carry. On lines
/// it is the effective pressure alone, since few nodes at a time come into contact.
fn signed_pressure(state: &CreepState) -> Field {
    let (mut field, problem) = (state.effective_pressure(), &state.contact.problem);
    if !problem.surface().grid().is_line() {
        let [_, stiffest] = problem.compliance().stiffness_range();
        let pairs = state.contact.pressure.iter().zip(&state.contact.gap);
        field.iter_mut().zip(pairs).filter(|(_, (p, _))| **p == 0.0).for_each(|(field, (_, gap))| {
            *field -= GAP_STIFFNESS * stiffest * gap.max(0.0);
        });
    }
    field
}

/// `<x u>`.
fn mean_product(x: &Field, u: &Field) -> f64 {
    let [x, u] = [x, u].map(|field| field.as_slice().expect("standard layout"));
    chunks::sum(x.len(), |i| x[i] * u[i]) / x.len() as f64
}
