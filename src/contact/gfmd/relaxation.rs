//! The relaxation rates of damped motion.

use super::{Gfmd, Masses, Pace};
use crate::contact::Problem;

/// The relaxation of free waves under damped motion: the theoretical decay rate of each.
///
/// A wave of stiffness `k` that no contact holds moves by `w' - w = keep (w - w_before) - add k w / m`, so that from step to step it
/// shrinks by the larger root of
///
/// ```text
/// x^2 - (1 + keep - s k / m / (1 + f)) x + keep = 0,    keep = (1 - f) / (1 + f),    s = dt^2
/// ```
///
/// with the friction `f`. Where the roots are complex the wave oscillates and decays by `sqrt(keep)`, independent of
/// its stiffness; where they are real it creeps, the softer the slower. The contact holds waves longer than its own
/// pattern, which then relax faster; the mean, which nothing but the contact holds, is slower than the longest wave
/// where the contact is small.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relaxation {
    step: f64,
    friction: f64,
    masses: Masses,
    /// Stiffness of the longest and of the shortest wave.
    ends: [f64; 2],
}

impl Relaxation {
    /// The relaxation under some settings; none under FIRE, whose friction changes.
    pub(super) fn new(settings: &Gfmd, problem: &Problem) -> Option<Self> {
        let response = problem.response();
        let stiffness: Vec<f64> = response.stiffnesses().collect();
        let pace = Pace::new(settings, &stiffness);
        let [softest, stiffest] = stiffness
            .iter()
            .filter(|&&k| k > 0.0)
            .fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], &k| [low.min(k), high.max(k)]);
        Some(Self { step: pace.step, friction: pace.friction()?, masses: settings.masses, ends: [softest, stiffest] })
    }

    /// Decrease of the amplitude per step, in decimal digits, for a wave of this stiffness (pressure per length).
    pub fn decades_per_step(&self, stiffness: f64) -> f64 {
        -shrinkage(self.step * self.softness(stiffness), self.friction).log10()
    }

    /// Decrease of the longest wave per step, in digits.
    pub fn slowest_decades_per_step(&self) -> f64 {
        self.decades_per_step(self.ends[0])
    }

    /// Decrease of the longest wave per step at critical damping, in digits: the best possible value.
    pub fn best_decades_per_step(&self) -> f64 {
        let step = self.step * self.softness(self.ends[0]);
        -shrinkage(step, critical(step)).log10()
    }

    /// The damping divided by the critical damping of the longest wave: below 1 it oscillates, above 1 it creeps.
    pub fn damping(&self) -> f64 {
        self.friction / critical(self.step * self.softness(self.ends[0]))
    }

    /// Stiffness of the shortest wave over that of the longest, each over its mass.
    pub fn condition(&self) -> f64 {
        let [softest, stiffest] = self.ends.map(|k| self.softness(k));
        stiffest / softest
    }

    /// Stiffness over mass.
    fn softness(&self, stiffness: f64) -> f64 {
        match self.masses {
            Masses::Uniform => stiffness,
            Masses::Stiffness => 1.0,
        }
    }
}

/// The friction at which the roots of a wave with `step = s k / m` are one.
fn critical(step: f64) -> f64 {
    (step - 0.25 * step * step).max(0.0).sqrt()
}

/// The larger modulus of the roots.
fn shrinkage(step: f64, friction: f64) -> f64 {
    let keep = (1.0 - friction) / (1.0 + friction);
    let half = 0.5 * (1.0 + keep - step / (1.0 + friction));
    let discriminant = half * half - keep;
    if discriminant > 0.0 { half.abs() + discriminant.sqrt() } else { keep.abs().sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{ContactModulus, Load};
    use crate::{Grid, Indenter};

    /// A wave in free flight, moved by the scheme itself, against the roots.
    #[test]
    fn waves_shrink_as_the_roots_say() {
        let sine = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(64, 1.0).unwrap()).unwrap();
        let problem = Problem::new(sine, ContactModulus(1.0), Load::ReducedPressure(0.1)).unwrap();
        for damping in [0.1, 1.0, 10.0] {
            let settings = Gfmd { damping, ..Gfmd::default() };
            let relaxation = Relaxation::new(&settings, &problem).unwrap();
            let k: Vec<f64> = problem.response().stiffnesses().collect();
            let mut pace = Pace::new(&settings, &k);
            for &k in &k[1..] {
                let (mut w, mut dw, mut largest) = (1.0, 0.0, Vec::new());
                for _ in 0..400 {
                    let f = [-k * w];
                    let [keep, add] = pace.push(&f, &[dw], &f);
                    dw = keep * dw + add * f[0];
                    w += dw;
                    largest.push(f64::abs(w).max(1e-200).log10());
                }
                // the envelope of the last hundred steps, in which a swing has its peaks
                let peak =
                    |range: std::ops::Range<usize>| largest[range].iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let found = (peak(200..300) - peak(300..400)) / 100.0;
                let expected = relaxation.decades_per_step(k);
                assert!(
                    (found / expected - 1.0).abs() < 0.15 || found < -1.9,
                    "{damping}, {k}: {found} for {expected}"
                );
            }
            assert!((relaxation.damping() / damping - 1.0).abs() < 0.01);
        }
    }
}
