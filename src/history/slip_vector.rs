//! The traction of one step with friction on a surface, along both axes.

use super::discs::{Discs, Pair, add, dot, length, scaled, solve};
use crate::contact::{Observer, Status, Stop, goes_on};
use crate::elastic::ShearResponse;

/// Most inner iterations for one exchange of sets.
const INNER: usize = 400;

/// Outer steps without progress of the certificate after which a solve has stalled, and what counts as progress.
const PATIENCE: usize = 60;
const PROGRESS: f64 = 0.9;

/// Part of the fall that the slope promises, from which a step counts.
const ENOUGH: f64 = 1e-4;

/// Bounds of the factor by which inner iterations reduce the residual.
const REDUCTION: [f64; 2] = [1e-6, 0.1];

/// The part of the tolerance that inner iterations aim at.
const SURPLUS: f64 = 0.1;

/// Relative distance from the rim of its disc up to which a node may slip. Steps along a chord take nodes off the rim.
const RIM: f64 = 1e-3;

/// Bounds of the pace of gradient steps, over the inverse of the length of `eta`.
const PACES: [f64; 2] = [1e-4, 1e4];

/// Rounding of the energy, over the sum of `mu p |s|`: a traction at the rim of its disc is there except for rounding.
const NOISE: f64 = 2e-15;

/// What a vector step solves: `min 1/2 <tau A tau> - <tau A tau_0>` over tractions in discs of given radii, with a given sum.
///
/// The gradient is `w = A tau - A tau_0`, and the slip is `s = w - l` with the shift `l`, the multiplier of the sum.
pub(super) struct VectorStep<'a> {
    pub response: &'a mut ShearResponse,
    /// The nodes in contact.
    pub places: Vec<usize>,
    pub discs: Discs,
    /// `A tau_0` at the nodes in contact.
    pub before: Vec<Pair>,
    /// The length `l` of `eta`, see [`crate::history::SlipCertificate`].
    pub length: f64,
    /// Whether steps are along projected gradients only, as the safeguard takes them.
    pub gradient_only: bool,
    fields: [Vec<f64>; 2],
    displaced: [Vec<f64>; 2],
}

/// A traction in its discs, with its displacement.
#[derive(Clone)]
struct SlipIterate {
    tau: Vec<Pair>,
    w: Vec<Pair>,
}

/// What a vector step found.
pub(super) struct VectorFound {
    pub tau: Vec<Pair>,
    pub shift: Pair,
    pub status: Status,
    pub iterations: usize,
}

/// The directions in which the tractions of nodes are free: all of them where a node sticks, along the rim of its disc where it slips.
struct Free {
    /// The direction along the rim, or none where a node sticks.
    along: Vec<Option<Pair>>,
    /// `|s|/(mu p)` where a node slips, a length per pressure; else zero.
    added: Vec<f64>,
    /// Weights of the preconditioner.
    weights: Vec<f64>,
    /// The sum of the projections, `[xx, xy, yy]`.
    sums: [f64; 3],
}

impl Free {
    fn project(&self, vectors: &mut [Pair]) {
        for (vector, along) in vectors.iter_mut().zip(&self.along) {
            if let Some(along) = along {
                *vector = scaled(*along, dot(*along, *vector));
            }
        }
    }

    /// Projects to the free directions with the sum zero. The gradients of both sums are the projections of uniform vectors, and so
    /// the multipliers solve two equations with the sum of the projections. Means over the free directions would not do.
    fn balance(&self, vectors: &mut [Pair]) {
        self.project(vectors);
        let sum = vectors.iter().fold([0.0; 2], |sum, vector| add(sum, 1.0, *vector));
        let shift = solve(self.sums, sum);
        for (vector, along) in vectors.iter_mut().zip(&self.along) {
            let part = along.map_or(shift, |along| scaled(along, dot(along, shift)));
            *vector = add(*vector, -1.0, part);
        }
    }
}

impl<'a> VectorStep<'a> {
    pub(crate) fn new(
        response: &'a mut ShearResponse,
        places: Vec<usize>,
        discs: Discs,
        before: Vec<Pair>,
        length: f64,
    ) -> Self {
        let zeros = || vec![0.0; response.compliance().grid().len()];
        let (fields, displaced) = ([zeros(), zeros()], [zeros(), zeros()]);
        Self { response, places, discs, before, length, gradient_only: false, fields, displaced }
    }

