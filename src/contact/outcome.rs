//! The contact that a solver returns.

use crate::contact::{
    Certificate, Counted, Edges, Failure, Feels, Patches, Problem, Quantity, Resolution, Resolved, StateValues, Status,
    certificate, chunks, hysteretic_friction, multilevel,
};
use crate::error::{SolveError, SurfaceError};
use crate::surface::Field;
use std::ops::{Add, AddAssign};
use std::sync::{Arc, OnceLock};

/// A solved (or best found) contact.
///
/// | field          | shape      | unit     | meaning                                        |
/// |----------------|------------|----------|------------------------------------------------|
/// | `pressure`     | `(ny, nx)` | pressure | `p >= 0`, `<p>` the load if that is given      |
/// | `displacement` | `(ny, nx)` | length   | `u(p)` into the solid, without mean if periodic |
/// | `gap`          | `(ny, nx)` | length   | `u - h + d`, `<p g> = 0` or `d` the mean gap; of a surface that yields, 0 where this is negative |
#[derive(Debug, Clone)]
pub struct Contact {
    /// The problem that it solves.
    pub problem: Problem,
    /// Pressure.
    pub pressure: Field,
    /// Displacement of the solid's surface.
    pub displacement: Field,
    /// Gap between the surfaces: their distance. Below a hardness it is never negative, and the overlap of the nodes that yield is
    /// [`Contact::overlap`]. On a hard wall, penetrations within the error of the certificate are negative.
    pub gap: Field,
    /// Error bounds of this pressure, computed from a transform pair of it in double precision.
    pub certificate: Certificate,
    /// Area and gradient of the contact on the next coarser grid, if the solver found it there, to a certificate of 0.1.
    pub coarser: Option<Resolved>,
    /// Work done.
    pub work: Work,
    /// How the solver stopped.
    pub status: Status,
    /// Name of the solver.
    pub solver: String,
    /// Why an observer failed, if one did.
    pub failure: Option<Arc<Failure>>,
    stiffness: OnceLock<f64>,
    values: StateValues,
}

/// Work of a solver.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Work {
    /// Iterations.
    pub iterations: usize,
    /// Fourier transforms, forward and inverse.
    pub transforms: u64,
    /// Seconds, without those spent in observers.
    pub seconds: f64,
}

