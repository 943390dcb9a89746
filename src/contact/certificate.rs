//! Certificates: bounds of the error of a pressure.

use crate::contact::rounding::Rounding;
use crate::contact::slack::{Slack, level};
use crate::contact::{Ceiling, CertificateSums, Problem};
use serde::Serialize;

/// Rigorous bounds of the error of a feasible pressure `p >= 0` (below the hardness, if there is one) under the load
/// that it carries. They follow from a duality gap (Frank-Wolfe gap).
///
/// Angle brackets are means over the nodes, `u = A p` is the displacement, `v = u - h`, and `|x|^2 = <x A x>`, in which a uniform
/// pressure has no length. An asterisk marks the solution.
///
/// # Under a mean pressure
/// Every feasible pressure obeys `f(p) - f* <= G`, `G = <p (v - min v)>`: the solution cannot lie deeper than the load times the
/// lowest point of the linearised energy, since `<(p - p*) v> <= <p v> - <p> min v`. `G` vanishes only at the solution. With
/// `a = G / <p>`, the mean gap where `<p g> = 0` is `d = -<p v>/<p>`, and the deepest node lies `a` below it.
///
/// **The pressure.** The solution obeys the variational inequality `<(p - p*) v*> >= 0`. So
///
/// ```text
/// |p - p*|^2 = <(p - p*) (v - v*)> <= <(p - p*) v> <= G
/// ```
///
/// and the relative error of the pressure in this norm is at most `sqrt(G / <p u>)`.
///
/// **The mean gap.** With `t = |p - p*|` and `<p (v* + D*)> >= 0`, `D* = -min v* = -<p* v*>/<p>`,
///
/// ```text
/// D* >= -<p v*>/<p>  = d - <u (p* - p)>/<p>                  >= d - |p| t / <p>
/// D* <= -min v - <u* (p* - p)>/<p> <= d + a + (|p| t - t^2) / <p>
/// ```
///
/// and `t^2 <= G`. Where `4 G <= <p u>` the last bracket is largest at `t^2 = G`, and `|D* - d| <= sqrt(a <p u>/<p>)`.
///
/// # At a mean gap
/// For the mean gap `D` the energy is `F = f + D <p>`, its gradient `v + D`, and the variational inequality that of `v* + D`.
/// Since `<p (v + D)> = <p> (D - d)` and `<p* v> >= <p*> min v`,
///
/// ```text
/// F(p) - F* <= <(p - p*) (v + D)> <= <p*> a + (<p> - <p*>) (D - d) <= max(<p>, <p*>) (a + |D - d|)
/// ```
///
/// So `a + |D - d|` takes the place of `a`. Both vanish only at the solution.
///
/// **The load.** Nothing here compares `a + |D - d|` with what is left of the gap. Close to closure, where `u` is all but `h`, any
/// uniform pressure may be added at the price of `|D - d| <= D`, and close to first touch all of the load is made by the last
/// `h_max - D` of the heights. The pressure is that of nearly the same heights at nearly the same gap, off by `a + |D - d|`; with
/// the contact stiffness `k = -d<p>/dD` its load is off by `k (a + |D - d|)` to first order. Near touch `k` is `<p> / (h_max - D)`
/// and near closure, where the gap falls exponentially with the load, it is about `<p> / D`, each times a factor of order one. So
/// [`Certificate::eta_gap`] is the relative error of the load in order of magnitude.
///
/// **The approach** takes the place of the mean gap where a uniform pressure displaces the surface: `D` is then the
/// highest peak less the approach, and `A` has the uniform pressure in it. Nothing else changes, since the proofs above
/// do not use `A` of a uniform pressure.
///
/// # Below a hardness
/// A [`crate::contact::Law`] may ask for `p <= H_c` as well. Then the lowest `<q v>` of all `q` that carry the load is that of a
/// fractional knapsack: `H_c` on the nodes of lowest `v`, one after the other, until the load is carried. With the value `lambda` of
/// `v` at the node that is filled last, `G = <p v>` less that is
///
/// ```text
/// G = <p max(v - lambda, 0)> + <(H_c - p) max(lambda - v, 0)>
/// ```
///
/// a sum of positive terms. It is no less than the true one for any other `lambda`, since `<(p - q)(v - lambda)>` is no
/// larger than it for every `q` between 0 and `H_c` with the same load: so rounding of `lambda` does no harm. The
/// variational inequality `<(p - p*) v*> >= 0` holds among the pressures below `H_c`, and with it `|p - p*|^2 <= G` and
/// all statements about the pressure. At a mean gap `D` the same sum with `lambda = -D` bounds `F(p) - F*`, and `<(p -
/// p*) (v + D)>`, for `q` of any load.
///
/// Where no node of `p` yields, the bounds of the hard wall hold as well, as more pressures are allowed there, and are used; at a mean
/// gap the smaller of both.
///
/// Where each node has a [`Ceiling`](crate::contact::Ceiling) of its own, `H_c` is that of the node in all of this, and the
/// knapsack is filled until the ceilings of its nodes carry the load.
///
/// **The datum.** Nodes that yield lie below zero, so `<p g> = 0` does not find it. Let `m = min(p, H_c - p)`, the room of the
/// pressure. At the solution nodes with room lie at zero, and `d = -<m v>/<m>`; where `p <= H_c/2` everywhere that is `<p g> = 0`.
/// Both `p + m` and `p - m` are allowed, so with `<(p +- m - p*) (v* + D*)> >= 0`
///
/// ```text
/// |D* - d| <m> <= G + |m| t - t^2,    t <= sqrt(G)
/// ```
///
/// with `|m|^2 <= <m^2> / k_min` for the softest stiffness. If no node has room, the whole contact yields. The datum of
/// the solution may then be anywhere between the highest node that yields and the lowest open node. The middle is used
/// (or the highest node, if all nodes yield), and the bound is infinite.
///
/// **The mean gap** below a hardness is `<max(g, 0)>`. It errs by no more than the datum and the mean of `abs(u - u*)`, which is at most
/// `t / sqrt(k_min)`. At a given datum only the last one is left.
///
/// **At the hardness** nothing else is allowed. Two pressures of the same mean below `H_c` obey `<abs(p - p*)> <= 2 <H_c - p>`, since what
/// one has more than the other, the other has left. Where less than half of `H_c` is left in all, `n <H_c - p> <= H_c / 2`, no node is open.
/// Then the mean gap is zero, and so is that of `p`, since the datum is taken at the highest node. And `2 <H_c - p> / <p>` bounds the relative error of the
/// pressure in the mean of its magnitude, which is used where it is smaller: a nearly uniform pressure has no length in the norm above.
/// Where `<p> = H_c` all of this is zero: the pressure is the hardness everywhere.
///
/// # Of a contact that moves
/// Where the surface slides steadily over a viscoelastic solid (see [`Problem::sliding`]), `A` is not symmetric, and no energy belongs
/// to it. The variational inequality `<(p - p*) v*> >= 0` holds all the same, and with it
///
/// ```text
/// <(p - p*) A (p - p*)> = <(p - p*) (v - v*)> <= <(p - p*) v> <= G
/// ```
///
/// The left side is that of the symmetric part of `A` alone, and so is `<p u> = <p A p>`. So `|x|^2 = <x A x>` is still the square of a
/// norm, and `pressure_error_bound` a bound. Only `eta` is no longer the bound of an energy: it is the largest penetration over the rms
/// height, or `G` over load times rms height.
///
/// The bound of the mean gap does not hold. It rests on `<p v*> - <p v> = <p A (p* - p)> = <u (p* - p)>`, which takes `A` to be
/// symmetric, and then on the inequality of Cauchy and Schwarz in its norm; the skew part of `A` has no bound in this norm. So
/// `mean_gap_error_bound` is infinite.
///
/// # Rounding
/// The computed `v` is off by `delta`, which [`Certificate::from_displacement`] bounds by magnitudes that it meets. As
/// `<(p - p*) v> <= G + |delta|* t` with the dual norm `|delta|*^2 = <delta A^-1 delta>`,
///
/// ```text
/// f(p) - f* <= <(p - p*) v> - t^2 / 2 <= G + |delta|*^2 / 2,    t <= |delta|* / 2 + sqrt(|delta|*^2 / 4 + G)
/// ```
///
/// The error of the energy is of second order in the rounding: about 1e-22 of the load times the rms height, where `G`
/// itself may err by 1e-15. At a mean gap the load is free, and the mean of `delta` counts as an error of `D`. All
/// bounds here have these terms in them. `penetration` and `load_error` are measured values, not bounds.
///
/// All fields are dimensionless. Where there is no pressure at all, and where a value is negative, above the hardness
/// or not finite, nothing is bounded: the errors are infinite. The documentation of the crate has an example that
/// certifies the pressure of another code.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Certificate {
    /// `eta = G / (<p> h_rms)`, the energy error divided by load times rms height. [`crate::contact::Stop`] uses it as
    /// the goal. At a mean gap `eta = (a + |D - d|) / h_rms`, the same with the larger of `<p>` and `<p*>`.
    pub eta: f64,
    /// `eta_D = (a + |D - d|) / min(D, h_max - D)`, with the highest peak `h_max` above the mean height: at a mean gap
    /// `D` the relative error of the load in order of magnitude. At a given approach `h_max - D`, it is divided by the
    /// approach. Under a mean pressure it is 0.
    pub eta_gap: f64,
    /// `sqrt(G / <p u(p)>)`: a bound of the relative error of the pressure in the norm `|x|^2 = <x u(x)>`. At small
    /// loads `eta` can be small for a poor pressure, since `h_rms` is then large compared with the relevant heights;
    /// use this bound there. At a mean gap `G = <p> (a + |D - d|)`, which takes `<p>` for the larger of `<p>` and
    /// `<p*>`. Infinite where `<p u(p)>` is not positive: a pressure that does not deform the solid, such as a uniform
    /// one, gives no bound. At a mean pressure as large as the hardness it is `2 <H_c - p> / <p>`, and so 0.
    pub pressure_error_bound: f64,
    /// The bound of `|D* - d| / h_rms`, the error of the datum under a given mean pressure, which is the mean gap on a
    /// periodic grid and the approach on a free one. At a given mean gap it is 0. At a given approach it is that of the mean gap, which is the mean
    /// displacement there: `t / sqrt(k_min)` for the softest stiffness. Where nodes yield it is that of the mean gap, in all cases. Of a contact that moves it is infinite:
    /// nothing bounds the error.
    pub mean_gap_error_bound: f64,
    /// The relative error of the prescribed load: `|<p> / mean_pressure - 1|`, or `|D - d| / h_rms` at a mean gap.
    pub load_error: f64,
    /// Smallest pressure over the mean pressure; never negative in a result.
    pub min_pressure: f64,
    /// The excess of the largest pressure above the hardness, divided by the hardness; 0 in a result, and for a hard
    /// wall.
    #[serde(skip_serializing_if = "is_zero")]
    pub above_hardness: f64,
    /// Largest penetration (negative gap) over `h_rms`, without nodes that yield. With the datum of the gap where `<p
    /// g> = 0`, as under a mean pressure, the deepest node lies `a` below zero, so this **is** `eta`, except for
    /// rounding. At a mean gap the datum is `D`, and it is at most `eta`.
    pub penetration: f64,
    /// The most that rounding of the displacement can add to `eta`, approximately. No solver reaches a certificate far
    /// below it.
    pub rounding: f64,
}

