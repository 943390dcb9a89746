//! Tractions within discs: the nearest ones with a given sum, and how far they are from Coulomb's law.

/// A vector in the plane of the surface, along `x` and `y`.
pub(super) type Pair = [f64; 2];

/// Newton steps for the shift that gives a sum, and trials of the length of each.
const CARRY_STEPS: usize = 200;
const TRIALS: usize = 100;

/// A step counts if it leaves at most this part of the slope along it, or of the whole slope.
const LEFT: f64 = 0.5;

/// Newton steps for the best shift of a certificate.
const SHIFT_STEPS: usize = 12;

/// Relative distance from the rim of its disc from which a node counts as inside.
const INSIDE: f64 = 1e-9;

/// Part of the trace that keeps a Hessian of two unknowns regular.
const RIDGE: f64 = 1e-14;

/// Relative error of a sum that counts as rounding.
const ROUNDING: f64 = 4e-16;

pub(super) fn dot(a: Pair, b: Pair) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn add(a: Pair, factor: f64, b: Pair) -> Pair {
    [a[0] + factor * b[0], a[1] + factor * b[1]]
}

pub(super) fn scaled(a: Pair, factor: f64) -> Pair {
    [a[0] * factor, a[1] * factor]
}

pub(super) fn length(a: Pair) -> f64 {
    a[0].hypot(a[1])
}

/// The solution of a symmetric system `[xx, xy, yy]` of two equations.
pub(super) fn solve([xx, xy, yy]: [f64; 3], [a, b]: Pair) -> Pair {
    let ridge = RIDGE * (xx + yy);
    let (xx, yy) = (xx + ridge, yy + ridge);
    let determinant = xx * yy - xy * xy;
    [(yy * a - xy * b) / determinant, (xx * b - xy * a) / determinant]
}

/// The point of the unit disc that is nearest to another one.
fn nearest(z: Pair) -> Pair {
    let r = length(z);
    if r > 1.0 { scaled(z, r.recip()) } else { z }
}

/// The tractions of some nodes, each in a disc of its own radius, with a given sum.
pub(super) struct Discs {
    /// The radius `mu p` of each disc, a pressure.
    pub radii: Vec<f64>,
    /// The sum of the tractions.
    pub total: Pair,
}

impl Discs {
    pub(crate) fn len(&self) -> usize {
        self.radii.len()
    }

    /// Makes of `u`, tractions over the radii, the nearest tractions in the discs with the given sum, where the squares of distances are
    /// weighted by `1/radius`: they are `radius P(u + c)`, with the point `P` of the unit disc that is nearest.
    ///
    /// The shift `c` minimises the convex `sum radius H(u + c) - total c`, with `H(z) = z^2/2` in the disc and `|z| - 1/2` outside. Newton
    /// steps with a search along each of them for where the slope is small find it: unlike the value, the slope keeps its digits where `u`
    /// is large. What rounding leaves of the sum is taken up by [`Discs::balance`], and so the sum is right in any case.
    pub(crate) fn carry(&self, u: &mut [Pair]) {
        let mut shift = [0.0; 2];
        let (mut slope, mut hessian) = self.slope(u, shift);
        let limit = ROUNDING * self.radii.iter().sum::<f64>();
        for _ in 0..CARRY_STEPS {
            if length(slope) <= limit {
                break;
            }
            let step = solve(hessian, slope);
            let Some(part) = self.part(u, shift, step, slope) else { break };
            shift = add(shift, -part, step);
            (slope, hessian) = self.slope(u, shift);
        }
        u.iter_mut().zip(&self.radii).for_each(|(u, radius)| *u = scaled(nearest(add(*u, 1.0, shift)), *radius));
        self.balance(u);
    }

    /// The part of a step, to be taken away from a shift, that leaves little of the slope. Along the step the slope rises steadily, and so
    /// the part where it is zero lies between two that were tried, or beyond all of them.
    fn part(&self, u: &[Pair], shift: Pair, step: Pair, slope: Pair) -> Option<f64> {
        let whole = dot(step, slope);
        let (mut part, mut low, mut high) = (1.0, 0.0, f64::INFINITY);
        for _ in 0..TRIALS {
            let (rest, _) = self.slope(u, add(shift, -part, step));
            let along = dot(step, rest);
            if along.abs() <= LEFT * whole || length(rest) <= LEFT * length(slope) {
                return Some(part);
            }
            if along > 0.0 {
                low = part;
            } else {
                high = part;
            }
            part = if high.is_finite() { 0.5 * (low + high) } else { 4.0 * part };
        }
        None
    }

