//! The process of a setup: which history it describes, and what makes it.

use super::process_kind::STEPS_OF_ADHESION;
use super::{ProcessKind, RollingMotion, Setup, Solid, YieldLaw};
use crate::adhesion::{AdhesiveMethod, AdhesiveMotion, AdhesiveProblem};
use crate::contact::{Load, Problem};
use crate::elastic::{DepthLayers, Prony};
use crate::error::{AdhesionError, ConflictRule, HistoryError, PlasticError, SetupError, SlipError};
use crate::grid::Grid;
use crate::history::{
    AdhesiveProcess, CreepProcess, PathPoint, Plastic, PlasticLoading, PlasticSolid, Process, RollingConditions,
    RollingDrive, RollingProcess, SlidingProcess, SlipHistory, SlipPace, SlipProcess,
};
use strum::IntoEnumIterator;

/// The estimated relative error in time, if none is given.
const TIME_TOLERANCE: f64 = 1e-2;

/// The estimated relative error by the steps of a path with friction, if none is given.
const PATH_TOLERANCE: f64 = 1e-2;

/// The iterations of a load step that are expected.
const ITERATIONS: usize = 30;
/// The memory of a history of yielding with those that estimate its errors, over its own: one of the same places, and others of at most a half, a half and a quarter.
const HISTORIES: f64 = 3.25;
/// Transforms of the surface that take as long as a load step in one layer, without flow and with it. Measured on a line of 512 nodes, a ball of 48 x 48 and a
/// rough surface of 64 x 64: 220 to 450 with flow.
const TRANSFORMS_OF_LAYER: [f64; 2] = [20.0, 300.0];
/// The time of a history of yielding with those that estimate its errors, over its own: twice the steps, a half, a quarter and a quarter of the places.
const TIMES_OF_ERRORS: f64 = 4.0;
/// Load steps by which the pressure of a given mean gap is found.
const TRIALS_OF_GAP: f64 = 6.0;

impl Setup {
    /// The process that the setup describes; none for a contact without a history.
    ///
    /// # Errors
    /// [`SetupError::Conflict`] for sections that do not go together.
    pub fn process(&self) -> Result<Option<ProcessKind>, SetupError> {
        self.check_together()?;
        Ok(ProcessKind::iter().find(|kind| (kind.row().is_given)(self)))
    }

    /// Whether the setup describes more than one state. A contact that slides at one speed is a single state, solved like any other.
    ///
    /// # Errors
    /// The errors of [`Setup::process`].
    pub fn is_history(&self) -> Result<bool, SetupError> {
        Ok(self.process()?.is_some() && self.speed().is_none())
    }

    /// The number of states of a history, an estimate where steps are chosen by the error in time; 0 for one contact.
    ///
    /// # Errors
    /// The errors of [`Setup::process`].
    pub fn expected_states(&self) -> Result<usize, SetupError> {
        Ok(self.process()?.filter(|_| self.speed().is_none()).map_or(0, |kind| (kind.row().states)(self)))
    }

    /// The states along the path, with a number of steps between two points if none is given.
    pub(super) fn states_of_path(&self, steps: usize) -> usize {
        let Some(path) = &self.path else { return 0 };
        // a path in time that begins at time 0 has a single state there
        let begins = usize::from(path.time.first() == Some(&0.0));
        begins + (path.len() - begins).saturating_mul(path.steps.unwrap_or(steps))
    }

    /// The frames of motions in a history with adhesion, if there is one long jump from each point of the path to the next.
    pub(super) fn expected_frames(&self) -> usize {
        let moves = self.adhesion.as_ref().is_some_and(|it| it.method == AdhesiveMethod::Gfmd);
        let ways = self.path_points().len().saturating_sub(1);
        if moves { ways * AdhesiveMotion::MOST_FRAMES } else { 0 }
    }

    /// The speed of sliding, if there is one speed.
    pub(crate) fn speed(&self) -> Option<f64> {
        match self.sliding.as_ref()?.speed.as_slice() {
            [speed] => Some(*speed),
            _ => None,
        }
    }

    /// The Prony series of the solid; without terms for one that does not creep.
    fn prony(&self) -> Result<Prony, SetupError> {
        Ok(self.viscoelastic.as_ref().map(super::Viscoelastic::prony).transpose()?.unwrap_or_default())
    }

    /// The terms of a solid that creeps, a ratio and a time each.
    pub(crate) fn memory(&self) -> Result<Vec<(f64, f64)>, SetupError> {
        Ok(self.prony()?.terms().iter().map(|term| (term.ratio, term.time)).collect())
    }

