//! Steady rolling of lines.

use crate::contact::{
    BoxInequality, Ceiling, Certificate, Contact, LoadOrDatum, Multilevel, Observer, Problem, SetIteration, Solver,
    Status, Stop, goes_on,
};
use crate::elastic::{Compliance, Coupling, Response};
use crate::error::{MotionError, ProblemError};
use crate::surface::Field;
use std::sync::Arc;

/// Largest number of updates of the traction, and of rounds between pressure and traction.
const UPDATES: usize = 400;
const ROUNDS: usize = 60;

/// The largest traction that is expected under a weak drive, over the drive and the square root of the number of nodes that touch: where
/// all of them stick, it grows like the inverse root of the distance from the edge. If it is too small, it is multiplied by the second one.
const REACH: f64 = 2.0;
const WIDER: f64 = 4.0;

/// The least part of the limit of friction that is left until sliding by which the goal of the traction is lowered: its square times the
/// tolerance of 1e-8 is still above rounding.
const LEAST_LEFT: f64 = 1e-3;

/// The part of the goal of the traction that is aimed at. Its square root is the error of the traction, which decides whether nodes stick.
const SURPLUS: f64 = 1e-3;

/// What drives a contact that rolls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RollingDrive {
    /// The creepage `xi`, the rigid slip of the solid per rolled distance, dimensionless. A negative one makes a positive traction.
    Creepage(f64),
    /// The tangential force over the limit of friction, `Fx/(mu Fn)`, between -1 and 1.
    Ratio(f64),
}

/// The conditions of steady rolling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingConditions {
    /// Coulomb's coefficient of friction `mu`.
    pub friction: f64,
    /// The step `dq` over which slip is taken, a length; usually the spacing of the grid.
    pub step: f64,
    /// Dundurs' parameter `beta`, between -0.5 and 0.5; 0 for bodies of the same material.
    pub beta: f64,
    /// Creepage or force.
    pub drive: RollingDrive,
}

