//! The traction along one axis of one step with friction.

use super::discs::{Pair, add, length, scaled};
use super::slip_round::{SlipTask, values};
use super::slip_traction::{Traction, better_shift};
use crate::contact::{Contact, Load, Observer, Problem, Solver, Status, Stop, Work};
use crate::elastic::{Compliance, Response};
use crate::error::SlipError;
use crate::surface::{Field, Surface};
use std::borrow::Cow;
use std::sync::Arc;

/// A traction is solved to this part of the tolerance. The certificate is quadratic in the error of the traction, but shift and lost energy
/// are not: with 1, energies of spheres were off by 5e-4 at a tolerance of 1e-8.
pub(super) const PULL_TOLERANCE_SHARE: f64 = 0.01;

/// No part of a tolerance is below this one, which rounding allows.
const LEAST_TOLERANCE: f64 = 2e-15;

/// The largest change of the traction that is expected, over the drive, the largest limit `mu p` and the square root of the number of
/// nodes that touch: where all of them stick, it grows like the inverse root of the distance from the edge.
const CHANGE_OVER_DRIVE: f64 = 2.0;

/// The factor by which the window of the traction is widened where the traction reaches its end.
pub(super) const WINDOW_GROWTH: f64 = 4.0;

/// Relative distance from the end of a window within which a traction counts as having reached it.
pub(super) const AT_BOUND: f64 = 1e-9;

/// A drive below this one is rounding of the traction before the step, relative to which it is taken.
const NO_DRIVE: f64 = 1e-15;

/// Solves the traction along `x` of a step.
pub(super) struct SlipPull<'a> {
    /// Coulomb's coefficient of friction `mu`.
    pub coefficient: f64,
    pub compliance: &'a Arc<Compliance>,
    pub solver: &'a dyn Solver,
    pub stop: Stop,
    /// The traction before the step, and the displacement that belongs to it.
    pub traction: &'a [f64],
    pub displaced: &'a [f64],
}

/// The traction before a step, cut to what friction carries under the new pressure.
struct MiddleTraction<'a> {
    values: Vec<f64>,
    /// What it displaces.
    displaced: Cow<'a, [f64]>,
    /// The displacement that is to come, `w_0` less what the traction displaces.
    lag: Vec<f64>,
}

/// The window in which the traction of each node is searched, about the one before the step.
struct SlipWindow {
    /// The sign of the tangential load.
    sign: f64,
    /// Half the width of the window; the limits `mu p` may be nearer.
    reach: f64,
    /// How much the traction of each node may grow in the direction of the load, and how much it may fall.
    room: [Vec<f64>; 2],
    /// Which of these the window limits, and not friction.
    is_narrow: Vec<[bool; 2]>,
    /// The sum of the change of the traction in the direction of the load.
    change: f64,
}

