//! Zeros of the rational functions that turn creep into relaxation and back.
//!
//! Letters of this file: `a_j = 1 / tau_j` the rates of the poles, growing with `j`; `x` a rate; `z` the place of a zero from
//! the pole `k`, `x = a_k (1 + z)`. In units of `a_k` the distance `a_j - x` is `(tau_k - tau_j - z tau_j) / tau_j`, which has
//! all digits also next to a pole.

/// A pole of a rational function, or its zero as a pole of the reciprocal: a ratio and the reciprocal of a rate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pole {
    pub ratio: f64,
    pub time: f64,
}

/// The poles of the compliance, for a stiffness `1 - sum_j g_j a_j / (a_j - x)` with `left = 1 - sum_j g_j`. The poles are
/// ordered by falling times.
///
/// The stiffness is written as `left - sum_j g_j x / (a_j - x)`, without cancellation for slow rates. It falls between poles, so
/// there is one zero below each of them.
pub(super) fn zeros_of_stiffness(poles: &[Pole], left: f64) -> Vec<Pole> {
    let at = |k: usize, z: f64| {
        let term = |pole: &Pole| pole.ratio * (1.0 + z) * pole.time / distance(poles[k].time, pole.time, z);
        left - poles.iter().map(term).sum::<f64>()
    };
    let first = |y: f64| {
        let longest = poles[0].time;
        left - poles.iter().map(|pole| pole.ratio * y / (longest / pole.time - y)).sum::<f64>()
    };
    let zero = |k: usize| {
        if k > 0 {
            return between(poles, k - 1, |k, z| -at(k, z));
        }
        // between zero and the slowest pole: x = a_0 y
        if first(0.5) > 0.0 {
            let z = -bisected(0.5, |z| at(0, -z));
            return pole_at(poles, 0, z);
        }
        let (y, longest) = (bisected(0.5, |y| -first(y)), poles[0].time);
        let term = |pole: &Pole| pole.ratio * (longest / pole.time) / (longest / pole.time - y).powi(2);
        Pole { ratio: 1.0 / (y * poles.iter().map(term).sum::<f64>()), time: longest / y }
    };
    (0..poles.len()).map(zero).collect()
}

/// The poles of the stiffness, for a compliance `1 + sum_j f_j a_j / (a_j - x)`. The poles are ordered by falling times. The
/// compliance grows between poles, so there is one zero above each of them.
pub(super) fn zeros_of_compliance(poles: &[Pole]) -> Vec<Pole> {
    let at = |k: usize, z: f64| {
        let time = poles[k].time;
        1.0 + poles.iter().map(|pole| pole.ratio * time / distance(time, pole.time, z)).sum::<f64>()
    };
    let zero = |k: usize| {
        if k + 1 < poles.len() {
            return between(poles, k, at);
        }
        // beyond the fastest pole the compliance is no less than 1 - sum f / z
        let most = 2.0 * poles.iter().map(|pole| pole.ratio).sum::<f64>();
        pole_at(poles, k, bisected(most, |z| at(k, z)))
    };
    (0..poles.len()).map(zero).collect()
}

/// `tau_j (a_j - x) / a_k`.
fn distance(time_k: f64, time_j: f64, z: f64) -> f64 {
    (time_k - time_j) - z * time_j
}

/// The zero between the poles `k` and `k + 1`, between which `rising(pole, z)` rises, from the nearer pole.
fn between(poles: &[Pole], k: usize, rising: impl Fn(usize, f64) -> f64) -> Pole {
    let [slow, fast] = [poles[k].time, poles[k + 1].time];
    let half = 0.5 * (slow - fast) / fast;
    if rising(k, half) >= 0.0 {
        return pole_at(poles, k, bisected(half, |z| rising(k, z)));
    }
    let half = 0.5 * (slow - fast) / slow;
    pole_at(poles, k + 1, -bisected(half, |z| -rising(k + 1, -z)))
}

/// The pole of the reciprocal at a zero: its ratio follows from the derivative there.
fn pole_at(poles: &[Pole], k: usize, z: f64) -> Pole {
    let time = poles[k].time;
    let term = |pole: &Pole| {
        let distance = distance(time, pole.time, z);
        pole.ratio * (time / distance) * (pole.time / distance)
    };
    Pole { ratio: 1.0 / ((1.0 + z) * poles.iter().map(term).sum::<f64>()), time: time / (1.0 + z) }
}

/// The place between 0 and `high` where `rising` changes its sign, to rounding: by bisection of the logarithm, so that a
/// place next to 0 has all digits.
fn bisected(mut high: f64, rising: impl Fn(f64) -> f64) -> f64 {
    let mut low = f64::MIN_POSITIVE;
    loop {
        let middle = low.sqrt() * high.sqrt();
        if !(middle > low && middle < high) {
            return high;
        }
        if rising(middle) < 0.0 { low = middle } else { high = middle }
    }
}