    /// Solves from a traction, which need not lie in its discs.
    ///
    /// An outer step exchanges the sets of nodes that stick and slip as a whole, takes a Newton step for them, and carries the result
    /// back into the discs. It counts if the energy `f` falls. Else, and where the certificate `G` does not fall by a tenth, the next step is
    /// along the projected gradient, with the least energy on the chord if the energy does not fall along all of it. Where rounding hides
    /// whether the energy falls, steps count, and the traction with the best certificate is kept.
    ///
    /// # Convergence
    /// No step raises `f`, and [`Discs::carry`] keeps all tractions in the discs and their sum as given. Let `|x|^2 = sum x^2/radius`, and `d`
    /// the change to the nearest point of `tau - a radius w`, so that `(a w + d/radius) (s - tau - d) >= 0` for any allowed `s`. With `s = tau` it
    /// says `w d <= -|d|^2/a`. If `d A d <= L |d|^2`, a gradient step lowers `f` by a fixed part of `|d|^2/a` times the lower of 1 and `1/(a L)`. As `f`
    /// is bounded below and `a` has bounds, `d` vanishes if gradient steps never end. By duality the least `G` of all shifts is
    /// `max w (tau - s) <= |w d| + |d| max|s - tau - d|/a`, and vanishes with `d`. If they end, `G` falls by a tenth in each further step. So `G`
    /// reaches any tolerance above rounding. A solve has stalled if the best `G` does not fall by a tenth in many steps.
    pub(crate) fn solve(&mut self, start: &[Pair], stop: &Stop, observer: &mut dyn Observer) -> VectorFound {
        let mut tau: Vec<Pair> = start.iter().zip(&self.discs.radii).map(|(t, r)| scaled(*t, r.recip())).collect();
        self.discs.carry(&mut tau);
        let mut at = SlipIterate { w: self.gradient(&tau), tau };
        let scale = self.discs.radii.iter().sum::<f64>() * self.length;
        let (mut shift, mut missed) = self.discs.best_shift(&at.tau, &at.w, [0.0; 2]);
        let mut best = (at.tau.clone(), shift, missed);
        let (mut iterations, mut patience) = (0, 0);
        let (mut pace, mut is_guarded) = (self.length.recip(), self.gradient_only);
        let status = loop {
            if missed <= stop.tolerance() * scale {
                break Status::Converged;
            }
            if iterations >= stop.max_iterations() {
                break Status::IterationCap;
            }
            if !goes_on(observer) {
                break Status::StoppedByObserver;
            }
            if patience > if self.gradient_only { 100 * PATIENCE } else { PATIENCE } {
                break Status::Stalled;
            }
            let last = missed;
            if is_guarded {
                iterations += 1;
                pace *= self.gradient_step(&mut at, shift, pace);
                pace = pace.clamp(PACES[0] / self.length, PACES[1] / self.length);
                is_guarded = self.gradient_only;
                (shift, missed) = self.discs.best_shift(&at.tau, &at.w, shift);
            } else {
                let eta = missed / scale;
                // Newton's method squares the error; what is beyond the tolerance is not needed
                let reduction = eta.sqrt().max(SURPLUS * stop.tolerance() / eta).clamp(REDUCTION[0], REDUCTION[1]);
                iterations += self.exchange(&mut at, shift, reduction, &mut is_guarded);
                (shift, missed) = self.discs.best_shift(&at.tau, &at.w, shift);
                is_guarded |= missed > PROGRESS * last;
            }
            if missed < PROGRESS * best.2 {
                patience = 0;
            } else {
                patience += 1;
            }
            if missed < best.2 {
                best = (at.tau.clone(), shift, missed);
            }
        };
        let (tau, shift, _) = best;
        VectorFound { tau, shift, status, iterations }
    }

    /// `A tau` at the nodes in contact.
    fn displacement(&mut self, tau: &[Pair]) -> Vec<Pair> {
        self.scatter(tau);
        let [x, y] = &mut self.displaced;
        self.response.displacement([&self.fields[0], &self.fields[1]], [x, y]);
        self.places.iter().map(|&i| [x[i], y[i]]).collect()
    }

    fn gradient(&mut self, tau: &[Pair]) -> Vec<Pair> {
        let mut w = self.displacement(tau);
        w.iter_mut().zip(&self.before).for_each(|(w, before)| *w = add(*w, -1.0, *before));
        w
    }

