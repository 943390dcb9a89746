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

/// The least change before and after a turn of the mean, as a part of the largest mean: what is less does not count, and may be rounding where a solid is
/// relaxed.
const SMALL_TURN: f64 = 1e-6;

/// Halvings of the distance of two places to find a turn between them to the last bits.
const HALVINGS: usize = 50;

impl StepProfile {
    /// A straight line.
    pub(crate) fn straight(dt: f64) -> Self {
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
    pub(crate) fn of_load(dt: f64, loads: [f64; 2], strains: &[MeanStrain]) -> Option<Self> {
        let course = Self::course(dt, loads, strains);
        let change = course.at(dt);
        if !(change.is_finite() && change != 0.0) {
            return None;
        }
        let profile = Self {
            dt,
            linear: course.linear / change,
            fading: course.fading.iter().map(|it| Fading { coefficient: it.coefficient / change, ..*it }).collect(),
        };
        profile.rises().then_some(profile)
    }

    /// The first time within a step at which the mean effective pressure turns, as [`StepProfile::of_load`] has it; none where it rises or falls all
    /// the way, but for what is short beside the shortest time or small beside the mean.
    pub(crate) fn turn_of_load(dt: f64, loads: [f64; 2], strains: &[MeanStrain]) -> Option<f64> {
        let course = Self::course(dt, loads, strains);
        let places = course.places();
        let is_rising = course.slope(places[0]) > 0.0;
        let has_turned = |s: f64| (course.slope(s) > 0.0) != is_rising;
        let i = places.iter().position(|&s| has_turned(s))?;
        let [mut before, mut after] = [places[i - 1], places[i]];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (before + after);
            if has_turned(middle) {
                after = middle;
            } else {
                before = middle;
            }
        }
        let size = loads[0].abs().max(loads[1].abs()) * (1.0 + strains.iter().map(|it| it.ratio).sum::<f64>());
        let [there, end] = [after, dt].map(|s| course.at(s));
        (there.abs().min((end - there).abs()) > SMALL_TURN * size).then_some(after)
    }

    /// The change of the mean effective pressure in the course of a step, in place of a profile.
    fn course(dt: f64, [begin, end]: [f64; 2], strains: &[MeanStrain]) -> Self {
        let growth = (end - begin) / dt;
        let linear = (end - begin) * (1.0 + strains.iter().map(|it| it.ratio).sum::<f64>());
        let fading = strains.iter().map(|it| Fading {
            coefficient: it.ratio * begin - it.strain - it.ratio * growth * it.time,
            time: it.time,
        });
        Self { dt, linear, fading: fading.collect() }
    }

    /// `phi(s)`.
    fn at(&self, s: f64) -> f64 {
        let fading = |it: &Fading| -it.coefficient * (-s / it.time).exp_m1();
        self.linear * s / self.dt + self.fading.iter().map(fading).sum::<f64>()
    }

    /// `phi'(s)`.
    fn slope(&self, s: f64) -> f64 {
        let fading = |it: &Fading| it.coefficient / it.time * (-s / it.time).exp();
        self.linear / self.dt + self.fading.iter().map(fading).sum::<f64>()
    }

    /// Whether the profile rises from place to place.
    fn rises(&self) -> bool {
        let values: Vec<f64> = self.places().iter().map(|&s| self.at(s)).collect();
        let allowed = 1e-9;
        values[0] >= -allowed && values.windows(2).all(|pair| pair[1] >= pair[0] - allowed)
    }

    /// Places at which a profile is looked at, up to the end of the step. They become denser towards the beginning, where short times end.
    fn places(&self) -> Vec<f64> {
        let shortest = self.shortest_time().min(self.dt);
        let ratio = (self.dt / (0.01 * shortest)).powf(1.0 / f64::from(PLACES));
        (0..=PLACES).map(|i| self.dt * ratio.powi(i - PLACES)).collect()
    }

    /// The length of the step.
    pub(crate) fn dt(&self) -> f64 {
        self.dt
    }

    /// The shortest time on which the profile changes; infinite for a straight line.
    pub(crate) fn shortest_time(&self) -> f64 {
        self.fading.iter().map(|it| it.time).fold(f64::INFINITY, f64::min)
    }

    /// What an element of the relaxation time `rho` holds at `s` of what the profile brings:
    /// `psi(s) = int_0^s exp(-(s - r)/rho) phi'(r) dr`. For a step without time it is 1.
    pub(crate) fn held(&self, s: f64, rho: f64) -> f64 {
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

    /// One element under a load that falls from a sudden first value: `P_e' = P' (1 + f) + (f P_0 - f P' tau)/tau exp(-s/tau)` is zero at
    /// `s = tau ln (f (P_0/tau - P') / (-P' (1 + f)))`.
    #[test]
    fn a_mean_that_turns_is_found_where_its_slope_is_zero() {
        let (f, tau, dt, loads) = (3.0, 2.0, 30.0, [1.0, 0.4]);
        let strains = [MeanStrain { ratio: f, time: tau, strain: 0.0 }];
        let slope = (loads[1] - loads[0]) / dt;
        let expected = tau * (f * (loads[0] / tau - slope) / (-slope * (1.0 + f))).ln();
        let turn = StepProfile::turn_of_load(dt, loads, &strains).expect("it creeps on, and then falls");
        assert!((turn / expected - 1.0).abs() < 1e-9, "{turn} {expected}");
        // from there on it falls all the way
        let at_turn = loads[0] + slope * turn;
        let strain = f * (at_turn - slope * tau) - f * (loads[0] - slope * tau) * (-turn / tau).exp();
        let strains = [MeanStrain { ratio: f, time: tau, strain }];
        assert!(StepProfile::turn_of_load(dt - turn, [at_turn, loads[1]], &strains).is_none());
        assert!(StepProfile::turn_of_load(dt, [1.0, 1.4], &strains).is_none());
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