    /// The slope of the potential of a shift, and its Hessian.
    fn slope(&self, u: &[Pair], shift: Pair) -> (Pair, [f64; 3]) {
        let (mut slope, mut hessian) = (scaled(self.total, -1.0), [0.0; 3]);
        for (u, &radius) in u.iter().zip(&self.radii) {
            let z = add(*u, 1.0, shift);
            let r = length(z);
            if r <= 1.0 {
                slope = add(slope, radius, z);
                hessian = [hessian[0] + radius, hessian[1], hessian[2] + radius];
            } else {
                let (e, stiffness) = (scaled(z, r.recip()), radius / r);
                slope = add(slope, radius, e);
                hessian[0] += stiffness * e[1] * e[1];
                hessian[1] -= stiffness * e[0] * e[1];
                hessian[2] += stiffness * e[0] * e[0];
            }
        }
        (slope, hessian)
    }

    /// Gives tractions in the discs the given sum `T`: with their sum `S`, `(1 - a) tau + a radius q` lies in the discs for `|q| <= 1`, and has
    /// the sum `T` if `q sum(radius) = S + (T - S)/a`. The least `a` makes `|q| = 1`. It is at most 1, since `|T| <= sum(radius)`.
    fn balance(&self, tau: &mut [Pair]) {
        let all: f64 = self.radii.iter().sum();
        let sum = tau.iter().fold([0.0; 2], |sum, tau| add(sum, 1.0, *tau));
        let missed = add(self.total, -1.0, sum);
        if length(missed) <= 4.0 * ROUNDING * all {
            return;
        }
        let (square, along, room) = (dot(missed, missed), dot(sum, missed), (all * all - dot(sum, sum)).max(0.0));
        let root = (along * along + square * room).sqrt();
        let inverse = if along > 0.0 { room / (along + root) } else { (root - along) / square };
        let part = inverse.max(1.0).recip();
        let q = nearest(scaled(add(sum, part.recip(), missed), all.recip()));
        tau.iter_mut()
            .zip(&self.radii)
            .for_each(|(tau, radius)| *tau = add(scaled(*tau, 1.0 - part), part * radius, q));
    }

    /// The sum over the nodes of `tau (w - l) + radius |w - l|` with a shift `l`: never negative, and zero where Coulomb's law holds.
    pub(crate) fn missed(&self, tau: &[Pair], w: &[Pair], shift: Pair) -> f64 {
        let terms = tau.iter().zip(w).zip(&self.radii);
        terms.fold(0.0, |sum, ((tau, w), radius)| {
            let slip = add(*w, -1.0, shift);
            sum + (dot(*tau, slip) + radius * length(slip)).max(0.0)
        })
    }

    /// A shift that lowers [`Discs::missed`] as far as some Newton steps do, with the value.
    ///
    /// The first shift is the best of three: the one that is given, the mean of `w` over the nodes inside their discs, and the one that
    /// leaves the least slip where nodes are inside and across the traction where they are at the rim. Newton steps minimise the sum with
    /// `sqrt(|w - l|^2 + spread^2)` for `|w - l|`, where `spread` is the distance that nodes inside have from the mean.
    pub(crate) fn best_shift(&self, tau: &[Pair], w: &[Pair], first: Pair) -> (Pair, f64) {
        let mut best = (first, self.missed(tau, w, first));
        let mut spread = 0.0;
        let (mut weight, mut mean, mut sums, mut across) = (0.0, [0.0; 2], [0.0; 3], [0.0; 2]);
        for ((tau, w), &radius) in tau.iter().zip(w).zip(&self.radii) {
            let size = length(*tau);
            if size < radius * (1.0 - INSIDE) {
                weight += radius;
                mean = add(mean, radius, *w);
                sums = [sums[0] + 1.0, sums[1], sums[2] + 1.0];
                across = add(across, 1.0, *w);
            } else {
                let [a, b] = [-tau[1] / size, tau[0] / size];
                sums = [sums[0] + a * a, sums[1] + a * b, sums[2] + b * b];
                across = add(across, dot([a, b], *w), [a, b]);
            }
        }
        let mut firsts = vec![solve(sums, across)];
        if weight > 0.0 {
            let mean = scaled(mean, weight.recip());
            let squares = tau.iter().zip(w).zip(&self.radii).filter(|((t, _), r)| length(**t) < **r * (1.0 - INSIDE));
            let squares: f64 = squares.map(|((_, w), radius)| radius * length(add(*w, -1.0, mean)).powi(2)).sum();
            spread = (squares / weight).sqrt();
            firsts.push(mean);
        }
        for shift in firsts.into_iter().filter(|shift| shift[0].is_finite() && shift[1].is_finite()) {
            let value = self.missed(tau, w, shift);
            if value < best.1 {
                best = (shift, value);
            }
        }
        for _ in 0..SHIFT_STEPS {
            let step = self.shift_step(w, best.0, spread);
            let trial = |part: f64| {
                let shift = add(best.0, -part, step);
                (shift, self.missed(tau, w, shift))
            };
            let better = [1.0, 0.3, 0.1, 0.01].into_iter().map(trial).find(|(_, value)| *value < 0.999 * best.1);
            let Some(better) = better else { break };
            best = better;
        }
        best
    }