    /// Writes values to the nodes in contact; others are zero at all times.
    fn scatter(&mut self, values: &[Pair]) {
        for (&i, value) in self.places.iter().zip(values) {
            (self.fields[0][i], self.fields[1][i]) = (value[0], value[1]);
        }
    }

    /// The preconditioner: the stiffness of the waves between the weights of the nodes.
    fn precondition(&mut self, free: &Free, residual: &[Pair]) -> Vec<Pair> {
        self.displaced.iter_mut().for_each(|field| field.fill(0.0));
        for ((&i, value), weight) in self.places.iter().zip(residual).zip(&free.weights) {
            (self.displaced[0][i], self.displaced[1][i]) = (weight * value[0], weight * value[1]);
        }
        let [x, y] = &mut self.displaced;
        self.response.traction([x, y]);
        let at = self.places.iter().zip(&free.weights);
        let mut result: Vec<Pair> = at.map(|(&i, weight)| [weight * x[i], weight * y[i]]).collect();
        free.balance(&mut result);
        result
    }

    /// The sets of an iterate: a node slips if it lies near the rim of its disc and its slip is against its traction.
    fn sets(&self, at: &SlipIterate, shift: Pair) -> Free {
        let stiffness = self.response.compliance().mean_stiffness();
        let count = self.discs.len();
        let (mut along, mut added) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut sums = [0.0; 3];
        for ((tau, w), &radius) in at.tau.iter().zip(&at.w).zip(&self.discs.radii) {
            let (e, slip) = (scaled(*tau, radius.recip()), add(*w, -1.0, shift));
            let (size, outwards) = (length(e), -dot(e, slip));
            // the second condition is that `tau/(mu p) - s/length` is outside of the unit disc, if the slip is along the traction
            let slips = size >= 1.0 - RIM && outwards > (1.0 - size).max(0.0) * self.length;
            let rim = scaled([-e[1], e[0]], size.recip());
            let [a, b] = rim;
            let part = if slips { [a * a, a * b, b * b] } else { [1.0, 0.0, 1.0] };
            sums.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
            along.push(slips.then_some(rim));
            added.push(if slips { outwards / radius } else { 0.0 });
        }
        let weights = added.iter().map(|added| (1.0 + added * stiffness).sqrt().recip()).collect();
        Free { along, added, weights, sums }
    }

    /// The Newton step of the sets by conjugate gradients, to a reduction of the residual, and the number of iterations.
    ///
    /// On the free directions with the sum zero, `A` is projected, and `|s|/(mu p)` is added where the traction turns along the rim.
    fn newton(&mut self, at: &SlipIterate, free: &Free, reduction: f64) -> (Vec<Pair>, usize) {
        let mut residual: Vec<Pair> = at.w.iter().map(|w| scaled(*w, -1.0)).collect();
        free.balance(&mut residual);
        let mut step = vec![[0.0; 2]; residual.len()];
        let mut direction: Vec<Pair> = Vec::new();
        let (mut before, mut first) = (0.0, 0.0);
        for iteration in 0..INNER {
            let better = self.precondition(free, &residual);
            let square: f64 = residual.iter().zip(&better).map(|(r, z)| dot(*r, *z)).sum();
            if iteration == 0 {
                (first, direction) = (square, better);
            } else {
                let factor = square / before;
                direction.iter_mut().zip(&better).for_each(|(d, z)| *d = add(*z, factor, *d));
            }
            if square <= (reduction * reduction * first).max(0.0) || !square.is_finite() {
                return (step, iteration);
            }
            let mut image = self.displacement(&direction);
            let added = image.iter_mut().zip(&direction).zip(&free.added);
            added.for_each(|((image, d), added)| *image = add(*image, *added, *d));
            free.balance(&mut image);
            let curvature: f64 = direction.iter().zip(&image).map(|(d, a)| dot(*d, *a)).sum();
            if curvature <= 0.0 || !curvature.is_finite() {
                return (step, iteration);
            }
            let factor = square / curvature;
            step.iter_mut().zip(&direction).for_each(|(s, d)| *s = add(*s, factor, *d));
            residual.iter_mut().zip(&image).for_each(|(r, a)| *r = add(*r, -factor, *a));
            before = square;
        }
        (step, INNER)
    }

