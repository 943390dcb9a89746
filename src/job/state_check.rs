//! The check of a state of a history against its setup.

use crate::adhesion::Attraction;
use crate::contact::{
    Certificate, FieldKind, Load, Problem, Quantity, ResultClaim, SavedDoubt, State, Status, is_met, is_same, largest,
    pressure_doubts,
};
use crate::elastic::{Compliance, Coupling, Response};
use crate::error::{ConflictRule, SetupError, StudyError};
use crate::history::PathPoint;
use crate::setup::{ProcessKind, Setup};
use crate::surface::Field;
use std::sync::Arc;

/// The part of a load, a traction or an attraction up to which two are the same.
const SAME: f64 = 1e-6;

/// How much larger than the tolerance a residual of adhesion may be: the safe method ends at 100 times the tolerance.
const SLOWER: f64 = 110.0;

/// How much larger than the tolerance the certificate of a traction may be that is computed again, with another shift.
const SHIFTED: f64 = 10.0;

/// The check of the states of a history, in their order.
///
/// A state has a pressure `p` and a further displacement `v`: by the memory `A eps` of a solid that creeps, by the attraction `-A sigma`, by a plastic strain, or by a
/// traction across `beta S tau`. So its pressure is that of the heights `h - v`, and its certificate follows from these.
pub(super) struct StateCheck<'a> {
    setup: &'a Setup,
    problem: &'a Problem,
    kind: ProcessKind,
    path: Vec<PathPoint>,
    attraction: Option<Attraction>,
    /// The points of the path that were reached, and the traction of the last state.
    reached: usize,
    traction: Option<Field>,
    /// The mean pressure of the last state.
    carried: f64,
}

impl<'a> StateCheck<'a> {
    /// The check of the states of a problem.
    ///
    /// # Errors
    /// For a setup without a history, and an attraction that cannot be.
    pub fn new(setup: &'a Setup, problem: &'a Problem) -> Result<Self, SetupError> {
        let Some(kind) = setup.process()? else {
            return Err(ConflictRule::NoHistory.into());
        };
        let attraction = setup.adhesion.as_ref().map(|it| it.attraction()).transpose()?;
        let path = setup.path_points();
        Ok(Self { setup, problem, kind, path, attraction, reached: 0, traction: None, carried: 0.0 })
    }

    /// What is wrong with the next state. Its certificate becomes the one that is computed here.
    ///
    /// # Errors
    /// For fields and conditions that do not fit the solid.
    pub fn doubts(&mut self, state: &mut State) -> Result<Vec<SavedDoubt>, StudyError> {
        let mut doubts = self.missing(state);
        if !doubts.is_empty() {
            return Ok(doubts);
        }
        let speed = state.value(Quantity::Speed);
        doubts.extend(self.speed_doubt(speed));
        let problem = self.moving(self.problem.clone(), Some(speed))?;
        doubts.extend(pressure_doubts(&problem, &state.contact.pressure).into_iter().filter(is_of_nodes));
        doubts.extend(self.load_doubt(state));
        doubts.extend(self.field_doubts(&problem, state)?);
        if doubts.is_empty() {
            doubts.extend(match self.attraction.is_some() {
                true => self.adhesion_doubts(state),
                false if state.claim == ResultClaim::Moving => Vec::new(),
                false => self.certificate_doubt(&problem, state)?.into_iter().collect(),
            });
        }
        doubts.extend(self.friction_doubts(state)?);
        self.traction = state.field(FieldKind::Traction).cloned();
        self.carried = state.contact.mean_pressure();
        self.reached = state.point.map_or(self.reached, |point| point + 1);
        Ok(doubts)
    }

    /// The fields without which a state cannot be checked.
    fn missing(&self, state: &State) -> Vec<SavedDoubt> {
        let needed = self.kind.row().needed;
        let missing = needed.iter().filter(|kind| state.field(**kind).is_none());
        missing.map(|kind| SavedDoubt::Missing { name: kind.row().array }).collect()
    }

    /// The problem of a state: at rest, or at its speed where that is one of the setup.
    ///
    /// # Errors
    /// For a memory of the solid that cannot be.
    pub fn moving(&self, problem: Problem, speed: Option<f64>) -> Result<Problem, SetupError> {
        match speed.filter(|speed| self.has_speed(*speed)) {
            Some(speed) => Ok(problem.sliding(speed, &self.setup.memory()?)?),
            None => Ok(problem),
        }
    }

