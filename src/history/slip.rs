//! Partial slip with a history.

use super::slip_state::{SlipCertificate, SlipState, Zone};
use crate::chunks;
use crate::contact::{Contact, Load, Observer, Problem, Solver, Status, Stop, Work};
use crate::elastic::{Compliance, Response};
use crate::error::SlipError;
use crate::surface::{Field, Surface};
use ndarray::Zip;
use std::sync::Arc;

/// A contact with Coulomb friction under normal and tangential loads, one pair after the other: the traction after a step depends on
/// those before.
///
/// A step finds the pressure `p` under the normal load, and then the traction `tau` along `x` with the given mean, from the traction
/// `tau_0` before the step:
///
/// ```text
/// slip   s = A_t (tau - tau_0) - delta
/// law    |tau| <= mu p,   s = 0 where |tau| < mu p,   s against tau elsewhere
/// ```
///
/// These are the conditions of the minimum of `1/2 <tau A_t tau> - <tau A_t tau_0>` over `|tau| <= mu p` with `<tau>` given. With `t = tau + mu p` it
/// is a [`Problem`] with the heights `A_t (tau_0 + mu p)`, below a [ceiling](crate::contact::Ceiling) `2 mu p` of each node. Every solver
/// that takes a hardness solves it, to a [`SlipCertificate`].
///
/// A path along which every node slips in one sense only is solved exactly in one step. A step must end where the tangential load
/// turns.
///
/// | grid    | it is exact                                                                                        |
/// |---------|----------------------------------------------------------------------------------------------------|
/// | line    | if normal and tangential loads do not couple (Dundurs' `beta = 0`)                                   |
/// | surface | if Poisson's ratio is 0 as well; else it leaves out tractions across the load, which are small       |
///
/// `A_t` is [`Compliance::tangential`]. Where the pressure of a node falls to zero, its traction is lost.
///
/// # Source
/// Cattaneo (1938); Mindlin & Deresiewicz, J. Appl. Mech. 20, 327 (1953); the minimum is that of Kalker, *Three-Dimensional Elastic Bodies
/// in Rolling Contact* (1990), chapter 4.
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
    /// The contact of the last step, with the displacement `A_t p`.
    pressed: Option<(Contact, Vec<f64>)>,
    traction: Vec<f64>,
    /// `A_t` of the traction.
    sheared: Vec<f64>,
    tangential: f64,
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
    /// [`Compliance::tangential`].
    ///
    /// # Errors
    /// The errors of [`SlipHistory::new`].
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
        let (traction, sheared) = (zeros(), zeros());
        let compliance = Arc::new(compliance);
        Ok(Self { problem, coefficient, compliance, solver, stop, pressed: None, traction, sheared, tangential: 0.0 })
    }

    /// The next state: under the normal load `load` and the tangential load `tangential`, of the same kind as the normal one and of any
    /// sign. The observer sees the steps of both solves.
    ///
    /// # Errors
    /// [`SlipError::NeedsPressure`] for a normal load that is no pressure, [`SlipError::Sliding`] for a tangential load that friction cannot
    /// carry, and the errors of [`Problem::with_load`] and of [`Solver::solve_from`]. After an error the history is as it was before the step.
    pub fn step(&mut self, load: Load, tangential: f64, observer: &mut dyn Observer) -> Result<SlipState, SlipError> {
        let share = self.share(load, tangential)?;
        let (contact, pressed, mut work) = self.press(load, observer)?;
        let mean_pressure = contact.mean_pressure();
        let target = share * self.coefficient * mean_pressure;
        let found = match self.coefficient {
            0.0 => Traction::none(self.traction.len()),
            _ => self.pull(&contact, &pressed, target, observer)?,
        };
        let Traction { values, displacement, shift, status, work: of_traction } = found;
        work = sum(work, of_traction);
        let slip: Vec<f64> = displacement.iter().zip(&self.sheared).map(|(now, before)| now - before - shift).collect();
        let mut contact = contact;
        if status != Status::Converged && contact.is_converged() {
            contact.status = status;
        }
        let state = self.state(contact, &values, slip, (shift, target), [&displacement, &pressed], work);
        self.pressed = Some((state.contact.clone(), pressed));
        (self.traction, self.sheared, self.tangential) = (values, displacement, target);
        Ok(state)
    }

    /// The share `Q / (mu P)` of the load at which everything slides, with its sign.
    fn share(&self, load: Load, tangential: f64) -> Result<f64, SlipError> {
        if !load.is_pressure() {
            return Err(SlipError::NeedsPressure { load: load.to_string() });
        }
        let limit = self.coefficient * load.value();
        let is_carried = tangential.abs() < limit || tangential == 0.0;
        if !is_carried {
            return Err(SlipError::Sliding { tangential, limit });
        }
        Ok(if tangential == 0.0 { 0.0 } else { tangential / limit })
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
        let mut pressed = vec![0.0; self.traction.len()];
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
        let heights = field(&|i| sign * self.sheared[i] + mu * pressed[i]);
        let ceilings: Vec<f64> = p.iter().map(|p| 2.0 * mu * p).collect();
        let problem = Problem::of_compliance(yardstick.into(), self.compliance.clone(), load)?;
        let problem = problem.with_heights(heights)?.with_ceilings(ceilings)?;
        let start = field(&|i| (sign * self.traction[i] + mu * p[i]).clamp(0.0, 2.0 * mu * p[i]));
        let found = self.solver.solve_from(Some(&start), &problem, &self.stop, observer)?;
        let t = values(&found.pressure);
        // nodes that stick lie at minus the datum of the heights as they were given
        let level = -(datum(&found) + problem.shift());
        Ok(Traction {
            values: t.iter().zip(p).map(|(t, p)| sign * (t - mu * p)).collect(),
            displacement: values(&found.displacement).iter().zip(pressed).map(|(u, p)| sign * (u - mu * p)).collect(),
            shift: sign * level,
            status: found.status,
            work: found.work,
        })
    }

    /// The state with a traction and its slip.
    fn state(
        &self,
        contact: Contact,
        traction: &[f64],
        mut slip: Vec<f64>,
        (shift, target): (f64, f64),
        [displacement, pressed]: [&[f64]; 2],
        work: Work,
    ) -> SlipState {
        let (mu, shape) = (self.coefficient, contact.pressure.raw_dim());
        let zone = |tau: f64, p: f64| match mu * p {
            _ if p <= 0.0 => Zone::Open,
            limit if tau >= limit * (1.0 - ROUNDING) => Zone::Forward,
            limit if tau <= -limit * (1.0 - ROUNDING) => Zone::Backward,
            _ => Zone::Stick,
        };
        let field = |values: Vec<f64>| Field::from_shape_vec(shape, values).expect("one value per node");
        let tau = field(traction.to_vec());
        let zones = Zip::from(&tau).and(&contact.pressure).map_collect(|&tau, &p| zone(tau, p));
        let certificate = certify(mu, values(&contact.pressure), [traction, &slip], pressed);
        let (n, before) = (slip.len() as f64, self.pressed.as_ref().map(|(contact, _)| values(&contact.pressure)));
        let (p, zone_of) = (values(&contact.pressure), zones.as_slice().expect("standard layout"));
        let dissipated = |i: usize| match zone_of[i] {
            Zone::Open | Zone::Stick => 0.0,
            _ => 0.5 * mu * (p[i] + before.map_or(p[i], |before| before[i])) * slip[i].abs(),
        };
        let dissipated = chunks::sum(slip.len(), dissipated) / n;
        let stored = 0.5 * chunks::sum(slip.len(), |i| traction[i] * displacement[i]) / n;
        slip.iter_mut().zip(zone_of).filter(|(_, zone)| **zone == Zone::Stick).for_each(|(slip, _)| *slip = 0.0);
        SlipState {
            tangential: target,
            traction: tau,
            slip: field(slip),
            zones,
            shift,
            dissipated,
            stored,
            certificate,
            work,
            contact,
        }
    }
}