    /// An exchange of the sets and a Newton step, if the energy falls; and the number of iterations.
    fn exchange(&mut self, at: &mut SlipIterate, shift: Pair, reduction: f64, is_guarded: &mut bool) -> usize {
        let free = self.sets(at, shift);
        let (step, iterations) = self.newton(at, &free, reduction);
        let trial = |part: f64| {
            let nodes = at.tau.iter().zip(&step).zip(&self.discs.radii).zip(free.along.iter().zip(&free.added));
            let turned = nodes.map(|(((tau, step), radius), (along, added))| {
                let u = scaled(add(*tau, part, *step), radius.recip());
                match along {
                    // beyond the rim by its slip, so that the shift does not take it off the rim
                    Some(_) => scaled(u, (1.0 + added * radius / self.length) / length(u)),
                    None => u,
                }
            });
            turned.collect::<Vec<Pair>>()
        };
        let (mut whole, mut quarter) = (trial(1.0), trial(0.25));
        self.discs.carry(&mut whole);
        let first = self.compare(at, whole, shift);
        if first.falls() {
            *at = first.to;
            return iterations + 1;
        }
        self.discs.carry(&mut quarter);
        let second = self.compare(at, quarter, shift);
        *is_guarded = true;
        if second.falls() {
            *at = second.to;
        } else {
            first.take_chord(at);
        }
        iterations + 2
    }

    /// A step along the projected gradient, with the least energy on the chord if it does not fall along all of it, and the factor of
    /// the pace for the next one.
    fn gradient_step(&mut self, at: &mut SlipIterate, shift: Pair, pace: f64) -> f64 {
        let nodes = at.tau.iter().zip(&at.w).zip(&self.discs.radii);
        let against = |w: &Pair| add(shift, -1.0, *w);
        let mut trial: Vec<Pair> = nodes.map(|((tau, w), r)| add(scaled(*tau, r.recip()), pace, against(w))).collect();
        self.discs.carry(&mut trial);
        let chord = self.compare(at, trial, shift);
        let part = chord.part();
        if chord.falls() {
            *at = chord.to;
        } else {
            chord.take_chord(at);
        }
        part.clamp(0.2, 2.0)
    }

    /// The way to another traction of the same sum. The sum of the changes is zero except for rounding, and so the `shift` only keeps
    /// digits.
    fn compare(&mut self, at: &SlipIterate, tau: Vec<Pair>, shift: Pair) -> Chord {
        let w = self.gradient(&tau);
        let (mut slope, mut curvature, mut noise) = (0.0, 0.0, 0.0);
        for (i, (to, w_to)) in tau.iter().zip(&w).enumerate() {
            let change = add(*to, -1.0, at.tau[i]);
            let slip = add(at.w[i], -1.0, shift);
            slope += dot(change, slip);
            noise += NOISE * self.discs.radii[i] * length(slip);
            curvature += dot(change, add(*w_to, -1.0, at.w[i]));
        }
        Chord { slope, curvature, noise, to: SlipIterate { tau, w } }
    }
}

/// The way from an iterate to another one, with the slope and the curvature of the energy along it.
struct Chord {
    slope: f64,
    curvature: f64,
    /// What rounding may add to the energy.
    noise: f64,
    to: SlipIterate,
}

impl Chord {
    /// Whether the energy is lower at the other end, as far as rounding lets one see.
    fn falls(&self) -> bool {
        self.slope + 0.5 * self.curvature <= ENOUGH * self.slope.min(0.0) + self.noise
    }

    /// Where the energy is least along the way, in parts of it; zero if it does not fall.
    fn part(&self) -> f64 {
        if self.slope < 0.0 { -self.slope / self.curvature.max(f64::MIN_POSITIVE) } else { 0.0 }
    }