/// A line contact that rolls steadily towards `+x`.
///
/// The pressure `p` is that of the [`Problem`], and the traction `tau` acts on the solid along `+x`. In a step `dq` the surface of the
/// solid slips over the rough surface by
///
/// `s(x) = xi dq + (A tau)(x) - (A tau)(x + dq) - beta (T p)(x)`
///
/// with the creepage `xi` and the compliances of [`Compliance::rolling`] and [`Coupling::rolling`], since the material at `x` was at
/// `x + dq` before. By Coulomb `|tau| <= mu p`, and `tau = -mu p sgn(s)` where it slips. With `t = tau + mu p` this is a variational
/// inequality with bounds, `0 <= t <= 2 mu p`, whose operator is monotone but not symmetric. Its traction is unique, and no energy
/// belongs to it.
///
/// | field      | shape    | unit     | meaning                          |
/// |------------|----------|----------|----------------------------------|
/// | `traction` | `(1, n)` | pressure | `tau`, on the solid along `+x`   |
/// | `slip`     | `(1, n)` | length   | `s`, in one step                 |
///
/// # Coupling
/// Where `beta` is not zero the traction displaces the surface into the solid by `beta S tau`. Pressure and traction are then solved in
/// turn (Panagiotopoulos 1975), until the pressure fits the heights `h - beta S tau` with the last traction to the tolerance. No bound of
/// the joint error is known: the result claims that both residuals are small, and nothing else.
///
/// # The error
/// With `v = B t - h_t`, `G = <t max(v - l, 0)> + <(2 mu p - t) max(l - v, 0)>` bounds `<(tau - tau*) B (tau - tau*)>`, in which only the
/// symmetric part of `B` counts, for the given pressure. `traction_certificate` is `G` over `mu <p>`, over the largest magnitude of `h_t`,
/// the displacement in a step of a contact that slips everywhere, and over the square of the *drive*. This is the ratio of the force; with a
/// given creepage at least the creepage over that of this displacement; at most 1, and 1 with coupling. So tractions far below `mu p` are as
/// exact as others.
///
/// In doubles, `t` would lose the digits of a traction far below `mu p`. So the bounds are narrower than `mu p` where the drive is weak:
/// a traction that reaches none of the narrow bounds but those of `mu p` is the solution within `mu p` as well. If it reaches them, they
/// are widened.
///
/// # Source
/// Carter, Proc. R. Soc. A 112, 151 (1926); Bentall & Johnson, Int. J. Mech. Sci. 9, 389 (1967); Kalker, *Three-Dimensional Elastic Bodies
/// in Rolling Contact* (1990). Deviation: updates of whole sets, with extragradient steps as a safeguard.
///
/// ```
/// use asperity::contact::{ContactModulus, Load};
/// use asperity::history::{Rolling, RollingConditions, RollingDrive};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// // Carter: xi = -(mu a/R) (1 - sqrt(1 - Fx/(mu Fn)))
/// let grid = Grid::line(512, 0.5)?.with_periodic([false; 2]);
/// let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(grid)?;
/// let problem = Problem::new(cylinder, ContactModulus(1.0), Load::Force(0.01))?;
/// let conditions =
///     RollingConditions { friction: 0.3, step: grid.spacing()[1], beta: 0.0, drive: RollingDrive::Ratio(0.64) };
/// let rolling = Rolling::solve(&problem, conditions, &Stop::default(), &mut ())?;
/// let a = (4.0 * 0.01 / std::f64::consts::PI).sqrt();
/// assert!((rolling.creepage() / (-0.3 * a * (1.0 - 0.36f64.sqrt())) - 1.0).abs() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Rolling {
    /// The normal contact. With coupling its displacement is the whole one, by pressure and traction. It has not converged if the traction
    /// has not, or if both do not converge together.
    pub contact: Contact,
    /// The conditions.
    pub conditions: RollingConditions,
    /// The traction on the solid along `+x`.
    pub traction: Field,
    /// The slip of the solid in one step.
    pub slip: Field,
    /// The certificate of the traction under the pressure.
    pub traction_certificate: f64,
    /// The certificate `eta` of the pressure under the heights that the last traction displaces.
    pub pressure_certificate: f64,
    /// Rounds between pressure and traction; 1 without coupling.
    pub rounds: usize,
    /// Updates of the traction.
    pub updates: usize,
    /// Inner steps of the updates.
    pub inner_steps: usize,
    /// Transforms of pressure and traction.
    pub transforms: u64,
    creepage: f64,
    /// The largest displacement in a step of a contact that slips everywhere, a length.
    reach: f64,
}

