//! The smooth part of `1/r`.

use std::f64::consts::PI;

/// `g(r) = S(r/R) / r`, which is `1/r` beyond the radius `R` and smooth within, with the step
///
/// `S(t) = t + sum_m a_m sin(m pi t)` for `0 <= t <= 1`, `a_m = 2 w(m pi) / (m pi w(0))`,
///
/// the integral of the Kaiser-Bessel window with the transform `w(k) = sinh(s)/s`, `s^2 = c^2 - k^2`. It consists of
/// waves below `c/R`, but for a part of about `exp(-c)`.
///
/// # Source
/// Kaiser & Schafer, IEEE Trans. Acoust. 28, 105 (1980).
pub(super) struct FarKernel {
    radius: f64,
    /// `a_m`.
    terms: Vec<f64>,
}

impl FarKernel {
    /// The kernel of a radius, with the `sharpness` `c`.
    pub(crate) fn new(radius: f64, sharpness: f64) -> Self {
        let transform = |k: f64| {
            let s = (sharpness * sharpness - k * k).sqrt();
            s.sinh() / s
        };
        let waves = (1..).map(|m| PI * f64::from(m)).take_while(|&k| k < sharpness);
        Self { radius, terms: waves.map(|k| 2.0 * transform(k) / (k * transform(0.0))).collect() }
    }

    /// The radius beyond which it is `1/r`.
    pub(crate) fn radius(&self) -> f64 {
        self.radius
    }

    /// The step from zero at `t = 0` to one at `t = 1`.
    pub(crate) fn step(&self, t: f64) -> f64 {
        if t >= 1.0 {
            return 1.0;
        }
        // sin(m x) by the recurrence of Chebyshev
        let (sine, twice) = ((PI * t).sin(), 2.0 * (PI * t).cos());
        let waves =
            self.terms.iter().fold([t, 0.0, sine], |[sum, last, wave], a| [sum + a * wave, wave, twice * wave - last]);
        waves[0]
    }

    /// The value at a distance.
    pub(crate) fn at(&self, r: f64) -> f64 {
        if r > 0.0 {
            return self.step(r / self.radius) / r;
        }
        let slope: f64 = (1..).zip(&self.terms).map(|(m, a)| PI * f64::from(m) * a).sum();
        (1.0 + slope) / self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_smooth_and_ends_at_the_radius() {
        let far = FarKernel::new(2.0, 28.0);
        assert_eq!([far.at(2.0), far.at(5.0)], [0.5, 0.2]);
        for (r, near) in [(0.0, 1e-7), (1.0, 1.0 + 1e-9), (2.0, 2.0 - 1e-9)] {
            assert!((far.at(r) - far.at(near)).abs() < 1e-8, "{r}");
        }
        let rises = (1..200).all(|i| far.step(f64::from(i) / 200.0) > far.step(f64::from(i - 1) / 200.0));
        assert!(rises && far.step(0.0) == 0.0);
    }
}