    /// Whether the solid creeps under a contact that does not slide.
    pub(super) fn creeps(&self) -> bool {
        self.viscoelastic.is_some() && self.sliding.is_none()
    }

    /// The points of the path of a history; with adhesion or a yield stress the load alone if it has none, and else none.
    pub fn path_points(&self) -> Vec<PathPoint> {
        let points = self.path.as_ref().map_or_else(Vec::new, |path| path.points(self.load));
        let has_load = self.yields() || (self.adhesion.is_some() && self.path.is_none());
        if points.is_empty() && has_load { vec![PathPoint::under(self.load)] } else { points }
    }

    /// How the solid yields below its surface, if anything of it is given.
    pub(super) fn yield_law(&self) -> Option<&YieldLaw> {
        self.solid.as_ref().and_then(Solid::yield_law)
    }

    /// Whether the solid yields below its surface.
    pub fn yields(&self) -> bool {
        self.yield_stress().is_some()
    }

    /// The yield stress of a solid that yields below its surface, a pressure.
    pub fn yield_stress(&self) -> Option<f64> {
        self.yield_law()?.yield_stress
    }

    /// Whether the solid yields in layers that were given, to which none are added.
    pub fn has_fixed_layers(&self) -> bool {
        self.yields() && self.yield_law().is_some_and(|law| !law.grows())
    }

    /// The number of steps from load to load of a solid that yields.
    pub fn yield_steps(&self) -> usize {
        self.path.as_ref().and_then(|path| path.steps).unwrap_or(1)
    }

    /// Whether the errors of a solid that yields are estimated, by other histories beside its own.
    pub fn estimates_errors(&self) -> bool {
        self.yield_law().is_some_and(|law| law.errors)
    }

    /// The setup of a solid that yields whose loads go back after the last one, and then to 0. Mean gaps go back to the first one.
    pub fn unloaded(mut self) -> Self {
        let mut loads: Vec<f64> = self.path_points().iter().map(|point| point.load.value()).collect();
        let back: Vec<f64> = loads.iter().rev().skip(1).copied().collect();
        loads.extend(back);
        loads.extend((!matches!(self.load, Load::MeanGap(_))).then_some(0.0));
        self.path.get_or_insert_default().load = loads;
        self
    }

    /// The solid that yields below a grid, and the layers in which it may.
    fn plastic_solid(&self, grid: &Grid) -> Result<(PlasticSolid, DepthLayers), SetupError> {
        let body = self.solid.as_ref().and_then(Solid::yielding_body);
        let (Some(law), Some(body)) = (self.yield_law(), body) else { return Err(ConflictRule::NoHistory.into()) };
        let made = law.solid(body.young, body.poisson).and_then(|solid| Ok((solid, law.layers(grid)?)));
        Ok(made.map_err(HistoryError::from)?)
    }

    /// Refuses a solid or layers that cannot be, and mean pressures under which it yields at all depths.
    pub(super) fn check_plastic(&self, grid: &Grid) -> Result<(), SetupError> {
        let limit = self.plastic_solid(grid)?.0.deep_limit();
        let pressures = self.path_points().into_iter().filter_map(|point| match point.load {
            Load::MeanPressure(pressure) => Some(pressure),
            Load::Force(force) => Some(force / grid.area()),
            _ => None,
        });
        match pressures.into_iter().find(|pressure| *pressure > limit) {
            Some(mean_pressure) => {
                Err(HistoryError::from(PlasticError::YieldsEverywhere { mean_pressure, limit }).into())
            }
            None => Ok(()),
        }
    }

    /// The states of a solid that yields, with the iterations if these are kept.
    pub(super) fn states_of_yielding(&self) -> usize {
        let each = if self.record.iterations { ITERATIONS } else { 1 };
        self.path_points().len().saturating_mul(self.yield_steps()).saturating_mul(each)
    }

    /// The bytes that flow below a grid takes, with those of the states that are kept.
    pub(super) fn plastic_bytes(&self, grid: &Grid) -> Result<f64, SetupError> {
        let (_, layers) = self.plastic_solid(grid)?;
        let histories = if self.estimates_errors() { HISTORIES } else { 1.0 };
        Ok(histories * Plastic::bytes(grid, &layers, self.expected_flow(grid)?)
            + self.states_of_path(1) as f64 * PlasticLoading::bytes_of_state(grid, &layers))
    }

