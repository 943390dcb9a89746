//! The process of loads on a solid that yields below its surface.

use super::flow::FlowLaw;
use super::load_step::{FlowIterate, LoadStep};
use super::pressing::Pressing;
use super::{PlasticCertificate, PlasticEnergy, PlasticSolid, PlasticState};
use crate::contact::{Feels, Load, Observer, Problem, Quantity, Solver, StateValues, Status, Stop, Work};
use crate::elastic::{DepthLayers, DepthResponse};
use crate::error::PlasticError;
use crate::grid::Grid;
use crate::history::apart::apart;
use crate::memory::check_bytes;
use crate::surface::Field;
use ndarray::{Array2, Array3, Axis};

/// The tolerance of the relative gap, and the most iterations of a step, if none are given.
const TOLERANCE: f64 = 1e-6;
const MOST_ITERATIONS: usize = 1000;
/// The tolerance `eta` of a contact from which a work or a first pressure is found.
pub(super) const CONTACT_TOLERANCE: f64 = 1e-11;
/// Tensors below each node: strain and stress before the step, increment, its successor and stress in the step.
const TENSORS: f64 = 5.0;
/// Tensors of Anderson's method for each place that flows: twelve of earlier points, and those of the new one.
const TENSORS_OF_FLOW: f64 = 18.0;
/// Further numbers for each place: two accumulated strains.
const NUMBERS: f64 = 2.0;
/// The largest relative difference of the contact moduli of problem and solid.
const SAME_MODULUS: f64 = 1e-9;

/// Loads, up and down, on a half-space that yields below its surface, one step after the other.
///
/// A step is implicit in the plastic strain (backward Euler): flow and contact at its end belong together. Each step is the minimum of one convex energy, and its
/// certificate bounds the distance from it, see [`PlasticCertificate`]. So the claim of a converged state is: *the solution of the load step on this grid and these
/// layers*. Three other errors have other names, and are estimated by solving again:
///
/// - the error of the steps, of first order in their length;
/// - the error of the layers, of an order between one and two in their thickness;
/// - the error of the grid.
///
/// [`PlasticLoading::with_errors`](super::PlasticLoading::with_errors) estimates all three.
///
/// An elastic step takes one contact. Unloading and loading again are steps like any other; flow in reverse on unloading is included. Where the solid is
/// fully plastic and hardly hardens, the pressure differs by some percent from node to node: that is the minimum on the grid. Sums such as load, area
/// and approach are more accurate than the pressure of one node.
///
/// Memory: 5 tensors below each node, 18 more where the solid flows, and the [`DepthResponse`].
///
/// ```
/// use asperity::contact::{ContactModulus, Load, PolonskyKeer};
/// use asperity::elastic::DepthLayers;
/// use asperity::history::{Plastic, PlasticSolid};
/// use asperity::{Grid, Indenter, Problem};
/// let solid = PlasticSolid::new(1.0, 0.3, 0.005, 0.05)?;
/// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(128, 1.0)?)?;
/// let problem = Problem::new(cylinder, ContactModulus(solid.contact_modulus()), Load::MeanPressure(1e-3))?;
/// let layers = DepthLayers::below(1.0 / 128.0, 0.2)?;
/// let mut plastic = Plastic::new(problem, solid, layers, &PolonskyKeer)?;
/// // nothing yields yet
/// let state = plastic.press(Load::MeanPressure(2e-4), &mut ())?;
/// assert!(state.is_converged && state.iterations == 0 && state.deepest_yield().is_none());
/// // this dents the solid, which keeps an imprint
/// let state = plastic.press(Load::MeanPressure(1.5e-3), &mut ())?;
/// assert!(state.is_converged && state.mean_contact_pressure() > 0.005);
/// let state = plastic.press(Load::MeanPressure(0.0), &mut ())?;
/// assert!(state.imprint_depth() > 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// Derived for this crate. Radial return: Simo & Hughes, *Computational Inelasticity* (1998), section 3.3. Contacts of this kind by volume integrals: Jacq et
/// al., J. Tribol. 124, 653 (2002); Frérot et al., Comput. Methods Appl. Mech. Eng. 351, 951 (2019).
pub struct Plastic<'s> {
    problem: Problem,
    solid: PlasticSolid,
    response: DepthResponse,
    solver: &'s dyn Solver,
    tolerance: f64,
    most_iterations: usize,
    /// Whether layers are added where the last one yields.
    grows: bool,
    /// The iterates of the last step, if they are kept.
    iterations: Option<Vec<PlasticState>>,
    state: PlasticState,
}

