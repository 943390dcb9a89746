//! Partial slip with a history.

use super::discs::{Discs, Pair};
use super::slip_state::{SlipCertificate, SlipState, Zone};
use super::slip_vector::VectorStep;
use crate::chunks;
use crate::clock::Instant;
use crate::contact::{Contact, Load, Observer, Problem, Solver, Status, Stop, Work};
use crate::elastic::{Compliance, Response, ShearCompliance, ShearResponse};
use crate::error::SlipError;
use crate::surface::{Field, Surface};
use ndarray::Array2;
use std::sync::Arc;

/// A contact with Coulomb friction under normal and tangential loads, one pair after the other: the traction after a step depends on
/// those before.
///
/// A step finds the pressure `p` under the normal load, and then the traction `tau` with the given mean, from the traction `tau_0` before
/// the step:
///
/// ```text
/// slip   s = A_t (tau - tau_0) - delta
/// law    |tau| <= mu p,   s = 0 where |tau| < mu p,   s against tau elsewhere
/// ```
///
/// These are the conditions of the minimum of `1/2 <tau A_t tau> - <tau A_t tau_0>` over `|tau| <= mu p` with `<tau>` given.
///
/// | grid                       | traction       | the step is solved                                                        |
/// |----------------------------|----------------|---------------------------------------------------------------------------|
/// | line                       | along `x`      | by the solver of the history                                              |
/// | surface with `m = 0`       | along `x`, until a load across is given | by the solver of the history                     |
/// | other surface              | along `x`, `y` | by Newton steps on the nodes that stick and slip                          |
///
/// **Along `x` alone**, `t = tau + mu p` is the pressure of a [`Problem`] with the heights `A_t (tau_0 + mu p)`, below a
/// [ceiling](crate::contact::Ceiling) `2 mu p` of each node. Every solver that takes a hardness solves it. `A_t` is
/// [`Compliance::tangential`].
///
/// **Along both axes**, the traction of each node lies in a disc, and `A_t` is that of [`ShearCompliance`]. A node that sticks has two unknowns.
/// One that slips has the angle of `tau = mu p (cos a, sin a)`; its equation says that the slip has no part across the traction, and
/// `|s|/(mu p)` is added to the diagonal of `A_t`. Sets of nodes are exchanged as a whole. The linear equations of a set are solved by
/// conjugate gradients, with the shift as the multiplier of the mean. Where the energy does not fall, or the certificate falls too slowly, a
/// step goes along the projected gradient to the least energy on its chord. These steps alone converge, since the energy is convex.
///
/// Both kinds of steps have a [`SlipCertificate`]. A path along which every node slips in one direction only is solved exactly in one step. A
/// step must end where the tangential load turns. The result is exact if normal and tangential loads do not couple (Dundurs' `beta = 0`).
/// Where the pressure of a node falls to zero, its traction is lost.
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
    /// `A_t` of the traction.
    sheared: [Vec<f64>; 2],
}