    /// Transforms of the surface that take as long as one state of a solid that yields, with the histories that estimate its errors.
    pub(crate) fn transforms_of_yielding(&self, grid: &Grid) -> Result<f64, SetupError> {
        let (_, layers) = self.plastic_solid(grid)?;
        let of_layer = TRANSFORMS_OF_LAYER[usize::from(self.expected_flow(grid)? > 0.0)];
        let histories = if self.estimates_errors() { TIMES_OF_ERRORS } else { 1.0 };
        let trials = if matches!(self.load, Load::MeanGap(_)) { TRIALS_OF_GAP } else { 1.0 };
        Ok(of_layer * layers.count() as f64 * histories * trials)
    }

    /// What makes the states of a solid that yields, one for each step of the path.
    pub(super) fn plastic(&self, problem: Problem) -> Result<PlasticLoading<'_>, SetupError> {
        let (solid, layers) = self.plastic_solid(problem.surface().grid())?;
        let loads = self.path_points().into_iter().map(|point| point.load).collect();
        let steps = self.yield_steps();
        let loading = Plastic::new(problem, solid, layers, self.solver.solver())
            .and_then(|plastic| plastic.with_tolerance(self.stop.tolerance()))
            .map(|plastic| plastic.with_max_iterations(self.stop.max_iterations()))
            .map(|plastic| if self.has_fixed_layers() { plastic } else { plastic.with_growing_depth() })
            .map(|plastic| if self.record.iterations { plastic.with_iterations() } else { plastic })
            .and_then(|plastic| PlasticLoading::new(plastic, loads, steps))
            .and_then(|loading| if self.estimates_errors() { loading.with_errors() } else { Ok(loading) });
        Ok(loading.map_err(HistoryError::from)?)
    }

    /// Checks what belongs to a process.
    pub(super) fn check_process(&self, process: ProcessKind, grid: &Grid) -> Result<(), SetupError> {
        self.viscoelastic.as_ref().map_or(Ok(()), |it| it.prony().map(drop))?;
        let path = self.path.as_ref().filter(|path| !(path.is_empty() && self.yields()));
        // an approach below 0 lifts the surface off a solid that creeps, which recovers then
        let lifts = self.creeps() && matches!(self.load, Load::Approach(_));
        path.map_or(Ok(()), |path| path.check(self.adhesion.is_some() || lifts))?;
        self.adhesion.as_ref().map_or(Ok(()), |it| it.attraction().map(drop))?;
        self.sliding.as_ref().map_or(Ok(()), super::SlidingMotion::check)?;
        self.rolling.as_ref().map_or(Ok(()), super::RollingMotion::check)?;
        self.check_beside(process, grid)?;
        (process.row().check)(self, grid)
    }

    /// Refuses mean gaps that are not positive, a grid that does not resolve the attraction, and a damped motion on a free boundary.
    pub(super) fn check_adhesion(&self, grid: &Grid) -> Result<(), SetupError> {
        if let Some(adhesion) = &self.adhesion {
            if !grid.is_periodic() && adhesion.method == AdhesiveMethod::Gfmd {
                return Err(AdhesionError::FreeMotion.into());
            }
            AdhesiveProblem::check_grid(grid, self.contact_modulus()?, &adhesion.attraction()?)?;
        }
        let is_closed = |point: &PathPoint| matches!(point.load, Load::MeanGap(gap) if gap <= 0.0);
        match self.path_points().iter().find(|point| is_closed(point)) {
            Some(point) => Err(AdhesionError::MeanGap { value: point.load.value() }.into()),
            None => Ok(()),
        }
    }

    /// Refuses a first step of a path at which everything would slide. Where everything slides later, the history ends there.
    pub(super) fn check_slip(&self) -> Result<(), SetupError> {
        let points = self.path_points();
        let Some(first) = points.first() else { return Ok(()) };
        let limit = self.friction.map_or(0.0, |friction| friction.coefficient) * first.load.value();
        let steps = match self.slip_pace() {
            SlipPace::Count(count) => count as f64,
            SlipPace::Tolerance(_) => 1.0,
        };
        let tangential = first.tangential.unwrap_or(0.0) / steps;
        if tangential.abs() >= limit { Err(SlipError::Sliding { tangential, limit }.into()) } else { Ok(()) }
    }

    /// The steps from one point of a path of slip to the next.
    fn slip_pace(&self) -> SlipPace {
        match self.path.as_ref().and_then(|path| path.steps) {
            Some(count) => SlipPace::Count(count),
            None => SlipPace::Tolerance(self.path_tolerance()),
        }
    }

    /// The tolerance of relative errors by the steps of a path with friction.
    pub fn path_tolerance(&self) -> f64 {
        self.path.as_ref().and_then(|path| path.tolerance).unwrap_or(PATH_TOLERANCE)
    }

    /// What makes the history of a problem, which is that of this setup; none for a contact without a history.
    ///
    /// # Errors
    /// The errors of [`Setup::process`] and of the process.
    pub fn history(&self, problem: Problem) -> Result<Option<Box<dyn Process + '_>>, SetupError> {
        self.process()?.map(|kind| (kind.row().make)(self, problem)).transpose()
    }

    /// What makes the history of slip along the path.
    pub(super) fn slip(&self, problem: Problem) -> Result<SlipProcess<'_>, SetupError> {
        let mu = self.friction.map_or(0.0, |friction| friction.coefficient);
        let history = SlipHistory::sheared(problem, mu, self.shear_ratio(), self.solver.solver(), self.stop)?;
        let history = history.with_coupling(self.dundurs_beta())?;
        Ok(SlipProcess::new(history, self.path_points(), self.slip_pace()))
    }

    /// What makes the states of sliding, one for each speed.
    pub(super) fn slides(&self, problem: Problem) -> Result<SlidingProcess, SetupError> {
        let speeds = self.sliding.clone().map_or(Vec::new(), |it| it.speed);
        Ok(SlidingProcess::new(problem, self.prony()?, speeds, self.stop))
    }

    /// What makes the states of rolling, one for each creepage or tangential load.
    pub(super) fn rolls(&self, problem: Problem) -> Result<RollingProcess, SetupError> {
        let rolling = self.rolling.clone().unwrap_or_default();
        let conditions = self.rolling_conditions(&rolling, problem.surface().grid())?;
        Ok(RollingProcess::new(problem, conditions, self.stop))
    }

    /// What makes the history of a problem with adhesion along the path of this setup.
    ///
    /// # Errors
    /// The errors of [`Adhesion::attraction`](super::Adhesion::attraction) and of [`AdhesiveProblem::new`].
    pub fn adhesive(&self, problem: Problem) -> Result<AdhesiveProcess, SetupError> {
        let adhesion = self.adhesion.clone().unwrap_or_default();
        let problem = AdhesiveProblem::new(problem, adhesion.attraction()?)?;
        let steps = self.path.as_ref().and_then(|path| path.steps).unwrap_or(STEPS_OF_ADHESION);
        Ok(AdhesiveProcess::new(problem, self.path_points(), steps, adhesion.method, self.stop))
    }

    /// The tolerance of relative errors in time.
    pub fn time_tolerance(&self) -> f64 {
        self.path.as_ref().and_then(|path| path.time_tolerance).unwrap_or(TIME_TOLERANCE)
    }

    /// What makes the history of a problem on a solid that creeps along the path of this setup.
    ///
    /// # Errors
    /// The errors of [`Viscoelastic::prony`](super::Viscoelastic::prony) and of [`CreepProcess::new`].
    pub fn creep(&self, problem: Problem) -> Result<CreepProcess<'_>, SetupError> {
        let steps = self.path.as_ref().and_then(|path| path.steps);
        let (points, solver) = (self.path_points(), self.solver.solver());
        let steps = (steps, self.time_tolerance());
        Ok(CreepProcess::new((problem, self.prony()?), &points, steps, (solver, self.stop))?)
    }

    /// The conditions of rolling, one for each creepage or tangential load.
    fn rolling_conditions(&self, rolling: &RollingMotion, grid: &Grid) -> Result<Vec<RollingConditions>, SetupError> {
        let friction = self.friction.map_or(0.0, |friction| friction.coefficient);
        let beta = self.dundurs_beta();
        let step = rolling.step.unwrap_or(grid.spacing()[1]);
        let limit = friction * self.load.value();
        let of = |drive| RollingConditions { friction, step, beta, drive };
        let creepages = rolling.creepage.iter().map(|&creepage| of(RollingDrive::Creepage(creepage)));
        let loads = rolling.tangential.iter().map(|&tangential| of(RollingDrive::Ratio(tangential / limit)));
        if let Some(&tangential) = rolling.tangential.iter().find(|it| it.abs() >= limit) {
            return Err(SlipError::Sliding { tangential, limit }.into());
        }
        Ok(creepages.chain(loads).collect())
    }

    /// Dundurs' constant; 0 for a solid of which only the contact modulus is known.
    pub(crate) fn dundurs_beta(&self) -> f64 {
        self.solid.as_ref().and_then(Solid::dundurs_beta).unwrap_or(0.0)
    }

    /// The ratio `m = sum (nu/G) / sum ((1 - nu)/G)` over the bodies, see [`Compliance::tangential`](crate::elastic::Compliance::tangential);
    /// 0 for a solid of which only the contact modulus is known.
    fn shear_ratio(&self) -> f64 {
        self.solid.as_ref().and_then(Solid::shear_ratio).unwrap_or(0.0)
    }
}