impl<'s> Plastic<'s> {
    /// The process of a problem, whose own load is not used, on a solid with layers in which it may yield. The solver solves the contact within each
    /// iteration of a step.
    ///
    /// # Errors
    /// [`PlasticError::OtherSolid`] for a problem whose solid is not a half-space of the same contact modulus, [`PlasticError::Hardness`] for one with a
    /// hardness, [`PlasticError::NeedsPeriodic`] for a grid with a free boundary, and [`PlasticError::Memory`] for more layers and nodes than fit in memory.
    pub fn new(
        problem: Problem,
        solid: PlasticSolid,
        layers: DepthLayers,
        solver: &'s dyn Solver,
    ) -> Result<Self, PlasticError> {
        let (found, expected) = (problem.contact_modulus(), solid.contact_modulus());
        if !problem.solid().is_half_space() || (found / expected - 1.0).abs() > SAME_MODULUS {
            return Err(PlasticError::OtherSolid { solid: problem.solid().description(), found, expected });
        }
        if problem.ceiling().is_finite() {
            return Err(PlasticError::Hardness);
        }
        let grid = *problem.surface().grid();
        check_memory(&grid, &layers)?;
        let response = DepthResponse::new(&grid, solid.young(), solid.poisson(), layers)?;
        let state = Self::at_rest(&problem, &solid, &response);
        let (tolerance, most_iterations) = (TOLERANCE, MOST_ITERATIONS);
        Ok(Self { problem, solid, response, solver, tolerance, most_iterations, grows: false, iterations: None, state })
    }

    /// The process with another tolerance of the [relative gap](PlasticCertificate::relative_gap) of each step, dimensionless; 1e-6 if it is not given.
    ///
    /// # Errors
    /// [`PlasticError::Range`] for a tolerance that is not positive and finite.
    pub fn with_tolerance(self, tolerance: f64) -> Result<Self, PlasticError> {
        if !(tolerance.is_finite() && tolerance > 0.0) {
            let name = "the tolerance of the relative gap";
            return Err(PlasticError::Range { name, value: tolerance, range: "(0, infinity)" });
        }
        Ok(Self { tolerance, ..self })
    }

    /// The process with another largest number of iterations of a step, after which it is returned as not converged.
    pub fn with_max_iterations(self, most_iterations: usize) -> Self {
        Self { most_iterations, ..self }
    }

    /// The process that adds layers with [`DepthLayers::deepened`] and repeats the step where the last layer yields.
    pub fn with_growing_depth(self) -> Self {
        Self { grows: true, ..self }
    }

    /// The process that keeps the iterates of each step, see [`Plastic::take_iterations`].
    pub fn with_iterations(self) -> Self {
        Self { iterations: Some(Vec::new()), ..self }
    }