    /// Whether the setup has a speed.
    fn has_speed(&self, speed: f64) -> bool {
        self.setup.sliding.iter().any(|it| it.speed.contains(&speed))
    }

    /// A doubt whether the setup has the speed of a state.
    fn speed_doubt(&self, speed: f64) -> Option<SavedDoubt> {
        let is_known = self.setup.sliding.is_none() || self.has_speed(speed);
        (!is_known).then_some(SavedDoubt::Place { name: "speed", found: speed })
    }

    /// A doubt whether the state is under a load of the path.
    fn load_doubt(&self, state: &State) -> Option<SavedDoubt> {
        let is_apart = matches!(state.claim, ResultClaim::Moving | ResultClaim::Separated);
        if is_apart && self.attraction.is_some() {
            return None;
        }
        let loads = self.loads(state);
        let found = self.found(state);
        let values = loads.iter().map(|load| self.prescribed(*load));
        let [least, most] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], it| [a.min(it), b.max(it)]);
        let scale = if self.setup.load.is_pressure() { 0.0 } else { self.problem.rms_height() };
        let slack = SAME * least.abs().max(most.abs()).max(scale) + self.residual_goal() * self.strength();
        if found >= least - slack && found <= most + slack {
            return None;
        }
        let prescribed = if found < least { least } else { most };
        let name = match self.setup.load {
            Load::MeanGap(_) => "mean gap",
            Load::Approach(_) => "approach",
            _ if prescribed > 0.0 => return Some(SavedDoubt::Load { carried: found / prescribed }),
            _ => "mean pressure",
        };
        Some(SavedDoubt::Datum { name, found, prescribed })
    }

    /// The loads between which that of a state lies: that of its point, or those of the points around it.
    fn loads(&self, state: &State) -> Vec<Load> {
        if self.path.is_empty() {
            return vec![self.setup.load];
        }
        if let Some(time) = state.get(Quantity::Time) {
            return self.loads_at(time);
        }
        match state.point {
            Some(point) => self.path.get(point).map(|it| it.load).into_iter().collect(),
            None => {
                let around = [self.reached.saturating_sub(1), self.reached];
                let mut loads: Vec<Load> =
                    around.into_iter().filter_map(|point| self.path.get(point)).map(|it| it.load).collect();
                // steps to the first load begin where nothing is pressed: without a pressure, or at first touch
                if self.reached == 0 && self.kind == ProcessKind::Plastic {
                    let first = if self.setup.load.is_pressure() { 0.0 } else { self.problem.highest() };
                    loads.push(self.setup.load.with_value(first));
                }
                loads
            }
        }
    }

    /// The loads at a time: one, or those of a sudden change.
    fn loads_at(&self, time: f64) -> Vec<Load> {
        let at = |point: &PathPoint| point.time.unwrap_or(0.0);
        let mut loads: Vec<Load> = self.path.iter().filter(|point| at(point) == time).map(|it| it.load).collect();
        for pair in self.path.windows(2).filter(|pair| at(&pair[0]) < time && time < at(&pair[1])) {
            let [from, to] = [&pair[0], &pair[1]];
            let share = (time - at(from)) / (at(to) - at(from));
            let value = from.load.value() + share * (to.load.value() - from.load.value());
            loads.push(from.load.with_value(value));
        }
        // the first load is applied at once
        loads.extend(self.path.first().filter(|first| time < at(first) || time == 0.0).map(|it| it.load));
        loads
    }

    /// What a load prescribes: a mean pressure, a mean gap or an approach.
    fn prescribed(&self, load: Load) -> f64 {
        match load {
            Load::ReducedPressure(reduced) => reduced * self.problem.rms_gradient() * self.problem.contact_modulus(),
            Load::Force(force) => force / self.problem.surface().grid().area(),
            Load::MeanPressure(value) | Load::MeanGap(value) | Load::Approach(value) => value,
        }
    }

    /// What a state has of it.
    fn found(&self, state: &State) -> f64 {
        let attraction = state.field(FieldKind::Attraction).and_then(|it| it.mean()).unwrap_or(0.0);
        match self.setup.load {
            Load::MeanGap(_) => state.contact.mean_gap(),
            Load::Approach(_) => state.contact.approach().unwrap_or(f64::NAN),
            _ => state.contact.mean_pressure() - attraction,
        }
    }

    /// The displacement by what acts besides the pressure.
    fn further(&self, problem: &Problem, state: &State) -> Result<Field, StudyError> {
        let grid = problem.surface().grid();
        let mut further = vec![0.0; problem.nodes()];
        if let Some(memory) = state.field(FieldKind::StoredStrain) {
            problem.response().displacement(values(memory), &mut further);
        }
        if let Some(attraction) = state.field(FieldKind::Attraction) {
            problem.response().displacement(values(&(-attraction)), &mut further);
        }
        if let Some(imprint) = state.field(FieldKind::Imprint) {
            further.iter_mut().zip(imprint).for_each(|(further, imprint)| *further += imprint);
        }
        let beta = self.setup.dundurs_beta();
        if let Some(traction) = state.field(FieldKind::Traction).filter(|_| beta != 0.0) {
            let across = state.field(FieldKind::TractionAcross).map(|it| it.to_owned());
            let across = across.map_or_else(Vec::new, |it| it.into_iter().collect());
            let mut coupling = self.coupling(problem)?;
            coupling.by_traction([values(traction), &across], &mut further);
            further.iter_mut().for_each(|u| *u *= beta);
        }
        Ok(Field::from_shape_vec(grid.shape(), further).expect("one value per node"))
    }

    /// What a traction displaces into the solid.
    fn coupling(&self, problem: &Problem) -> Result<Coupling, StudyError> {
        let (grid, solid) = (problem.surface().grid(), problem.solid().as_ref());
        let step = self.setup.rolling.as_ref().map(|it| it.step.unwrap_or(grid.spacing()[1]));
        Ok(match step {
            Some(step) => Coupling::rolling(grid, solid, step).map_err(SetupError::from)?,
            None => Coupling::new(grid, solid).map_err(SetupError::from)?,
        })
    }

    /// Doubts whether displacement and gap are those of the pressure and of what acts besides, up to a constant.
    fn field_doubts(&self, problem: &Problem, state: &State) -> Result<Vec<SavedDoubt>, StudyError> {
        let contact = &state.contact;
        let further = self.further(problem, state)?;
        let mut own = Field::zeros(further.dim());
        let target = own.as_slice_mut().expect("standard layout");
        problem.response().displacement(values(&contact.pressure), target);
        let all = &own + &further;
        let heights = problem.surface().height();
        let scale = largest(&all) + largest(heights) + self.violation(problem);
        let is_own = |saved: &Field, computed: &Field| {
            let difference = saved - computed;
            let constant = difference.mean().unwrap_or(0.0);
            is_same(&difference, &Field::from_elem(difference.dim(), constant), scale)
        };
        if !is_own(&contact.displacement, &all) {
            return Ok(vec![SavedDoubt::Displacement]);
        }
        let has_gap = is_own(&contact.gap, &(&all - heights)) && contact.gap.iter().all(|g| *g >= -scale);
        Ok((!has_gap).then_some(SavedDoubt::Gap).into_iter().collect())
    }

    /// The displacement by a violation of equilibrium within the tolerance, over [`SAME`].
    fn violation(&self, problem: &Problem) -> f64 {
        let [softest, _] = problem.compliance().stiffness_range();
        self.residual_goal() * self.strength() / softest / SAME
    }

    /// The largest attraction, a pressure; 0 without adhesion.
    fn strength(&self) -> f64 {
        self.attraction.as_ref().map_or(0.0, Attraction::strength)
    }

    fn residual_goal(&self) -> f64 {
        SLOWER * self.setup.stop.tolerance().clamp(1e-11, 0.1)
    }

    /// A doubt whether the pressure solves its problem, for what acts besides as it is.
    fn certificate_doubt(&self, problem: &Problem, state: &mut State) -> Result<Option<SavedDoubt>, StudyError> {
        let pressure = &state.contact.pressure;
        if pressure.iter().all(|p| *p == 0.0) {
            return Ok(None);
        }
        let further = self.further(problem, state)?;
        let load = Load::MeanPressure(state.contact.mean_pressure());
        // a solid that yields is pressed to a mean gap by the pressure that leaves it
        let is_pressed = self.setup.load.is_pressure() || self.kind == ProcessKind::Plastic;
        let load = if is_pressed { load } else { state.contact.problem.load() };
        let posed = problem.with_heights(problem.surface().height() - &further).map_err(SetupError::from)?;
        let Ok(posed) = posed.with_load(load) else {
            return Ok(Some(SavedDoubt::Certificate { eta: f64::INFINITY })); // nothing touches under such a load
        };
        let found = Certificate::new(&posed, values(pressure));
        // the goal of the pressure is that of the whole step in time
        let eta_alone = Certificate { pressure_error_bound: 0.0, ..found };
        let is_solved = state.contact.status != Status::Converged || is_met(&self.setup.stop, &eta_alone);
        let saved = state.contact.certificate.eta;
        let is_near = (saved - found.eta).abs() <= 0.1 * found.eta + found.rounding;
        state.contact.certificate = Certificate { eta: if is_near { saved } else { found.eta }, ..found };
        Ok((!is_solved).then_some(SavedDoubt::Certificate { eta: found.eta }))
    }

    /// Doubts whether a state with adhesion is in equilibrium with its own attraction.
    fn adhesion_doubts(&self, state: &State) -> Vec<SavedDoubt> {
        let (Some(attraction), Some(sigma)) = (&self.attraction, state.field(FieldKind::Attraction)) else {
            return Vec::new();
        };
        let (contact, strength) = (&state.contact, attraction.strength());
        if state.claim == ResultClaim::Separated {
            let is_apart = largest(sigma) == 0.0 && largest(&contact.pressure) == 0.0;
            return if is_apart { Vec::new() } else { vec![SavedDoubt::Attraction] };
        }
        let is_own = |(sigma, gap): (&f64, &f64)| (sigma - attraction.traction(gap.max(0.0))).abs() <= SAME * strength;
        if !sigma.iter().zip(&contact.gap).all(is_own) {
            return vec![SavedDoubt::Attraction];
        }
        if state.claim == ResultClaim::Moving {
            return Vec::new();
        }
        let residual = self.residual(contact, sigma) / strength;
        (residual > self.residual_goal()).then_some(SavedDoubt::Equilibrium { residual }).into_iter().collect()
    }

    /// The largest violation of equilibrium at a node, a pressure: contact pressure beside a gap, and on periodic grids a force that the pressure does
    /// not balance.
    fn residual(&self, contact: &crate::contact::Contact, sigma: &Field) -> f64 {
        let reach = SAME * self.problem.rms_height();
        let beside = contact.pressure.iter().zip(&contact.gap).filter(|(_, gap)| **gap > reach);
        let beside = beside.map(|(p, _)| *p).fold(0.0, f64::max);
        if !self.problem.surface().grid().is_periodic() {
            return beside;
        }
        let mut force = Field::zeros(sigma.dim());
        let target = force.as_slice_mut().expect("standard layout");
        self.problem.response().pressure(values(&contact.displacement), target);
        let missed = &contact.pressure - sigma - &force;
        let mean = missed.mean().unwrap_or(0.0);
        missed.iter().map(|it| (it - mean).abs()).fold(beside, f64::max)
    }

    /// Doubts whether the traction is one that friction carries, and that follows from the state before.
    fn friction_doubts(&self, state: &State) -> Result<Vec<SavedDoubt>, StudyError> {
        let (Some(along), Some(friction)) = (state.field(FieldKind::Traction), self.setup.friction) else {
            return Ok(Vec::new());
        };
        let (pressure, mu) = (&state.contact.pressure, friction.coefficient);
        let across = state.field(FieldKind::TractionAcross);
        let length = |i: usize| values(along)[i].hypot(across.map_or(0.0, |it| values(it)[i]));
        let most = mu * largest(pressure);
        let excess = (0..pressure.len()).map(|i| length(i) - mu * values(pressure)[i]).fold(0.0, f64::max);
        if excess > SAME.max(self.setup.stop.tolerance()) * most {
            return Ok(vec![SavedDoubt::Friction { excess: excess / most }]);
        }
        let doubt = self.tangential_doubt(state, along);
        // a state under another normal load may have been reached in steps that were not saved
        let risen = state.contact.mean_pressure() - self.carried;
        let is_one_step = self.traction.is_none() || risen.abs() <= SAME * self.carried;
        if doubt.is_some()
            || self.kind != ProcessKind::Slip
            || across.is_some()
            || self.setup.dundurs_beta() != 0.0
            || !is_one_step
        {
            return Ok(doubt.into_iter().collect());
        }
        let eta = self.slip_certificate(along, pressure, mu)?;
        let is_solved = state.contact.status != Status::Converged || eta <= SHIFTED * self.setup.stop.tolerance();
        Ok((!is_solved).then_some(SavedDoubt::Slip { eta }).into_iter().collect())
    }

    /// A doubt whether a traction carries a tangential load of the setup.
    fn tangential_doubt(&self, state: &State, along: &Field) -> Option<SavedDoubt> {
        let found = along.mean().unwrap_or(0.0);
        let prescribed: Vec<f64> = match self.kind {
            ProcessKind::Rolling => {
                let rolling = self.setup.rolling.as_ref()?;
                if rolling.tangential.is_empty() {
                    let creepage = state.value(Quantity::Creepage);
                    let is_known = rolling.creepage.iter().any(|it| (it - creepage).abs() <= SAME * it.abs());
                    return (!is_known).then_some(SavedDoubt::Place { name: "creepage", found: creepage });
                }
                rolling.tangential.clone()
            }
            _ => match state.point {
                Some(point) => self.path.get(point).map(|it| it.tangential.unwrap_or(0.0)).into_iter().collect(),
                None => return None,
            },
        };
        let over = |value: f64| self.prescribed(self.setup.load.with_value(value));
        let slack = SAME * self.setup.friction?.coefficient * state.contact.mean_pressure();
        let nearest =
            prescribed.into_iter().map(over).min_by(|a, b| (a - found).abs().total_cmp(&(b - found).abs()))?;
        ((nearest - found).abs() > slack).then_some(SavedDoubt::Tangential { found, prescribed: nearest })
    }

    /// The certificate of a traction along `x` after that of the state before, with the shift of the rigid surface that suits it best: see
    /// [`SlipCertificate`](crate::history::SlipCertificate).
    fn slip_certificate(&self, along: &Field, pressure: &Field, mu: f64) -> Result<f64, StudyError> {
        let grid = self.problem.surface().grid();
        let compliance = Compliance::tangential(grid, self.problem.solid().clone(), 0.0).map_err(SetupError::from)?;
        let mut response = Response::from_compliance(Arc::new(compliance));
        let change = self.traction.as_ref().map_or_else(|| along.clone(), |before| along - before);
        let [mut moved, mut pressed] = [(); 2].map(|()| vec![0.0; along.len()]);
        response.displacement(values(&change), &mut moved);
        response.displacement(values(pressure), &mut pressed);
        let n = along.len() as f64;
        let nodes = || (0..along.len()).filter(|i| values(pressure)[*i] > 0.0);
        let missed = |shift: f64| {
            let of = |i: usize| {
                let slip = moved[i] - shift;
                slip * values(along)[i] + mu * values(pressure)[i] * slip.abs()
            };
            nodes().map(of).sum::<f64>() / n
        };
        // the sum is convex in the shift, and linear between the displacements of two nodes
        let mut shifts: Vec<f64> = nodes().map(|i| moved[i]).collect();
        shifts.sort_unstable_by(f64::total_cmp);
        let (mut low, mut high) = (0, shifts.len().saturating_sub(1));
        while low < high {
            let middle = (low + high) / 2;
            if missed(shifts[middle]) <= missed(shifts[middle + 1]) { high = middle } else { low = middle + 1 }
        }
        let gap = shifts.get(low).map_or(0.0, |shift| missed(*shift));
        let length = mu * (pressed.iter().map(|u| u * u).sum::<f64>() / n).sqrt();
        let work = mu * pressure.mean().unwrap_or(0.0) * length;
        Ok(if work > 0.0 { gap.max(0.0) / work } else { 0.0 })
    }
}

/// Whether a doubt concerns single nodes.
fn is_of_nodes(doubt: &SavedDoubt) -> bool {
    matches!(doubt, SavedDoubt::Tension { .. } | SavedDoubt::AboveHardness { .. })
}

fn values(field: &Field) -> &[f64] {
    field.as_slice().expect("fields are in standard layout")
}
