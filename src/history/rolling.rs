//! Steady rolling of lines.

use crate::contact::{
    BoxInequality, Ceiling, Certificate, Contact, LoadOrDatum, Multilevel, Observer, Problem, SetIteration, Solver,
    Stop,
};
use crate::elastic::{Compliance, Coupling, Response};
use crate::error::{MotionError, ProblemError};
use crate::surface::Field;
use std::sync::Arc;

/// Largest number of updates of the traction, and of rounds between pressure and traction.
const UPDATES: usize = 400;
const ROUNDS: usize = 60;

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
/// symmetric part of `B` counts, for the given pressure. `traction_certificate` is `G` over `mu <p>` and the largest magnitude of `h_t`,
/// the displacement in a step of a contact that slips everywhere.
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
    /// The normal contact; with coupling, that of the heights less what the traction displaces.
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
}

impl Rolling {
    /// Solves the contact that `problem` describes at rest, rolling. `observer` watches the normal contact, in each round.
    ///
    /// # Errors
    /// [`MotionError::NotPositive`], [`MotionError::NotFinite`], [`MotionError::Beta`] and [`MotionError::Slides`] for conditions out of
    /// range; [`MotionError::NeedsHalfSpace`], [`MotionError::NeedsHardWall`] and [`MotionError::NeedsRest`] for a problem that cannot
    /// roll; [`MotionError::Problem`] for a surface; [`MotionError::Solve`] for a pressure that did not converge, [`MotionError::Traction`]
    /// for such a traction, and [`MotionError::Rounds`] if both do not converge together.
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
        for rounds in 1..=ROUNDS {
            let start = last.as_ref().map(|(contact, _)| &contact.pressure);
            let contact = Multilevel.solve_from(start, &posed, stop, observer)?.converged()?;
            transforms += contact.work.transforms;
            let pressure = contact.pressure.as_slice().expect("results are made in standard layout").to_vec();
            let before = last.take().map(|(_, traction)| traction);
            let solved = shifts.traction(&pressure, before, stop)?;
            updates += solved.updates;
            inner_steps += solved.inner_steps;
            transforms += solved.transforms;
            let pressure_certificate = if conditions.beta == 0.0 {
                contact.certificate.eta
            } else {
                posed = problem.with_heights(shifts.heights(problem, &solved.traction))?;
                Certificate::new(&posed, &pressure).eta
            };
            if pressure_certificate <= stop.tolerance() {
                let field = |values| Field::from_shape_vec((1, pressure.len()), values).expect("one value per node");
                return Ok(Self {
                    contact,
                    conditions,
                    traction: field(solved.traction),
                    slip: field(solved.slip),
                    traction_certificate: solved.certificate,
                    pressure_certificate,
                    rounds,
                    updates,
                    inner_steps,
                    transforms,
                    creepage: solved.datum / conditions.step,
                });
            }
            if rounds == ROUNDS {
                let (normal, tangential) = (pressure_certificate, solved.certificate);
                return Err(MotionError::Rounds { rounds, normal, tangential });
            }
            last = Some((contact, solved.traction));
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

    /// Nodes that touch and stick: their traction is below the limit of friction.
    pub fn sticks(&self) -> Vec<bool> {
        let pairs = self.traction.iter().zip(&self.contact.pressure);
        pairs.map(|(tau, &p)| p > 0.0 && tau.abs() < self.conditions.friction * p * (1.0 - 1e-12)).collect()
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
    traction: Vec<f64>,
    slip: Vec<f64>,
    /// `xi dq`.
    datum: f64,
    certificate: f64,
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
    ) -> Result<SolvedTraction, MotionError> {
        let RollingConditions { friction, step, beta, drive } = self.conditions;
        let n = pressure.len();
        let limit: Vec<f64> = pressure.iter().map(|p| friction * p).collect();
        let ceilings: Arc<[f64]> = limit.iter().map(|limit| 2.0 * limit).collect();
        let mut height = vec![0.0; n];
        Response::from_compliance(self.rolling.clone()).displacement(&limit, &mut height);
        if let Some([ahead, _]) = &mut self.coupling {
            let mut shift = vec![0.0; n];
            ahead.by_pressure(pressure, [&mut shift, &mut []]);
            height.iter_mut().zip(shift).for_each(|(h, shift)| *h += beta * shift);
        }
        let load: f64 = limit.iter().sum();
        let goal = match drive {
            RollingDrive::Creepage(creepage) => LoadOrDatum::Datum(creepage * step),
            RollingDrive::Ratio(ratio) => LoadOrDatum::Sum(load * (1.0 + ratio)),
        };
        let share = if let RollingDrive::Ratio(ratio) = drive { 1.0 + ratio } else { 1.0 };
        let first = match before {
            Some(traction) => {
                traction.iter().zip(&limit).map(|(tau, limit)| (tau + limit).clamp(0.0, 2.0 * limit)).collect()
            }
            None => limit.iter().map(|limit| share * limit).collect(),
        };
        let largest = height.iter().fold(0.0, |most: f64, h| most.max(h.abs()));
        let task = BoxInequality { height: &height, ceilings: Ceiling::Field(ceilings), goal };
        let mut state = SetIteration::new(task, &self.rolling, &self.grid, first);
        let unit = load / n as f64 * largest;
        for updates in 0..=UPDATES {
            let (gap, level) = state.gap();
            let certificate = gap / unit;
            if certificate <= stop.tolerance() {
                let traction = state.p.iter().zip(&limit).map(|(t, limit)| t - limit).collect();
                let slip = state.u.iter().zip(&height).map(|(u, h)| u - h - level).collect();
                let (inner_steps, transforms) = (state.inner, state.transforms());
                return Ok(SolvedTraction {
                    traction,
                    slip,
                    datum: -level,
                    certificate,
                    updates,
                    inner_steps,
                    transforms,
                });
            }
            if updates == UPDATES {
                return Err(MotionError::Traction { updates, certificate });
            }
            state.advance(certificate, &mut |_| true);
        }
        unreachable!("the last update returns")
    }

    /// The heights of a surface less what a traction displaces.
    fn heights(&mut self, problem: &Problem, traction: &[f64]) -> Field {
        let mut height = problem.surface().height().clone();
        if let Some([_, sign]) = &mut self.coupling {
            let mut shift = vec![0.0; traction.len()];
            sign.by_traction([traction, &[]], &mut shift);
            height.iter_mut().zip(shift).for_each(|(h, shift)| *h -= self.conditions.beta * shift);
        }
        height
    }
}
