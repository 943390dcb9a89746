//! How the effective pressure goes from the beginning of a step in time to its end.
//!
//! Letters of this file: `s` the time since the beginning of the step, `dt` its length, `phi(s)` the profile.

/// The profile `phi` of a step: `p_e(s) = p_e(0) + phi(s) (p_e(dt) - p_e(0))` in all nodes, with `phi(0) = 0` and `phi(dt) = 1`,
///
/// ```text
/// phi(s) = a s/dt + sum_j c_j (1 - exp(-s/tau_j)),    tau_j the retardation times
/// ```
#[derive(Debug, Clone)]
pub(super) struct StepProfile {
    dt: f64,
    linear: f64,
    fading: Vec<Fading>,
}

/// A part of a profile: `c (1 - exp(-s/tau))`.
#[derive(Debug, Clone, Copy)]
struct Fading {
    coefficient: f64,
    time: f64,
}

/// What is left of a Kelvin element's mean strain, and how the element answers.
#[derive(Debug, Clone, Copy)]
pub(super) struct MeanStrain {
    /// `f`.
    pub ratio: f64,
    /// `tau`.
    pub time: f64,
    /// `<eps>` at the beginning of the step.
    pub strain: f64,
}

/// Places between which a profile is looked at, to see whether it rises all the way.
const PLACES: i32 = 96;

impl StepProfile {
    /// A straight line.
    pub fn straight(dt: f64) -> Self {
        Self { dt, linear: 1.0, fading: Vec::new() }
    }

    /// The course of the mean effective pressure under a mean pressure that changes linearly, from the mean strains of the Kelvin
    /// elements. With `P(s) = P_0 + P' s` and `tau_j d eps_j/dt + eps_j = f_j P`,
    ///
    /// ```text
    /// P_e(s) - P_e(0) = P' s (1 + sum f_j) + sum (f_j P_0 - eps_j - f_j P' tau_j) (1 - exp(-s/tau_j))
    /// ```
    ///
    /// None where this does not rise or fall all the way, since it is no profile then.
    pub fn of_load(dt: f64, [begin, end]: [f64; 2], strains: &[MeanStrain]) -> Option<Self> {
        let growth = (end - begin) / dt;
        let linear = (end - begin) * (1.0 + strains.iter().map(|it| it.ratio).sum::<f64>());
        let fading = strains.iter().map(|it| Fading {
            coefficient: it.ratio * begin - it.strain - it.ratio * growth * it.time,
            time: it.time,
        });
        let course = Self { dt, linear, fading: fading.collect() };
        let change = course.at(dt);
        if !(change.is_finite() && change != 0.0) {
            return None;
        }
        let profile = Self {
            dt,
            linear: linear / change,
            fading: course.fading.iter().map(|it| Fading { coefficient: it.coefficient / change, ..*it }).collect(),
        };
        profile.rises().then_some(profile)
    }

    /// `phi(s)`.
    fn at(&self, s: f64) -> f64 {
        let fading = |it: &Fading| -it.coefficient * (-s / it.time).exp_m1();
        self.linear * s / self.dt + self.fading.iter().map(fading).sum::<f64>()
    }

    /// Whether the profile rises from place to place. The places become denser towards the beginning, where short times end.
    fn rises(&self) -> bool {
        let shortest = self.shortest_time().min(self.dt);
        let ratio = (self.dt / (0.01 * shortest)).powf(1.0 / f64::from(PLACES));
        let place = |i: i32| self.dt * ratio.powi(i - PLACES);
        let values: Vec<f64> = (0..=PLACES).map(|i| self.at(place(i))).collect();
        let allowed = 1e-9;
        values[0] >= -allowed && values.windows(2).all(|pair| pair[1] >= pair[0] - allowed)
    }

    /// The length of the step.
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// The shortest time on which the profile changes; infinite for a straight line.
    pub fn shortest_time(&self) -> f64 {
        self.fading.iter().map(|it| it.time).fold(f64::INFINITY, f64::min)
    }