impl Rolling {
    /// Solves the contact that `problem` describes at rest, rolling. `observer` watches the normal contact, in each round.
    ///
    /// What does not converge comes back as it is, with the status of its contact.
    ///
    /// # Errors
    /// [`MotionError::NotPositive`], [`MotionError::NotFinite`], [`MotionError::Beta`] and [`MotionError::Slides`] for conditions out of
    /// range; [`MotionError::LongStep`] for a step longer than the contact; [`MotionError::NeedsHalfSpace`], [`MotionError::NeedsHardWall`]
    /// and [`MotionError::NeedsRest`] for a problem that cannot roll; [`MotionError::Problem`] for a surface, and [`MotionError::Solve`] for
    /// an observer that failed.
    pub fn solve(
        problem: &Problem,
        conditions: RollingConditions,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Self, MotionError> {
        check(problem, conditions)?;
        let mut shifts = Shifts::new(problem, conditions)?;
        let mut posed = problem.clone();
        let mut last: Option<(Contact, Vec<f64>)> = None;
        let (mut updates, mut inner_steps, mut transforms) = (0, 0, 0);
        for rounds in 1.. {
            let start = last.as_ref().map(|(contact, _)| &contact.pressure);
            let mut contact = Multilevel.solve_from(start, &posed, stop, observer)?;
            if contact.failure.is_some() {
                contact = contact.converged()?;
            }
            check_step(&contact, conditions.step)?;
            transforms += contact.work.transforms;
            let pressure = contact.pressure.as_slice().expect("results are made in standard layout").to_vec();
            let before = last.take().map(|(_, traction)| traction);
            let solved = shifts.traction(&pressure, before, stop, observer)?;
            updates += solved.updates;
            inner_steps += solved.inner_steps;
            transforms += solved.transforms;
            if contact.is_converged() {
                contact.status = solved.status;
            }
            let raised = shifts.raised(&solved.traction);
            let certificate = match &raised {
                Some(raised) => {
                    posed = problem.with_heights(problem.surface().height() - raised)?;
                    Certificate::new(&posed, &pressure)
                }
                None => contact.certificate,
            };
            let fits = certificate.eta <= stop.tolerance();
            if contact.is_converged() && !fits && rounds < ROUNDS {
                last = Some((contact, solved.traction));
                continue;
            }
            if contact.is_converged() && !fits {
                contact.status = Status::Stalled;
            }
            if let Some(raised) = raised.as_ref().and_then(|raised| raised.as_slice()) {
                contact = contact.displaced_by(problem.clone(), raised, certificate);
            }
            let field = |values| Field::from_shape_vec((1, pressure.len()), values).expect("one value per node");
            return Ok(Self {
                contact,
                conditions,
                traction: field(solved.traction),
                slip: field(solved.slip),
                traction_certificate: solved.certificate,
                pressure_certificate: certificate.eta,
                rounds,
                updates,
                inner_steps,
                transforms,
                creepage: solved.datum / conditions.step,
                reach: solved.reach,
            });
        }
        unreachable!("the last round returns")
    }

    /// The creepage `xi`: the given one, or the one that belongs to the force.
    pub fn creepage(&self) -> f64 {
        self.creepage
    }

    /// The tangential force over the limit of friction, `<tau>/(mu <p>)`.
    pub fn ratio(&self) -> f64 {
        self.traction.sum() / (self.conditions.friction * self.contact.pressure.sum())
    }

    /// Nodes that touch and stick: their traction is below the limit of friction. What is left to the limit is weighed against the slip, over the
    /// displacement in a step of a contact that slips everywhere, since both are small where a node begins to slip.
    pub fn sticks(&self) -> Vec<bool> {
        let nodes = self.traction.iter().zip(&self.slip).zip(&self.contact.pressure);
        let is_below = |tau: f64, slip: f64, limit: f64| (tau / limit - slip / self.reach).abs() < 1.0 - 1e-12;
        nodes.map(|((&tau, &slip), &p)| p > 0.0 && is_below(tau, slip, self.conditions.friction * p)).collect()
    }

    /// Direction in which each node slips: 1 if the solid slips towards `+x`, -1 towards `-x`, and 0 for nodes that stick or do not
    /// touch.
    pub fn slip_directions(&self) -> Vec<i8> {
        let nodes = self.traction.iter().zip(&self.contact.pressure).zip(self.sticks());
        nodes
            .map(|((&tau, &p), sticks)| match p > 0.0 && !sticks {
                true if tau > 0.0 => -1,
                true => 1,
                false => 0,
            })
            .collect()
    }
}

fn check(problem: &Problem, conditions: RollingConditions) -> Result<(), MotionError> {
    let RollingConditions { friction, beta, drive, .. } = conditions;
    if !(friction.is_finite() && friction > 0.0) {
        return Err(MotionError::NotPositive { name: "coefficient of friction", value: friction });
    }
    if !(-0.5..=0.5).contains(&beta) {
        return Err(MotionError::Beta { value: beta });
    }
    match drive {
        RollingDrive::Creepage(value) if !value.is_finite() => {
            return Err(MotionError::NotFinite { name: "creepage", value });
        }
        RollingDrive::Ratio(ratio) if !(ratio.is_finite() && ratio.abs() < 1.0) => {
            return Err(MotionError::Slides { ratio });
        }
        _ => {}
    }
    if problem.is_moving() {
        return Err(MotionError::NeedsRest);
    }
    if !problem.law().is_hard_wall() {
        return Err(MotionError::NeedsHardWall);
    }
    match problem.solid().is_half_space() {
        true => Ok(()),
        false => Err(MotionError::NeedsHalfSpace { solid: problem.solid().description() }),
    }
}

/// Refuses a step that is longer than the contact: in it material would cross the contact without touching.
fn check_step(contact: &Contact, step: f64) -> Result<(), MotionError> {
    let touches: Vec<bool> = contact.pressure.iter().map(|p| *p > 0.0).collect();
    let ends = touches.iter().position(|it| *it).zip(touches.iter().rposition(|it| *it));
    let length =
        ends.map_or(0.0, |(first, last)| (last - first + 1) as f64 * contact.problem.surface().grid().spacing()[1]);
    if step > length { Err(MotionError::LongStep { step, length }) } else { Ok(()) }
}

/// What pressures and tractions displace.
struct Shifts {
    conditions: RollingConditions,
    grid: crate::Grid,
    rolling: Arc<Compliance>,
    /// `T` and `S`, where there is coupling.
    coupling: Option<[Coupling; 2]>,
}

/// A solved traction.
struct SolvedTraction {
    status: Status,
    traction: Vec<f64>,
    slip: Vec<f64>,
    /// `xi dq`.
    datum: f64,
    certificate: f64,
    /// The largest displacement in a step by tractions at their limits.
    reach: f64,
    updates: usize,
    inner_steps: usize,
    transforms: u64,
}

impl Shifts {
    fn new(problem: &Problem, conditions: RollingConditions) -> Result<Self, MotionError> {
        let grid = *problem.surface().grid();
        let rolling = Arc::new(Compliance::rolling(&grid, problem.solid().clone(), conditions.step)?);
        let half_space = problem.solid().as_ref();
        let coupling = match conditions.beta {
            0.0 => None,
            _ => Some([
                Coupling::rolling(&grid, half_space, conditions.step)?,
                Coupling::new(&grid, half_space).map_err(ProblemError::from)?,
            ]),
        };
        Ok(Self { conditions, grid, rolling, coupling })
    }