impl Certificate {
    /// The certificate of no pressure, or of one that is infeasible.
    const NONE: Self = Self {
        eta: f64::INFINITY,
        eta_gap: f64::INFINITY,
        pressure_error_bound: f64::INFINITY,
        mean_gap_error_bound: f64::INFINITY,
        load_error: f64::INFINITY,
        min_pressure: 0.0,
        above_hardness: 0.0,
        penetration: f64::INFINITY,
        rounding: f64::INFINITY,
    };

    /// The value for a state without a certificate.
    pub(crate) const UNKNOWN: Self = Self {
        eta: f64::NAN,
        eta_gap: f64::NAN,
        pressure_error_bound: f64::NAN,
        mean_gap_error_bound: f64::NAN,
        load_error: f64::NAN,
        min_pressure: f64::NAN,
        above_hardness: f64::NAN,
        penetration: f64::NAN,
        rounding: f64::NAN,
    };

    /// The certificate of `pressure`, row by row. It needs one transform pair.
    ///
    /// # Panics
    /// If the length of `pressure` does not fit the grid.
    pub fn new(problem: &Problem, pressure: &[f64]) -> Self {
        let mut displacement = vec![0.0; pressure.len()];
        problem.response().displacement(pressure, &mut displacement);
        Self::from_displacement(problem, pressure, &displacement)
    }