impl SlipPull<'_> {
    /// The traction with the mean `target` under the pressure of a contact.
    ///
    /// With the sign of the target, the unknown `t` of a node is the upper end of its window less its traction, between zero and the width of
    /// the window. Without a window it is `mu p - tau`. So all that is searched is small close to sliding, where few nodes stick
    /// and `t` is the pressure on these, and under a weak pull, where the window is narrow: rounding and tolerance are
    /// relative to it in both cases.
    pub(crate) fn solve(&self, task: &SlipTask<'_>, observer: &mut dyn Observer) -> Result<Traction, SlipError> {
        let (mu, p) = (self.coefficient, values(&task.contact.pressure));
        let target = task.target[0];
        let middle = self.middle(p, task);
        let limits: Vec<f64> = p.iter().map(|p| mu * p).collect();
        let total = [target * p.len() as f64, 0.0];
        let before: Vec<Pair> = self.traction.iter().map(|tau| [*tau, 0.0]).collect();
        let drive = match drive_of(&limits, &before, total) {
            // displacements by the pressure ask for tractions that the load does not tell of
            _ if task.is_coupled => 1.0,
            0.0 if middle.lag.iter().any(|lag| *lag != 0.0) => 1.0,
            drive => drive,
        };
        if drive == 0.0 || limits.iter().all(|limit| *limit == 0.0) {
            // nothing touches, or the traction before the step carries the load and nothing moves
            return Ok(still(middle));
        }
        let touching = p.iter().filter(|p| **p > 0.0).count();
        let highest = limits.iter().copied().fold(0.0, f64::max);
        let mut reach = reach_of(drive, touching) * highest;
        let near = 1.0 - target.abs() / (mu * task.contact.mean_pressure());
        let stop = finer(self.stop, PULL_TOLERANCE_SHARE * near);
        let mut work = Work::default();
        loop {
            let window = SlipWindow::new(&limits, &middle.values, target, reach);
            if !window.carries() {
                reach *= WINDOW_GROWTH;
                continue;
            }
            let yardstick = drive * mu;
            let (found, raised) = self.solve_within(&window, task, (&middle, yardstick), &stop, observer)?;
            work += found.work + Work { transforms: 2, ..Work::default() };
            if found.status == Status::Converged && window.is_reached(values(&found.pressure)) {
                reach = WINDOW_GROWTH * window.reach;
                continue;
            }
            return Ok(self.traction_of(&window, middle, (&found, &raised), (task, work)));
        }
    }

    /// The traction before the step, cut to the limits under a pressure, with what is left of `w_0`.
    fn middle(&self, p: &[f64], task: &SlipTask<'_>) -> MiddleTraction<'_> {
        let moved = &task.moved[0];
        let cut = |(tau, p): (&f64, &f64)| tau.clamp(-self.coefficient * p, self.coefficient * p);
        let cut: Vec<f64> = self.traction.iter().zip(p).map(cut).collect();
        // with coupling the displacement before the step is also that by the pressure
        if cut == self.traction && !task.is_coupled {
            return MiddleTraction { values: cut, displaced: Cow::Borrowed(self.displaced), lag: moved.clone() };
        }
        let mut displaced = vec![0.0; cut.len()];
        Response::from_compliance(self.compliance.clone()).displacement(&cut, &mut displaced);
        let lag = (0..cut.len()).map(|i| moved[i] + (self.displaced[i] - displaced[i])).collect();
        MiddleTraction { values: cut, displaced: Cow::Owned(displaced), lag }
    }

    /// The unknown `t` in a window, and what the room of the window would displace.
    fn solve_within(
        &self,
        window: &SlipWindow,
        task: &SlipTask<'_>,
        (middle, yardstick): (&MiddleTraction<'_>, f64),
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<(Contact, Vec<f64>), SlipError> {
        let grid = *task.contact.problem.surface().grid();
        let n = task.pressed.len();
        let field =
            |of: &dyn Fn(usize) -> f64| Field::from_shape_fn(grid.shape(), |(y, x)| of(y * grid.shape()[1] + x));
        let [room, back] = &window.room;
        let mut raised = vec![0.0; n];
        Response::from_compliance(self.compliance.clone()).displacement(room, &mut raised);
        let load = Load::MeanPressure((room.iter().sum::<f64>() - window.change) / n as f64);
        // certificates are over the rms of these heights, the displacement by a traction of the size of the drive
        let scale = Surface::new(grid, field(&|i| yardstick * task.pressed[i])).map_err(SlipError::Surface)?;
        let heights = field(&|i| raised[i] - window.sign * middle.lag[i]);
        let ceilings: Vec<f64> = room.iter().zip(back).map(|(room, back)| room + back).collect();
        let problem = Problem::of_compliance(scale.into(), self.compliance.clone(), load)?;
        let problem = problem.with_heights(heights)?.with_ceilings(ceilings.clone())?;
        let change = |i: usize| window.sign * (task.start[0][i] - middle.values[i]);
        let start = field(&|i| (room[i] - change(i)).clamp(0.0, ceilings[i]));
        Ok((self.solver.solve_from(Some(&start), &problem, stop, observer)?, raised))
    }

    /// The traction that belongs to an unknown `t`, with its shift.
    fn traction_of(
        &self,
        window: &SlipWindow,
        middle: MiddleTraction<'_>,
        (found, raised): (&Contact, &[f64]),
        (task, work): (&SlipTask<'_>, Work),
    ) -> Traction {
        let (sign, p) = (window.sign, values(&task.contact.pressure));
        let n = p.len();
        let (t, u) = (values(&found.pressure), values(&found.displacement));
        let at_limit = |i: usize, traction: f64| match window.is_narrow[i] {
            // exactly at the limit, whatever rounding makes of the sum
            [false, _] if t[i] == 0.0 => sign * self.coefficient * p[i],
            _ => traction,
        };
        let traction: Vec<f64> =
            (0..n).map(|i| at_limit(i, middle.values[i] + sign * (window.room[0][i] - t[i]))).collect();
        let change: Vec<f64> = (0..n).map(|i| sign * (raised[i] - u[i])).collect();
        let moved: Vec<f64> = (0..n).map(|i| change[i] - middle.lag[i]).collect();
        // nodes that stick lie at minus the datum of the heights as they were given
        let level = sign * (datum(found) + found.problem.shift());
        let shift = better_shift(self.coefficient, p, [&traction, &moved], level);
        let displacement = (0..n).map(|i| middle.displaced[i] + change[i]).collect();
        Traction {
            values: [traction, Vec::new()],
            displacement: [displacement, Vec::new()],
            shift: [shift, 0.0],
            status: found.status,
            work,
        }
    }
}

impl SlipWindow {
    /// The window of half a width `reach` about a traction within its limits.
    fn new(limits: &[f64], middle: &[f64], target: f64, reach: f64) -> Self {
        let sign = if target < 0.0 { -1.0 } else { 1.0 };
        let room_along = |sign: f64| limits.iter().zip(middle).map(move |(limit, tau)| limit - sign * tau);
        let room = [sign, -sign].map(|sign| room_along(sign).map(|room| room.min(reach)).collect());
        let [ahead, behind] = [sign, -sign].map(room_along);
        let is_narrow = ahead.zip(behind).map(|(ahead, behind)| [ahead > reach, behind > reach]).collect();
        let change = target.abs() * limits.len() as f64 - sign * middle.iter().sum::<f64>();
        Self { sign, reach, room, is_narrow, change }
    }

    /// Whether tractions within the window can carry the load, with something to spare.
    fn carries(&self) -> bool {
        let is_whole = |axis: usize| !self.is_narrow.iter().any(|it| it[axis]);
        let [ahead, behind] = self.room.each_ref().map(|room| room.iter().sum::<f64>());
        (is_whole(0) || ahead >= WINDOW_GROWTH * self.change) && (is_whole(1) || behind >= -WINDOW_GROWTH * self.change)
    }

    /// Whether a traction has reached an end of the window at which friction does not limit it.
    fn is_reached(&self, t: &[f64]) -> bool {
        let [room, back] = &self.room;
        (0..t.len()).any(|i| {
            let [ahead, behind] = self.is_narrow[i];
            let near = AT_BOUND * (room[i] + back[i]);
            ahead && t[i] <= near || behind && t[i] >= room[i] + back[i] - near
        })
    }
}

/// The traction of a step in which nothing moves.
fn still(middle: MiddleTraction<'_>) -> Traction {
    Traction {
        values: [middle.values, Vec::new()],
        displacement: [middle.displaced.into_owned(), Vec::new()],
        ..Traction::none([0, 0])
    }
}

/// How much traction a step has to move, over the limit of friction: what the load asks for and what the limits have cut off, at most 1. Zero
/// where the traction before the step carries the load.
pub(super) fn drive_of(limits: &[f64], before: &[Pair], total: Pair) -> f64 {
    let (mut left, mut cut_off, mut size, mut most) = (total, 0.0, 0.0, 0.0);
    for (tau, limit) in before.iter().zip(limits) {
        let before = length(*tau);
        let kept = if before > *limit { scaled(*tau, limit / before) } else { *tau };
        left = add(left, -1.0, kept);
        cut_off += (before - limit).max(0.0);
        size += before;
        most += limit;
    }
    let moved = length(left) + cut_off;
    if most == 0.0 || moved <= NO_DRIVE * size { 0.0 } else { (moved / most).min(1.0) }
}

/// Half the width of the window of a drive, over the largest limit of friction.
pub(super) fn reach_of(drive: f64, touching: usize) -> f64 {
    CHANGE_OVER_DRIVE * (touching as f64).sqrt() * drive
}

/// A part of a tolerance.
pub(super) fn finer(stop: Stop, part: f64) -> Stop {
    let tolerance = stop.tolerance();
    Stop::new((part * tolerance).max(LEAST_TOLERANCE).min(tolerance), stop.max_iterations()).unwrap_or(stop)
}

/// The datum of the gap of a contact, by one node: `g - (u - h)`.
fn datum(contact: &Contact) -> f64 {
    contact.gap[[0, 0]] - (contact.displacement[[0, 0]] - contact.problem.height()[0])
}