impl<'s> SlipHistory<'s> {
    /// A history that begins without any load. The load of `problem` is not used. The coefficient of friction `mu` may be zero.
    ///
    /// # Errors
    /// [`SlipError::NotPositive`] for a coefficient that is negative or not finite, [`SlipError::Yielding`] for a problem with a hardness,
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
            return Err(SlipError::NotPositive { name: "coefficient of friction", value: coefficient });
        }
        if !problem.law().is_hard_wall() {
            return Err(SlipError::Yielding);
        }
        let compliance = Compliance::tangential(problem.surface().grid(), problem.solid().clone(), m)?;
        let zeros = || vec![0.0; problem.nodes()];
        let compliance = Arc::new(compliance);
        let (traction, sheared) = ([zeros(), Vec::new()], [zeros(), Vec::new()]);
        let mut history =
            Self { problem, coefficient, compliance, solver, stop, m, shear: None, pressed: None, traction, sheared };
        if m != 0.0 && !history.problem.surface().grid().is_line() {
            history.take_both_axes()?;
        }
        Ok(history)
    }

    /// Takes steps along both axes from now on.
    fn take_both_axes(&mut self) -> Result<(), SlipError> {
        let (grid, solid) = (self.problem.surface().grid(), self.problem.solid().clone());
        self.shear = Some(ShearResponse::new(Arc::new(ShearCompliance::new(grid, solid, self.m)?)));
        let nodes = self.problem.nodes();
        self.traction[1].resize(nodes, 0.0);
        self.sheared[1].resize(nodes, 0.0);
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
        let (mut contact, pressed, mut work) = self.press(load, observer)?;
        let full = self.coefficient * contact.mean_pressure();
        let target = share.map(|share| share * full);
        let found = match self.coefficient {
            0.0 => Traction::none(self.traction.each_ref().map(Vec::len)),
            _ if self.shear.is_some() => self.pull_towards(&contact, &pressed, target),
            _ => self.pull(&contact, &pressed, target[0], observer)?,
        };
        work = sum(work, found.work);
        if found.status != Status::Converged && contact.is_converged() {
            contact.status = found.status;
        }
        let state = self.state(contact, &found, target, &pressed, work);
        self.pressed = Some((state.contact.clone(), pressed));
        (self.traction, self.sheared) = (found.values, found.displacement);
        Ok(state)
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

    /// The contact under a normal load, with `A_t` of its pressure: that of the last step if the load is the same.
    fn press(&self, load: Load, observer: &mut dyn Observer) -> Result<(Contact, Vec<f64>, Work), SlipError> {
        let before = self.pressed.as_ref();
        if let Some((contact, pressed)) = before.filter(|(contact, _)| contact.problem.load() == load) {
            let mut contact = contact.clone();
            contact.work = Work::default();
            return Ok((contact, pressed.clone(), Work::default()));
        }
        let problem = self.problem.clone().with_load(load)?;
        let start = before.map(|(contact, _)| &contact.pressure);
        let contact = self.solver.solve_from(start, &problem, &self.stop, observer)?;
        let mut pressed = vec![0.0; self.problem.nodes()];
        Response::from_compliance(self.compliance.clone()).displacement(values(&contact.pressure), &mut pressed);
        let work = sum(contact.work, Work { transforms: 2, ..Work::default() });
        Ok((contact, pressed, work))
    }

    /// The traction with the mean `target` under the pressure of a contact.
    ///
    /// With the sign of the target, `t = mu p + tau` or `mu p - tau`, whose mean is not below `mu <p>`.
    fn pull(
        &self,
        contact: &Contact,
        pressed: &[f64],
        target: f64,
        observer: &mut dyn Observer,
    ) -> Result<Traction, SlipError> {
        let (mu, sign) = (self.coefficient, if target < 0.0 { -1.0 } else { 1.0 });
        let (grid, p) = (*contact.problem.surface().grid(), values(&contact.pressure));
        let field =
            |of: &dyn Fn(usize) -> f64| Field::from_shape_fn(grid.shape(), |(y, x)| of(y * grid.shape()[1] + x));
        let load = Load::MeanPressure(mu * contact.mean_pressure() + target.abs());
        let yardstick = Surface::new(grid, field(&|i| mu * pressed[i])).map_err(SlipError::Surface)?;
        let heights = field(&|i| sign * self.sheared[0][i] + mu * pressed[i]);
        let ceilings: Vec<f64> = p.iter().map(|p| 2.0 * mu * p).collect();
        let problem = Problem::of_compliance(yardstick.into(), self.compliance.clone(), load)?;
        let problem = problem.with_heights(heights)?.with_ceilings(ceilings)?;
        let start = field(&|i| (sign * self.traction[0][i] + mu * p[i]).clamp(0.0, 2.0 * mu * p[i]));
        let stop = Stop::new(FINER * self.stop.tolerance(), self.stop.max_iterations()).unwrap_or(self.stop);
        let found = self.solver.solve_from(Some(&start), &problem, &stop, observer)?;
        let t = values(&found.pressure);
        // nodes that stick lie at minus the datum of the heights as they were given
        let level = -(datum(&found) + problem.shift());
        Ok(Traction {
            values: [t.iter().zip(p).map(|(t, p)| sign * (t - mu * p)).collect(), Vec::new()],
            displacement: [
                values(&found.displacement).iter().zip(pressed).map(|(u, p)| sign * (u - mu * p)).collect(),
                Vec::new(),
            ],
            shift: [sign * level, 0.0],
            status: found.status,
            work: found.work,
        })
    }

    /// The traction along both axes with the mean `target` under the pressure of a contact.
    fn pull_towards(&mut self, contact: &Contact, pressed: &[f64], target: Pair) -> Traction {
        let start_of_work = Instant::now();
        let (mu, p) = (self.coefficient, values(&contact.pressure));
        let places: Vec<usize> = chunks::positive(p, 0..p.len()).collect();
        let at = |fields: &[Vec<f64>; 2]| places.iter().map(|&i| [fields[0][i], fields[1][i]]).collect::<Vec<Pair>>();
        let (start, before) = (at(&self.traction), at(&self.sheared));
        let radii: Vec<f64> = places.iter().map(|&i| mu * p[i]).collect();
        let discs = Discs { radii, total: target.map(|target| target * p.len() as f64) };
        let response = self.shear.as_mut().expect("the history takes both axes");
        let transforms = response.transforms();
        let found = VectorStep::new(response, places.clone(), discs, before, sliding_length(mu, pressed))
            .solve(&start, &self.stop);
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

    /// The state with a traction.
    fn state(&self, contact: Contact, found: &Traction, target: Pair, pressed: &[f64], work: Work) -> SlipState {
        let (mu, shape, p) = (self.coefficient, contact.pressure.raw_dim(), values(&contact.pressure));
        let n = p.len();
        let slip_along = |axis: usize| -> Vec<f64> {
            let both = found.displacement[axis].iter().zip(&self.sheared[axis]);
            both.map(|(now, before)| now - before - found.shift[axis]).collect()
        };
        let mut slip = [slip_along(0), slip_along(1)];
        let certificate = certify(mu, p, found, &slip, pressed);
        let reach = sliding_length(mu, pressed);
        let zone = |i: usize| match mu * p[i] {
            _ if p[i] <= 0.0 => Zone::Open,
            limit if !found.slips(i, limit, at(&slip, i), reach) => Zone::Stick,
            _ if found.values[0][i] >= 0.0 => Zone::Forward,
            _ => Zone::Backward,
        };
        let zones: Vec<Zone> = (0..n).map(zone).collect();
        let is_still = |zone: Zone| matches!(zone, Zone::Open | Zone::Stick);
        let before = self.pressed.as_ref().map(|(contact, _)| values(&contact.pressure));
        let dissipated = |i: usize| match zones[i] {
            zone if is_still(zone) => 0.0,
            _ => 0.5 * mu * (p[i] + before.map_or(p[i], |before| before[i])) * length_at(&slip, i),
        };
        let dissipated = chunks::sum(n, dissipated) / n as f64;
        let work_at = |i: usize| {
            let ([a, b], [u, v]) = (at(&found.values, i), at(&found.displacement, i));
            a * u + b * v
        };
        let stored = 0.5 * chunks::sum(n, work_at) / n as f64;
        for slip in &mut slip {
            slip.iter_mut().zip(&zones).filter(|(_, zone)| **zone == Zone::Stick).for_each(|(slip, _)| *slip = 0.0);
        }
        let field = |values: Vec<f64>| Field::from_shape_vec(shape, values).expect("one value per node");
        let across = |values: Vec<f64>| (!values.is_empty()).then(|| field(values));
        let [along_x, along_y] = slip;
        SlipState {
            tangential: target[0],
            tangential_across: target[1],
            traction: field(found.values[0].clone()),
            traction_across: across(found.values[1].clone()),
            slip: field(along_x),
            slip_across: across(along_y),
            zones: Array2::from_shape_vec(shape, zones).expect("one zone per node"),
            shift: found.shift[0],
            shift_across: found.shift[1],
            dissipated,
            stored,
            certificate,
            work,
            contact,
        }
    }
}

/// A traction along `x` is solved to this part of the tolerance: its certificate is over `mu <p>`, and not over the mean of `t`, which may be
/// twice as large, and is taken with the shift of the nodes that stick, and not with the best one.
const FINER: f64 = 0.1;

/// Relative distance from `mu p` up to which a traction counts as slipping, because of rounding.
const ROUNDING: f64 = 1e-14;

/// A traction, and what was found with it. The second component of fields is empty where the traction is along `x` alone.
struct Traction {
    values: [Vec<f64>; 2],
    displacement: [Vec<f64>; 2],
    shift: Pair,
    status: Status,
    work: Work,
}

impl Traction {
    /// No traction on each axis; each number is the count of nodes of one axis.
    fn none(nodes: [usize; 2]) -> Self {
        let zeros = || nodes.map(|nodes| vec![0.0; nodes]);
        Self {
            values: zeros(),
            displacement: zeros(),
            shift: [0.0; 2],
            status: Status::Converged,
            work: Work::default(),
        }
    }

    /// Whether a node in contact slips. Along both axes it does where `tau/(mu p) - s/reach` lies outside of the unit circle: where it
    /// sticks the slip is zero except for the tolerance.
    fn slips(&self, i: usize, limit: f64, [a, b]: Pair, reach: f64) -> bool {
        let [x, y] = at(&self.values, i);
        if self.values[1].is_empty() || limit == 0.0 {
            return x.abs() >= limit * (1.0 - ROUNDING);
        }
        (x / limit - a / reach).hypot(y / limit - b / reach) >= 1.0 - ROUNDING
    }
}

/// The vector at a node, whose second component is zero in a field without one.
fn at(fields: &[Vec<f64>; 2], i: usize) -> Pair {
    [fields[0][i], fields[1].get(i).copied().unwrap_or(0.0)]
}

fn length_at(fields: &[Vec<f64>; 2], i: usize) -> f64 {
    let [x, y] = at(fields, i);
    if y == 0.0 { x.abs() } else { x.hypot(y) }
}

/// The rms of the displacement by `mu p`, about its mean.
fn sliding_length(mu: f64, pressed: &[f64]) -> f64 {
    let mean = |of: &(dyn Fn(usize) -> f64 + Sync)| chunks::sum(pressed.len(), of) / pressed.len() as f64;
    let middle = mean(&|i| pressed[i]);
    mu * mean(&|i| (pressed[i] - middle).powi(2)).sqrt()
}

/// The bounds of a traction with its slip, under a pressure that displaces the surface by `pressed`.
fn certify(mu: f64, pressure: &[f64], found: &Traction, slip: &[Vec<f64>; 2], pressed: &[f64]) -> SlipCertificate {
    let n = pressure.len();
    let mean = |of: &(dyn Fn(usize) -> f64 + Sync)| chunks::sum(n, of) / n as f64;
    let missed = |i: usize| {
        let ([x, y], [a, b]) = (at(&found.values, i), at(slip, i));
        if pressure[i] > 0.0 { x * a + y * b + mu * pressure[i] * length_at(slip, i) } else { 0.0 }
    };
    let gap = mean(&missed);
    let square = mu * mu * mean(&|i| pressure[i] * pressed[i]);
    let over = |gap: f64, scale: f64| if mu > 0.0 { gap.max(0.0) / scale } else { 0.0 };
    SlipCertificate {
        eta: over(gap, mu * mean(&|i| pressure[i]) * sliding_length(mu, pressed)),
        traction_error_bound: over(gap, square).sqrt(),
    }
}

/// The datum of the gap of a contact, by one node: `g - (u - h)`.
fn datum(contact: &Contact) -> f64 {
    contact.gap[[0, 0]] - (contact.displacement[[0, 0]] - contact.problem.height()[0])
}

fn values(field: &Field) -> &[f64] {
    field.as_slice().expect("results are made in standard layout")
}

fn sum(a: Work, b: Work) -> Work {
    Work {
        iterations: a.iterations + b.iterations,
        transforms: a.transforms + b.transforms,
        seconds: a.seconds + b.seconds,
    }
}