    /// The certificate of `pressure`, whose displacement `u(pressure)` with zero mean is known from a transform pair,
    /// both row by row.
    pub fn from_displacement(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> Self {
        let sums = CertificateSums::new(problem, pressure, displacement);
        if problem.ceiling().is_finite() {
            return Self::below_ceiling(problem, &sums, &Slack::new(problem, pressure, displacement));
        }
        Self::from_sums(problem, &sums)
    }

    /// The certificate of the state with these sums on a hard wall.
    pub(super) fn from_sums(problem: &Problem, sums: &CertificateSums) -> Self {
        Self::from_bounds(problem, sums, |mean_pressure| Bounds::new(problem, sums, mean_pressure))
    }

    /// The certificate of the state with these sums below a ceiling.
    fn below_ceiling(problem: &Problem, sums: &CertificateSums, slack: &Slack) -> Self {
        let above_hardness = Ceiling::excess(slack.highest_share);
        if above_hardness > 0.0 {
            return Self { above_hardness, ..Self::NONE };
        }
        Self::from_bounds(problem, sums, |mean_pressure| Bounds::below_ceiling(problem, sums, slack, mean_pressure))
    }

    /// The certificate of the state with these sums, by the bounds under its mean pressure.
    fn from_bounds(problem: &Problem, sums: &CertificateSums, bounds: impl FnOnce(f64) -> Bounds) -> Self {
        if !(sums.pressure > 0.0 && sums.pressure.is_finite()) {
            return Self::NONE;
        }
        let mean_pressure = sums.pressure / problem.nodes() as f64;
        let min_pressure = sums.lowest_pressure / mean_pressure;
        if min_pressure < 0.0 {
            return Self { min_pressure, ..Self::NONE };
        }
        let bounds = bounds(mean_pressure);
        let rms_height = problem.rms_height();
        let load_error = match problem.mean_pressure() {
            Some(prescribed) => (mean_pressure / prescribed - 1.0).abs(),
            None => bounds.missed.abs() / rms_height,
        };
        let (datum, eta) = (problem.datum(), bounds.excess() / rms_height);
        if !eta.is_finite() {
            return Self { min_pressure, ..Self::NONE };
        }
        Self {
            eta,
            eta_gap: datum.map_or(0.0, |datum| bounds.excess() / room(problem, datum)),
            pressure_error_bound: bounds.pressure_error(),
            mean_gap_error_bound: match datum {
                Some(_) if problem.mean_gap().is_some() => bounds.spread_error() / rms_height,
                Some(_) => bounds.displacement_error(problem) / rms_height,
                None if problem.is_moving() => f64::INFINITY,
                None => bounds.gap_error() / rms_height,
            },
            load_error,
            min_pressure,
            above_hardness: 0.0,
            penetration: bounds.deepest.max(0.0) / rms_height,
            rounding: (bounds.rounding.mean + bounds.rounding.depth) / rms_height,
        }
    }
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// The quantities of the proof of [`Certificate`], by their letters there.
struct Bounds {
    mean_pressure: f64,
    /// `a`: the depth of the lowest point of the gap below the datum where `<p g> = 0`, or `G / <p>`.
    depth: f64,
    /// `D - d`; 0 under a mean pressure, and where it is in `G`.
    above_gap: f64,
    /// `D - d` of the datum that the state says; 0 under a mean pressure.
    missed: f64,
    /// The depth of the lowest point of the gap that may take more pressure.
    deepest: f64,
    /// `<p u>`.
    elastic: f64,
    /// `<m>` and the bound of `|m|^2`.
    room: [f64; 2],
    is_at_gap: bool,
    /// The terms that nodes at the hardness add to the bound; none on a hard wall.
    yielding: Option<Yielding>,
    rounding: Rounding,
}

/// The terms that bound the error of a pressure of which some nodes are at their ceilings.
#[derive(Clone, Copy)]
struct Yielding {
    /// Where no node is open: the bound of the mean gap, a length, and `2 <H_c - p> / <p>`, which is infinite at a given mean gap.
    closed: Option<[f64; 2]>,
    /// The softest stiffness, where the gap is cut off at zero.
    softest: Option<f64>,
}

impl Bounds {
    fn new(problem: &Problem, sums: &CertificateSums, mean_pressure: f64) -> Self {
        let (mean_v, gap) = (sums.pressure_v / sums.pressure, problem.datum());
        let depth = (mean_v - sums.lowest_v).max(0.0);
        let above_gap = gap.map_or(0.0, |gap| mean_v + (sums.reference_v + gap));
        let elastic = sums.elastic / problem.nodes() as f64;
        Self {
            mean_pressure,
            depth,
            above_gap,
            missed: above_gap,
            deepest: depth - above_gap,
            elastic,
            room: [mean_pressure, elastic],
            is_at_gap: gap.is_some(),
            yielding: None,
            rounding: Rounding::new(problem, sums),
        }
    }

    /// The bounds below a ceiling; those of a hard wall hold as well, except for the datum of the gap.
    fn below_ceiling(problem: &Problem, sums: &CertificateSums, slack: &Slack, mean_pressure: f64) -> Self {
        let wall = Self::new(problem, sums, mean_pressure);
        if 2.0 * slack.highest_share <= 1.0 {
            return wall;
        }
        let [softest, _] = problem.compliance().stiffness_range();
        let datum = problem.datum().unwrap_or(-slack.level);
        let own = Self {
            missed: datum + slack.level,
            deepest: -(slack.lowest_v + datum),
            room: [slack.room, slack.square_room / softest],
            yielding: Some(Yielding::new(problem, slack, mean_pressure)),
            ..wall
        };
        let depth = slack.gain / mean_pressure;
        if Ceiling::is_reached(slack.highest_share) && depth < own.depth + own.above_gap.abs() {
            let rounding = own.rounding.with_depth(depth);
            return Self { depth, above_gap: 0.0, rounding, ..own };
        }
        own
    }

    /// `a + |D - d|` with the rounding of its parts, but not of the transforms.
    fn distance(&self) -> f64 {
        let Self { depth, above_gap, rounding, .. } = self;
        depth + above_gap.abs() + rounding.depth + if self.is_at_gap { rounding.mean } else { 0.0 }
    }

    /// `eta h_rms`: the bound of the error in energy over the load.
    fn excess(&self) -> f64 {
        self.distance() + 0.5 * self.rounding.energy / self.mean_pressure
    }

    /// The bound of `|p - p*|`.
    fn error(&self) -> f64 {
        length(self.rounding.energy, self.mean_pressure * self.distance())
    }

    /// The bound of `|p - p*| / |p|`.
    fn pressure_error(&self) -> f64 {
        let Self { mean_pressure, elastic, rounding, .. } = self;
        let least = elastic - mean_pressure * rounding.mean - rounding.elastic;
        let least = (0.25 * rounding.energy + least).sqrt() - 0.5 * rounding.energy.sqrt();
        let bound = if least > 0.0 { self.error() / least } else { f64::INFINITY };
        self.yielding.and_then(|it| it.closed).map_or(bound, |[_, saturation]| bound.min(saturation))
    }

    /// The bound of the mean of `abs(u - u*)`, by which a gap that is cut off at zero errs.
    fn spread_error(&self) -> f64 {
        let softest = self.yielding.and_then(|it| it.softest);
        softest.map_or(0.0, |softest| self.error() / softest.sqrt())
    }

    /// The bound of the mean of `abs(u - u*)`, `t / sqrt(k_min)`: at a given approach the mean gap errs by the mean displacement.
    fn displacement_error(&self, problem: &Problem) -> f64 {
        let [softest, _] = problem.compliance().stiffness_range();
        self.error() / softest.sqrt()
    }

    /// The bound of `|D* - d|`, or of the error of the mean gap where nodes yield.
    fn gap_error(&self) -> f64 {
        let Self { mean_pressure, room: [room, square], rounding, .. } = self;
        if let Some([mean_gap, _]) = self.yielding.and_then(|it| it.closed) {
            return mean_gap;
        }
        if *room == 0.0 {
            return f64::INFINITY;
        }
        let most = length(rounding.energy, square.max(0.0) + room * rounding.mean + rounding.elastic);
        let (error, slope) = (self.error(), most + rounding.energy.sqrt());
        let t = error.min(0.5 * slope);
        let [below, above] = [most * error, mean_pressure * self.distance() + (slope - t) * t];
        (below.max(above) + rounding.energy.sqrt() * most) / room + rounding.mean + self.spread_error()
    }
}

impl Yielding {
    fn new(problem: &Problem, slack: &Slack, mean_pressure: f64) -> Self {
        let (hardness, n) = (problem.law().hardness(), problem.nodes() as f64);
        let closed = hardness.filter(|hardness| n * slack.left <= 0.5 * hardness).map(|_| {
            let saturation = 2.0 * slack.left / mean_pressure;
            let is_at_datum = problem.datum().is_some();
            [0.0, if is_at_datum { f64::INFINITY } else { saturation }]
        });
        let [softest, _] = problem.compliance().stiffness_range();
        let softest = hardness.filter(|_| Ceiling::is_reached(slack.highest_share)).map(|_| softest);
        Self { closed, softest }
    }
}

/// The largest `t` with `t^2 <= square + t |delta|*`.
fn length(rounding: f64, square: f64) -> f64 {
    0.5 * rounding.sqrt() + (0.25 * rounding + square).sqrt()
}

/// The range of a prescribed datum: `min(D, h_max - D)` of a mean gap `D`, beyond which everything touches, or nothing;
/// the approach, beyond which nothing does.
fn room(problem: &Problem, datum: f64) -> f64 {
    let above_mean = datum + problem.shift() - problem.mean_height();
    let left = problem.highest() - above_mean;
    if problem.mean_gap().is_some() { above_mean.min(left) } else { left }
}

/// The datum `d` of the gap `g = u - h + d`: the prescribed one, or else minus the mean of `u - h` weighted by the
/// pressure, so that `<p g> = 0`, or below a hardness by the room of the pressure, see [`level`].
pub(super) fn datum(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> f64 {
    problem.datum().unwrap_or_else(|| -level(problem, pressure, displacement))
}