impl Add for Work {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            iterations: self.iterations + other.iterations,
            transforms: self.transforms + other.transforms,
            seconds: self.seconds + other.seconds,
        }
    }
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Contact {
    /// The contact with a pressure and its displacement, and the certificate of both.
    pub(super) fn new(problem: &Problem, pressure: Vec<f64>, displacement: Vec<f64>, work: Work, solver: &str) -> Self {
        let certificate = Certificate::from_displacement(problem, &pressure, &displacement);
        let datum = certificate::datum(problem, &pressure, &displacement);
        let (height, mut gap) = (problem.height(), vec![0.0; displacement.len()]);
        chunks::update(&mut gap, |nodes, gap| {
            gap.iter_mut().zip(nodes).for_each(|(gap, i)| *gap = displacement[i] - height[i] + datum);
        });
        let shape = problem.surface().grid().shape();
        let field = |values: Vec<f64>| Field::from_shape_vec(shape, values).expect("one value per node");
        let pressure = field(pressure);
        Self {
            problem: problem.clone(),
            displacement: field(displacement),
            gap: apart(problem, &pressure, field(gap)),
            pressure,
            certificate,
            coarser: None,
            work,
            status: Status::Stalled,
            solver: solver.into(),
            failure: None,
            stiffness: OnceLock::new(),
            values: StateValues::default(),
        }
    }

    /// The contact with a pressure that was found elsewhere: displacement, gap and certificate are computed from it. Nothing is said of how its
    /// solver stopped: its status is [`Status::Stalled`].
    ///
    /// # Errors
    /// [`SurfaceError::Shape`] for a pressure that does not fit the grid of the problem.
    pub fn from_pressure(problem: &Problem, pressure: Field, work: Work, solver: &str) -> Result<Self, SurfaceError> {
        let expected = problem.surface().grid().shape();
        if pressure.shape() != expected {
            return Err(SurfaceError::Shape { found: pressure.shape().to_vec(), expected });
        }
        let pressure: Vec<f64> = pressure.into_iter().collect();
        let mut displacement = vec![0.0; pressure.len()];
        problem.response().displacement(&pressure, &mut displacement);
        Ok(Self::new(problem, pressure, displacement, work, solver))
    }

    /// The contact with the parts of another contact: fields (pressure, displacement and gap), certificate, work,
    /// status, solver and the state on the next coarser grid. Nothing is computed again. This moves a contact to
    /// another process.
    ///
    /// # Errors
    /// [`SurfaceError::Shape`] for a field that does not fit the grid of the problem.
    pub fn from_parts(
        problem: Problem,
        fields: [Field; 3],
        (certificate, work, status): (Certificate, Work, Status),
        solver: impl Into<String>,
        coarser: Option<Resolved>,
    ) -> Result<Self, SurfaceError> {
        let expected = problem.surface().grid().shape();
        if let Some(field) = fields.iter().find(|field| field.shape() != expected) {
            return Err(SurfaceError::Shape { found: field.shape().to_vec(), expected });
        }
        let [pressure, displacement, gap] = fields.map(|field| field.as_standard_layout().into_owned());
        let gap = apart(&problem, &pressure, gap);
        let (solver, failure, stiffness) = (solver.into(), None, OnceLock::new());
        Ok(Self {
            problem,
            pressure,
            displacement,
            gap,
            certificate,
            coarser,
            work,
            status,
            solver,
            failure,
            stiffness,
            values: StateValues::default(),
        })
    }

    /// The contact on the heights of `problem`, whose surface tractions displace into the solid by `added` besides. The displacement is the
    /// whole one, and the gap follows from it.
    pub(crate) fn displaced_by(self, problem: Problem, added: &[f64], certificate: Certificate) -> Self {
        let mut whole = self.displacement.clone();
        whole.iter_mut().zip(added).for_each(|(u, added)| *u += added);
        let displacement = whole.as_slice().expect("results are made in standard layout");
        let datum = certificate::datum(&problem, self.pressures(), displacement);
        let gap = displacement.iter().zip(problem.height()).map(|(u, h)| u - h + datum).collect();
        let gap = Field::from_shape_vec(whole.raw_dim(), gap).expect("one value per node");
        Self { problem, displacement: whole, gap, certificate, ..self }
    }

    /// The contact with what the state of a history knows better.
    pub fn with_values(self, values: StateValues) -> Self {
        Self { values, ..self }
    }

    /// The contact with other work, such as that of all solves since the state before.
    pub fn with_work(self, work: Work) -> Self {
        Self { work, ..self }
    }

    /// What the state of a history knows better than its contact; nothing for a contact that is no state.
    pub fn values(&self) -> &StateValues {
        &self.values
    }

    /// Whether the certificate met the tolerance.
    pub fn is_converged(&self) -> bool {
        self.status == Status::Converged
    }

    /// The contact, if it converged and no observer failed.
    ///
    /// # Errors
    /// The [`Contact::fault`].
    pub fn converged(self) -> Result<Self, SolveError> {
        self.fault().map_or(Ok(self), Err)
    }

    /// Why the contact did not reach its goals, if it did not: [`SolveError::Observer`] with the failure of an
    /// observer, or [`SolveError::NotConverged`] with the certificate that was reached.
    pub fn fault(&self) -> Option<SolveError> {
        if let Some(failure) = &self.failure {
            return Some(SolveError::Observer(failure.clone()));
        }
        let Certificate { eta: certificate, pressure_error_bound, .. } = self.certificate;
        let (solver, iterations, reason) = (self.solver.clone(), self.work.iterations, self.status.to_string());
        let fault = SolveError::NotConverged { solver, iterations, reason, certificate, pressure_error_bound };
        (!self.is_converged()).then_some(fault)
    }

    /// Stores the failure of an observer, or of the source of the steps.
    pub fn fail(&mut self, failure: impl Into<Failure>) {
        self.failure.get_or_insert_with(|| Arc::new(failure.into()));
    }

    /// Area, gradients and proportionality factors by counting nodes.
    pub fn counted(&self) -> Counted {
        Counted::new(&self.problem, self.pressures())
    }

    /// The edges of the contact, between the nodes.
    pub fn edges(&self) -> Edges<'_, impl Fn(usize) -> f64 + Sync> {
        let (gap, overlap) = (self.gap.as_slice().expect("results are made in standard layout"), self.overlaps());
        let overlap = move |node: usize| overlap.as_ref().map_or(0.0, |overlap| overlap(node));
        let has_yielded = self.values.get(Quantity::MaxPlasticStrain).is_some_and(|strain| strain > 0.0);
        let edges = Edges::new(&self.problem, self.pressures(), move |node| gap[node] - overlap(node));
        edges.with_flow(has_yielded)
    }

    /// Area, gradient and `kappa_r` with edges interpolated between the nodes.
    pub fn resolved(&self) -> Resolved {
        self.edges().resolved()
    }

    /// How well the grid resolves the contact.
    pub fn resolution(&self) -> Resolution {
        let grid = self.problem.surface().grid();
        Resolution::new(grid, &self.counted(), &self.resolved(), &self.patches(), self.coarser.as_ref())
    }

    /// Contact patches.
    pub fn patches(&self) -> Patches {
        Patches::new(self.pressures(), self.problem.surface().grid())
    }

    /// Contact stiffness `k = -d<p>/d<g>`, a pressure per length: the increase of the mean pressure per decrease of the
    /// mean gap, or of the [`Contact::separation`] where nodes yield. It is infinite if all nodes of a periodic cell touch, and NaN if the contact moves over its solid ([`Problem::is_moving`]).
    ///
    /// It is computed on first use, with about a tenth of the work of a solve. From then on it is one of the
    /// [`crate::contact::Observables`] of this contact.
    ///
    /// ```
    /// use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
    /// use asperity::{Grid, Indenter, Problem, Stop};
    /// use std::f64::consts::PI;
    /// // a sine that touches on half of its length (Westergaard): k = pi E* / (L ln 2)
    /// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(1024, 1.0)?)?;
    /// let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.005 * PI))?;
    /// let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
    /// assert!((contact.stiffness() / (PI / 2f64.ln()) - 1.0).abs() < 0.01);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn stiffness(&self) -> f64 {
        if self.problem.is_moving() {
            return f64::NAN;
        }
        let displacement = || self.displacement.as_slice().expect("results are made in standard layout");
        *self.stiffness.get_or_init(|| multilevel::stiffness(&self.problem, self.pressures(), displacement()))
    }

    /// The stiffness that the contact would have if all touching nodes were elastic, also those that yield: a pressure per length.
    /// Without a hardness it is the [`Contact::stiffness`]. It measures the contact set alone, and not what carries the next load.
    pub fn stiffness_of_all(&self) -> f64 {
        if !self.problem.ceiling().is_finite() || self.problem.is_moving() {
            return self.stiffness();
        }
        let displacement = self.displacement.as_slice().expect("results are made in standard layout");
        multilevel::stiffness_of_all(&self.problem, self.pressures(), displacement)
    }

    /// The contact with its stiffness, which was computed before.
    pub(super) fn with_stiffness(self, stiffness: f64) -> Self {
        Self { stiffness: OnceLock::from(stiffness), ..self }
    }

    /// The stiffness, if it has been computed.
    pub(super) fn known_stiffness(&self) -> Option<f64> {
        self.stiffness.get().copied()
    }

    /// The pressures, row by row.
    fn pressures(&self) -> &[f64] {
        self.pressure.as_slice().expect("results are made in standard layout")
    }

    /// Mean pressure.
    pub fn mean_pressure(&self) -> f64 {
        mean(self.pressures())
    }

    /// Mean gap between the surfaces: nodes that yield or have yielded have no gap. It is negative only where surfaces that do not yield
    /// penetrate, in a contact that has not converged, or by rounding.
    pub fn mean_gap(&self) -> f64 {
        mean(self.gap.as_slice().expect("results are made in standard layout"))
    }

    /// Distance of the mean planes of both surfaces as if none had yielded, a length: the datum of the gap, which
    /// [`crate::contact::Load::MeanGap`] prescribes. Without a hardness it is the mean gap, and else the mean gap less the plastic overlap,
    /// so that it may be negative.
    pub fn separation(&self) -> f64 {
        mean(self.gap.as_slice().expect("results are made in standard layout")) - self.mean_overlap()
    }

    /// The mean overlap where the surfaces yield or have yielded, a length.
    pub(super) fn mean_overlap(&self) -> f64 {
        let n = self.gap.len();
        let now = self.overlaps().map_or(0.0, |overlap| chunks::sum(n, overlap) / n as f64);
        now + self.problem.flattened_by()
    }

    /// The overlap of the surfaces where they yield, a length, shape `(ny, nx)`: how much the law flattens the surface in this contact. It is
    /// zero at all other nodes.
    ///
    /// Where all nodes yield, any larger datum would do as well, and the smallest overlap is given: that at which the node that is flattened
    /// least just touches.
    pub fn overlap(&self) -> Field {
        let shape = self.gap.raw_dim();
        let Some(overlap) = self.overlaps() else { return Field::zeros(shape) };
        Field::from_shape_vec(shape, (0..self.gap.len()).map(overlap).collect()).expect("one value per node")
    }

    /// The overlap of each node; none without a hardness. The datum is that of the node which is farthest from where it yields.
    fn overlaps(&self) -> Option<impl Fn(usize) -> f64 + Sync> {
        let (law, pressure, height) = (self.problem.law(), self.pressures(), self.problem.height());
        law.hardness()?;
        let [displacement, gap] =
            [&self.displacement, &self.gap].map(|field| field.as_slice().expect("standard layout"));
        let v = move |node: usize| displacement[node] - height[node];
        let farthest = (0..gap.len()).max_by(|&a, &b| v(a).total_cmp(&v(b)))?;
        let datum = gap[farthest] - v(farthest);
        Some(move |node: usize| if law.yields(pressure[node]) { -(v(node) + datum).min(0.0) } else { 0.0 })
    }

    /// The approach, a length: the distance that the surface has moved since its highest peak touched the undeformed
    /// solid. None on a periodic half-space, where it is not defined. For a line with a free boundary it is measured
    /// from the datum of the solid, see [`crate::elastic::ElasticSolid::datum`].
    pub fn approach(&self) -> Option<f64> {
        let displacement = self.displacement.as_slice().expect("results are made in standard layout");
        let datum = self.separation() - mean(displacement);
        Some(self.problem.highest() - datum + self.uniform_displacement()?)
    }

    /// The mean of the pressure that would displace the elastic solid of the problem as far as this solid is displaced. It is the mean pressure,
    /// but for
    /// - a solid that creeps, which remembers earlier pressures: the mean effective pressure;
    /// - adhesion: the mean pressure less the mean attraction;
    /// - a contact that slides: its uniform pressure does not change in time, so that the solid is relaxed under it, `<p> (1 + sum f)`.
    fn displacing_pressure(&self) -> f64 {
        let values = self.values();
        let given = match values.feels {
            Feels { memory: true, .. } => values.get(Quantity::EffectivePressure),
            Feels { attraction: true, .. } => values.get(Quantity::MeanPressure),
            _ => None,
        };
        given.unwrap_or_else(|| self.mean_pressure() * (1.0 + self.problem.compliance().creep().unwrap_or(0.0)))
    }

    /// The uniform displacement, if the displacement does not contain it, by the mean of the pressure that displaces; none if it is not
    /// defined.
    fn uniform_displacement(&self) -> Option<f64> {
        match self.problem.compliance().has_uniform() {
            true => Some(0.0),
            false => Some(self.problem.solid().uniform_compliance()? * self.displacing_pressure()),
        }
    }

    /// The elastic energy of the uniform displacement per area of the cell, if the displacement does not contain it: pressure times length. Zero
    /// where it is not defined.
    pub(crate) fn uniform_energy(&self) -> f64 {
        0.5 * self.displacing_pressure() * self.uniform_displacement().unwrap_or(0.0)
    }

    /// Elastic energy `<p u>/2` per area of the cell, pressure times length, including the uniform displacement. This is finite on a layer; on a
    /// periodic half-space the displacement has zero mean. Under increasing loads the energy grows with the [approach](Self::approach) `d` as
    /// `<p> = dU/dd`. On a half-space it decreases with the mean gap as `<p> = -dU/d<g>`.
    ///
    /// A contact that slides has no energy that loads exchange with it: this is half the work `<p u>` there.
    pub fn elastic_energy(&self) -> f64 {
        let displacement = self.displacement.as_slice().expect("results are made in standard layout");
        let pressure = self.pressures();
        let uniform = self.uniform_displacement().unwrap_or(0.0);
        0.5 * chunks::sum(pressure.len(), |i| pressure[i] * (displacement[i] + uniform)) / pressure.len() as f64
    }

    /// The contact modulus that acts, a pressure, by which areas and pressures are made dimensionless: of a contact that slides, see
    /// [`Problem::effective_modulus`]; else `E*`.
    pub fn effective_modulus(&self) -> f64 {
        self.problem.effective_modulus(self.pressures())
    }

    /// The hysteretic friction coefficient of a contact that slides over a viscoelastic solid: the force along `x` by the loss in the
    /// solid over the load, see [`crate::history::Sliding`]. NaN for a contact at rest.
    pub fn friction(&self) -> f64 {
        let displacement = self.displacement.as_slice().expect("results are made in standard layout");
        hysteretic_friction(&self.problem, self.pressures(), displacement)[1]
    }

    /// Largest pressure.
    pub fn max_pressure(&self) -> f64 {
        let pressure = self.pressures();
        let largest = |range: std::ops::Range<usize>| range.fold(0.0, |most: f64, i| most.max(pressure[i]));
        chunks::visit(pressure.len(), largest).into_iter().fold(0.0, f64::max)
    }

    /// Largest gap.
    pub fn max_gap(&self) -> f64 {
        self.gap.fold(0.0, |max: f64, &gap| max.max(gap))
    }

    /// The active set: nodes with `p > 0`.
    pub fn mask(&self) -> ndarray::Array2<bool> {
        self.pressure.mapv(|p| p > 0.0)
    }
}

/// A gap that is cut off at zero, if any node yields.
fn apart(problem: &Problem, pressure: &Field, mut gap: Field) -> Field {
    if problem.yields(pressure.as_slice().expect("results are made in standard layout")) {
        gap.mapv_inplace(|gap| gap.max(0.0));
    }
    gap
}

fn mean(values: &[f64]) -> f64 {
    chunks::sum(values.len(), |i| values[i]) / values.len() as f64
}