/// Relative distance from `mu p` up to which a traction counts as slipping, because of rounding.
const ROUNDING: f64 = 1e-14;

/// A traction, and what was found with it.
struct Traction {
    values: Vec<f64>,
    displacement: Vec<f64>,
    shift: f64,
    status: Status,
    work: Work,
}

impl Traction {
    /// No traction.
    fn none(nodes: usize) -> Self {
        let (values, displacement) = (vec![0.0; nodes], vec![0.0; nodes]);
        Self { values, displacement, shift: 0.0, status: Status::Converged, work: Work::default() }
    }
}

/// The bounds of a traction with its slip, under a pressure that displaces the surface by `pressed`.
fn certify(mu: f64, pressure: &[f64], [traction, slip]: [&[f64]; 2], pressed: &[f64]) -> SlipCertificate {
    let n = slip.len() as f64;
    let mean = |of: &(dyn Fn(usize) -> f64 + Sync)| chunks::sum(slip.len(), of) / n;
    let gap = mean(&|i| if pressure[i] > 0.0 { traction[i] * slip[i] + mu * pressure[i] * slip[i].abs() } else { 0.0 });
    let middle = mean(&|i| pressed[i]);
    let length = mu * mean(&|i| (pressed[i] - middle).powi(2)).sqrt();
    let square = mu * mu * mean(&|i| pressure[i] * pressed[i]);
    let over = |gap: f64, scale: f64| if mu > 0.0 { gap.max(0.0) / scale } else { 0.0 };
    SlipCertificate {
        eta: over(gap, mu * mean(&|i| pressure[i]) * length),
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