    /// The traction under a pressure, from the last one.
    fn traction(
        &mut self,
        pressure: &[f64],
        before: Option<Vec<f64>>,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<SolvedTraction, MotionError> {
        let limit: Vec<f64> = pressure.iter().map(|p| self.conditions.friction * p).collect();
        let largest = self.height(pressure, &limit).iter().fold(0.0, |most: f64, h| most.max(h.abs()));
        let drive = match self.conditions.drive {
            _ if self.coupling.is_some() => 1.0,
            RollingDrive::Creepage(creepage) => (creepage * self.conditions.step / largest).abs(),
            RollingDrive::Ratio(ratio) => ratio.abs(),
        };
        // without a drive there is no traction, and with a strong one all bounds are reached
        let drive = if drive > 0.0 && drive < 1.0 { drive } else { 1.0 };
        let unit = limit.iter().sum::<f64>() / limit.len() as f64 * largest;
        let touching = limit.iter().filter(|limit| **limit > 0.0).count();
        let highest = limit.iter().copied().fold(0.0, f64::max);
        let mut reach = REACH * (touching as f64).sqrt() * drive * highest;
        let (mut updates, mut inner_steps, mut transforms) = (0, 0, 0);
        loop {
            let narrow: Vec<f64> = limit.iter().map(|limit| limit.min(reach)).collect();
            let task = TractionTask { pressure, limit: &limit, narrow: &narrow, unit, drive };
            let mut found = self.traction_within(&task, before.as_deref(), stop, observer)?;
            updates += found.updates;
            inner_steps += found.inner_steps;
            transforms += found.transforms;
            let reaches = |i: usize| narrow[i] < limit[i] && found.traction[i].abs() >= narrow[i] * (1.0 - 1e-9);
            if found.status != Status::Converged || !(0..limit.len()).any(reaches) {
                (found.updates, found.inner_steps, found.transforms) = (updates, inner_steps, transforms);
                found.reach = largest;
                return Ok(found);
            }
            reach *= WIDER;
        }
    }

    /// `h_t`: the displacement in a step by tractions at their bounds and by the pressure.
    fn height(&mut self, pressure: &[f64], bounds: &[f64]) -> Vec<f64> {
        let mut height = vec![0.0; bounds.len()];
        Response::from_compliance(self.rolling.clone()).displacement(bounds, &mut height);
        if let Some([ahead, _]) = &mut self.coupling {
            let mut shift = vec![0.0; pressure.len()];
            ahead.by_pressure(pressure, [&mut shift, &mut []]);
            height.iter_mut().zip(shift).for_each(|(h, shift)| *h += self.conditions.beta * shift);
        }
        height
    }

    /// The traction within narrow bounds.
    fn traction_within(
        &mut self,
        task: &TractionTask<'_>,
        before: Option<&[f64]>,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<SolvedTraction, MotionError> {
        let &TractionTask { pressure, limit, narrow, unit, drive: least } = task;
        let RollingConditions { step, drive, .. } = self.conditions;
        let ceilings: Arc<[f64]> = narrow.iter().map(|limit| 2.0 * limit).collect();
        let height = self.height(pressure, narrow);
        let [load, carried]: [f64; 2] = [narrow, limit].map(|it| it.iter().sum());
        let (goal, share) = match drive {
            RollingDrive::Creepage(creepage) => (LoadOrDatum::Datum(creepage * step), 0.0),
            RollingDrive::Ratio(ratio) => (LoadOrDatum::Sum(load + ratio * carried), ratio * carried / load),
        };
        let first = match before {
            Some(traction) => {
                traction.iter().zip(narrow).map(|(tau, limit)| (tau + limit).clamp(0.0, 2.0 * limit)).collect()
            }
            None => narrow.iter().map(|limit| (1.0 + share) * limit).collect(),
        };
        let task = BoxInequality { height: &height, ceilings: Ceiling::Field(ceilings), goal };
        let mut state = SetIteration::new(task, &self.rolling, &self.grid, first);
        let most = UPDATES.min(stop.max_iterations());
        for updates in 0.. {
            let (gap, level) = state.gap();
            let carries = (state.p.iter().sum::<f64>() - load).abs() / carried;
            let certificate = gap / (unit * carries.max(least).powi(2));
            let is_converged = certificate <= stop.tolerance();
            // close to sliding few nodes stick, and their tractions lack little: the goal is relative to that
            let left = (1.0 - carries).max(LEAST_LEFT).powi(2);
            let is_done = certificate <= SURPLUS * left * stop.tolerance();
            let is_stale = is_converged && state.is_stale();
            let is_stopped = !is_done && !goes_on(observer);
            if !is_done && !is_stale && !is_stopped && updates < most {
                state.advance(certificate, &mut |_| goes_on(observer));
                continue;
            }
            let status = match is_converged {
                true => Status::Converged,
                false if is_stopped => Status::StoppedByObserver,
                false if most < UPDATES => Status::IterationCap,
                false => Status::Stalled,
            };
            let traction = state.p.iter().zip(narrow).map(|(t, limit)| t - limit).collect();
            let slip = state.u.iter().zip(&height).map(|(u, h)| u - h - level).collect();
            return Ok(SolvedTraction {
                status,
                traction,
                slip,
                datum: -level,
                certificate,
                reach: 0.0,
                updates,
                inner_steps: state.inner,
                transforms: state.transforms(),
            });
        }
        unreachable!("the last update returns")
    }

    /// What a traction displaces into the solid, where there is coupling.
    fn raised(&mut self, traction: &[f64]) -> Option<Field> {
        let [_, sign] = self.coupling.as_mut()?;
        let mut shift = vec![0.0; traction.len()];
        sign.by_traction([traction, &[]], &mut shift);
        shift.iter_mut().for_each(|u| *u *= self.conditions.beta);
        Some(Field::from_shape_vec((1, shift.len()), shift).expect("one value per node"))
    }
}

/// The traction that a round asks for.
struct TractionTask<'a> {
    pressure: &'a [f64],
    /// `mu p`.
    limit: &'a [f64],
    /// The bounds of the traction, at most `mu p`.
    narrow: &'a [f64],
    /// What `G` is divided by, besides the square of the drive.
    unit: f64,
    /// The drive, at least.
    drive: f64,
}