    /// The Newton step of a shift, to be taken away.
    fn shift_step(&self, w: &[Pair], shift: Pair, spread: f64) -> Pair {
        let (mut slope, mut hessian) = (scaled(self.total, -1.0), [0.0; 3]);
        for (w, radius) in w.iter().zip(&self.radii) {
            let slip = add(*w, -1.0, shift);
            let r = length(slip).hypot(spread);
            if r > 0.0 {
                let (e, stiffness) = (scaled(slip, r.recip()), radius / r);
                slope = add(slope, -radius, e);
                hessian[0] += stiffness * (1.0 - e[0] * e[0]);
                hessian[1] -= stiffness * e[0] * e[1];
                hessian[2] += stiffness * (1.0 - e[1] * e[1]);
            }
        }
        if hessian[0] + hessian[2] > 0.0 { solve(hessian, slope) } else { [0.0; 2] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn discs() -> (Discs, Vec<Pair>) {
        let radii: Vec<f64> = (0..50).map(|i| 0.1 + f64::from(i * i % 17)).collect();
        let u = (0..50).map(|i| [f64::from(i * 7 % 11) - 5.0, 0.3 * f64::from(i * 5 % 13) - 2.0]).collect();
        (Discs { radii, total: [150.0, -40.0] }, u)
    }

    #[test]
    fn tractions_are_carried_within_their_discs() {
        let (mut discs, u) = discs();
        let most: f64 = discs.radii.iter().sum();
        for share in [0.0, 0.3, 0.9, 0.999, 0.999_999] {
            discs.total = [0.8 * share * most, -0.6 * share * most];
            let mut tau = u.clone();
            discs.carry(&mut tau);
            let sum = tau.iter().fold([0.0; 2], |sum, tau| add(sum, 1.0, *tau));
            assert!(length(add(sum, -1.0, discs.total)) < 1e-12 * most, "{share}: {sum:?}");
            assert!(tau.iter().zip(&discs.radii).all(|(tau, radius)| length(*tau) <= radius * (1.0 + 1e-15)));
        }
    }

    /// Tractions may lie far outside of their discs, as where the pressure has fallen.
    #[test]
    fn tractions_far_outside_are_carried_to_their_sum() {
        let mut state = 7u64;
        let mut random = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        for case in 0..2000 {
            let count = 1 + case % 40;
            let radii: Vec<f64> = (0..count).map(|_| 10f64.powf(-6.0 * random())).collect();
            let most: f64 = radii.iter().sum();
            let (share, far) = (0.9999 * random(), 12.0 * random());
            let mut tau: Vec<Pair> = (0..count).map(|_| [random() - 0.5, random() - 0.3]).collect();
            tau.iter_mut().for_each(|u| *u = scaled(*u, 10f64.powf(far * random())));
            let discs = Discs { radii, total: [-0.6 * share * most, 0.8 * share * most] };
            discs.carry(&mut tau);
            let sum = tau.iter().fold([0.0; 2], |sum, tau| add(sum, 1.0, *tau));
            assert!(length(add(sum, -1.0, discs.total)) < 1e-14 * most, "{case}: {sum:?} for {:?}", discs.total);
            assert!(tau.iter().zip(&discs.radii).all(|(tau, radius)| length(*tau) <= radius * (1.0 + 1e-15)), "{case}");
        }
    }

    /// The nearest tractions do not move when they are carried again, and no exchange between two nodes is nearer.
    #[test]
    fn carried_tractions_are_nearest() {
        let (discs, u) = discs();
        let mut tau = u.clone();
        discs.carry(&mut tau);
        let over = |tau: &[Pair]| tau.iter().zip(&discs.radii).map(|(t, r)| scaled(*t, r.recip())).collect::<Vec<_>>();
        let mut again = over(&tau);
        discs.carry(&mut again);
        assert!(tau.iter().zip(&again).all(|(a, b)| length(add(*a, -1.0, *b)) < 1e-11));
        let distance = |v: &[Pair]| -> f64 {
            over(v).iter().zip(&u).zip(&discs.radii).map(|((v, u), r)| r * length(add(*v, -1.0, *u)).powi(2)).sum()
        };
        for (i, j) in [(1, 2), (5, 30), (17, 44), (8, 9)] {
            for change in [[1e-4, 0.0], [0.0, 1e-4], [-1e-4, 1e-4]] {
                let mut other = tau.clone();
                (other[i], other[j]) = (add(tau[i], 1.0, change), add(tau[j], -1.0, change));
                let fits = |k: usize| length(other[k]) <= discs.radii[k];
                assert!(!(fits(i) && fits(j)) || distance(&other) >= distance(&tau), "{i} {j} {change:?}");
            }
        }
    }
}