    /// Goes where the energy is least.
    fn take_chord(self, at: &mut SlipIterate) {
        let part = self.part().min(1.0);
        if part >= 1.0 {
            *at = self.to;
            return;
        }
        let mix = |at: &mut [Pair], to: &[Pair]| {
            at.iter_mut().zip(to).for_each(|(at, to)| *at = add(scaled(*at, 1.0 - part), part, *to));
        };
        mix(&mut at.tau, &self.to.tau);
        mix(&mut at.w, &self.to.w);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Grid;
    use crate::elastic::{HalfSpace, ShearCompliance};

    /// A Hertzian pressure that is pulled along `x` and pushed along `y`, after another pull.
    fn with_step<T>(work: impl FnOnce(&mut VectorStep<'_>) -> T) -> T {
        let grid = Grid::surface([15, 15], [2.4, 2.4]).unwrap().with_periodic([false; 2]);
        let compliance = ShearCompliance::new(&grid, HalfSpace::new(1.0).into(), 0.6).unwrap();
        let mut response = ShearResponse::new(compliance.into());
        let pressure = |i: usize| {
            let [y, x] = [i / 15, i % 15].map(|i| 0.16 * (i as f64 - 7.0));
            (1.0 - x * x - y * y).max(0.0).sqrt()
        };
        let places: Vec<usize> = (0..225).filter(|&i| pressure(i) > 0.0).collect();
        let radii: Vec<f64> = places.iter().map(|&i| pressure(i)).collect();
        let most: f64 = radii.iter().sum();
        let before = places.iter().map(|&i| [0.01 * (i % 4) as f64, 0.02 * (i % 7) as f64]).collect();
        let discs = Discs { radii, total: [0.5 * most, -0.4 * most] };
        work(&mut VectorStep::new(&mut response, places, discs, before, 0.5))
    }

    fn energy(step: &VectorStep<'_>, at: &SlipIterate) -> f64 {
        let terms = at.tau.iter().zip(&at.w).zip(&step.before);
        terms.map(|((tau, w), before)| 0.5 * dot(*tau, add(*w, -1.0, *before))).sum()
    }

    #[test]
    fn gradient_steps_alone_lower_the_energy_and_reach_the_solution() {
        let stop = Stop::new(1e-13, 100_000).unwrap();
        let start = |step: &VectorStep<'_>| vec![[0.0; 2]; step.discs.len()];
        let exact = with_step(|step| step.solve(&start(step), &stop, &mut ()));
        assert_eq!(exact.status, Status::Converged);
        assert!(exact.iterations < 150, "{}", exact.iterations);
        with_step(|step| {
            step.gradient_only = true;
            let found = step.solve(&start(step), &Stop::new(1e-7, 100_000).unwrap(), &mut ());
            assert_eq!(found.status, Status::Converged);
            let most = exact.tau.iter().fold(0.0, |most: f64, tau| most.max(length(*tau)));
            let apart = exact.tau.iter().zip(&found.tau).map(|(a, b)| length(add(*a, -1.0, *b))).fold(0.0, f64::max);
            assert!(apart < 1e-4 * most, "{apart:e} of {most:e}");
        });
        with_step(|step| {
            let mut tau = start(step);
            step.discs.carry(&mut tau);
            let w = step.gradient(&tau);
            let (mut at, mut pace, mut last) = (SlipIterate { tau, w }, 2.0, f64::INFINITY);
            for _ in 0..300 {
                pace *= step.gradient_step(&mut at, [0.0; 2], pace);
                let now = energy(step, &at);
                assert!(now <= last + 1e-13 * now.abs(), "{now} after {last}");
                last = now;
            }
            let w = step.gradient(&exact.tau);
            let least = energy(step, &SlipIterate { tau: exact.tau.clone(), w });
            assert!((last / least - 1.0).abs() < 1e-9, "{last} against {least}");
        });
    }

    /// The directions that are left have the sum zero, and what is taken away is a gradient of the sums.
    #[test]
    fn directions_are_balanced_on_rims_as_well() {
        with_step(|step| {
            let tau: Vec<Pair> = step.discs.radii.iter().map(|r| [0.6 * r, -0.8 * r]).collect();
            let w = tau.iter().enumerate().map(|(i, tau)| scaled(*tau, (i as f64).sin())).collect();
            let free = step.sets(&SlipIterate { tau, w }, [0.0; 2]);
            let count = free.along.iter().flatten().count();
            assert!(count > 10 && count + 10 < step.discs.len());
            let mut vectors: Vec<Pair> = (0..step.discs.len()).map(|i| [(i % 5) as f64, (i % 3) as f64]).collect();
            free.balance(&mut vectors);
            let sum = vectors.iter().fold([0.0; 2], |sum, vector| add(sum, 1.0, *vector));
            assert!(length(sum) < 1e-11, "{sum:?}");
            let mut again = vectors.clone();
            free.balance(&mut again);
            assert!(vectors.iter().zip(&again).all(|(a, b)| length(add(*a, -1.0, *b)) < 1e-12));
        });
    }
}