    /// The states on the way of the last step, one for each iteration but the last one: contact and flow do not belong together in them yet. Empty unless they are
    /// [kept](Plastic::with_iterations).
    pub fn take_iterations(&mut self) -> Vec<PlasticState> {
        self.iterations.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// The last state; before the first load that without pressure and strain.
    pub fn state(&self) -> &PlasticState {
        &self.state
    }

    /// A process of another problem and of other layers, which has not begun.
    pub(super) fn like(&self, problem: Problem, layers: DepthLayers) -> Result<Self, PlasticError> {
        let other = Self::new(problem, self.solid, layers, self.solver)?;
        let Self { tolerance, most_iterations, grows, .. } = *self;
        Ok(Self { tolerance, most_iterations, grows, ..other })
    }

    /// Goes on from a state that a process of the same problem, solid and layers has reached.
    ///
    /// # Panics
    /// If the state does not fit the grid and the layers.
    pub fn resume(&mut self, state: PlasticState) {
        assert_eq!(state.strain.dim(), self.state.strain.dim(), "the state must fit the grid and the layers");
        self.state = state;
    }

    /// The solid.
    pub fn solid(&self) -> &PlasticSolid {
        &self.solid
    }

    /// The bytes that the process takes below a grid, if a share of the places in the layers flows in one step, from 0 to 1.
    pub fn bytes(grid: &Grid, layers: &DepthLayers, flow: f64) -> f64 {
        let tensors = (TENSORS + flow * TENSORS_OF_FLOW) * size_of::<f64>() as f64 + DepthResponse::BYTES;
        let places = layers.count() as f64 * grid.len() as f64;
        places * (DepthResponse::components(grid) as f64 * tensors + NUMBERS * size_of::<f64>() as f64)
    }

    /// The problem, whose own load is not used.
    pub(super) fn problem(&self) -> &Problem {
        &self.problem
    }

    /// What solves the contacts.
    pub(super) fn solver(&self) -> &dyn Solver {
        self.solver
    }

    /// Refuses a load that cannot be.
    ///
    /// # Errors
    /// The errors of [`Plastic::press`] that are known before anything is solved, such as a load under which the solid yields at all depths.
    pub fn check(&self, load: Load) -> Result<(), PlasticError> {
        match load {
            Load::MeanGap(gap) if gap.is_finite() && gap > 0.0 => Ok(()),
            Load::MeanGap(gap) => Err(PlasticError::NotPositive { name: "mean gap", value: gap }),
            pressure => self.posed(pressure).map(drop),
        }
    }

    /// Solves one step to a load: a pressure or a force, which may be zero, or a mean gap, a length. At a mean gap the state is that of the load step under the
    /// mean pressure that is found for it, which takes some load steps. A step that has not converged is returned, and says so.
    ///
    /// # Errors
    /// [`PlasticError::NeedsPressure`] for an approach, [`PlasticError::Load`] for a pressure or a force that is negative or not finite,
    /// [`PlasticError::NotPositive`] for such a mean gap, [`PlasticError::YieldsEverywhere`] for a mean pressure above [`PlasticSolid::deep_limit`], and
    /// those of the solver.
    pub fn press(&mut self, load: Load, observer: &mut dyn Observer) -> Result<&PlasticState, PlasticError> {
        self.check(load)?;
        let mut state = match load {
            Load::MeanGap(gap) => self.step_to_gap(gap, observer)?,
            pressure => self.step(pressure, observer)?,
        };
        let (before, work) = (self.state.energy, self.work_of_step(&state, observer)?);
        let taken_up = state.energy.elastic + state.energy.plastic - before.elastic - before.plastic;
        state.energy.work = before.work + work;
        state.energy.imbalance = before.imbalance + (work - taken_up).abs();
        self.state = state;
        Ok(&self.state)
    }

    /// The work of the load in the step from the last state to another one, per area.
    fn work_of_step(&self, state: &PlasticState, observer: &mut dyn Observer) -> Result<f64, PlasticError> {
        let pressing = |state: &PlasticState| Pressing::from_whole(&state.contact, &state.residual);
        let (before, after) = (pressing(&self.state), pressing(state));
        if state.strain == self.state.strain {
            return Ok(before.elastic_work(&after));
        }
        let pressure = self.state.contact.mean_pressure();
        let mut flowed = Pressing::default();
        if pressure > 0.0 {
            let heights = self.problem.surface().height() - &state.residual;
            let posed = self.problem.with_heights(heights)?.with_load(Load::MeanPressure(pressure))?;
            let (start, stop) = (Some(&self.state.contact.pressure), Stop::default().at(CONTACT_TOLERANCE));
            flowed = Pressing::new(&self.solver.solve_from(start, &posed, &stop, observer)?, &state.residual);
        }
        Ok(before.work(&state.unflowed, &flowed, &after))
    }

    /// The state after a load step to a pressure or a force, which is not kept; layers that were added are.
    pub(super) fn step(&mut self, load: Load, observer: &mut dyn Observer) -> Result<PlasticState, PlasticError> {
        let problem = self.posed(load)?;
        loop {
            let (before, of_problem, iterations) = (&self.state, &self.problem, &mut self.iterations);
            iterations.iter_mut().for_each(Vec::clear);
            let mut each = |now: &FlowIterate| {
                iterations.iter_mut().for_each(|all| all.push(before.after(of_problem, load, now.clone())));
            };
            let step = LoadStep {
                law: FlowLaw::new(&self.solid),
                before,
                problem: problem.clone(),
                response: &mut self.response,
                solver: self.solver,
                observer: &mut *observer,
                each: &mut each,
                tolerance: self.tolerance,
                most_iterations: self.most_iterations,
            };
            let reached = step.run()?;
            let state = self.state.after(&self.problem, load, reached);
            if !(self.grows && state.reaches_the_bottom()) {
                return Ok(state);
            }
            self.grow()?;
        }
    }

    /// Adds layers without plastic strain below the last one.
    fn grow(&mut self) -> Result<(), PlasticError> {
        let (grid, layers) = (*self.problem.surface().grid(), self.state.layers.deepened()?);
        check_memory(&grid, &layers)?;
        let (young, poisson) = (self.solid.young(), self.solid.poisson());
        self.response = DepthResponse::new(&grid, young, poisson, layers.clone())?;
        let before = &self.state;
        let mut strain = self.response.zeros();
        strain.iter_mut().zip(&before.strain).for_each(|(to, from)| *to = *from);
        let mut accumulated = Array2::zeros((layers.count(), grid.len()));
        accumulated.iter_mut().zip(&before.accumulated).for_each(|(to, from)| *to = *from);
        let pressure: Vec<f64> = before.contact.pressure.iter().copied().collect();
        let stress = self.response.stress_of(&strain, &pressure);
        self.state = PlasticState { strain, accumulated, stress, layers, ..before.clone() };
        Ok(())
    }

    /// Goes to a load in a number of equal steps, at least one. The error of the steps is of first order in their length.
    ///
    /// # Errors
    /// The errors of [`Plastic::press`].
    pub fn press_in(
        &mut self,
        steps: usize,
        load: Load,
        observer: &mut dyn Observer,
    ) -> Result<&PlasticState, PlasticError> {
        let from = self.start_of(load);
        for step in 1..steps {
            let share = step as f64 / steps as f64;
            self.press(load.with_value(from + share * (load.value() - from)), observer)?;
        }
        self.press(load, observer)
    }

    /// The number from which steps to a load begin: that of the last load of its kind, or else that at which the surfaces just touch.
    pub(super) fn start_of(&self, load: Load) -> f64 {
        let same_kind = self.state.load.filter(|last| last.name() == load.name());
        let touching = if matches!(load, Load::MeanGap(_)) { self.problem.highest() } else { 0.0 };
        same_kind.map_or(touching, |last| last.value())
    }

    /// The problem under a load; none for a load of zero.
    fn posed(&self, load: Load) -> Result<Option<Problem>, PlasticError> {
        if !load.is_pressure() {
            return Err(PlasticError::NeedsPressure { load: load.name() });
        }
        if !(load.value().is_finite() && load.value() >= 0.0) {
            return Err(PlasticError::Load { load: load.name(), value: load.value() });
        }
        if load.value() == 0.0 {
            return Ok(None);
        }
        let problem = self.problem.clone().with_load(load)?;
        let (mean_pressure, limit) = (problem.expected_mean_pressure(), self.solid.deep_limit());
        if mean_pressure > limit {
            return Err(PlasticError::YieldsEverywhere { mean_pressure, limit });
        }
        Ok(Some(problem))
    }

    /// The state before the first load.
    fn at_rest(problem: &Problem, solid: &PlasticSolid, response: &DepthResponse) -> PlasticState {
        let residual = Field::zeros(problem.surface().grid().shape());
        let strain = response.zeros();
        let (layers, _, nodes) = strain.dim();
        PlasticState {
            load: None,
            contact: apart(problem.clone(), residual.clone(), Work::default(), None),
            stress: strain.clone(),
            strain,
            accumulated: Array2::zeros((layers, nodes)),
            residual,
            certificate: PlasticCertificate::default(),
            energy: PlasticEnergy::default(),
            iterations: 0,
            is_converged: true,
            unflowed: Pressing::default(),
            layers: response.layers().clone(),
            solid: *solid,
        }
    }
}

impl PlasticState {
    /// The state that an iterate of a step reaches.
    fn after(&self, problem: &Problem, load: Load, reached: FlowIterate) -> Self {
        let before = self;
        let FlowIterate {
            increment, stress, residual, contact, certificate, iterations, status, unflowed, work, ..
        } = reached;
        let is_converged = status == Status::Converged && before.is_converged;
        let mut contact = match contact {
            None => apart(before.contact.problem.clone(), residual.clone(), work, None),
            Some(contact) => {
                let certificate = contact.certificate;
                let problem = problem.clone().with_load(load).expect("the load was posed before");
                let added = residual.as_slice().expect("standard layout").to_vec();
                contact.with_work(work).displaced_by(problem, &added, certificate)
            }
        };
        // a step that converged goes on from the strain of one that did not
        contact.status = if status == Status::Converged { before.contact.status } else { status };
        let mut accumulated = before.accumulated.clone();
        accumulate(&mut accumulated, &increment);
        let plastic = before.energy.plastic + certificate.dissipated + reached.back_work;
        // the work is found for the end of a step only
        let energy = PlasticEnergy { elastic: reached.elastic, plastic, work: f64::NAN, imbalance: f64::INFINITY };
        let mut state = PlasticState {
            load: Some(load),
            contact,
            strain: &before.strain + &increment,
            accumulated,
            stress,
            residual,
            certificate,
            energy,
            iterations,
            is_converged,
            unflowed: unflowed.unwrap_or_default(),
            layers: before.layers.clone(),
            solid: before.solid,
        };
        // the edges of a contact differ where its solid has yielded
        let values = StateValues::new(Feels::EIGENSTRAIN).with(Quantity::MaxPlasticStrain, state.max_accumulated());
        state.contact = state.contact.with_values(values);
        state
    }
}

/// Adds the amounts of an increment.
fn accumulate(accumulated: &mut Array2<f64>, increment: &Array3<f64>) {
    let amount = |parts: [f64; 2]| (2.0 / 3.0 * (parts[0] + 2.0 * parts[1])).sqrt();
    for (mut alpha, increment) in accumulated.outer_iter_mut().zip(increment.outer_iter()) {
        for (alpha, tensor) in alpha.iter_mut().zip(increment.axis_iter(Axis(1))) {
            let squares = |range: std::ops::Range<usize>| range.map(|c| tensor[c] * tensor[c]).sum::<f64>();
            *alpha += amount([squares(0..3), squares(3..tensor.len())]);
        }
    }
}

/// Refuses more layers and nodes than fit in memory, even if nothing flows.
fn check_memory(grid: &Grid, layers: &DepthLayers) -> Result<(), PlasticError> {
    let needed = Plastic::bytes(grid, layers, 0.0);
    let refuse = |free| PlasticError::Memory { layers: layers.count(), shape: grid.shape(), needed, free };
    check_bytes(needed).map_err(|missing| refuse(missing.free))
}
