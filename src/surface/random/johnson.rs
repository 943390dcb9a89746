//! Johnson's system of distributions.

use std::f64::consts::TAU;

/// Normal scores over which moments of bounded distributions are summed: from minus to plus this.
const WIDEST: f64 = 10.0;
/// Values in these sums.
const VALUES: usize = 1001;
/// Halvings of an interval.
const HALVINGS: usize = 44;
/// The smallest and the largest shape `delta` that is tried.
const SHAPES: [f64; 2] = [0.02, 1e4];
/// The largest shift `gamma` over the shape.
const FARTHEST: f64 = 40.0;

/// A distribution of Johnson's system with a skewness and a kurtosis: a function of a normal score `z`, with `u = (z + gamma) / delta`,
///
/// ```text
/// sinh(u)          unbounded, heavier tails than those of a lognormal distribution of the same skewness
/// 1 / (1 + e^-u)   bounded, lighter tails
/// ```
///
/// Both together reach every pair of a skewness and a kurtosis that a distribution can have.
///
/// Source: Johnson, Biometrika 36:149, 1949; Hill, Hill & Holder, Appl. Stat. 25:180, 1976.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Johnson {
    is_bounded: bool,
    gamma: f64,
    delta: f64,
    sign: f64,
}

impl Johnson {
    /// The distribution of a skewness and a kurtosis, if there is one within rounding of what is searched.
    pub(crate) fn from_moments(skewness: f64, kurtosis: f64) -> Option<Self> {
        let sign = if skewness < 0.0 { -1.0 } else { 1.0 };
        let (is_bounded, delta) = shape(skewness.abs(), kurtosis)?;
        let gamma = shift(is_bounded, delta, skewness.abs())?;
        let found = Self { is_bounded, gamma, delta, sign };
        let [_, reached] = moments(is_bounded, delta, gamma);
        ((reached / kurtosis - 1.0).abs() < 1e-6).then_some(found)
    }

    /// The value at a normal score.
    pub(crate) fn value(&self, score: f64) -> f64 {
        self.sign * translated(self.is_bounded, (self.sign * score + self.gamma) / self.delta)
    }
}

fn translated(is_bounded: bool, u: f64) -> f64 {
    if is_bounded { 1.0 / (1.0 + (-u).exp()) } else { u.sinh() }
}

/// The kind and the shape of the distribution. At the shape of a lognormal distribution of this skewness both kinds end.
fn shape(skewness: f64, kurtosis: f64) -> Option<(bool, f64)> {
    let of = |is_bounded: bool, delta: f64| {
        shift(is_bounded, delta, skewness).map(|gamma| moments(is_bounded, delta, gamma)[1])
    };
    let limit = lognormal_shape(skewness);
    let at_limit = match limit < SHAPES[1] {
        true => lognormal(limit)[1],
        false => 3.0,
    };
    let is_bounded = kurtosis < at_limit;
    // towards the limit the kurtosis of bounded distributions rises, and that of unbounded ones falls
    let first = if is_bounded { SHAPES[0] } else { 0.1 };
    let [mut low, mut high] = [first, limit.min(SHAPES[1])];
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        let is_above = of(is_bounded, middle).is_none_or(|found| found.is_nan() || found > kurtosis);
        if is_above == is_bounded { high = middle } else { low = middle }
    }
    Some((is_bounded, (low * high).sqrt())).filter(|(_, delta)| delta.is_finite())
}

/// The shift at which a distribution of some shape has a skewness that is not negative, if there is one.
fn shift(is_bounded: bool, delta: f64, skewness: f64) -> Option<f64> {
    if skewness == 0.0 {
        return Some(0.0);
    }
    // a shift to the left skews a bounded distribution to the right, and an unbounded one is skewed by a shift to the right
    let side = if is_bounded { -1.0 } else { 1.0 };
    let [mut low, mut high] = [0.0, FARTHEST * delta.max(1.0)];
    if moments(is_bounded, delta, side * high)[0] < skewness {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if moments(is_bounded, delta, side * middle)[0] < skewness { low = middle } else { high = middle }
    }
    Some(side * 0.5 * (low + high))
}

/// Skewness and kurtosis of a lognormal distribution of the shape `delta`.
fn lognormal(delta: f64) -> [f64; 2] {
    let w = delta.powi(-2).exp();
    [(w + 2.0) * (w - 1.0).sqrt(), w.powi(4) + 2.0 * w.powi(3) + 3.0 * w.powi(2) - 3.0]
}

/// The shape at which a lognormal distribution has a skewness, at most the largest one.
fn lognormal_shape(skewness: f64) -> f64 {
    let [mut low, mut high] = SHAPES;
    for _ in 0..2 * HALVINGS {
        let middle = (low * high).sqrt();
        if lognormal(middle)[0] > skewness { low = middle } else { high = middle }
    }
    high
}

/// Skewness and kurtosis.
fn moments(is_bounded: bool, delta: f64, gamma: f64) -> [f64; 2] {
    if is_bounded { bounded_moments(delta, gamma) } else { unbounded_moments(delta, gamma) }
}

/// Of `sinh((z + gamma) / delta)`, from `<e^(n u)> = exp(n gamma / delta + n^2 / (2 delta^2))`.
fn unbounded_moments(delta: f64, gamma: f64) -> [f64; 2] {
    let (w, shift) = (delta.powi(-2).exp(), gamma / delta);
    let variance = 0.5 * (w - 1.0) * (w * (2.0 * shift).cosh() + 1.0);
    let third = w.sqrt() * (w - 1.0).powi(2) * (w * (w + 2.0) * (3.0 * shift).sinh() + 3.0 * shift.sinh()) / 4.0;
    let fourth = (w - 1.0).powi(2)
        * (w.powi(2) * (w.powi(4) + 2.0 * w.powi(3) + 3.0 * w.powi(2) - 3.0) * (4.0 * shift).cosh()
            + 4.0 * w.powi(2) * (w + 2.0) * (2.0 * shift).cosh()
            + 3.0 * (2.0 * w + 1.0))
        / 8.0;
    [third / variance.powf(1.5), fourth / variance.powi(2)]
}

/// Of the bounded distribution, by sums over normal scores.
fn bounded_moments(delta: f64, gamma: f64) -> [f64; 2] {
    let step = 2.0 * WIDEST / (VALUES - 1) as f64;
    let scores = || (0..VALUES).map(|i| step * i as f64 - WIDEST);
    let weight = |score: f64| step * (-0.5 * score * score).exp() / TAU.sqrt();
    let value = |score: f64| translated(true, (score + gamma) / delta);
    let mean: f64 = scores().map(|z| weight(z) * value(z)).sum();
    let central = |power: i32| scores().map(|z| weight(z) * (value(z) - mean).powi(power)).sum::<f64>();
    let variance = central(2);
    [central(3) / variance.powf(1.5), central(4) / variance.powi(2)]
}