    /// What an element of the relaxation time `rho` holds at `s` of what the profile brings:
    /// `psi(s) = int_0^s exp(-(s - r)/rho) phi'(r) dr`. For a step without time it is 1.
    pub fn held(&self, s: f64, rho: f64) -> f64 {
        if self.dt == 0.0 {
            return 1.0;
        }
        let fading = |it: &Fading| it.coefficient * (s / it.time) * divided_difference(s / it.time, s / rho);
        self.linear * (s / self.dt) * divided_difference(0.0, s / rho) + self.fading.iter().map(fading).sum::<f64>()
    }
}

/// `(exp(-a) - exp(-b)) / (b - a)`, and its limit `exp(-a)`, for numbers that are not negative.
fn divided_difference(a: f64, b: f64) -> f64 {
    let (least, apart) = (a.min(b), (b - a).abs());
    let mean = if apart == 0.0 { 1.0 } else { -(-apart).exp_m1() / apart };
    (-least).exp() * mean
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean effective pressure by many small steps of fourth order.
    fn integrated(dt: f64, [begin, end]: [f64; 2], strains: &[MeanStrain]) -> f64 {
        let count = 40_000;
        let h = dt / f64::from(count);
        let load = |s: f64| begin + (end - begin) * s / dt;
        let strain = |it: &MeanStrain| {
            let slope = |s: f64, eps: f64| (it.ratio * load(s) - eps) / it.time;
            (0..count).fold(it.strain, |eps, i| {
                let s = f64::from(i) * h;
                let a = slope(s, eps);
                let b = slope(s + 0.5 * h, eps + 0.5 * h * a);
                let c = slope(s + 0.5 * h, eps + 0.5 * h * b);
                eps + h * (a + 2.0 * (b + c) + slope(s + h, eps + h * c)) / 6.0
            })
        };
        end + strains.iter().map(strain).sum::<f64>()
    }

    #[test]
    fn the_profile_of_a_load_is_the_course_of_the_mean() {
        let strains = [(2.0, 0.3, 0.5), (4.0, 5.0, 0.1), (1.0, 0.01, 0.9)];
        let strains = strains.map(|(ratio, time, strain)| MeanStrain { ratio, time, strain });
        let (dt, loads) = (0.7, [1.0, 1.4]);
        let profile = StepProfile::of_load(dt, loads, &strains).expect("the mean rises");
        let first = loads[0] + strains.iter().map(|it| it.strain).sum::<f64>();
        let last = integrated(dt, loads, &strains);
        for part in [0.1, 0.4, 1.0] {
            let s = part * dt;
            let now = integrated(s, [loads[0], loads[0] + part * (loads[1] - loads[0])], &strains);
            let expected = (now - first) / (last - first);
            assert!((profile.at(s) - expected).abs() < 1e-9, "{} {expected}", profile.at(s));
        }
    }

    #[test]
    fn a_mean_that_turns_within_the_step_is_no_profile() {
        // the load falls to zero while the element still creeps on
        let strains = [MeanStrain { ratio: 9.0, time: 1.0, strain: 0.0 }];
        assert!(StepProfile::of_load(1.0, [1.0, 0.2], &strains).is_none());
        assert!(StepProfile::of_load(1.0, [0.0, 0.0], &strains).is_none());
        assert!(StepProfile::of_load(1.0, [1.0, 1.0], &strains).is_some());
    }

    #[test]
    fn what_is_held_obeys_its_differential_equation() {
        let strains =
            [MeanStrain { ratio: 3.0, time: 0.2, strain: 0.0 }, MeanStrain { ratio: 1.0, time: 9.0, strain: 0.0 }];
        let profiles = [StepProfile::straight(1.3), StepProfile::of_load(1.3, [1.0, 1.5], &strains).unwrap()];
        for (profile, rho) in profiles.iter().flat_map(|it| [1e-2, 0.2, 0.2 + 1e-9, 7.0].map(|rho| (it, rho))) {
            for s in [0.01, 0.3, 1.2] {
                let h = 1e-5;
                let slope = |f: &dyn Fn(f64) -> f64| (f(s + h) - f(s - h)) / (2.0 * h);
                let held = profile.held(s, rho);
                let found = slope(&|s| profile.held(s, rho)) + held / rho;
                let expected = slope(&|s| profile.at(s));
                assert!((found - expected).abs() < 1e-6 * expected.abs().max(held / rho), "{found} {expected} {rho}");
            }
        }
    }
}
